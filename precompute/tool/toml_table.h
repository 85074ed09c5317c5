// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/toml_table.h - takes values out of a table of a TOML file that a person wrote; for the .cpp
// files of such formats alone.
//
// The first complaint is kept, `FILE:LINE: KEY: what is due`; whoever reads the whole file looks at
// it once, in the end. Keys that nobody asked for are complaints too.
#pragma once

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tool/report.h"
#include "tool/settings.h"
#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite {

class TomlTable {
 public:
  /// Borrows all three.
  TomlTable(const toml::table& table, const std::string& file, std::optional<Error>& error)
      : table_(table), file_(file), error_(error) {}

  bool has(const char* key) const { return table_.contains(key); }
  /// The node, or null; a complaint where it has to be there.
  const toml::node* find(const char* key, bool may_be_absent) {
    taken_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr && !may_be_absent) complain(key, "it is missing here and is due");
    return node;
  }

  std::string word(const char* key, std::optional<std::string> fallback = std::nullopt) {
    const toml::node* node = find(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or("");
    if (!node->is_string()) complain(*node, key, "a text in quotes is due");
    return node->value<std::string>().value_or("");
  }
  bool is_word(const char* key, std::string_view word) {
    const toml::node* node = find(key, true);
    return node != nullptr && node->value<std::string_view>() == word;
  }
  bool flag(const char* key, bool fallback) {
    const toml::node* node = find(key, true);
    if (node == nullptr) return fallback;
    if (!node->is_boolean()) complain(*node, key, "true or false is due");
    return node->value<bool>().value_or(fallback);
  }
  /// Any finite one.
  double number(const char* key, double fallback) {
    const toml::node* node = find(key, true);
    return node == nullptr ? fallback : finite(*node, key);
  }
  double number(const char* key, std::optional<double> fallback, double low, double high) {
    const toml::node* node = find(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or(0);
    const auto value = node->value<double>();
    if (value && *value >= low && *value <= high) return *value;
    complain(*node, key,
             "a number from " + fixed_text(low, 0) + " to " + fixed_text(high, 0) + " is due");
    return 0;
  }
  /// Counted from 1 in the file, from 0 here.
  int index(const char* key, int most) {
    const toml::node* node = find(key, false);
    if (node == nullptr) return 0;
    const auto value = node->value<std::int64_t>();
    if (!value || *value < 1 || *value > most)
      complain(*node, key, "a whole number from 1 to " + std::to_string(most) + " is due");
    return static_cast<int>(value.value_or(1)) - 1;
  }
  /// Each counted from 1 in the file, from 0 here.
  std::vector<int> indices(const char* key, int most) {
    std::vector<int> out;
    each_of(key, false, "an array of numbers is due", [&](const toml::node& each) {
      const auto value = each.value<std::int64_t>();
      if (!value || *value < 1 || *value > most)
        complain(each, key, "whole numbers from 1 to " + std::to_string(most) + " are due");
      out.push_back(static_cast<int>(value.value_or(1)) - 1);
    });
    return out;
  }
  std::vector<std::string> words(const char* key, bool may_be_absent) {
    std::vector<std::string> out;
    each_of(key, may_be_absent, "an array of texts is due", [&](const toml::node& each) {
      if (!each.is_string()) complain(each, key, "texts in quotes are due");
      out.push_back(each.value<std::string>().value_or(""));
    });
    return out;
  }
  std::vector<double> numbers(const char* key, bool may_be_absent) {
    std::vector<double> out;
    each_of(key, may_be_absent, "an array of numbers is due",
            [&](const toml::node& each) { out.push_back(finite(each, key)); });
    return out;
  }
  Vec2 point(const char* key) {
    const toml::node* node = find(key, false);
    return node == nullptr ? Vec2{} : to_point(*node, key, "");
  }
  /// `what`: what a point is called in a complaint, with its number.
  std::vector<Vec2> points(const char* key, bool may_be_absent, const std::string& what) {
    std::vector<Vec2> out;
    each_of(key, may_be_absent, "an array of [x, y] is due", [&](const toml::node& each) {
      out.push_back(
          to_point(each, key, what + " " + std::to_string(out.size() + 1) + " is no place: "));
    });
    return out;
  }
  /// The tables of an array of tables; none if there is no such key.
  std::vector<const toml::table*> tables(const char* key) {
    std::vector<const toml::table*> out;
    const toml::node* node = find(key, true);
    if (node == nullptr) return out;
    if (const toml::array* list = node->as_array())
      for (const toml::node& each : *list)
        if (each.is_table()) out.push_back(each.as_table());
    if (out.empty()) complain(*node, key, "tables [[" + std::string(key) + "]] are due");
    return out;
  }
  /// Every node of an array.
  template <class Each>
  void each_of(const char* key, bool may_be_absent, const char* due, const Each& each) {
    const toml::node* node = find(key, may_be_absent);
    if (node == nullptr) return;
    if (!node->is_array()) complain(*node, key, due);
    if (const toml::array* list = node->as_array())
      for (const toml::node& one : *list) each(one);
  }

  void complain(const toml::node& at, const std::string& key, const std::string& what) {
    complain_at(at.source(), key, what);
  }
  /// About the table as a whole.
  void complain(const std::string& key, const std::string& what) {
    complain_at(table_.source(), key, what);
  }
  /// Complains about the keys that were not taken.
  void done() {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (taken_.count(name)) continue;
      const std::string near = nearest_name(name, {taken_.begin(), taken_.end()});
      complain_at(key.source(), name,
                  "not known here" + (near.empty() ? "" : "; is `" + near + "` meant?"));
    }
  }

 private:
  void complain_at(const toml::source_region& at, const std::string& key, const std::string& what) {
    if (!error_)
      error_ = Error{ErrorCode::BadContent,
                     file_ + ":" + std::to_string(at.begin.line) + ": " + key + ": " + what};
  }
  double finite(const toml::node& node, const char* key) {
    const auto value = node.value<double>();
    if (!value || !std::isfinite(*value)) complain(node, key, "a number is due");
    return value.value_or(0);
  }
  Vec2 to_point(const toml::node& node, const char* key, const std::string& which) {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN(), kFar = 30000;
    const toml::array* pair = node.as_array();
    const bool is_pair = pair != nullptr && pair->size() == 2;
    const double x = is_pair ? pair->get(0)->value_or(kNowhere) : kNowhere;
    const double y = is_pair ? pair->get(1)->value_or(kNowhere) : kNowhere;
    if (std::fabs(x) <= kFar && std::fabs(y) <= kFar)
      return {static_cast<float>(x), static_cast<float>(y)};
    complain(node, key, which + "[x, y] in px, each from -30000 to 30000, is due");
    return {};
  }

  const toml::table& table_;
  const std::string& file_;
  std::optional<Error>& error_;
  std::set<std::string> taken_;
};

/// Errors: BadContent, with the place where the text is no TOML.
inline Result<toml::table> parse_toml(const std::string& text, const std::string& file) {
  toml::parse_result parsed = toml::parse(text);
  if (parsed) return std::move(parsed).table();
  return Error{ErrorCode::BadContent,
               file + ":" + std::to_string(parsed.error().source().begin.line) +
                   ": not TOML: " + std::string(parsed.error().description())};
}

}  // namespace vsprite
