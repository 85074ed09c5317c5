// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Points back into the text they came from: only the arrays that were changed are written anew,
// each in its place, so that a person's comments and order stay.
#include <algorithm>
#include <charconv>

#include "tool/files.h"
#include "tool/points_edit.h"
#include "tool/toml_table.h"
#include "tool/views_file.h"

namespace vsprite {
namespace {

constexpr std::size_t kWidth = 100;

std::string plain(float value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value + 0.0f).ptr};
}

/// `[a, b, ...]`, broken where a line becomes too long; `indent`: of the following lines.
std::string array_of(const std::vector<std::string>& items, std::size_t indent) {
  std::string out = "[";
  std::size_t width = indent;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) out += ",";
    if (k > 0 && width + items[k].size() + 2 > kWidth) {
      out += "\n" + std::string(indent, ' ');
      width = indent;
    } else if (k > 0) {
      out += " ";
    }
    out += items[k];
    width += items[k].size() + 2;
  }
  return out + "]";
}

std::vector<std::string> items_of(const std::vector<Vec2>& points) {
  std::vector<std::string> out;
  for (const Vec2 p : points) out.push_back("[" + plain(p.x) + ", " + plain(p.y) + "]");
  return out;
}
std::vector<std::string> items_of(const std::vector<float>& numbers) {
  std::vector<std::string> out;
  for (const float n : numbers) out.push_back(plain(n));
  return out;
}
std::vector<std::string> items_of(const std::vector<Face>& faces, std::uint32_t corners) {
  std::vector<std::string> out;
  for (const Face& face : faces) {
    if (face.count != corners) continue;
    std::string row = "[";
    for (std::uint32_t c = 0; c < corners; ++c)
      row += (c > 0 ? ", " : "") + std::to_string(face.corners[c] + 1);
    out.push_back(row + "]");
  }
  return out;
}

class Patch {
 public:
  explicit Patch(const std::string& text) : text_(text) {
    for (std::size_t at = 0; at != std::string::npos;) {
      lines_.push_back(at);
      at = text.find('\n', at);
      if (at != std::string::npos) ++at;
    }
  }

  /// `key = items` in a table; `after`: where it goes if it is not there yet.
  void put(const toml::table& table, const std::string& key, const std::vector<std::string>& items,
           std::size_t after, bool is_inline) {
    const std::string indent = key + " = ";
    if (const toml::node* node = table.get(key))
      pieces_.push_back({offset(node->source().begin), offset(node->source().end),
                         array_of(items, indent.size() + 1)});
    else if (is_inline)
      pieces_.push_back({after, after, indent + array_of(items, indent.size() + 1) + ", "});
    else
      pieces_.push_back({after, after, indent + array_of(items, indent.size() + 1) + "\n"});
  }

  /// Columns count characters, not bytes.
  std::size_t offset(const toml::source_position& at) const {
    std::size_t byte = lines_[std::min<std::size_t>(at.line, lines_.size()) - 1];
    if (at.line == 1 && text_.starts_with("\xEF\xBB\xBF")) byte += 3;
    for (toml::source_index column = 1; column < at.column && byte < text_.size(); ++column) {
      ++byte;
      while (byte < text_.size() && (static_cast<unsigned char>(text_[byte]) & 0xC0) == 0x80)
        ++byte;
    }
    return byte;
  }
  /// The start of the line after this one.
  std::size_t line_after(const toml::source_position& at) {
    if (at.line < lines_.size()) return lines_[at.line];
    needs_newline_ = true;
    return text_.size();
  }
  std::size_t line_of(const toml::source_position& at) const { return lines_[at.line - 1]; }

  std::string apply() {
    std::string out = text_;
    if (needs_newline_ && !out.empty() && out.back() != '\n')
      for (Piece& piece : pieces_)
        if (piece.begin == text_.size()) piece.text = "\n" + piece.text;
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
    for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece)
      out.replace(piece->begin, piece->end - piece->begin, piece->text);
    return out;
  }

 private:
  struct Piece {
    std::size_t begin, end;
    std::string text;
  };
  const std::string& text_;
  std::vector<std::size_t> lines_;
  std::vector<Piece> pieces_;
  bool needs_newline_ = false;
};

