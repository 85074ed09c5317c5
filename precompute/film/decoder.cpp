// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The child is forked, not executed: it needs no program of its own, and it ends with _exit, so
// that nothing of the parent's is torn down twice.
#include "film/decoder.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

namespace vsprite::detail {
namespace {

constexpr rlim_t kChildBytes = rlim_t{4} << 30;  // beyond what the parent had mapped

// Containers in which people keep films. Without the list FFmpeg plays text files as ANSI art and
// follows play lists to other files.
constexpr char kContainers[] =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,mpegvideo,flv,ogg,asf,gif,yuv4mpegpipe,"
    "nut,h264,hevc,m4v,ivf,mxf,dv,rm,swf,obu,apng,webp_pipe";

struct Free {
  void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(SwsContext* p) const { sws_freeContext(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

// Leaves the child with nothing of the parent's but the pipe, and a bound on its memory.
void isolate(int& out, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  std::signal(SIGINT, SIG_IGN);  // the parent decides when work ends
  for (int s : {SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(s, SIG_DFL);
  const int null = open("/dev/null", O_RDWR);
  for (int fd : {0, 1, 2}) dup2(null, fd);
  if (out != 3) dup2(out, 3);
  out = 3;
  close_range(4, ~0u, 0);
  rlimit limit{};
  rlim_t mapped = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
    unsigned long pages = 0;
    if (std::fscanf(statm, "%lu", &pages) == 1)
      mapped = rlim_t{pages} * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    std::fclose(statm);
  }
  limit.rlim_cur = limit.rlim_max = mapped + kChildBytes;
  setrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = limit.rlim_max = 0;
  setrlimit(RLIMIT_CORE, &limit);
}

// Nobody reads any more: there is nothing left to do.
void send(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = write(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(0);
    at += n;
    size -= static_cast<std::size_t>(n);
  }
}

void send_plane(int fd, const std::uint8_t* data, std::ptrdiff_t stride, int width, int height) {
  const auto row = static_cast<std::size_t>(width);
  if (stride == width) return send(fd, data, row * static_cast<std::size_t>(height));
  std::vector<std::uint8_t> packed(row * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    std::copy_n(data + y * stride, row, packed.data() + row * static_cast<std::size_t>(y));
  send(fd, packed.data(), packed.size());
}

void check_memory(int error) {
  if (error == AVERROR(ENOMEM)) throw std::bad_alloc();
}

template <class T>
T* need(T* made) {
  if (!made) throw std::bad_alloc();
  return made;
}

Coding coding_of(const AVFrame& frame) {
  Coding coding;
  switch (frame.colorspace) {
    case AVCOL_SPC_BT709:
      coding.matrix = Matrix::Bt709;
      break;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      coding.matrix = Matrix::Bt2020;
      break;
    case AVCOL_SPC_UNSPECIFIED:  // what players assume of a film without a tag
      coding.matrix = frame.height >= 720 ? Matrix::Bt709 : Matrix::Bt601;
      break;
    default:
      coding.matrix = Matrix::Bt601;
  }
  coding.full_range = frame.color_range == AVCOL_RANGE_JPEG || frame.format == AV_PIX_FMT_YUVJ420P;
  switch (frame.chroma_location) {
    case AVCHROMA_LOC_LEFT:
      coding.siting = Siting::Left;
      break;
    case AVCHROMA_LOC_CENTER:
      coding.siting = Siting::Center;
      break;
    case AVCHROMA_LOC_TOPLEFT:
      coding.siting = Siting::TopLeft;
      break;
    default:
      coding.siting = Siting::Unknown;
  }
  return coding;
}

// A film and its decoder.
class Film {
 public:
  /// False: there is no film in the file.
  bool open(const std::string& path) {
    AVFormatContext* format = need(avformat_alloc_context());
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    av_dict_set(&options, "format_whitelist", kContainers, 0);
    // A name with a colon must not be taken for a protocol.
    const int opened = avformat_open_input(&format, ("file:" + path).c_str(), nullptr, &options);
    av_dict_free(&options);
    check_memory(opened);
    if (opened < 0) return false;
    format_.reset(format);
    if (avformat_find_stream_info(format, nullptr) < 0) return false;
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || !codec) return false;
    for (unsigned s = 0; s < format->nb_streams; ++s)
      if (static_cast<int>(s) != stream_) format->streams[s]->discard = AVDISCARD_ALL;
    decoder_.reset(need(avcodec_alloc_context3(codec)));
    check_memory(avcodec_parameters_to_context(decoder_.get(), stream().codecpar));
    decoder_->flags |= AV_CODEC_FLAG_BITEXACT;  // the same pixels on every machine
    decoder_->idct_algo = FF_IDCT_SIMPLE;
    decoder_->thread_count = 0;  // as many as there are cores; pixels do not depend on it
    decoder_->pkt_timebase = stream().time_base;
    const int started = avcodec_open2(decoder_.get(), codec, nullptr);
    check_memory(started);
    return started >= 0;
  }
  AVStream& stream() const { return *format_->streams[stream_]; }
  AVFormatContext& format() const { return *format_; }
  AVCodecContext& decoder() const { return *decoder_; }

  /// The next packet of the film; false at the end.
  bool next_packet(AVPacket& packet) {
    for (;;) {
      av_packet_unref(&packet);
      const int got = av_read_frame(format_.get(), &packet);
      check_memory(got);
      if (got < 0) return false;
      if (packet.stream_index == stream_) return true;
    }
  }
  /// The next frame of the packets that `wanted` admits; false at the end. A picture that cannot be
  /// decoded is passed over: the count of frames will tell.
  template <class Wanted>
  bool next_frame(AVFrame& frame, Wanted wanted) {
    for (int lost = 0; lost < 1 << 20;) {
      const int got = avcodec_receive_frame(decoder_.get(), &frame);
      check_memory(got);
      if (got >= 0) return true;
      if (got == AVERROR_EOF) return false;
      lost += ended_ ? 1 : 0;
      if (!ended_) feed(wanted);
    }
    return false;
  }

 private:
  template <class Wanted>
  void feed(Wanted wanted) {
    while (!waits_) {
      ended_ = !next_packet(*packet_);
      if (ended_ || wanted(*packet_)) break;
    }
    const int sent = avcodec_send_packet(decoder_.get(), ended_ ? nullptr : packet_.get());
    check_memory(sent);
    waits_ = sent == AVERROR(EAGAIN);
  }

  Owned<AVFormatContext> format_;
  Owned<AVCodecContext> decoder_;
  Owned<AVPacket> packet_{need(av_packet_alloc())};
  int stream_ = -1;
  bool waits_ = false;  // the packet at hand was not taken yet
  bool ended_ = false;  // there are no more packets
};

int rotation_of(const AVStream& stream) {
  const auto* matrix = reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  if (!matrix) return 0;
  const double clockwise = -av_display_rotation_get(matrix);
  if (!std::isfinite(clockwise)) return 0;
  return static_cast<int>(std::lround(clockwise / 90) * 90 % 360 + 360) % 360;
}

Hello describe(const Film& film, const AVFrame& first) {
  AVStream& stream = film.stream();
  Hello hello;
  hello.kind = Kind::Film;
  hello.width = first.width;
  hello.height = first.height;
  hello.fps = av_q2d(av_guess_frame_rate(&film.format(), &stream, nullptr));
  // Frames by the index of the container, or by its claims of time.
  double claimed = static_cast<double>(stream.nb_frames);
  if (stream.nb_frames <= 0) {
    double seconds = 0;
    if (stream.duration != AV_NOPTS_VALUE)
      seconds = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
    else if (film.format().duration != AV_NOPTS_VALUE)
      seconds = static_cast<double>(film.format().duration) / AV_TIME_BASE;
    claimed = seconds * hello.fps + 0.5;
  }
  hello.claimed_frames = claimed >= 1 && claimed < 1e9 ? static_cast<std::int32_t>(claimed) : 0;
  hello.rotation = rotation_of(stream);
  hello.time_numerator = static_cast<std::uint32_t>(stream.time_base.num);
  hello.time_denominator = static_cast<std::uint32_t>(stream.time_base.den);
  hello.coding = coding_of(first);
  if (first.color_trc == AVCOL_TRC_SMPTE2084) hello.transfer = Transfer::Pq;
  if (first.color_trc == AVCOL_TRC_ARIB_STD_B67) hello.transfer = Transfer::Hlg;
  const AVFieldOrder order = stream.codecpar->field_order;
  hello.interlaced = first.interlaced_frame || order == AV_FIELD_TT || order == AV_FIELD_BB ||
                     order == AV_FIELD_TB || order == AV_FIELD_BT;
  if (const auto* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(first.format))) {
    hello.bits = format->comp[0].depth;
    hello.has_alpha = (format->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
    std::strncpy(hello.pixel_format, format->name, sizeof hello.pixel_format - 1);
  }
  return hello;
}

// Frames to the pipe; what is not 8-bit 4:2:0 is made so.
class Sender {
 public:
  explicit Sender(int out) : out_(out) {}
  void send_frame(const AVFrame& frame, int index) {
    FrameHead head;
    head.kind = Kind::Frame;
    head.width = frame.width;
    head.height = frame.height;
    head.index = index;
    if (frame.best_effort_timestamp != AV_NOPTS_VALUE) head.time = frame.best_effort_timestamp;
    head.coding = coding_of(frame);
    head.damaged = frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
    const AVFrame* shown = &frame;
    if (frame.format != AV_PIX_FMT_YUV420P && frame.format != AV_PIX_FMT_YUVJ420P)
      shown = &convert(frame, head.coding);
    send(out_, &head, sizeof head);
    const int cw = (frame.width + 1) / 2;
    const int ch = (frame.height + 1) / 2;
    send_plane(out_, shown->data[0], shown->linesize[0], frame.width, frame.height);
    send_plane(out_, shown->data[1], shown->linesize[1], cw, ch);
    send_plane(out_, shown->data[2], shown->linesize[2], cw, ch);
  }

 private:
  const AVFrame& convert(const AVFrame& frame, Coding& coding) {
    const auto from = static_cast<AVPixelFormat>(frame.format);
    scaler_.reset(need(sws_getCachedContext(scaler_.release(), frame.width, frame.height, from,
                                            frame.width, frame.height, AV_PIX_FMT_YUV420P,
                                            SWS_AREA | SWS_BITEXACT | SWS_ACCURATE_RND, nullptr,
                                            nullptr, nullptr)));
    const auto* format = av_pix_fmt_desc_get(from);
    if (format && (format->flags & AV_PIX_FMT_FLAG_RGB) != 0) {
      coding = {Matrix::Bt601, false, Siting::Center};
    } else {
      const int* table = sws_getCoefficients(SWS_CS_DEFAULT);  // Y'CbCr on both sides: not used
      sws_setColorspaceDetails(scaler_.get(), table, coding.full_range, table, coding.full_range, 0,
                               1 << 16, 1 << 16);
    }
    av_frame_unref(made_.get());
    made_->format = AV_PIX_FMT_YUV420P;
    made_->width = frame.width;
    made_->height = frame.height;
    check_memory(av_frame_get_buffer(made_.get(), 0));
    sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, made_->data,
              made_->linesize);
    return *made_;
  }

  int out_;
  Owned<SwsContext> scaler_;
  Owned<AVFrame> made_{need(av_frame_alloc())};
};

// The film's packets, undecoded: which of them stand for key frames, and when each is shown.
struct Outline {
  std::vector<std::int64_t> times;  // of every shown frame, sorted; kNoTime where there is none
  std::vector<int> keys;            // packet numbers
};

Outline outline_of(const std::string& path) {
  Outline outline;
  Film film;
  if (!film.open(path)) return outline;
  const Owned<AVPacket> packet(need(av_packet_alloc()));
  for (int i = 0; film.next_packet(*packet); ++i) {
    if ((packet->flags & AV_PKT_FLAG_DISCARD) != 0) continue;
    outline.times.push_back(packet->pts == AV_NOPTS_VALUE ? Frame::kNoTime : packet->pts);
    if ((packet->flags & AV_PKT_FLAG_KEY) != 0) outline.keys.push_back(i);
  }
  std::sort(outline.times.begin(), outline.times.end());
  return outline;
}

// `wanted` of `count` things, spread evenly: the middles of as many equal parts.
std::vector<bool> spread(std::size_t count, int wanted) {
  std::vector<bool> chosen(count, count <= static_cast<std::size_t>(wanted));
  for (std::size_t k = 0; count > 0 && k < static_cast<std::size_t>(wanted); ++k)
    chosen[(2 * k + 1) * count / (2 * static_cast<std::size_t>(wanted))] = true;
  return chosen;
}

class Choice {
 public:
  Choice(const std::string& path, const Selection& selection)
      : mode_(selection.mode), length_(selection.length) {
    if (mode_ == Selection::Every) return;
    outline_ = outline_of(path);
    const bool few =
        static_cast<int>(outline_.keys.size()) < std::min(selection.wanted, kLeastKeyFrames);
    by_keys_ = mode_ != Selection::Spread && !few;
    if (by_keys_) key_chosen_ = spread(outline_.keys.size(), selection.wanted);
    if (mode_ == Selection::KeyFrames && few) mode_ = Selection::Spread;
    if (by_keys_) return;
    chosen_ = spread(outline_.times.size(), selection.wanted);
    if (mode_ != Selection::Bursts) return;
    // Runs begin at the chosen frames; none runs into the next.
    for (int i = static_cast<int>(chosen_.size()) - 1; i >= 0; --i)
      for (int k = 1; chosen_[static_cast<std::size_t>(i)] && k < length_; ++k)
        if (const auto next = static_cast<std::size_t>(i + k); next < chosen_.size())
          chosen_[next] = true;
  }
  bool keys_only() const { return mode_ == Selection::KeyFrames; }
  int counted() const { return static_cast<int>(outline_.times.size()); }
  bool admits(const AVPacket& packet) {
    if (!by_keys_) return true;
    const bool shown = (packet.flags & AV_PKT_FLAG_DISCARD) == 0;
    const bool key = (packet.flags & AV_PKT_FLAG_KEY) != 0 && shown;
    if (key && key_chosen_[std::min(key_++, key_chosen_.size() - 1)]) {
      left_ = mode_ == Selection::Bursts ? length_ + kReordered : 1;
      begin_ = index_of(packet.pts);
    } else if (key && mode_ == Selection::KeyFrames) {
      left_ = 0;
    }
    if (mode_ == Selection::KeyFrames && !key) return false;
    if (left_ == 0) return false;
    if (mode_ == Selection::Bursts && key) begins_.push_back(begin_);
    left_ -= shown ? 1 : 0;
    return true;
  }
  /// Whether the frame, the `count`-th decoded, is to be sent, and its number in the film.
  bool sends(const AVFrame& frame, int count, int& index) const {
    index = count;
    if (mode_ == Selection::Every) return true;
    if (!by_keys_)
      return static_cast<std::size_t>(count) < chosen_.size() &&
             chosen_[static_cast<std::size_t>(count)];
    if (frame.best_effort_timestamp != AV_NOPTS_VALUE)
      index = index_of(frame.best_effort_timestamp);
    if (mode_ == Selection::KeyFrames) return true;
    // Behind the run's end frames come with holes between: those that they refer to are not read.
    return std::any_of(begins_.begin(), begins_.end(),
                       [&](int begin) { return index >= begin && index < begin + length_; });
  }

 private:
  static constexpr int kLeastKeyFrames = 24;
  static constexpr int kReordered = 6;  // packets that may stand before an earlier frame's
  int index_of(std::int64_t time) const {
    return static_cast<int>(std::lower_bound(outline_.times.begin(), outline_.times.end(), time) -
                            outline_.times.begin());
  }

  Selection::Mode mode_;
  int length_;
  bool by_keys_ = false;
  Outline outline_;
  std::vector<bool> chosen_, key_chosen_;
  std::size_t key_ = 0;
  int left_ = 0, begin_ = 0;
  std::vector<int> begins_;
};

void decode(int out, const std::string& path, const Selection& selection) {
  av_log_set_level(AV_LOG_QUIET);
  Choice choice(path, selection);
  const auto admits = [&choice](const AVPacket& packet) { return choice.admits(packet); };
  Film film;
  const Owned<AVFrame> frame(need(av_frame_alloc()));
  Hello hello;
  const bool opened = film.open(path);
  if (opened && choice.keys_only()) film.decoder().skip_frame = AVDISCARD_NONKEY;
  if (!opened || !film.next_frame(*frame, admits)) return send(out, &hello, sizeof hello);
  hello = describe(film, *frame);
  hello.counted_frames = choice.counted();
  send(out, &hello, sizeof hello);
  Sender sender(out);
  int count = 0;
  do {
    int index = 0;
    if (choice.sends(*frame, count++, index)) sender.send_frame(*frame, index);
    av_frame_unref(frame.get());
  } while (film.next_frame(*frame, admits));
  const FrameHead end;
  send(out, &end, sizeof end);
}

}  // namespace

void decode_in_child(int out, pid_t parent, const std::string& path, const Selection& selection) {
  isolate(out, parent);
  int status = 0;
  try {
    decode(out, path, selection);
  } catch (const std::bad_alloc&) {
    status = kExitNoMemory;
  } catch (...) {
    status = 70;
  }
  _exit(status);
}

}  // namespace vsprite::detail
