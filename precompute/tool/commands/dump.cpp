// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// dump: the numbers behind a sprite, as float64, for NumPy or a spreadsheet.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tool/commands/verbs.h"
#include "tool/labels.h"
#include "tool/pictures.h"
#include "tool/project.h"

namespace vsprite {
namespace {

/// An array of any shape, row-major, and names for the columns of its CSV form.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

Table table_of(std::vector<std::string> columns, std::vector<double> values) {
  const std::size_t rows = values.size() / columns.size();
  return {columns, {rows, columns.size()}, std::move(values)};
}

std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

/// Texts become numbers: 0, 1, ... in the order in which they first stand; an untagged sample's tag
/// is 0.
Table samples_table(const std::vector<SampleRow>& rows) {
  std::vector<std::string> columns;
  std::istringstream names(kSampleColumns);
  for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
  std::vector<std::string> sources, tags{""};
  std::vector<double> values;
  for (const SampleRow& r : rows) {
    const double source = static_cast<double>(index_of(sources, r.source));
    const double tag = static_cast<double>(index_of(tags, r.tag));
    for (const double value :
         {static_cast<double>(r.sample), static_cast<double>(r.clip), static_cast<double>(r.frame),
          r.left, r.top, r.width, r.height, r.anchor_x, r.anchor_y, r.velocity_x, r.velocity_y,
          r.area, source, tag, static_cast<double>(r.duration), r.scale,
          static_cast<double>(r.mirror_of)})
      values.push_back(value);
  }
  return table_of(columns, std::move(values));
}

/// The pairs that `train` learns from: drawn again with the settings of its record, and a person's.
Result<std::vector<Label>> labels_of(const Project& project, const FeatureSet& set,
                                     const Settings& settings) {
  const Json* record = project.record("train");
  if (record == nullptr)
    return Error{ErrorCode::NotFound,
                 project.folder() +
                     ": no classifier has been trained here: run `vsprite train --work " +
                     project.folder() + "`"};
  int count = settings.pairs;
  std::uint64_t seed = settings.seed;
  const Json made = record->value("settings", Json::object());
  if (made.contains("pairs") && made["pairs"].is_number_integer()) count = made["pairs"];
  if (made.contains("seed") && made["seed"].is_number_unsigned()) seed = made["seed"];
  auto labels = folder_labels(project, set, count, seed);
  if (!labels) return labels.error();
  return std::move(labels->labels);
}

Result<std::vector<Label>> read_pairs(const std::string& path, int samples) {
  const auto text = read_file(path);
  if (!text) return text.error();
  std::vector<Label> pairs;
  std::istringstream lines(*text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#' || line.starts_with("i,j")) continue;
    Label pair;
    char comma = 0, rest = 0;
    std::istringstream fields(line);
    const bool read =
        static_cast<bool>(fields >> pair.i >> comma >> pair.j) && comma == ',' && !(fields >> rest);
    if (!read || pair.i < 0 || pair.j < 0 || pair.i >= samples || pair.j >= samples)
      return Error{ErrorCode::BadContent, path + ":" + std::to_string(number) + ":1: `" + line +
                                              "` where two samples `i,j` below " +
                                              std::to_string(samples) + " are due"};
    pairs.push_back(pair);
  }
  return pairs;
}

Result<Table> pair_table(const Project& project, const Settings& settings) {
  const auto sprites = load_sprites(project);
  if (!sprites) return sprites.error();
  const FeatureSet& set = sprites->features;
  const bool wants_features = settings.what == "features";
  const auto labels = wants_features && !settings.pair_file.empty()
                          ? read_pairs(settings.pair_file, static_cast<int>(set.rows.size()))
                          : labels_of(project, set, settings);
  if (!labels) return labels.error();
  std::vector<std::string> columns{"i", "j"};
  if (wants_features)
    columns.insert(columns.end(), kFeatureNames, kFeatureNames + kFeatureCount);
  else
    columns.insert(columns.end(), {"acceptable", "by_person"});
  std::vector<double> values;
  for (const Label& label : *labels) {
    values.insert(values.end(), {static_cast<double>(label.i), static_cast<double>(label.j)});
    if (wants_features) {
      const FeatureVector f = features(set, label.i, label.j);
      values.insert(values.end(), f.begin(), f.end());
    } else {
      values.insert(values.end(), {label.acceptable ? 1.0 : 0.0, label.by_person ? 1.0 : 0.0});
    }
  }
  return table_of(columns, std::move(values));
}

Table distances_table(const TransitionFile& file) {
  std::vector<double> values;
  for (const PairDistance& pair : file.pairs)
    values.insert(values.end(), {static_cast<double>(pair.i), static_cast<double>(pair.j),
                                 double{pair.distance}});
  return table_of({"i", "j", "D"}, std::move(values));
}

Table transitions_table(const CostTable& costs) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < costs.row_start.size(); ++i)
    for (std::uint32_t k = costs.row_start[i]; k < costs.row_start[i + 1]; ++k)
      values.insert(values.end(),
                    {static_cast<double>(i), static_cast<double>(costs.transitions[k].to),
                     double{costs.transitions[k].cost}});
  return table_of({"i", "j", "T"}, std::move(values));
}

