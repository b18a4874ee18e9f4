// What is drawn between the rows of a branch, and where curves lie on each other.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "io/overlaps.hpp"
#include "io/smooth_line.hpp"

namespace springfold::io {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Rows on a circle of radius 1, `count` steps of a turn of `angle`.
std::vector<LineRow> arc(int count, double angle) {
  std::vector<LineRow> rows;
  for (int i = 0; i <= count; ++i) {
    const double s = angle * i / count;
    rows.push_back({{std::cos(s), std::sin(s)}, s});
  }
  return rows;
}

double worst_radius(const std::vector<Polyline>& lines) {
  double worst = 0;
  for (const Polyline& line : lines)
    for (const PlotPoint& at : line)
      worst = std::max(worst, std::abs(std::hypot(at.first, at.second) - 1));
  return worst;
}

TEST(PointsBetween, LieOnTheCircleOnWhichTheRowsLieToThirdOrder) {
  const double coarse = worst_radius(points_between(arc(16, 2 * std::numbers::pi)));
  const double fine = worst_radius(points_between(arc(32, 2 * std::numbers::pi)));
  const double chord = 1 - std::cos(std::numbers::pi / 16);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(coarse, chord / 4) << "a polygon is farther away";
  EXPECT_GT(coarse / fine, 6) << "half the step: an eighth of the error, about";
}

TEST(PointsBetween, KeepTheLargestLoadAtItsLimitPoint) {
  // y = sin x has its maximum at the third row, beside which the rows are unevenly spaced.
  std::vector<LineRow> rows;
  for (const double s : {0.0, 0.9, std::numbers::pi / 2, 2.9, 3.4})
    rows.push_back({{s, std::sin(s)}, s});
  rows[2].is_special = true;
  for (const Polyline& line : points_between(rows))
    for (const PlotPoint& at : line) EXPECT_LT(at.second, 1);
}

TEST(PointsBetween, LeaveNoCornerThatIsSeen) {
  const auto rows = arc(16, std::numbers::pi);
  const auto lines = points_between(rows);
  Polyline all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    all.push_back(rows[i].at);
    all.insert(all.end(), lines[i].begin(), lines[i].end());
  }
  for (std::size_t i = 2; i < all.size(); ++i) {
    const double a =
        std::atan2(all[i - 1].second - all[i - 2].second, all[i - 1].first - all[i - 2].first);
    const double b = std::atan2(all[i].second - all[i - 1].second, all[i].first - all[i - 1].first);
    EXPECT_LT(std::abs(std::remainder(b - a, 2 * std::numbers::pi)), 5 * std::numbers::pi / 180)
        << i;
  }
}

TEST(PointsBetween, KeepTheCornerAtWhichASpringSwitches) {
  // Two straight lines: no row of one tells the other's slope.
  std::vector<LineRow> rows;
  for (int i = 0; i <= 4; ++i) rows.push_back({{0.1 * i, 0.1 * i}, 0.1 * i, 0});
  for (int i = 4; i <= 8; ++i) rows.push_back({{0.1 * i, 0.8 - 0.1 * i}, 0.1 * i, 1});
  for (const Polyline& line : points_between(rows)) EXPECT_THAT(line, IsEmpty());
}

/// Commands to n targets, at places that grow with i.
analysis::Study commands_to(int n, const std::function<double(double)>& place) {
  analysis::Study study;
  study.kind = analysis::StudyKind::control;
  for (int i = 0; i < n; ++i)
    study.targets.targets.push_back(Vector{{-30 + place(i), 110 + 0.1 * place(i)}});
  return study;
}

TEST(SmoothAlong, IsThePathOfCommandsThatHasNoCorners) {
  const analysis::Study line = commands_to(13, [](double i) { return i / 3; });
  EXPECT_EQ(smooth_along(line), "path");
  analysis::Study circle;
  circle.kind = analysis::StudyKind::control;
  circle.targets.circle = analysis::CirclePath{.centre = Vector::Zero(2), .radius = 1};
  circle.targets.circle_points = 9;
  EXPECT_EQ(smooth_along(circle), "path");
}

TEST(SmoothAlong, IsNothingWhereTheWayOrTheLoadTurnsAtATarget) {
  EXPECT_EQ(smooth_along(commands_to(5, [](double i) { return std::abs(i - 2); })), "");
  EXPECT_EQ(smooth_along(commands_to(5, [](double i) { return i * i; })), "") << "other steps";
  analysis::Study line = commands_to(3, [](double i) { return i; });
  line.targets.loads = {Vector::Zero(2), Vector::Ones(2), Vector::Zero(2)};
  EXPECT_EQ(smooth_along(line), "");
}

