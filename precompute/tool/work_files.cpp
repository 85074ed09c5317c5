// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/work_files.h"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "tool/files.h"
#include "tool/settings.h"

namespace vsprite {
namespace {

constexpr std::size_t kColumnCount = 17;
constexpr std::string_view kTransitionMagic = "VSPTRANS";
constexpr std::string_view kValueMagic = "VSPVALUE";

// ---- samples.csv ----

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + "\"";
}

struct Field {
  std::string text;
  std::size_t column = 1;  ///< of its first character, from 1
};

/// One record of RFC 4180; quoted fields may not hold line breaks.
std::vector<Field> split_line(std::string_view line) {
  std::vector<Field> fields{{{}, 1}};
  bool inside = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (inside && c == '"' && at + 1 < line.size() && line[at + 1] == '"') {
      fields.back().text += line[++at];
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      fields.push_back({{}, at + 2});
    } else {
      fields.back().text += c;
    }
  }
  return fields;
}

/// Reads the fields of one line in order and remembers the first that is wrong.
class RowReader {
 public:
  RowReader(const std::vector<Field>& fields, std::string where)
      : fields_(fields), where_(std::move(where)) {}

  void take(const char* name, int& value, std::int64_t low, std::int64_t high) {
    const Field& field = next();
    std::int64_t parsed = 0;
    if (!whole_field(field, parsed) || parsed < low || parsed > high)
      fail(field, name,
           "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    else
      value = static_cast<int>(parsed);
  }
  void take(const char* name, double& value, double low, double high) {
    const Field& field = next();
    double parsed = 0;
    const char* end = field.text.data() + field.text.size();
    const auto [stop, error] = std::from_chars(field.text.data(), end, parsed);
    if (error != std::errc{} || stop != end || !(parsed >= low && parsed <= high))
      fail(field, name, "a number from " + number_text(low) + " to " + number_text(high));
    else
      value = parsed;
  }
  void take(std::string& value) { value = next().text; }
  const std::string& problem() const noexcept { return problem_; }

 private:
  const Field& next() { return fields_[next_++]; }
  static bool whole_field(const Field& field, std::int64_t& value) {
    const char* end = field.text.data() + field.text.size();
    const auto [stop, error] = std::from_chars(field.text.data(), end, value);
    return error == std::errc{} && stop == end;
  }
  void fail(const Field& field, const char* name, const std::string& due) {
    if (problem_.empty())
      problem_ = where_ + std::to_string(field.column) + ": " + name + " is `" + field.text +
                 "` where " + due + " is due";
  }

  const std::vector<Field>& fields_;
  std::string where_;
  std::string problem_;
  std::size_t next_ = 0;
};

std::string read_row(const std::vector<Field>& fields, const std::string& where, int due_sample,
                     SampleRow& row) {
  constexpr std::int64_t kMany = std::numeric_limits<int>::max();
  constexpr double kFar = 1e9;
  RowReader reader(fields, where);
  reader.take("sample", row.sample, due_sample, due_sample);
  reader.take("clip", row.clip, 0, kMany);
  reader.take("frame", row.frame, 0, kMany);
  reader.take("left", row.left, -kFar, kFar);
  reader.take("top", row.top, -kFar, kFar);
  reader.take("width", row.width, 1e-3, 65536);
  reader.take("height", row.height, 1e-3, 65536);
  reader.take("anchor_x", row.anchor_x, -kFar, kFar);
  reader.take("anchor_y", row.anchor_y, -kFar, kFar);
  reader.take("velocity_x", row.velocity_x, -kFar, kFar);
  reader.take("velocity_y", row.velocity_y, -kFar, kFar);
  reader.take("area", row.area, 0, 1e10);
  reader.take(row.source);
  reader.take(row.tag);
  reader.take("duration", row.duration, 1, 65535);
  reader.take("scale", row.scale, 1e-6, 1e3);
  reader.take("mirror_of", row.mirror_of, -1, due_sample - 1);
  return reader.problem();
}

// ---- the binary tables ----

ByteWriter begin_table(std::string_view magic) {
  ByteWriter writer;
  writer.put_array(std::span(magic.data(), magic.size()));
  writer.put(kTableVersion);
  writer.put(std::uint32_t{0});
  return writer;
}

std::string end_table(ByteWriter writer) {
  writer.put(hash_bytes(writer.bytes()));
  return std::move(writer).take();
}

Error damaged(const std::string& path, const std::string& what, const char* stage) {
  return {ErrorCode::CorruptData, path + ": " + what + ": make it again with `vsprite " + stage +
                                      " --force " + stage + "`"};
}

/// The bytes between head and sum, both checked.
Result<std::string_view> open_table(std::string_view bytes, std::string_view magic,
                                    const std::string& path, const char* stage) {
  constexpr std::size_t kHead = 16, kSum = 8;
  if (bytes.size() < kHead + kSum || bytes.substr(0, 8) != magic)
    return damaged(
        path, "not a file of this kind, or cut off at " + std::to_string(bytes.size()) + " bytes",
        stage);
  std::uint32_t version = 0;
  std::uint64_t sum = 0;
  ByteReader(bytes.substr(8)).get(version);
  ByteReader(bytes.substr(bytes.size() - kSum)).get(sum);
  if (hash_bytes(bytes.substr(0, bytes.size() - kSum)) != sum)
    return damaged(path, "damaged, its sum does not fit its content", stage);
  if (version != kTableVersion)
    return damaged(path,
                   "version " + std::to_string(version) + " where " +
                       std::to_string(kTableVersion) + " is due",
                   stage);
  return bytes.substr(kHead, bytes.size() - kHead - kSum);
}

Error wrong_count(const std::string& path, std::uint64_t found, std::size_t due,
                  const char* stage) {
  return damaged(
      path, std::to_string(found) + " samples where samples.csv has " + std::to_string(due), stage);
}

/// What is wrong with transitions whose counts fit; empty: nothing.
std::string fault_of(const TransitionFile& file, std::size_t samples) {
  const CostTable& costs = file.costs;
  const auto number = [](std::size_t n) { return std::to_string(n); };
  const std::string last = number(samples - 1);
  if (!(file.v0 > 0) || !std::isfinite(file.v0))
    return "v0 is " + number_text(file.v0) + " where a speed above 0 is due";
  if (costs.row_start.front() != 0 || costs.row_start.back() != costs.transitions.size())
    return "its rows run from " + number(costs.row_start.front()) + " to " +
           number(costs.row_start.back()) + " where 0 to " + number(costs.transitions.size()) +
           " are due";
  for (std::size_t i = 0; i < samples; ++i)
    if (costs.row_start[i] > costs.row_start[i + 1])
      return "the row of sample " + number(i) + " ends at " + number(costs.row_start[i + 1]) +
             " where " + number(costs.row_start[i]) + " or more is due";
  for (std::size_t i = 0; i < samples; ++i) {
    const std::string from = "sample " + number(i) + " ";
    if (costs.kept[i] > 1)
      return from + "is kept " + number(costs.kept[i]) + " times where 0 or 1 is due";
    if (costs.kept[i] == 1 && costs.row_start[i] == costs.row_start[i + 1])
      return from + "leads nowhere where a kept one leads to one or more";
    std::int64_t before = -1;
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& t = costs.transitions[e];
      const std::string way = from + "leads to sample " + number(t.to);
      if (t.to >= samples) return way + " where 0 to " + last + " are due";
      if (t.to <= before) return way + " where a row ascends";
      if (costs.kept[i] == 0 || costs.kept[t.to] == 0)
        return way + " where both were to be kept, and one was not";
      if (!(t.cost >= 0) || !std::isfinite(t.cost))
        return way + " at a cost of " + number_text(static_cast<double>(t.cost)) +
               " where 0 or more is due";
      before = t.to;
    }
    if (!(file.skip_costs[i] >= 0))
      return "leaving out what follows " + from + "costs " +
             number_text(static_cast<double>(file.skip_costs[i])) + " where 0 or more is due";
  }
  for (const PairDistance& p : file.pairs)
    if (p.i >= p.j || p.j >= samples)
      return "it pairs samples " + number(p.i) + " and " + number(p.j) + " where two of 0 to " +
             last + " are due, the lower one first";
  return {};
}

}  // namespace

