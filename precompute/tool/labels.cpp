// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/labels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

namespace vsprite {
namespace {

constexpr const char* kLabelsFile = "labels.sqlite";
constexpr std::string_view kHeader =
    "film_a,frame_a,mirrored_a,film_b,frame_b,mirrored_b,acceptable,at_random,guess";

// ---- CSV ----

struct Cell {
  std::string_view text;
  std::size_t column = 1;  ///< of the line, from 1
};

std::vector<Cell> split(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    std::string_view text = line.substr(begin, comma - begin);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
    cells.push_back({text, begin + 1});
    if (comma == line.size()) return cells;
    begin = comma + 1;
  }
}

/// One line, by the names of the first line's columns.
class Row {
 public:
  Row(const std::vector<std::string>& columns, std::vector<Cell> cells, std::string where)
      : columns_(columns), cells_(std::move(cells)), where_(std::move(where)) {}

  bool has(std::string_view name) const { return at(name) < columns_.size(); }
  std::string_view text(std::string_view name) {
    const std::size_t k = at(name);
    return k < cells_.size() ? cells_[k].text : std::string_view();
  }
  int whole(std::string_view name, int low, int high) {
    const std::string_view found = text(name);
    int value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    const bool fits =
        error == std::errc{} && end == found.data() + found.size() && value >= low && value <= high;
    if (!fits)
      fail(name, "`" + std::string(found) + "` where a whole number from " + std::to_string(low) +
                     " to " + std::to_string(high) + " is due");
    return fits ? value : low;
  }
  double real(std::string_view name) {
    const std::string_view found = text(name);
    double value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error == std::errc{} && end == found.data() + found.size() && std::isfinite(value))
      return value;
    fail(name, "`" + std::string(found) + "` where a number is due");
    return 0;
  }
  bool yes(std::string_view name) { return whole(name, 0, 1) == 1; }
  void fail(std::string_view name, const std::string& what) {
    if (!problem_.empty()) return;
    const std::size_t k = at(name);
    problem_ = where_ + std::to_string(k < cells_.size() ? cells_[k].column : 1) + ": " +
               std::string(name) + ": " + what;
  }
  const std::string& problem() const { return problem_; }

 private:
  std::size_t at(std::string_view name) const {
    return static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), name) -
                                    columns_.begin());
  }
  const std::vector<std::string>& columns_;
  std::vector<Cell> cells_;
  std::string where_, problem_;
};

constexpr int kMany = 2'000'000'000;

SampleName read_name(Row& row, const std::string& side) {
  SampleName name{std::string(row.text("film_" + side)), row.whole("frame_" + side, 0, kMany),
                  row.has("mirrored_" + side) && row.yes("mirrored_" + side)};
  const bool hash = name.film.size() == 16 &&
                    name.film.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!hash) row.fail("film_" + side, "`" + name.film + "` where 16 hex digits are due");
  return name;
}

Answer read_answer(Row& row, const SampleNames& names) {
  Answer answer;
  if (row.has("i")) {
    const int last = names.size() - 1;
    answer.a = names.name(row.whole("i", 0, last));
    answer.b = names.name(row.whole("j", 0, last));
  } else {
    answer.a = read_name(row, "a");
    answer.b = read_name(row, "b");
  }
  answer.acceptable = row.yes("acceptable");
  answer.at_random = row.has("at_random") && row.yes("at_random");
  if (row.has("guess")) answer.guess = row.real("guess");
  if (answer.a == answer.b) row.fail(row.has("i") ? "j" : "frame_b", "a sample with itself");
  return answer;
}

std::string missing_columns(const std::vector<std::string>& columns) {
  const auto has = [&](const char* name) {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
  };
  const bool by_number = has("i") && has("j");
  const bool by_name = has("film_a") && has("frame_a") && has("film_b") && has("frame_b");
  return (by_number || by_name) && has("acceptable")
             ? std::string()
             : "the first line must name the columns i,j,acceptable or " + std::string(kHeader);
}

}  // namespace

Result<SampleNames> SampleNames::of(const Project& project, const std::vector<SampleRow>& rows) {
  const Json* record = project.record("segment");
  const Json inputs = record != nullptr ? record->value("inputs", Json::object()) : Json::object();
  SampleNames names;
  for (const SampleRow& row : rows) {
    const Json film = inputs.value(inputs.contains(row.source) ? row.source : "film", Json());
    if (!film.is_string())
      return Error{ErrorCode::CorruptData,
                   project.path("manifest.json") + ": the hash of " + row.source +
                       " is missing, and labels are named by it: run `vsprite segment` again"};
    names.names_.push_back({film.get<std::string>(), row.frame, row.mirror_of >= 0});
    names.numbers_.emplace(names.names_.back(), row.sample);
  }
  return names;
}