/// After the last key of the root; before the first table where it has none.
std::size_t root_place(const toml::table& root, Patch& patch) {
  const toml::source_region* last = nullptr;
  const toml::source_region* first_table = nullptr;
  for (const auto& [key, node] : root) {
    const toml::array* array = node.as_array();
    const bool is_table = (node.is_table() && !node.as_table()->is_inline()) ||
                          (array != nullptr && !array->empty() && array->get(0)->is_table() &&
                           !array->get(0)->as_table()->is_inline());
    const toml::source_region& place =
        array != nullptr && is_table ? array->get(0)->source() : node.source();
    const toml::source_region*& kept = is_table ? first_table : last;
    const bool is_further =
        kept != nullptr && (is_table ? place.begin < kept->begin : kept->end < place.end);
    if (kept == nullptr || is_further) kept = &place;
  }
  if (last != nullptr) return patch.line_after(last->end);
  return first_table == nullptr ? 0 : patch.line_of(first_table->begin);
}

}  // namespace

Result<std::string> PointsEdit::written_into(const std::string& text,
                                             const std::string& path) const {
  const auto root = parse_toml(text, path);
  if (!root) return root.error();
  const State now = state();
  Patch patch(text);
  const std::size_t top = root_place(*root, patch);
  if (now.depth != read_.depth) patch.put(*root, "depth", items_of(now.depth), top, false);
  if (now.faces != read_.faces) {
    const auto quads = items_of(now.faces, 4);
    if (!quads.empty() || root->contains("quads")) patch.put(*root, "quads", quads, top, false);
    patch.put(*root, "triangles", items_of(now.faces, 3), top, false);
  }
  std::vector<const toml::table*> tables;
  for (const char* key : {"view", "character"})
    if (const toml::array* list = root->get_as<toml::array>(key))
      for (const toml::node& each : *list)
        if (each.is_table()) tables.push_back(each.as_table());
  if (tables.size() != now.sheets.size())
    return Error{ErrorCode::BadContent,
                 path + ": it was changed by another hand: " + std::to_string(tables.size()) +
                     " views, " + std::to_string(now.sheets.size()) + " are due"};
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const toml::table& table = *tables[k];
    const bool is_inline = table.is_inline();
    const std::size_t place =
        is_inline ? patch.offset(table.source().begin) + 1 : patch.line_after(table.source().begin);
    const Sheet &is = now.sheets[k], &was = read_.sheets[k];
    if (is.depth != was.depth) patch.put(table, "depth", items_of(is.depth), place, is_inline);
    if (is.texture_points != was.texture_points)
      patch.put(table, "texture_points", items_of(is.texture_points), place, is_inline);
    if (is.points != was.points) patch.put(table, "points", items_of(is.points), place, is_inline);
  }
  return patch.apply();
}

Result<PointsFile> PointsFile::open(const std::string& path) {
  auto text = read_views_text(path);
  if (!text) return text.error();
  PointsFile file;
  file.path_ = path;
  file.read_ = file.last_ = std::move(*text);
  return file;
}

Result<void> PointsFile::save(PointsEdit& edit) {
  const auto there = read_file(path_);
  if (there && *there != last_)
    return Error{ErrorCode::BadContent,
                 path_ + ": another program has changed it since it was read; it is left alone"};
  auto text = edit.written_into(read_, path_);
  if (!text) return text.error();
  if (auto wrote = write_file(path_, *text); !wrote) return wrote;
  last_ = std::move(*text);
  edit.mark_saved();
  return {};
}

Result<std::string> PointsFile::save_aside(const PointsEdit& edit) const {
  const std::string spare = path_ + ".unsaved";
  const auto text = edit.written_into(read_, path_);
  if (!text) return text.error();
  if (auto wrote = write_file(spare, *text); !wrote) return wrote.error();
  return spare;
}

}  // namespace vsprite
