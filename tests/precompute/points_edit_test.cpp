// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/points_edit.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temp_folder.h"
#include "tool/files.h"
#include "tool/views_file.h"

namespace vsprite {
namespace {

constexpr PointLayer kPicture = PointLayer::Picture;

/// Two views of a square of 100 px, the second one moved by 10 to the right.
ViewSet two_squares(std::vector<Vec2> points = {{10, 10}, {90, 10}, {90, 90}, {10, 90}}) {
  ViewSet set{.name = "square"};
  set.parameters = {{.name = "turn"}};
  for (int v = 0; v < 2; ++v) {
    View view{.name = "view " + std::to_string(v + 1), .at = {double(v)}, .points = points};
    view.picture = {120, 120, std::vector<std::uint8_t>(4 * 120 * 120, 255)};
    for (Vec2& p : view.points) p.x += 10.0f * static_cast<float>(v);
    set.views.push_back(std::move(view));
  }
  return set;
}
PointsEdit edit_of(ViewSet set) {
  auto made = PointsEdit::make(std::move(set));
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

TEST(PointsEdit, ANewPointGoesWhereTheMeshCarriesItInEveryView) {
  PointsEdit edit = edit_of(two_squares());
  ASSERT_TRUE(edit.add(0, kPicture, {50, 30}));
  EXPECT_EQ(edit.point_count(), 5u);
  EXPECT_EQ(edit.points(0, kPicture)[4], (Vec2{50, 30}));
  EXPECT_NEAR(edit.points(1, kPicture)[4].x, 60, 0.01);
  EXPECT_NEAR(edit.points(1, kPicture)[4].y, 30, 0.01);
  EXPECT_EQ(edit.faces().size(), 4u);
  EXPECT_TRUE(fit_puppets(edit.set()));
}

TEST(PointsEdit, EveryStepIsTakenBackAndDoneAgain) {
  PointsEdit edit = edit_of(two_squares());
  EXPECT_TRUE(edit.is_saved());
  ASSERT_TRUE(edit.add(0, kPicture, {50, 50}));
  ASSERT_TRUE(edit.erase(0));
  edit.take(1, kPicture, 0);
  edit.move({70, 20});
  edit.move({71, 21});
  edit.drop();
  EXPECT_EQ(edit.points(1, kPicture)[0], (Vec2{71, 21}));
  EXPECT_EQ(edit.points(0, kPicture)[0], (Vec2{90, 10}));  // only in its own view
  EXPECT_TRUE(edit.undo());                                // a drag is one step
  EXPECT_EQ(edit.points(1, kPicture)[0], (Vec2{100, 10}));
  EXPECT_TRUE(edit.undo());
  EXPECT_TRUE(edit.undo());
  EXPECT_FALSE(edit.undo());
  EXPECT_TRUE(edit.is_saved());
  EXPECT_TRUE(edit.redo() && edit.redo() && edit.redo());
  EXPECT_FALSE(edit.redo());
  EXPECT_EQ(edit.points(1, kPicture)[0], (Vec2{71, 21}));
  EXPECT_EQ(edit.point_count(), 4u);
}

TEST(PointsEdit, AKeptMeshIsChangedByHand) {
  PointsEdit edit = edit_of(two_squares());
  ASSERT_EQ(edit.faces().size(), 2u);
  const auto edge = edit.edge_at(0, kPicture, {50, 50}, 1);  // the diagonal
  ASSERT_TRUE(edge);
  ASSERT_TRUE(edit.flip((*edge)[0], (*edge)[1]));
  EXPECT_TRUE(edit.has_own_faces());
  EXPECT_FALSE(edit.flip((*edge)[0], (*edge)[1]));  // it is no edge any more
  EXPECT_TRUE(fit_puppets(edit.set()));             // no face is folded
  const auto other = edit.edge_at(0, kPicture, {50, 50}, 1);
  ASSERT_TRUE(other);
  EXPECT_NE((*other)[0] + (*other)[1], (*edge)[0] + (*edge)[1]);
  ASSERT_TRUE(edit.add(0, kPicture, {60, 30}));  // its face becomes three
  EXPECT_EQ(edit.faces().size(), 4u);
  ASSERT_TRUE(edit.undo());
  ASSERT_TRUE(edit.add(0, kPicture, {60, 40}));  // on the edge: both of its faces become two
  EXPECT_EQ(edit.faces().size(), 4u);
  EXPECT_TRUE(fit_puppets(edit.set()));
  ASSERT_TRUE(edit.cut_face(0));
  EXPECT_EQ(edit.faces().size(), 3u);
  ASSERT_TRUE(edit.erase(4));
  for (const Face& face : edit.faces())
    for (std::uint32_t c = 0; c < face.count; ++c) EXPECT_LT(face.corners[c], 4u);
  EXPECT_FALSE(edit.has_own_faces());  // none is left: they are made again
  EXPECT_EQ(edit.faces().size(), 2u);
  ASSERT_TRUE(edit.keep_mesh());
  ASSERT_TRUE(edit.free_mesh());
  EXPECT_FALSE(edit.free_mesh());
}

TEST(PointsEdit, SaysWhyItCannotBe) {
  PointsEdit edit = edit_of(two_squares());
  EXPECT_NE(edit.add(0, kPicture, {10, 10}).error().message.find("lies there already"),
            std::string::npos);
  EXPECT_NE(edit.erase(7).error().message.find("there is no point 8"), std::string::npos);
  EXPECT_NE(edit.flip(0, 1).error().message.find("no edge between two"), std::string::npos);
  EXPECT_NE(edit.replace(0, kPicture, {{1, 1}}).error().message.find("1 points, the views have 4"),
            std::string::npos);
  EXPECT_TRUE(edit.is_saved());
  ViewSet uneven = two_squares();
  uneven.views[1].points.pop_back();
  EXPECT_NE(PointsEdit::make(uneven).error().message.find("view 2: 3 control points, view 1 has 4"),
            std::string::npos);
  ViewSet beyond = two_squares();
  beyond.faces = {{.corners = {0, 1, 9}}};
  EXPECT_NE(PointsEdit::make(beyond).error().message.find("control point 10"), std::string::npos);
}

TEST(PointsEdit, AScriptSaysWhichLineIsWrong) {
  PointsEdit edit = edit_of(two_squares());
  ASSERT_TRUE(run_points_script(
      "# mine\nadd 1 50 50\nmove 2 5 61.5 52\n\nmesh # kept\nundo\nredo\n", "s.txt", edit));
  EXPECT_EQ(edit.points(1, kPicture)[4], (Vec2{61.5f, 52}));
  EXPECT_TRUE(edit.has_own_faces());
  const std::pair<const char*, const char*> bad[] = {
      {"move 1 2 3", "s.txt:1: `move VIEW POINT X Y` is due"},
      {"\nmove 3 1 1 1", "s.txt:2: there are 2 views"},
      {"move 0 1 1 1", "there are 2 views"},
      {"move 1 9 1 1", "there is no point 9"},
      {"add 1 nan 2", "`nan`: a number is due"},
      {"shear 1", "`shear`: move, add"},
      {"cut 99", "there is no face 99"}};
  for (const auto& [script, due] : bad) {
    const auto done = run_points_script(script, "s.txt", edit);
    ASSERT_FALSE(done) << script;
    EXPECT_NE(done.error().message.find(due), std::string::npos) << done.error().message;
  }
}

constexpr const char* kText =
    "# der Kopf, groß\nname = \"k\u00f6pfchen\" # ü\n\n[[parameter]]\nname = \"turn\"\n\n"
    "[[view]]   # the first\nat = [0]\npoints = [[10, 10], # left\n  [90, 10.50], [50, 90]] # end\n"
    "\n[[view]]\nat = [1]\n";

TEST(PointsText, OnlyWhatWasChangedIsWrittenAnew) {
  const auto set = parse_draft_views(kText, "k.toml");
  ASSERT_TRUE(set) << set.error().message;
  PointsEdit edit = edit_of(*set);
  EXPECT_FALSE(edit.is_saved());  // the second view has got points
  ASSERT_TRUE(edit.move_to(1, kPicture, 0, {12.34f, 10}));
  const auto text = edit.written_into(kText, "k.toml");
  ASSERT_TRUE(text);
  EXPECT_EQ(*text,
            "# der Kopf, groß\nname = \"k\u00f6pfchen\" # ü\n\n[[parameter]]\nname = "
            "\"turn\"\n\n[[view]]   # the first\nat = [0]\npoints = [[10, 10], # left\n  "
            "[90, 10.50], [50, 90]] # end\n\n[[view]]\n"
            "points = [[12.34, 10], [90, 10.5], [50, 90]]\nat = [1]\n");
  const auto again = parse_draft_views(*text, "k.toml");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->views[1].points, edit.points(1, kPicture));
}

TEST(PointsText, EverythingThatWasChangedComesBack) {
  const std::string inner =
      "depth = [0, 0, 1, 1]\nparameter = [{name = \"turn\"}]\nview = [{at = [0], points = [[10, "
      "10], [90, 10], [90, 90], [10, 90]], depth = [1, 2, 3, 4]},\n {at = [1]}]";  // no last \n
  const auto set = parse_draft_views(inner, "k.toml");
  ASSERT_TRUE(set) << set.error().message;
  ViewSet pictured = *set;
  for (View& view : pictured.views)
    view.picture = {120, 120, std::vector<std::uint8_t>(4 * 120 * 120, 255)};
  PointsEdit edit = edit_of(pictured);
  ASSERT_TRUE(edit.keep_mesh());
  ASSERT_TRUE(edit.add(0, kPicture, {40, 20}));
  const auto text = edit.written_into(inner, "k.toml");
  ASSERT_TRUE(text);
  const auto again = parse_draft_views(*text, "k.toml");
  ASSERT_TRUE(again) << again.error().message << "\n" << *text;
  EXPECT_EQ(again->faces, edit.set().faces);
  EXPECT_EQ(again->depth, edit.set().depth);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(again->views[v].points, edit.points(v, kPicture));
    EXPECT_EQ(again->views[v].depth, edit.sheet(v).depth);
  }
}

TEST(PointsFile, LeavesAFileAloneThatAnotherProgramHasChanged) {
  const testing::TempFolder folder;
  const std::string path = folder.path() + "/k.toml";
  ASSERT_TRUE(write_file(path, kText));
  auto file = PointsFile::open(path);
  ASSERT_TRUE(file);
  PointsEdit edit = edit_of(*parse_draft_views(file->text(), path));
  ASSERT_TRUE(file->save(edit));
  EXPECT_TRUE(edit.is_saved());
  ASSERT_TRUE(edit.move_to(0, kPicture, 0, {1, 2}));
  ASSERT_TRUE(file->save(edit));  // what it wrote itself is no other program's
  EXPECT_EQ(parse_draft_views(*read_file(path), path)->views[0].points[0], (Vec2{1, 2}));
  ASSERT_TRUE(write_file(path, "name = \"other\"\n"));
  ASSERT_TRUE(edit.move_to(0, kPicture, 0, {3, 4}));
  EXPECT_NE(file->save(edit).error().message.find("another program"), std::string::npos);
  EXPECT_EQ(*read_file(path), "name = \"other\"\n");
  EXPECT_TRUE(file->save_aside(edit));
  EXPECT_EQ(parse_draft_views(*read_file(path + ".unsaved"), path)->views[0].points[0],
            (Vec2{3, 4}));
}

}  // namespace
}  // namespace vsprite