std::optional<int> SampleNames::find(const SampleName& name) const {
  const auto found = numbers_.find(name);
  return found == numbers_.end() ? std::nullopt : std::optional<int>(found->second);
}

PersonLabels resolve(const std::vector<Answer>& answers, const SampleNames& names) {
  PersonLabels person;
  person.answers = static_cast<int>(answers.size());
  std::map<std::pair<int, int>, std::size_t> seen;
  for (const Answer& answer : answers) {
    const auto a = names.find(answer.a), b = names.find(answer.b);
    if (!a || !b || *a == *b) {
      ++person.gone;
      continue;
    }
    if (answer.at_random && answer.guess >= 0)
      person.guesses.count(answer.guess <= 1, answer.acceptable);
    const Label label{std::min(*a, *b), std::max(*a, *b), answer.acceptable, true,
                      answer.at_random};
    const auto [at, is_new] = seen.emplace(std::pair(label.i, label.j), person.labels.size());
    if (is_new) {
      person.labels.push_back(label);
      continue;
    }
    Label& earlier = person.labels[at->second];
    ++person.repeated;
    person.disagreeing += earlier.acceptable != label.acceptable;
    earlier = label;
  }
  return person;
}

Result<PersonLabels> read_person_labels(const Project& project, const SampleNames& names) {
  const std::string path = project.path(kLabelsFile);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return PersonLabels{};
  const auto store = LabelStore::open(path);
  if (!store) return store.error();
  const auto answers = store->answers();
  if (!answers) return answers.error();
  return resolve(*answers, names);
}

std::vector<Label> merge_labels(std::vector<Label> film, const PersonLabels& person) {
  std::set<std::pair<int, int>> answered;
  for (const Label& label : person.labels) answered.emplace(label.i, label.j);
  std::erase_if(film, [&](const Label& l) { return answered.count({l.i, l.j}) > 0; });
  film.insert(film.end(), person.labels.begin(), person.labels.end());
  return film;
}

Result<FolderLabels> folder_labels(const Project& project, const FeatureSet& set, int pairs,
                                   std::uint64_t seed) {
  const auto names = SampleNames::of(project, set.rows);
  if (!names) return names.error();
  auto person = read_person_labels(project, *names);
  if (!person) return person.error();
  FolderLabels out{{}, std::move(*person)};
  out.labels = merge_labels(bootstrap_labels(set, pairs, seed), out.person);
  return out;
}

std::string format_answers(const std::vector<Answer>& answers) {
  std::string out = std::string(kHeader) + "\n";
  const auto add = [&out](const SampleName& name) {
    out += name.film + "," + std::to_string(name.frame) + "," + (name.mirrored ? "1," : "0,");
  };
  for (const Answer& answer : answers) {
    add(answer.a);
    add(answer.b);
    out += std::string(answer.acceptable ? "1," : "0,") + (answer.at_random ? "1," : "0,") +
           number_text(answer.guess) + "\n";
  }
  return out;
}

Result<ParsedAnswers> parse_answers(const std::string& text, const std::string& path,
                                    const SampleNames& names) {
  ParsedAnswers parsed;
  std::vector<std::string> columns;
  std::size_t number = 0;
  const std::size_t mark = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // some spreadsheets' sign
  for (std::size_t begin = mark; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    const std::string where = path + ":" + std::to_string(++number) + ":";
    if (line.empty() || line == "\r" || line.front() == '#') continue;
    std::vector<Cell> cells = split(line);
    if (columns.empty()) {
      for (const Cell& cell : cells) columns.emplace_back(cell.text);
      if (const std::string missing = missing_columns(columns); !missing.empty())
        return Error{ErrorCode::BadContent, where + "1: " + missing};
      continue;
    }
    if (cells.size() != columns.size())
      return Error{ErrorCode::BadContent, where + "1: " + std::to_string(cells.size()) +
                                              " columns where " + std::to_string(columns.size()) +
                                              " are due"};
    Row row(columns, std::move(cells), where);
    if (row.has("by_person") && row.text("by_person") == "0") {
      ++parsed.passed_over;
      continue;
    }
    Answer answer = read_answer(row, names);
    if (!row.problem().empty()) return Error{ErrorCode::BadContent, row.problem()};
    parsed.answers.push_back(std::move(answer));
  }
  if (columns.empty())
    return Error{ErrorCode::BadContent, path + ":1:1: " + missing_columns(columns)};
  return parsed;
}

}  // namespace vsprite