Figure with_parts(std::vector<CurvePart> parts) {
  Figure figure{.low = {0, 0}, .high = {1, 1}};
  for (CurvePart& part : parts) figure.curves.push_back({.parts = {std::move(part)}});
  return figure;
}

std::size_t lines_in(const DrawnLines& drawn) {
  std::size_t count = 0;
  for (const auto& parts : drawn.curves) count += parts.size();
  return count;
}

const Polyline lower_line{{0.1, 0.1}, {0.5, 0.3}, {0.9, 0.9}};
const Polyline back(lower_line.rbegin(), lower_line.rend());

TEST(WithoutOverlaps, DrawsOneOfTwoDashedLinesThatWouldFillEachOther) {
  const auto drawn = without_overlaps(
      with_parts({{Stability::unstable, lower_line}, {Stability::unstable, back}}), Canvas{});
  EXPECT_EQ(lines_in(drawn), 1u);
  EXPECT_THAT(drawn.mixed, IsEmpty());
}

TEST(WithoutOverlaps, SaysWhereAnUnstableLineLiesOnAStableOne) {
  const auto drawn = without_overlaps(
      with_parts({{Stability::unstable, back}, {Stability::stable, lower_line}}), Canvas{});
  ASSERT_THAT(drawn.mixed, SizeIs(1));
  EXPECT_THAT(drawn.curves[0], IsEmpty());
  EXPECT_THAT(drawn.curves[1], SizeIs(1)) << "the stable line";
}

TEST(WithoutOverlaps, KeepsTheRestOfALineThatRunsBackOverItself) {
  Polyline both{{0.1, 0.1}, {0.5, 0.5}, {0.3, 0.3}, {0.3, 0.9}};
  const auto drawn = without_overlaps(with_parts({{Stability::unstable, both}}), Canvas{});
  ASSERT_THAT(drawn.curves[0], SizeIs(2));
  EXPECT_EQ(drawn.curves[0][1].line.back(), both.back());
  double length = 0;
  for (const CurvePart& part : drawn.curves[0])
    for (std::size_t i = 1; i < part.line.size(); ++i)
      length += std::hypot(part.line[i].first - part.line[i - 1].first,
                           part.line[i].second - part.line[i - 1].second);
  EXPECT_NEAR(length, 0.4 * std::sqrt(2.0) + 0.6, 0.06) << "the way back is drawn once";
}

TEST(WithoutOverlaps, DoesNotSayThatABranchLiesOnItselfAtItsLimitPoint) {
  // A sharp turn: x = 100 (y - 0.5)^2, stable below and unstable above.
  Figure figure{.low = {0, 0}, .high = {1, 1}};
  CurvePart below{Stability::stable, {}}, above{Stability::unstable, {}};
  for (int i = -20; i <= 0; ++i) below.line.push_back({100 * i * i / 4e4, 0.5 + i / 200.0});
  for (int i = 0; i <= 20; ++i) above.line.push_back({100 * i * i / 4e4, 0.5 + i / 200.0});
  figure.curves.push_back({.parts = {below, above}});
  const auto drawn = without_overlaps(figure, Canvas{});
  EXPECT_THAT(drawn.mixed, IsEmpty());
  EXPECT_EQ(lines_in(drawn), 2u);
}

/// Twice the same curve, as of a design that changes nothing: the unstable line of one ends where the stable one of the
/// other begins.
TEST(WithoutOverlaps, DoesNotSayThatEqualCurvesLieOnEachOtherWhereTheyLoseStability) {
  Figure figure{.low = {0, 0}, .high = {1, 1}};
  const FigureCurve curve{.parts = {{Stability::stable, {{0.1, 0.1}, {0.5, 0.8}}},
                                    {Stability::unstable, {{0.5, 0.8}, {0.9, 0.7}}}}};
  figure.curves = {curve, curve};
  const auto drawn = without_overlaps(figure, Canvas{});
  EXPECT_THAT(drawn.mixed, IsEmpty());
  EXPECT_EQ(lines_in(drawn), 3u) << "both solid lines, and one of the dashed ones";
}

TEST(WithoutOverlaps, LeavesLinesThatCrossAlone) {
  const auto drawn = without_overlaps(with_parts({{Stability::unstable, {{0.1, 0.1}, {0.9, 0.9}}},
                                                  {Stability::unstable, {{0.1, 0.9}, {0.9, 0.1}}},
                                                  {Stability::stable, {{0.5, 0.1}, {0.5, 0.9}}}}),
                                      Canvas{});
  EXPECT_EQ(lines_in(drawn), 3u);
  EXPECT_THAT(drawn.mixed, IsEmpty());
}

}  // namespace
}  // namespace springfold::io
