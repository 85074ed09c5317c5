// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The optional sections PUPT and PSET (engine/PACK.md): puppets beside a sprite, and the example
// sets of those that have some; written by copying a pack.

#include <array>
#include <bit>
#include <cmath>
#include <set>

#include "pack_copy.h"
#include "vsprite/puppet.h"

namespace vsprite {
namespace detail {
namespace {

constexpr std::uint32_t kMaxPuppets = 256;
constexpr std::uint32_t kMaxArray = 1u << 26;  // numbers in one array
constexpr std::uint64_t kMaxPuppetBytes = std::uint64_t{1} << 30;

Error bad_pupt(const std::string& path, const std::string& what) {
  return {ErrorCode::CorruptData, path + ": PUPT: " + what};
}
Error bad_pset(const std::string& path, const std::string& what) {
  return {ErrorCode::CorruptData, path + ": PSET: " + what};
}

void put_real(Bytes& out, double value) { out.put(std::bit_cast<std::uint64_t>(value)); }

void put_text(Bytes& out, const std::string& text) {
  out.put(static_cast<std::uint32_t>(text.size()));
  out.text(text);
  out.pad_to(4);
}

void put_reals(Bytes& out, const std::vector<double>& values) {
  out.put(static_cast<std::uint32_t>(values.size()));
  for (const double v : values) put_real(out, v);
}

void put_points(Bytes& out, const std::vector<Vec2>& points) {
  out.put(static_cast<std::uint32_t>(points.size()));
  for (const Vec2 p : points) {
    out.put(std::bit_cast<std::uint32_t>(p.x));
    out.put(std::bit_cast<std::uint32_t>(p.y));
  }
}

void put_network(Bytes& out, const RbfNetwork& net) {
  out.put(static_cast<std::uint32_t>(net.kernel));
  out.put(static_cast<std::uint32_t>(net.degree + 1));
  out.put(static_cast<std::uint32_t>(net.dims));
  out.put(static_cast<std::uint32_t>(net.outputs));
  put_real(out, net.width);
  for (const auto* array :
       {&net.period, &net.metric, &net.centers, &net.weights, &net.polynomial, &net.hull})
    put_reals(out, *array);
}

Result<void> put_puppet(Bytes& out, FrameCodec& codec, const Puppet& puppet) {
  put_text(out, puppet.name);
  out.put(static_cast<std::uint32_t>(puppet.parameters.size()));
  for (const PuppetParameter& p : puppet.parameters) {
    put_text(out, p.name);
    for (const double v : {p.low, p.high, p.period}) put_real(out, v);
  }
  out.put(static_cast<std::uint32_t>(puppet.faces.size()));
  for (const Face& face : puppet.faces) {
    out.put(face.count);
    for (const std::uint32_t c : face.corners) out.put(c);
  }
  put_network(out, puppet.net);
  const bool has_map = puppet.view_map.outputs > 0;
  out.put(static_cast<std::uint32_t>((puppet.blends ? 1 : 0) + (has_map ? 2 : 0)));
  if (has_map) put_network(out, puppet.view_map);
  out.put(static_cast<std::uint32_t>(puppet.views.size()));
  for (const PuppetView& view : puppet.views) {
    const auto packed = codec.encode(view.picture);
    put_points(out, view.points);
    out.put(static_cast<std::uint32_t>(view.picture.width));
    out.put(static_cast<std::uint32_t>(view.picture.height));
    out.put(static_cast<std::uint32_t>(packed.size()));
    out.data.insert(out.data.end(), packed.begin(), packed.end());
    out.pad_to(4);
  }
  out.put(static_cast<std::uint32_t>(puppet.links.size()));
  for (const PuppetLink& link : puppet.links) {
    out.put(link.first);
    out.put(link.count);
    out.put(link.parent);
    out.put(link.parameter);
  }
  put_points(out, puppet.offset);
  put_real(out, puppet.motion);
  return {};
}

void put_set(Bytes& out, const ExampleSet& set) {
  put_network(out, set.net);
  put_reals(out, set.median);
  out.put(static_cast<std::uint32_t>(set.joins.size()));
  for (const std::uint32_t join : set.joins) out.put(join);
}

// Takes numbers off the front; once something does not fit, everything is 0.
class Taker {
 public:
  explicit Taker(std::span<const std::uint8_t> bytes) : cursor_(bytes) {}

