// Curves, ticks and keys on axes that are logarithmic or show a part.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "case_files.hpp"
#include "cli/small_case.hpp"
#include "io/canvas.hpp"
#include "io/gnuplot_process.hpp"
#include "io/round_ticks.hpp"
#include "io/sample_results.hpp"
#include "io/smooth_line.hpp"
#include "scratch_folder.hpp"
#include "springfold/io/plots.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// All points of the line through the rows on these axes.
Polyline drawn_line(const std::vector<LineRow>& rows, bool x_log, bool y_log) {
  const auto between = points_between(rows, scales_of(rows, x_log, y_log));
  Polyline all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    all.push_back(rows[i].at);
    if (i < between.size()) all.insert(all.end(), between[i].begin(), between[i].end());
  }
  return all;
}

/// The farthest that straight lines between the points are from y(x) on doubly logarithmic axes, in decades.
template <class Curve>
double worst_gap(const Polyline& line, const Curve& y) {
  double worst = 0;
  for (std::size_t i = 1; i < line.size(); ++i)
    for (const double t : {0.2, 0.5, 0.8}) {
      const double x = std::pow(line[i - 1].first, 1 - t) * std::pow(line[i].first, t);
      const double drawn = std::pow(line[i - 1].second, 1 - t) * std::pow(line[i].second, t);
      worst = std::max(worst, std::abs(std::log10(drawn / y(x))));
    }
  return worst;
}

// Of two decades on 1000 pixels a pixel is 0.002.
constexpr double pixel = 0.002;

TEST(LogAxes, BendAStepThatIsStraightInTheValues) {
  const auto y = [](double x) { return 2 * x - 1; };
  const std::vector<LineRow> rows{{{1, 1}, 0, 0}, {{100, 199}, 1, 1}};
  EXPECT_GT(worst_gap({rows[0].at, rows[1].at}, y), 50 * pixel) << "the straight line";
  EXPECT_LT(worst_gap(drawn_line(rows, true, true), y), pixel);
}

TEST(LogAxes, AddNothingWhereTheyAreLinear) {
  EXPECT_THAT(drawn_line({{{1, 1}, 0, 0}, {{100, 199}, 1, 1}}, false, false), SizeIs(2));
}

TEST(LogAxes, ShowTheCubicBetweenTheRows) {
  // Over s = x the parabola is what Bessel's tangents give exactly, up to the origin.
  std::vector<LineRow> rows;
  for (int i = 0; i <= 10; ++i) rows.push_back({{0.1 * i, 0.01 * i * i}, 0.1 * i});
  Polyline line = drawn_line(rows, true, true);
  line.erase(line.begin());  // the origin has no place
  EXPECT_LT(worst_gap(line, [](double x) { return x * x; }), pixel);
}

TEST(LogAxes, KeepWhatIsStraightInTheValuesOverOneOfThem) {
  std::vector<LineRow> rows;
  for (int i = 0; i <= 20; ++i) rows.push_back({{0.05 * i, 0.5 * i}, 0.05 * i});
  for (const bool x_log : {true, false})
    for (const PlotPoint& at : drawn_line(rows, x_log, !x_log))
      EXPECT_NEAR(at.second, 10 * at.first, 1e-12);
}

TEST(LogAxes, KeepAPowerLawWhatItIs) {
  // y = 3 x^-2, x growing by a factor of 1.5 from row to row: on these axes a straight line.
  std::vector<LineRow> rows;
  for (int i = 0; i <= 12; ++i) {
    const double x = std::pow(1.5, i);
    rows.push_back({{x, 3 / (x * x)}, 0.5 * i});
  }
  const Polyline line = drawn_line(rows, true, true);
  EXPECT_LT(worst_gap(line, [](double x) { return 3 / (x * x); }), 1e-12);
  for (std::size_t i = 1; i < line.size(); ++i) EXPECT_GT(line[i].first, line[i - 1].first);
}

TEST(LogAxes, SeeThatAnSIsNotItsChord) {
  // Not half a decade long; its middle lies on the straight line between its ends.
  const auto curve = [](double t) {
    return PlotPoint{std::pow(10, 0.4 * t),
                     std::pow(10, 0.1 * t + 0.02 * std::sin(2 * std::numbers::pi * t))};
  };
  Polyline points;
  add_points_between(curve, 0, 1, {.x_log = true, .y_log = true}, points);
  EXPECT_GT(points.size(), 4U);
}

TEST(LogAxes, FollowACurveToWhereTheyHaveNoPlace) {
  const Polyline line = drawn_line({{{0, 1}, 0, 0}, {{1, 3}, 1, 1}, {{100, 4}, 2, 2}}, true, false);
  const auto positive =
      std::count_if(line.begin(), line.end(), [](const PlotPoint& at) { return at.first > 0; });
  double least = 1;
  for (const PlotPoint& at : line)
    if (at.first > 0) least = std::min(least, at.first);
  EXPECT_LT(least, 0.01) << "the least row is at 1: the frame begins above it";
  EXPECT_LT(positive, 1000);
  for (const PlotPoint& at : line)
    if (at.first <= 1) {
      EXPECT_NEAR(at.second, 1 + 2 * at.first, 1e-12);
    }
}

