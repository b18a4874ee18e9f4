// Figures that are drawn without gnuplot.
#include "io/plain_figure.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "io/canvas.hpp"
#include "io/plain_frame.hpp"
#include "io/point_names.hpp"
#include "io/sample_results.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const plain::Frame square{{0, 0, 100, 100}, {0, 0}, {1, 1}};

TEST(PlainFrame, CutsALineAtItsEdges) {
  const auto parts = plain::clipped(square, {{-1, 0.5}, {0.5, 0.5}, {2, 0.5}, {2, 2}, {0.5, 0.5}});
  ASSERT_THAT(parts, SizeIs(2));  // across, and back in from the corner
  EXPECT_EQ(parts[0].front().x, 0);
  EXPECT_EQ(parts[0].back().x, 100);
  EXPECT_EQ(parts[1].front().x, 100);
  EXPECT_EQ(parts[1].front().y, 0);
  EXPECT_THAT(plain::clipped(square, {{-1, -1}, {-1, 2}}), IsEmpty());
}

TEST(PlainFrame, HasNoPlaceForWhatIsNotPositiveOnALogarithmicAxis) {
  const plain::Frame frame{{0, 0, 100, 100}, {1, 0}, {100, 1}, true, false};
  EXPECT_NEAR(frame.place({10, 0}).x, 50, 1e-12);
  EXPECT_THAT(plain::clipped(frame, {{-1, 0.5}, {0, 0.5}}), IsEmpty());
  EXPECT_THAT(plain::clipped(frame, {{0, 0.5}, {1, 0.5}, {10, 0.5}}), SizeIs(1));
}

TEST(PlainFrame, CutsAnOutlineToWhatIsSeen) {
  const auto corners = plain::clipped_outline(square, {{-1, -1}, {3, -1}, {3, 3}, {-1, 3}});
  double area = 0;  // of the whole frame, by the sum over its sides
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += (a.x * b.y - b.x * a.y) / 2;
  }
  EXPECT_NEAR(std::abs(area), 100 * 100, 1e-9);
}

Figure sample_figure(const PlotSpec& spec) {
  Case the_case = sample::two_runs();
  the_case.plots = {spec};
  std::vector<std::string> problems;
  return figures_of(the_case, sample::two_results(), problems).at(0);
}

TEST(PlainFigure, ShowsLinesInsideItsAxesAlone) {
  PlotSpec spec{.name = "a", .curves = {{.study = "push from Q2"}}};
  spec.look.x_range = {0.1, 0.3};
  const Figure figure = sample_figure(spec);
  const Canvas canvas = canvas_of(figure.look, false);
  std::size_t curves = 0;
  for (const drawing::Mark& mark : plain::picture_of(figure).marks) {
    const auto* path = std::get_if<drawing::Path>(&mark);
    if (path == nullptr || path->ink.width < 3 || path->places.size() < 3) continue;
    ++curves;
    for (const drawing::Place& place : path->places) {
      EXPECT_GE(place.x, canvas.left - 1e-9);
      EXPECT_LE(place.x, canvas.right + 1e-9);
    }
  }
  EXPECT_GT(curves, 0U);
}

TEST(PlainFigure, TextsOfTheCaseAreText) {
  PlotSpec spec{.name = "a",
                .title = "</title><script>alert(1)</script>\n\x1b[31m",
                .curves = {{.study = "push from Q2"}}};
  const std::string svg = drawing::svg_text(plain::picture_of(sample_figure(spec)));
  EXPECT_THAT(svg, Not(HasSubstr("<script>")));
  EXPECT_THAT(svg, HasSubstr("&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt; \\x1b[31m"));
}

TEST(PlainFigure, PointsHaveTheNamesOfGnuplotsFigures) {
  const std::string style =
      text_in(std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "plots/style.gp");
  for (const char* code :
       {"start", "LP", "CL", "SA", "BP", "KB", "KS", "TP", "FM", "UZ", "SC", "UR", "ES", "EU", "CP",
        "IC",    "CX", "HT", "BB", "C2", "FA", "CR", "TA", "AA", "SB", "PT", "EX", "TH", "JP"})
    EXPECT_THAT(style,
                HasSubstr(std::string{"code eq '"} + code + "' ? '" + point_name(code) + "'"));
}

TEST(PlainMap, LeavesNodesWithoutValuePaleAndSaysSo) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  MapFigure figure{.name = "a", .low = 0, .high = 3, .has_gaps = true};
  figure.panels = {{.field = {{0, 1}, {0, 1}, {0, 1, none, 3}}}};
  const std::string svg = drawing::svg_text(plain::picture_of(figure));
  EXPECT_THAT(svg, HasSubstr("#440154"));  // the least value
  EXPECT_THAT(svg, HasSubstr("#fde725"));  // the largest
  EXPECT_THAT(svg, HasSubstr(">no value</text>"));
  const auto patches = [](const MapFigure& of) {
    std::size_t count = 0;
    for (const drawing::Mark& mark : plain::picture_of(of).marks)
      if (const auto* path = std::get_if<drawing::Path>(&mark); path && path->ink.width == 0.5)
        ++count;
    return count;
  };
  MapFigure without = figure;  // with the patches of its colour bar only
  without.panels[0].field.values.assign(4, none);
  EXPECT_EQ(patches(figure) - patches(without), 3U);
}

TEST(PlainMap, HasTheSizeThatIsWanted) {
  MapFigure figure{.name = "a", .low = 0, .high = 3};
  figure.panels = {{.field = {{0, 1}, {0, 1}, {0, 1, 2, 3}}},
                   {.field = {{0, 1}, {0, 1}, {0, 1, 2, 3}}}};
  figure.look.width = 900, figure.look.height = 500;
  EXPECT_NEAR(plain::picture_of(figure).width, 900, 1e-9);
  EXPECT_NEAR(plain::picture_of(figure).height, 500, 1e-9);
}

TEST(PlainTornado, HasABarOfTheRightLengthForEveryParameter) {
  TornadoFigure figure{.name = "a"};
  figure.bars = {{"L", -2}, {"k", 1}};
  std::vector<double> widths;
  for (const drawing::Mark& mark : plain::picture_of(figure).marks)
    if (const auto* path = std::get_if<drawing::Path>(&mark); path && path->is_closed)
      widths.push_back(path->places[1].x - path->places[0].x);
  ASSERT_THAT(widths, SizeIs(2));
  EXPECT_NEAR(widths[0] / widths[1], -2, 1e-9);
}

}  // namespace
}  // namespace springfold::io