  template <class T>
  T get() noexcept {
    if (!fits_ || cursor_.left() < sizeof(T)) {
      fits_ = false;
      return T{};
    }
    return cursor_.get<T>();
  }
  double real() noexcept { return std::bit_cast<double>(get<std::uint64_t>()); }
  /// A count of things of at least `bytes` each, checked before memory is taken.
  std::size_t count(std::size_t bytes, std::uint32_t most = kMaxArray) noexcept {
    const auto n = get<std::uint32_t>();
    if (n <= most && std::uint64_t{n} * bytes <= cursor_.left()) return n;
    fits_ = false;
    return 0;
  }
  std::span<const std::uint8_t> take(std::size_t bytes) noexcept {
    if (fits_ && bytes <= cursor_.left()) return cursor_.take(bytes);
    fits_ = false;
    return {};
  }
  std::string text() {
    const std::size_t n = count(1, kMaxText);
    const auto bytes = take((n + 3) / 4 * 4);
    return fits_ ? std::string(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)) : "";
  }
  std::vector<double> reals() {
    std::vector<double> out(count(8));
    for (double& v : out) v = real();
    return out;
  }
  std::vector<Vec2> points() {
    std::vector<Vec2> out(count(8));
    for (Vec2& p : out) {
      p.x = std::bit_cast<float>(get<std::uint32_t>());
      p.y = std::bit_cast<float>(get<std::uint32_t>());
    }
    return out;
  }
  void fail() noexcept { fits_ = false; }
  bool fits() const noexcept { return fits_; }
  std::size_t left() const noexcept { return cursor_.left(); }

