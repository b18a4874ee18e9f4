// Contour lines, and what figures of maps show.
#include "io/map_figure.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "scratch_folder.hpp"
#include "springfold/io/checkpoint.hpp"

namespace springfold::io {
namespace {

GridField circle_field(int points) {
  GridField field;
  for (int i = 0; i < points; ++i) {
    field.xs.push_back(-1 + 2.0 * i / (points - 1));
    field.ys.push_back(field.xs.back());
  }
  for (const double y : field.ys)
    for (const double x : field.xs) field.values.push_back(x * x + y * y);
  return field;
}

TEST(Contour, OfADistanceIsACircleOfTheRightLength) {
  const auto lines = contour(circle_field(101), 0.25);
  double length = 0;
  for (const auto& [a, b] : lines) {
    EXPECT_NEAR(std::hypot(a.first, a.second), 0.5, 1e-3);
    length += std::hypot(b.first - a.first, b.second - a.second);
  }
  EXPECT_NEAR(length, 3.14159, 1e-3);
}

TEST(Contour, LeavesCellsWithoutValueAlone) {
  GridField field = circle_field(3);
  field.values[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contour(field, 0.5).empty());
}

TEST(Contour, DoesNotLeadThroughACellInWhichASpringSwitches) {
  const GridField field{{0, 1}, {0, 1}, {0, 1, 0, 1}};
  EXPECT_EQ(contour(field, 0.5).size(), 1u);
  EXPECT_TRUE(contour(field, 0.5, {"0", "1", "0", "1"}).empty());
}

/// Two cells side by side: gentle from 0 to 2, then a jump to 100.
TEST(Contour, HasNoLinesWhereMoreOfThemThanCanBeToldApartLeadThroughACell) {
  const GridField field{{0, 1, 2}, {0, 1}, {0, 2, 100, 0, 2, 100}};
  std::vector<std::vector<Segment>> lines;
  for (const double level : {1.0, 20.0, 40.0, 60.0, 80.0}) lines.push_back(contour(field, level));
  for (const auto& line : lines) ASSERT_EQ(line.size(), 1u);
  auto few = lines;
  drop_crowded(few, field, 3);
  EXPECT_EQ(few[0], lines[0]) << "the gentle one stays";
  for (std::size_t i = 1; i < few.size(); ++i) EXPECT_TRUE(few[i].empty());
  auto all = lines;
  drop_crowded(all, field, 4);
  EXPECT_EQ(all, lines);
}

TEST(Contour, ASaddleIsDecidedByTheMeanOfItsCorners) {
  const GridField high{{0, 1}, {0, 1}, {1, 0, 0, 1}};
  const auto lines = contour(high, 0.4);  // the mean 0.5 is above: the corners of 1 are connected
  ASSERT_EQ(lines.size(), 2u);
  for (const auto& [a, b] : lines) EXPECT_NEAR(std::abs(a.first - b.first), 0.4, 1e-12);
}

class Checkpoints : public testing::Test {
 protected:
  Checkpoints() {
    the_case.hash = "abc";
    planned.study = "a map";
    planned.plan.map.axes = {{.name = "node.x", .pose = 0, .from = 0, .to = 1, .points = 3}};
    rows.rows.resize(3);
    rows.done = {true, false, true};
    rows.rows[0] = {{0.1, std::nan(""), 1.0 / 3}, "0.1", "", "ok"};
    rows.rows[2] = {{-0.0, std::numeric_limits<double>::infinity(), 5e-324},
                    "",
                    "",
                    "unreachable: chain a, \"b\""};
  }
  Case the_case{};
  PlannedRun planned{};
  analysis::PartialRows rows{};
  ScratchFolder scratch{};
};

TEST_F(Checkpoints, GiveBackEveryBit) {
  write_checkpoint(scratch.path(), the_case, planned, rows);
  const auto read = read_checkpoint(scratch.path(), the_case, planned);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->done, rows.done);
  for (const std::size_t i : {0u, 2u}) {
    EXPECT_EQ(read->rows[i].status, rows.rows[i].status);
    EXPECT_EQ(read->rows[i].piece, rows.rows[i].piece);
    ASSERT_EQ(read->rows[i].values.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(read->rows[i].values[k] == rows.rows[i].values[k] ||
                  (std::isnan(read->rows[i].values[k]) && std::isnan(rows.rows[i].values[k])));
  }
}

TEST_F(Checkpoints, OfAnotherCaseAreNotUsed) {
  write_checkpoint(scratch.path(), the_case, planned, rows);
  the_case.hash = "abd";
  EXPECT_FALSE(read_checkpoint(scratch.path(), the_case, planned));
}

TEST_F(Checkpoints, AreRemovedWhenAllIsDone) {
  write_checkpoint(scratch.path(), the_case, planned, rows);
  the_case.runs = {planned};
  remove_checkpoints(scratch.path(), the_case);
  EXPECT_FALSE(read_checkpoint(scratch.path(), the_case, planned));
}

}  // namespace
}  // namespace springfold::io