TEST(LogAxes, BeginALittleBelowTheLeastPositiveRow) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .curves = {{.study = "push from Q2", .runs = {2}}}}};
  the_case.plots[0].look.x_log = the_case.plots[0].look.y_log = true;
  const auto results = sample::two_results();
  double least = 1, most = 0;
  for (const auto& row : results[1].branches[0].samples)
    if (row.values[2] > 0 && row.values[3] > 0)
      least = std::min(least, row.values[2]), most = std::max(most, row.values[2]);
  std::vector<std::string> problems;
  const Figure figure = figures_of(the_case, results, problems).at(0);
  EXPECT_NEAR(figure.low.first, least / std::pow(most / least, 0.05), 1e-9);
}

TEST(RoundTicks, AreRoundAndFewAndInTheRange) {
  EXPECT_THAT(round_ticks({0, 1}, false, 4), ElementsAre("0", "0.5", "1"));
  EXPECT_THAT(round_ticks({-0.3, 0.3}, false, 4), ElementsAre("-0.2", "0", "0.2"));
  EXPECT_THAT(round_ticks({1e-2, 1e2}, true, 4), ElementsAre("0.01", "1", "100"));
  EXPECT_THAT(round_ticks({2, 8}, true, 4), ElementsAre("2", "4", "6", "8"));
}

TEST(RoundTicks, OfWideRangesWithOnePowerOfTenAreInEqualPartsOfTheAxis) {
  EXPECT_THAT(round_ticks({0.002, 0.09}, true, 6),
              ElementsAre("0.002", "0.005", "0.01", "0.02", "0.05"));
  EXPECT_THAT(round_ticks({0.11, 9.5}, true, 6), ElementsAre("0.2", "0.5", "1", "2", "5"));
}

TEST(RoundTicks, TellNarrowRangesApart) {
  EXPECT_THAT(round_ticks({1.0001, 1.0004}, false, 4),
              ElementsAre("1.0001", "1.0002", "1.0003", "1.0004"));
}

TEST(RoundTicks, OfAnyRangeAreTwoToFourInOrder) {
  std::mt19937 random{7};
  std::uniform_real_distribution<double> place{-3, 3}, size{-6, 6};
  for (int n = 0; n < 500; ++n) {
    const double low = place(random), high = low + std::pow(10, size(random));
    const auto ticks = round_ticks({low, high}, false, 4);
    ASSERT_GE(ticks.size(), 2U) << low << " " << high;
    ASSERT_LE(ticks.size(), 4U) << low << " " << high;
    const double edge = 1e-6 * (high - low);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(std::stod(ticks[i]), low - edge);
      EXPECT_LE(std::stod(ticks[i]), high + edge);
      if (i > 0) {
        EXPECT_LT(std::stod(ticks[i - 1]), std::stod(ticks[i]));
      }
    }
  }
}

TEST(Insets, HaveRoomForTheirNumbersInsideTheAxes) {
  for (const char* corner : {"top right", "top left", "bottom right", "bottom left"})
    for (const double font : {10.0, 14.0, 24.0}) {
      PlotLook look;
      look.font_size = font;
      const Canvas canvas = canvas_of(look, false);
      const InsetPlace place =
          place_of_inset({.x = {0, 1}, .y = {1000.25, 1000.5}, .corner = corner}, look, canvas);
      EXPECT_GE(place.low.first - place.left_room, canvas.left) << corner << " " << font;
      EXPECT_GE(place.low.second - place.bottom_room, canvas.bottom) << corner << " " << font;
      EXPECT_LE(place.high.first, canvas.right) << corner << " " << font;
      EXPECT_LE(place.high.second, canvas.top) << corner << " " << font;
    }
}

/// A script of the figure, without gnuplot.
class KeyOfAFigure : public testing::Test {
 protected:
  std::string script(PlotSpec spec) const {
    Case the_case = sample::two_runs();
    spec.name = "a";
    spec.curves = {{.study = "push from Q2", .runs = {2}}};
    the_case.plots = {spec};
    draw_plots(scratch.path(), the_case, sample::two_results(), {.gnuplot = "/nowhere/gnuplot"});
    return text_in(scratch.path() / "plots/a.gp");
  }
  ScratchFolder scratch{};
};

TEST_F(KeyOfAFigure, NamesAllThatIsSeen) {
  const std::string all = script({});
  EXPECT_THAT(all, HasSubstr("key_codes = 'start LP'"));
  EXPECT_THAT(all, HasSubstr("first_parts = 'stable_1 unstable_1'"));
}