 private:
  Cursor cursor_;
  bool fits_ = true;
};

RbfNetwork take_network(Taker& from) {
  RbfNetwork net;
  const auto kernel = from.get<std::uint32_t>(), degree = from.get<std::uint32_t>(),
             dims = from.get<std::uint32_t>(), outputs = from.get<std::uint32_t>();
  if (kernel >= kKernelCount || degree > 2 || dims > kMaxNetworkDims ||
      outputs > 4 * kMaxNetworkDims)
    from.fail();
  if (!from.fits()) return net;
  net.kernel = static_cast<Kernel>(kernel);
  net.degree = static_cast<int>(degree) - 1;
  net.dims = static_cast<int>(dims), net.outputs = static_cast<int>(outputs);
  net.width = from.real();
  for (auto* array :
       {&net.period, &net.metric, &net.centers, &net.weights, &net.polynomial, &net.hull})
    *array = from.reals();
  return net;
}

PuppetView take_view(Taker& from, FrameCodec& codec) {
  PuppetView view;
  view.points = from.points();
  const auto width = from.get<std::uint32_t>(), height = from.get<std::uint32_t>();
  const std::size_t packed = from.count(1);
  const auto bytes = from.take((packed + 3) / 4 * 4);
  const bool sized = width >= 1 && height >= 1 && width <= 65535 && height <= 65535 &&
                     std::uint64_t{width} * height <= kMaxPixels;
  if (!from.fits() || !sized) {
    from.fail();
    return view;
  }
  std::copy_n(bytes.begin(), packed, codec.input(packed).begin());
  if (!codec.decode(static_cast<int>(width), static_cast<int>(height), view.picture)) from.fail();
  return view;
}

Puppet take_puppet(Taker& from, FrameCodec& codec) {
  Puppet puppet;
  puppet.name = from.text();
  puppet.parameters.resize(from.count(28, kMaxHullDims));
  for (PuppetParameter& p : puppet.parameters) {
    p.name = from.text();
    p.low = from.real(), p.high = from.real(), p.period = from.real();
  }
  puppet.faces.resize(from.count(20));
  for (Face& face : puppet.faces) {
    face.count = from.get<std::uint32_t>();
    for (std::uint32_t& c : face.corners) c = from.get<std::uint32_t>();
  }
  puppet.net = take_network(from);
  const auto flags = from.get<std::uint32_t>();
  if (flags > 3) from.fail();
  puppet.blends = (flags & 1) != 0;
  if ((flags & 2) != 0) puppet.view_map = take_network(from);
  const std::size_t views = from.count(16, kMaxPuppets);
  for (std::size_t v = 0; v < views && from.fits(); ++v)
    puppet.views.push_back(take_view(from, codec));
  puppet.links.resize(from.count(16, 64));
  for (PuppetLink& link : puppet.links) {
    link.first = from.get<std::uint32_t>(), link.count = from.get<std::uint32_t>();
    link.parent = from.get<std::int32_t>(), link.parameter = from.get<std::uint32_t>();
  }
  puppet.offset = from.points();
  puppet.motion = from.real();
  return puppet;
}

Result<std::vector<Puppet>> read_puppets(std::span<const std::uint8_t> bytes,
                                         const std::string& path) {
  Taker from(bytes);
  FrameCodec codec;
  std::vector<Puppet> out;
  std::set<std::string> names;
  const std::size_t count = from.count(64, kMaxPuppets);
  for (std::size_t k = 0; k < count; ++k) {
    Puppet parts = take_puppet(from, codec);
    if (!from.fits())
      return bad_pupt(path, "puppet " + std::to_string(k) + " is cut off or holds a wrong count");
    if (parts.name.empty() || !names.insert(parts.name).second)
      return bad_pupt(path, "`" + parts.name + "`: names of 1 to 255 bytes are due, each once");
    auto puppet = make_puppet(std::move(parts));
    if (!puppet) return bad_pupt(path, puppet.error().message);
    out.push_back(std::move(*puppet));
  }
  if (!from.fits()) return bad_pupt(path, "its first count does not fit its bytes");
  if (from.left() != 0)
    return bad_pupt(path, std::to_string(from.left()) + " bytes more than its puppets need");
  return out;
}

ExampleSet take_set(Taker& from) {
  ExampleSet set;
  set.net = take_network(from);
  set.median = from.reals();
  set.joins.resize(from.count(4, kMostSets));
  for (std::uint32_t& join : set.joins) join = from.get<std::uint32_t>();
  return set;
}

Result<void> read_sets(std::span<const std::uint8_t> bytes, const std::string& path,
                       std::span<Puppet> puppets) {
  constexpr std::size_t kLeastBytes = 64;  // of a set: its network's numbers and counts
  Taker from(bytes);
  std::size_t next = 0;
  const std::size_t count = from.count(8 + kLeastBytes, kMaxPuppets);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t index = from.get<std::uint32_t>();
    if (from.fits() && (index < next || index >= puppets.size()))
      return bad_pset(path, "puppet " + std::to_string(index) + " after " + std::to_string(next) +
                                " of " + std::to_string(puppets.size()));
    std::vector<ExampleSet> sets;
    const std::size_t due = from.count(kLeastBytes, kMostSets);
    for (std::size_t s = 0; s < due && from.fits(); ++s) sets.push_back(take_set(from));
    if (!from.fits() || due == 0)
      return bad_pset(path, "the sets of puppet " + std::to_string(index) +
                                " are cut off or hold a wrong count");
    Puppet parts = std::move(puppets[index]);
    parts.sets = std::move(sets);
    auto puppet = make_puppet(std::move(parts));
    if (!puppet) return bad_pset(path, puppet.error().message);
    puppets[index] = std::move(*puppet);
    next = index + 1;
  }
  if (!from.fits()) return bad_pset(path, "its first count does not fit its bytes");
  if (from.left() != 0)
    return bad_pset(path, std::to_string(from.left()) + " bytes more than its sets need");
  return {};
}

Result<std::vector<std::uint8_t>> read_limited(const ByteSource& source,
                                               const SectionEntry& entry) {
  if (entry.bytes <= kMaxPuppetBytes) return read_section(source, entry);
  return Error{ErrorCode::CorruptData, source.name() + ": " + entry.name + ": " +
                                           std::to_string(entry.bytes) +
                                           " bytes, at most 2^30 are due"};
}

Result<std::vector<Puppet>> load(const ByteSource& source, const std::string& path) {
  const auto content = read_table(source);
  if (!content) return content.error();
  std::vector<Puppet> puppets;
  if (const SectionEntry* entry = find_section(*content, "PUPT")) {
    const auto bytes = read_limited(source, *entry);
    if (!bytes) return bytes.error();
    auto read = read_puppets(*bytes, path);
    if (!read) return read;
    puppets = std::move(*read);
  }
  if (const SectionEntry* entry = find_section(*content, "PSET")) {
    const auto bytes = read_limited(source, *entry);
    if (!bytes) return bytes.error();
    if (auto read = read_sets(*bytes, path, puppets); !read) return read.error();
  }
  return puppets;
}

}  // namespace
}  // namespace detail