std::string number_text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string format_samples(const std::vector<SampleRow>& rows) {
  std::string out = std::string(kSampleColumns) + "\n";
  for (const SampleRow& row : rows) {
    const auto whole = [&out](int value) { out += std::to_string(value) + ","; };
    const auto real = [&out](double value) { out += number_text(value) + ","; };
    whole(row.sample), whole(row.clip), whole(row.frame);
    real(row.left), real(row.top), real(row.width), real(row.height);
    real(row.anchor_x), real(row.anchor_y), real(row.velocity_x), real(row.velocity_y);
    real(row.area);
    out += csv_text(row.source) + "," + csv_text(row.tag) + ",";
    whole(row.duration), real(row.scale);
    out += std::to_string(row.mirror_of) + "\n";
  }
  return out;
}

Result<std::vector<SampleRow>> parse_samples(const std::string& text, const std::string& path) {
  std::vector<SampleRow> rows;
  std::size_t line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);  // saved by a spreadsheet
    begin = end + 1;
    const std::string where = path + ":" + std::to_string(++line_number) + ":";
    if (line_number == 1) {
      if (line != kSampleColumns)
        return Error{ErrorCode::CorruptData,
                     where + "1: the first line must name the columns " + kSampleColumns};
      continue;
    }
    if (line.empty()) continue;
    const std::vector<Field> fields = split_line(line);
    if (fields.size() != kColumnCount)
      return Error{ErrorCode::CorruptData, where + std::to_string(fields.back().column) + ": " +
                                               std::to_string(fields.size()) + " columns where " +
                                               std::to_string(kColumnCount) + " are due"};
    SampleRow row;
    const std::string problem = read_row(fields, where, static_cast<int>(rows.size()), row);
    if (!problem.empty()) return Error{ErrorCode::CorruptData, problem};
    if (!rows.empty() && row.clip < rows.back().clip)
      return Error{ErrorCode::CorruptData,
                   where + std::to_string(fields[1].column) + ": clip " + fields[1].text +
                       " after clip " + std::to_string(rows.back().clip) + ": clips must ascend"};
    if (!rows.empty() && row.clip == rows.back().clip && row.frame <= rows.back().frame)
      return Error{ErrorCode::CorruptData, where + std::to_string(fields[2].column) + ": frame " +
                                               fields[2].text + " after frame " +
                                               std::to_string(rows.back().frame) +
                                               ": frames must ascend inside a clip"};
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return Error{ErrorCode::CorruptData, path + ":1:1: no sample stands in it"};
  return rows;
}