Table values_table(const ValueFile& file, std::size_t samples) {
  const auto stages = static_cast<std::size_t>(file.solution.stages);
  return {{},
          {kDirectionCount, stages, samples},
          {file.solution.values.begin(), file.solution.values.end()}};
}

Result<Table> make_table(const Project& project, const Settings& settings) {
  if (settings.what == "labels" || settings.what == "features")
    return pair_table(project, settings);
  const auto rows = project.samples();
  if (!rows) return rows.error();
  if (settings.what == "samples") return samples_table(*rows);
  if (settings.what == "values") {
    if (settings.mode != "paper")
      return Error{ErrorCode::BadContent, project.path("values.bin") + ": it holds no mode `" +
                                              settings.mode + "`: use --mode paper"};
    const auto values = project.values(rows->size());
    if (!values) return values.error();
    return values_table(*values, rows->size());
  }
  const auto file = project.transitions(rows->size());
  if (!file) return file.error();
  return settings.what == "distances" ? distances_table(*file) : transitions_table(file->costs);
}

/// NPY 1.0: magic, version, length of the header, a Python dict padded to 64 bytes, little-endian
/// data.
std::string npy_bytes(const Table& table) {
  std::string shape;
  for (const std::size_t side : table.shape) shape += std::to_string(side) + ", ";
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }";
  constexpr std::size_t kFixed = 10;
  while ((kFixed + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  ByteWriter writer;
  writer.put_array(std::span("\x93NUMPY\x01\x00", 8));
  writer.put(static_cast<std::uint16_t>(header.size()));
  writer.put_array(std::span<const char>(header));
  writer.put_array(std::span<const double>(table.values));
  return std::move(writer).take();
}

std::string csv_number(double value) { return std::isfinite(value) ? number_text(value) : "inf"; }

/// Two dimensions as they are; more as one line a number, its indices before it.
std::string csv_bytes(const Table& table) {
  std::string out;
  if (table.shape.size() == 2) {
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      out += (c > 0 ? "," : "") + table.columns[c];
    out += "\n";
    for (std::size_t k = 0; k < table.values.size(); ++k)
      out += csv_number(table.values[k]) + ((k + 1) % table.shape[1] == 0 ? "\n" : ",");
    return out;
  }
  out = "direction,stage,sample,value\n";
  for (std::size_t k = 0; k < table.values.size(); ++k)
    out += std::to_string(k / (table.shape[1] * table.shape[2])) + "," +
           std::to_string(k / table.shape[2] % table.shape[1]) + "," +
           std::to_string(k % table.shape[2]) + "," + csv_number(table.values[k]) + "\n";
  return out;
}

}  // namespace

Result<int> run_dump(const Settings& settings, Console& console) {
  if (settings.film.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "a work folder is due: FILM, PACK or --work DIR"};
  if (settings.what.empty())
    return Error{ErrorCode::BadSetting,
                 "--what is due: samples, labels, features, distances, transitions or values"};
  if (settings.output.empty()) return Error{ErrorCode::BadSetting, "-o FILE is due"};
  const std::string work = find_work_folder(settings.work, settings.film, {});
  const auto project = Project::look(work);
  if (!project) return project.error();
  const auto table = make_table(*project, settings);
  if (!table) return table.error();
  const std::string bytes = settings.format == "npy" ? npy_bytes(*table) : csv_bytes(*table);
  if (auto wrote = write_file(settings.output, bytes); !wrote) return wrote.error();
  console.text(settings.output + ": " + settings.what + ", " +
               std::to_string(table->values.size()) + " numbers\n");
  console.document({{"what", settings.what},
                    {"file", settings.output},
                    {"shape", table->shape},
                    {"columns", table->columns}});
  console.next("vsprite doctor --work " + shell_word(work));
  return 0;
}

}  // namespace vsprite
