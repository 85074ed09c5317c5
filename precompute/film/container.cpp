// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/container.h"

#include <algorithm>
#include <cmath>
#include <cstring>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

namespace vsprite::detail {
namespace {

// Containers in which people keep films. Without the list FFmpeg plays text files as ANSI art and
// follows play lists to other files.
constexpr char kContainers[] =
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg,mpegvideo,flv,ogg,asf,gif,yuv4mpegpipe,"
    "nut,h264,hevc,m4v,ivf,mxf,dv,rm,swf,obu,apng,webp_pipe";

// FFmpeg's own VP9 decoder passes over a film's second stream of alpha.
const AVCodec* decoder_for(const AVStream& stream, const AVCodec* found) {
  const AVDictionaryEntry* mode = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
  if (!mode || std::string_view(mode->value) != "1") return found;
  const AVCodecID id = stream.codecpar->codec_id;
  const char* name = id == AV_CODEC_ID_VP9 ? "libvpx-vp9" : id == AV_CODEC_ID_VP8 ? "libvpx" : "";
  const AVCodec* other = avcodec_find_decoder_by_name(name);
  return other ? other : found;
}

int rotation_of(const AVStream& stream) {
  const auto* matrix = reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  if (!matrix) return 0;
  const double clockwise = -av_display_rotation_get(matrix);
  if (!std::isfinite(clockwise)) return 0;
  return static_cast<int>(std::lround(clockwise / 90) * 90 % 360 + 360) % 360;
}

// A phone leaves out frames and a screen recorder all that repeat, so that frames divided by
// seconds is less than the rate at which the film runs while it runs: that is the mean of the usual
// gaps. 0 where the time stamps do not tell.
double running_rate(const std::vector<std::int64_t>& times, AVRational tick) {
  std::vector<std::int64_t> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i - 1] == Frame::kNoTime) return 0;
    if (times[i] > times[i - 1]) gaps.push_back(times[i] - times[i - 1]);
  }
  if (gaps.size() < 3) return 0;
  auto sorted = gaps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::int64_t sum = 0, count = 0;
  for (const std::int64_t gap : gaps)
    if (4 * gap >= 3 * *middle && 4 * gap <= 5 * *middle) sum += gap, ++count;
  return static_cast<double>(count) / (static_cast<double>(sum) * av_q2d(tick));
}

bool in_fields(AVFieldOrder order) {
  return order == AV_FIELD_TT || order == AV_FIELD_BB || order == AV_FIELD_TB ||
         order == AV_FIELD_BT;
}

}  // namespace

bool Film::open(const std::string& path) {
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
  codec = decoder_for(stream(), codec);
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

Transfer transfer_of(const AVFrame& frame) {
  if (frame.color_trc == AVCOL_TRC_SMPTE2084) return Transfer::Pq;
  if (frame.color_trc == AVCOL_TRC_ARIB_STD_B67) return Transfer::Hlg;
  return Transfer::Sdr;
}

bool has_alpha(const AVFrame& frame) {
  const auto* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  return format && (format->flags & AV_PIX_FMT_FLAG_ALPHA) != 0;
}

Outline outline_of(const std::string& path) {
  Outline outline;
  Film film;
  if (!film.open(path)) return outline;
  const Owned<AVPacket> packet(need(av_packet_alloc()));
  while (film.next_packet(*packet)) {
    if ((packet->flags & AV_PKT_FLAG_DISCARD) != 0) continue;
    outline.times.push_back(packet->pts == AV_NOPTS_VALUE ? Frame::kNoTime : packet->pts);
    if ((packet->flags & AV_PKT_FLAG_KEY) != 0) outline.keys.push_back(outline.times.back());
  }
  std::sort(outline.times.begin(), outline.times.end());
  return outline;
}

Hello describe(const Film& film, const Outline& outline, const AVFrame& first) {
  AVStream& stream = film.stream();
  Hello hello;
  hello.kind = Kind::Film;
  hello.width = first.width;
  hello.height = first.height;
  hello.interlaced = first.interlaced_frame || in_fields(stream.codecpar->field_order);
  hello.fps = av_q2d(av_guess_frame_rate(&film.format(), &stream, nullptr));
  const double running = hello.interlaced ? 0 : running_rate(outline.times, stream.time_base);
  if (running > 0) hello.fps = running;
  // Frames by the index of the container, or by its claims of time.
  double claimed = static_cast<double>(stream.nb_frames);
  if (stream.nb_frames <= 0) {
    double seconds = 0;
    if (stream.duration != AV_NOPTS_VALUE)
      seconds = static_cast<double>(stream.duration) * av_q2d(stream.time_base);
    else if (film.format().duration != AV_NOPTS_VALUE)
      seconds = static_cast<double>(film.format().duration) / AV_TIME_BASE;
    claimed = seconds * hello.fps + 0.5;
    hello.claims_time = 1;
  }
  hello.claimed_frames = claimed >= 1 && claimed < 1e9 ? static_cast<std::int32_t>(claimed) : 0;
  hello.counted_frames = static_cast<std::int32_t>(outline.times.size());
  hello.rotation = rotation_of(stream);
  if (hello.rotation % 180 != 0) std::swap(hello.width, hello.height);
  hello.time_numerator = static_cast<std::uint32_t>(stream.time_base.num);
  hello.time_denominator = static_cast<std::uint32_t>(stream.time_base.den);
  hello.transfer = transfer_of(first);
  hello.coding = coding_of(first);
  hello.has_alpha = has_alpha(first);
  if (const auto* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(first.format))) {
    hello.bits = format->comp[0].depth;
    std::strncpy(hello.pixel_format, format->name, sizeof hello.pixel_format - 1);
  }
  return hello;
}

}  // namespace vsprite::detail