std::string format_classifier(const Training& training, double moved) {
  std::string out =
      "# Smooth or not: D = sum of weight x feature / threshold; a jump is smooth where D <= 1.\n"
      "# Weights are per unit of the feature and never negative. May be edited: the stages after "
      "it\n"
      "# take it up.\n";
  const auto add = [&out](const std::string& name, double value) {
    std::string number = number_text(value);
    if (number.find_first_of(".e") == std::string::npos) number += ".0";
    out += name + " = " + number + "\n";
  };
  add("threshold", training.classifier.threshold);
  if (moved != 1) {
    out += "# The designer's move: the line lies at threshold x moved.\n";
    add("moved", moved);
  }
  out += "\n[weights]\n";
  for (std::size_t k = 0; k < kFeatureCount; ++k)
    add(kFeatureNames[k], training.classifier.weights[k]);
  return out;
}

Result<Classifier> parse_classifier(const std::string& text, const std::string& path,
                                    double* moved) {
  const auto fault = [&path](const toml::source_position& at, const std::string& what) {
    return Error{ErrorCode::CorruptData, path + ":" + std::to_string(std::max(at.line, 1u)) + ":" +
                                             std::to_string(std::max(at.column, 1u)) + ": " + what};
  };
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed)
    return fault(parsed.error().source().begin, std::string(parsed.error().description()));
  const toml::table& root = parsed.table();
  const auto number = [&](const toml::table& table, std::string_view name,
                          double& value) -> Result<void> {
    const toml::node* node = table.get(name);
    if (node == nullptr)
      return fault(table.source().begin, "`" + std::string(name) + "` is missing");
    const auto found = node->value<double>();
    if (!found || !std::isfinite(*found) || *found < 0)
      return fault(node->source().begin, "`" + std::string(name) + "` must be a number >= 0");
    value = *found;
    return {};
  };
  Classifier classifier;
  if (auto ok = number(root, "threshold", classifier.threshold); !ok) return ok.error();
  if (classifier.threshold <= 0)
    return fault(root.get("threshold")->source().begin, "`threshold` must be above 0");
  double move = 1;
  if (root.contains("moved"))
    if (auto ok = number(root, "moved", move); !ok) return ok.error();
  if (move <= 0) return fault(root.get("moved")->source().begin, "`moved` must be above 0");
  classifier.threshold *= move;
  if (moved != nullptr) *moved = move;
  const toml::table* weights = root["weights"].as_table();
  if (weights == nullptr) return fault(root.source().begin, "the table [weights] is missing");
  const std::vector<std::string> names(kFeatureNames, kFeatureNames + kFeatureCount);
  for (const auto& [key, node] : *weights) {
    if (std::find(names.begin(), names.end(), key.str()) != names.end()) continue;
    const std::string near = nearest_name(key.str(), names);
    return fault(key.source().begin, "no feature is called `" + std::string(key.str()) + "`" +
                                         (near.empty() ? "" : ": did you mean `" + near + "`"));
  }
  for (std::size_t k = 0; k < kFeatureCount; ++k)
    if (auto ok = number(*weights, names[k], classifier.weights[k]); !ok) return ok.error();
  return classifier;
}