TEST_F(KeyOfAFigure, DoesNotNameWhatLiesOutsideTheAxes) {
  PlotSpec spec;
  spec.look.x_range = {-0.05, 0.05};  // round the start, before the first limit point
  const std::string part = script(spec);
  EXPECT_THAT(part, HasSubstr("point_codes = 'start LP'")) << "drawn where the range is changed";
  EXPECT_THAT(part, HasSubstr("key_codes = 'start'"));
  EXPECT_THAT(part, HasSubstr("first_parts = 'stable_1'"));
}

TEST_F(KeyOfAFigure, NamesWhatOnlyAnInsetShows) {
  PlotSpec spec;
  spec.look.x_range = {-0.05, 0.05};
  spec.look.insets = {{.x = {0.05, 0.6}, .y = {-1, 1}, .corner = "top right"}};
  EXPECT_THAT(script(spec), HasSubstr("key_codes = 'start LP'"));
}

TEST_F(KeyOfAFigure, HasAnEntryForEveryQuantity) {
  PlotSpec spec;
  spec.more_y = {"point.x"};
  const std::string both = script(spec);
  EXPECT_THAT(both, HasSubstr("quantities = 2"));
  EXPECT_THAT(both, HasSubstr("quantity_name[1] = 'force'"));
  EXPECT_THAT(both, HasSubstr("quantity_name[2] = 'point.x'"));
  EXPECT_THAT(script({}), HasSubstr("quantities = 0"));
}

TEST_F(KeyOfAFigure, IsDrawnByGnuplotWithInsetsOnAnyAxes) {
  if (!find_executable("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  Case the_case = sample::two_runs();
  PlotSpec spec{.name = "a", .curves = {{.study = "push from Q2"}}};
  spec.more_y = {"point.x"};
  spec.look.x_log = true;
  spec.look.formats = {"png", "svg", "pdf"};
  spec.look.insets = {{.x = {0.01, 0.5}, .y = {0.25, 0.75}, .corner = "top left"},
                      {.x = {0.1, 0.2}, .y = {0.501, 0.502}, .corner = "bottom right"}};
  the_case.plots = {spec};
  const auto outcome = draw_plots(scratch.path(), the_case, sample::two_results());
  for (const std::string& warning : outcome.warnings)
    EXPECT_THAT(warning, HasSubstr("values that are not positive"));
  EXPECT_THAT(outcome.missing, IsEmpty());
  const std::string svg = text_in(scratch.path() / "plots/a.svg");
  for (const char* text : {">force<", ">point.x<", ">0.5015<"}) EXPECT_THAT(svg, HasSubstr(text));
}

TEST_F(KeyOfAFigure, HasNumbersOnLogarithmicAxesWithinADecade) {
  PlotSpec spec;
  spec.look.x_log = true;
  spec.look.x_range = {0.02, 0.09};
  EXPECT_THAT(script(spec), HasSubstr("x_ticks = '0.02 0.04 0.06 0.08'"));
  spec.look.x_range = {0.001, 0.9};
  EXPECT_THAT(script(spec), HasSubstr("x_ticks = ''")) << "powers of ten";
}

TEST_F(KeyOfAFigure, IsDrawnByGnuplotWithInsetsOfLargeAndSmallNumbers) {
  if (!find_executable("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  Case the_case = sample::two_runs();
  PlotSpec spec{.name = "a", .curves = {{.study = "push from Q2"}}};
  spec.look.formats = {"svg"};
  spec.look.insets = {{.x = {0, 4e5}, .y = {-1e-5, 1e-5}, .corner = "top left"},
                      {.x = {1e-7, 1e22}, .y = {0, 1e6}, .corner = "bottom right"}};
  the_case.plots = {spec};
  const auto outcome = draw_plots(scratch.path(), the_case, sample::two_results());
  EXPECT_THAT(outcome.warnings, IsEmpty());
  EXPECT_THAT(text_in(scratch.path() / "plots/a.svg"), HasSubstr(">0.00001<"));
}

class PolarPlot : public CaseFiles {};

TEST_F(PolarPlot, HasNoLogarithmicAxes) {
  const std::string plot =
      "[[plot]]\nname = \"a\"\npolar = true\nx_log = true\ny_log = true\n"
      "curves = [{ study = \"push\" }]\n";
  EXPECT_THAT(messages(cli::small_case("", plot)),
              ElementsAre(HasSubstr("plot[1].x_log: got true, need false beside polar = true"),
                          HasSubstr("plot[1].y_log: got true, need false beside polar = true")));
  EXPECT_THAT(messages(cli::small_case("", replaced(plot, "polar = true", "polar = false"))),
              IsEmpty());
}

}  // namespace
}  // namespace springfold::io