Result<std::vector<std::uint8_t>> encode_puppets(std::span<const Puppet> puppets) {
  detail::Bytes out;
  detail::FrameCodec codec;
  out.put(static_cast<std::uint32_t>(puppets.size()));
  for (const Puppet& puppet : puppets)
    if (auto put = detail::put_puppet(out, codec, puppet); !put) return put.error();
  out.pad_to(4);
  return std::move(out.data);
}

Result<std::vector<Puppet>> decode_puppets(std::span<const std::uint8_t> bytes,
                                           const std::string& name) {
  try {
    return detail::read_puppets(bytes, name);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, name + ": out of memory while reading puppets"};
  }
}

Result<std::vector<std::uint8_t>> encode_puppet_sets(std::span<const Puppet> puppets) {
  detail::Bytes out;
  std::uint32_t count = 0;
  for (const Puppet& puppet : puppets) count += !puppet.sets.empty();
  if (count == 0) return std::vector<std::uint8_t>{};
  out.put(count);
  for (std::size_t k = 0; k < puppets.size(); ++k) {
    if (puppets[k].sets.empty()) continue;
    out.put(static_cast<std::uint32_t>(k));
    out.put(static_cast<std::uint32_t>(puppets[k].sets.size()));
    for (const ExampleSet& set : puppets[k].sets) detail::put_set(out, set);
  }
  return std::move(out.data);
}

Result<void> decode_puppet_sets(std::span<const std::uint8_t> bytes, const std::string& name,
                                std::span<Puppet> puppets) {
  try {
    return detail::read_sets(bytes, name, puppets);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, name + ": out of memory while reading example sets"};
  }
}

Result<std::vector<Puppet>> load_puppets(const std::string& path) {
  try {
    const auto source = detail::ByteSource::open(path);
    if (!source) return source.error();
    return detail::load(*source, path);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory while reading puppets"};
  }
}

Result<void> save_puppets(const std::string& from, const std::string& to,
                          std::span<const Puppet> puppets) {
  try {
    std::array<PackExtra, 2> sections{{{"PUPT", {}}, {"PSET", {}}}};
    if (!puppets.empty()) {
      auto encoded = encode_puppets(puppets);
      if (!encoded) return encoded.error();
      auto sets = encode_puppet_sets(puppets);
      if (!sets) return sets.error();
      auto read = detail::read_puppets(*encoded, to);
      if (!read) return read.error();
      if (!sets->empty())
        if (auto fits = detail::read_sets(*sets, to, *read); !fits) return fits;
      sections[0].bytes = std::move(*encoded), sections[1].bytes = std::move(*sets);
    }
    const auto source = detail::ByteSource::open(from);
    if (!source) return source.error();
    return detail::copy_with_sections(*source, to, sections);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, to + ": out of memory while writing puppets"};
  }
}

}  // namespace vsprite