std::string format_transitions(const TransitionFile& file) {
  ByteWriter writer = begin_table(kTransitionMagic);
  writer.put(std::uint64_t{file.costs.kept.size()});
  writer.put(std::uint64_t{file.costs.transitions.size()});
  writer.put(std::uint64_t{file.pairs.size()});
  writer.put(file.v0);
  writer.put_array(std::span(file.costs.row_start));
  writer.put_array(std::span(file.costs.transitions));
  writer.put_array(std::span(file.costs.kept));
  writer.put_array(std::span(file.pairs));
  writer.put_array(std::span(file.skip_costs));
  return end_table(std::move(writer));
}

Result<TransitionFile> parse_transitions(const std::string& bytes, const std::string& path,
                                         std::size_t samples) {
  const auto body = open_table(bytes, kTransitionMagic, path, "transitions");
  if (!body) return body.error();
  ByteReader reader(*body);
  std::uint64_t count = 0, transitions = 0, pairs = 0;
  TransitionFile file;
  if (reader.get(count) && count != samples)
    return wrong_count(path, count, samples, "transitions");
  if (!reader.get(transitions) || !reader.get(pairs) || !reader.get(file.v0) ||
      !reader.get_array(file.costs.row_start, count + 1) ||
      !reader.get_array(file.costs.transitions, transitions) ||
      !reader.get_array(file.costs.kept, count) || !reader.get_array(file.pairs, pairs) ||
      !reader.get_array(file.skip_costs, count) || reader.left() != 0)
    return damaged(path, "its counts contradict its size", "transitions");
  if (const std::string fault = fault_of(file, samples); !fault.empty())
    return damaged(path, fault, "transitions");
  return file;
}

