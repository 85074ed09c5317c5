// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/sender.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

extern "C" {
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include "film/color.h"
#include "film/hdr.h"

namespace vsprite::detail {
namespace {

// Writes a plane as a player shows it, turned clockwise by 0, 90, 180 or 270 degrees; `size` bytes
// a pixel. Returns the end of what it wrote.
std::uint8_t* put_turned(const std::uint8_t* data, std::ptrdiff_t stride, int width, int height,
                         int degrees, int size, std::uint8_t* out) {
  if (degrees == 0) {
    const std::ptrdiff_t row = std::ptrdiff_t{width} * size;
    for (int y = 0; y < height; ++y, out += row) std::copy_n(data + y * stride, row, out);
    return out;
  }
  const bool upright = degrees == 180;
  for (int v = 0; v < (upright ? height : width); ++v)
    for (int u = 0; u < (upright ? width : height); ++u) {
      const int x = degrees == 90 ? v : degrees == 180 ? width - 1 - u : width - 1 - v;
      const int y = degrees == 90 ? height - 1 - u : degrees == 180 ? height - 1 - v : u;
      out = std::copy_n(data + y * stride + x * size, size, out);
    }
  return out;
}

// What the keyer's planes hold of a picture with coverage: the picture over black, full range.
Frame over_black(const Image& picture) {
  Image opaque = picture;
  for (std::size_t i = 0; i < opaque.rgba.size(); i += 4) {
    const int a = opaque.rgba[i + 3];
    for (std::size_t c = 0; c < 3 && a < 255; ++c)
      opaque.rgba[i + c] = static_cast<std::uint8_t>((opaque.rgba[i + c] * a + 127) / 255);
  }
  return to_frame(opaque, 0, {Matrix::Bt601, true, Siting::Center});
}

bool is_wide(const AVFrame& frame) { return frame.color_primaries == AVCOL_PRI_BT2020; }

}  // namespace

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

std::uint8_t* Sender::claim(const FrameHead& head) {
  if (head.width != hello_.width || head.height != hello_.height) return nullptr;
  char grant = 0;
  ssize_t n = 0;
  do n = read(channel_.socket, &grant, 1);
  while (n < 0 && errno == EINTR);
  if (n <= 0) _exit(0);
  if (!ring_.mapped() && !ring_.map(channel_.memory, head.width, head.height))
    throw std::bad_alloc();
  return ring_.next();
}

void Sender::send_frame(const AVFrame& frame, int index) {
  FrameHead head;
  head.kind = Kind::Frame;
  const bool lying = hello_.rotation % 180 != 0;
  head.width = lying ? frame.height : frame.width;
  head.height = lying ? frame.width : frame.height;
  head.index = index;
  if (frame.best_effort_timestamp != AV_NOPTS_VALUE) head.time = frame.best_effort_timestamp;
  head.coding = coding_of(frame);
  head.damaged = frame.decode_error_flags != 0 || (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0;
  if (has_alpha(frame)) return send_coverage(frame, head);
  const auto* format = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  const bool rgb = format && (format->flags & AV_PIX_FMT_FLAG_RGB) != 0;
  if (!rgb && (transfer_of(frame) != Transfer::Sdr || is_wide(frame)))
    return send_mapped(frame, head);
  const AVFrame* shown = &frame;
  if (frame.format != AV_PIX_FMT_YUV420P && frame.format != AV_PIX_FMT_YUVJ420P) {
    if (rgb) head.coding = {Matrix::Bt601, false, Siting::Center};
    shown = &convert(frame, AV_PIX_FMT_YUV420P, head.coding.full_range);
  }
  send_planes(head, {shown->data[0], shown->data[1], shown->data[2]},
              {shown->linesize[0], shown->linesize[1], shown->linesize[2]}, frame.width,
              frame.height);
}

void Sender::send_planes(const FrameHead& upright, const std::uint8_t* const (&planes)[3],
                         const std::ptrdiff_t (&strides)[3], int width, int height) {
  FrameHead head = upright;
  if (hello_.rotation != 0 && head.coding.siting != Siting::Center)
    head.coding.siting = Siting::Unknown;  // it was to the left, and is now above
  if (std::uint8_t* out = claim(head))
    for (int p = 0; p < 3; ++p)
      out = put_turned(planes[p], strides[p], p ? (width + 1) / 2 : width,
                       p ? (height + 1) / 2 : height, hello_.rotation, 1, out);
  send(channel_.socket, &head, sizeof head);
}

// The same matrix and range on both sides: what RGB and what Y'CbCr is, stays so.
const AVFrame& Sender::convert(const AVFrame& frame, AVPixelFormat to, bool full_range) {
  const auto from = static_cast<AVPixelFormat>(frame.format);
  const int flags = SWS_AREA | SWS_BITEXACT | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT;
  scaler_.reset(
      need(sws_getCachedContext(scaler_.release(), frame.width, frame.height, from, frame.width,
                                frame.height, to, flags, nullptr, nullptr, nullptr)));
  const auto* format = av_pix_fmt_desc_get(from);
  if (format && (format->flags & AV_PIX_FMT_FLAG_RGB) == 0) {
    const Matrix matrix = coding_of(frame).matrix;
    const int* table = sws_getCoefficients(matrix == Matrix::Bt709    ? SWS_CS_ITU709
                                           : matrix == Matrix::Bt2020 ? SWS_CS_BT2020
                                                                      : SWS_CS_ITU601);
    const bool to_rgb = to == AV_PIX_FMT_RGBA;
    sws_setColorspaceDetails(scaler_.get(), table, full_range, table, to_rgb || full_range, 0,
                             1 << 16, 1 << 16);
  }
  av_frame_unref(made_.get());
  made_->format = to;
  made_->width = frame.width;
  made_->height = frame.height;
  check_memory(av_frame_get_buffer(made_.get(), 0));
  sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, made_->data,
            made_->linesize);
  return *made_;
}

void Sender::send_coverage(const AVFrame& frame, FrameHead head) {
  const AVFrame& rgba = convert(frame, AV_PIX_FMT_RGBA, head.coding.full_range);
  Image picture{head.width, head.height, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(head.width) *
                      static_cast<std::size_t>(head.height));
  put_turned(rgba.data[0], rgba.linesize[0], frame.width, frame.height, hello_.rotation, 4,
             picture.rgba.data());
  send_picture(picture, head.index, head.time);
}

void Sender::send_picture(const Image& picture, int index, std::int64_t time) {
  const Frame planes = over_black(picture);
  FrameHead head;
  head.kind = Kind::Frame;
  head.width = picture.width;
  head.height = picture.height;
  head.index = index;
  head.time = time;
  head.coding = planes.coding;
  head.has_rgba = 1;
  if (std::uint8_t* out = claim(head))
    for (const auto* plane : {&planes.y, &planes.cb, &planes.cr, &picture.rgba})
      out = std::copy(plane->begin(), plane->end(), out);
  send(channel_.socket, &head, sizeof head);
}

void Sender::send_mapped(const AVFrame& frame, FrameHead head) {
  const AVFrame* deep = &frame;
  if (frame.format != AV_PIX_FMT_YUV420P10LE)
    deep = &convert(frame, AV_PIX_FMT_YUV420P10LE, head.coding.full_range);
  Planes10 planes;
  planes.y = reinterpret_cast<const std::uint16_t*>(deep->data[0]);
  planes.cb = reinterpret_cast<const std::uint16_t*>(deep->data[1]);
  planes.cr = reinterpret_cast<const std::uint16_t*>(deep->data[2]);
  planes.y_stride = deep->linesize[0] / 2;
  planes.color_stride = deep->linesize[1] / 2;
  Frame plain;
  plain.resize(frame.width, frame.height);
  map_to_sdr(planes, transfer_of(frame), head.coding, plain);
  head.coding = plain.coding;
  send_planes(head, {plain.y.data(), plain.cb.data(), plain.cr.data()},
              {plain.width, plain.cell_width(), plain.cell_width()}, frame.width, frame.height);
}

}  // namespace vsprite::detail