namespace {

// The settings of a mode, one after the other, for reading and writing alike.
template <class Mode, class Visit>
bool visit_settings(Mode& m, Visit&& visit) {
  return visit(m.alpha) && visit(m.w1) && visit(m.turn_w1) && visit(m.cap) &&
         visit(m.change_rate) && visit(m.speed_weight) && visit(m.skip_price) &&
         visit(m.exit_angle) && visit(m.dead_angle) && visit(m.bend_cos) && visit(m.bend_sin) &&
         visit(m.stages) && visit(m.headings) && visit(m.power) && visit(m.table_of) &&
         visit(m.served) && visit(m.served_headings) && visit(m.residual) && visit(m.error_bound);
}

}  // namespace

const Solution* ValueFile::find(const std::string& name) const {
  for (const Solution& solution : modes)
    if (solution.mode.name == name) return &solution;
  return nullptr;
}

std::string format_values(ValueFile file) {
  ByteWriter writer = begin_table(kValueMagic);
  std::size_t entries = 0;
  for (const Solution& solution : file.modes)
    entries += 3 * solution.values.size() + solution.mode.arrived.size();
  writer.reserve(4 * entries + 1024 * file.modes.size());
  const auto put = [&writer](auto& array) {
    writer.put_array(std::span(std::as_const(array)));
    array = {};
  };
  const ControlMode& first = file.modes.front().mode;
  writer.put(std::uint64_t{first.next.size() / first.tables()});
  writer.put(std::uint64_t{file.modes.size()});
  for (Solution& solution : file.modes) {
    ControlMode& mode = solution.mode;
    writer.put(static_cast<std::uint32_t>(mode.by_state) |
               static_cast<std::uint32_t>(mode.plays_through) << 1);
    visit_settings(mode, [&](const auto& value) { return writer.put(value), true; });
    put(mode.next);
    put(mode.go);
    put(solution.values);
    put(mode.arrived);
  }
  return end_table(std::move(writer));
}

Result<ValueFile> parse_values(const std::string& bytes, const std::string& path,
                               std::size_t samples) {
  const auto body = open_table(bytes, kValueMagic, path, "solve");
  if (!body) return body.error();
  ByteReader reader(*body);
  std::uint64_t count = 0, modes = 0;
  ValueFile file;
  if (reader.get(count) && count != samples) return wrong_count(path, count, samples, "solve");
  if (!reader.get(modes) || modes < 1 || modes > 16)
    return damaged(path, "it names " + std::to_string(modes) + " modes where 1 to 16 are due",
                   "solve");
  const auto fits = [samples](std::uint32_t to) { return to < samples || to == kNoSample; };
  for (std::uint64_t k = 0; k < modes; ++k) {
    Solution solution;
    ControlMode& mode = solution.mode;
    std::uint32_t flags = 0;
    const bool read =
        reader.get(flags) && visit_settings(mode, [&](auto& value) { return reader.get(value); });
    const bool sound = read && flags < 4 && mode.headings <= kMaxHeadings && mode.stages <= 256;
    const std::uint64_t cells = sound ? mode.tables() * count : 0;
    if (!sound || !reader.get_array(mode.next, cells) || !reader.get_array(mode.go, cells) ||
        !reader.get_array(solution.values, cells) ||
        !reader.get_array(mode.arrived, (flags & 1u) != 0 ? count : 0))
      return damaged(path, "its counts contradict its size", "solve");
    if (!std::all_of(mode.next.begin(), mode.next.end(), fits))
      return damaged(path, "it names a sample that does not exist", "solve");
    mode.by_state = (flags & 1u) != 0;
    mode.plays_through = (flags & 2u) != 0;
    mode.name = mode.by_state ? "responsive" : "paper";
    file.modes.push_back(std::move(solution));
  }
  if (reader.left() != 0) return damaged(path, "its counts contradict its size", "solve");
  return file;
}

}  // namespace vsprite
