// Figures of relative sensitivities.
#include "io/tornado_figure.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "io/gnuplot_process.hpp"
#include "io/gnuplot_text.hpp"
#include "scratch_folder.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/io/plots.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// lambda = a b^-2 c at a = 2, b = 0.5, c = 0: by a 1, by b -2; c has the value 0.
class Tornado : public testing::Test {
 protected:
  Tornado() {
    PlannedRun planned;
    planned.study = "s";
    planned.parameters = {{"a", 2}, {"b", 0.5}, {"c", 0}};
    the_case.runs.push_back(planned);
    the_case.tornados.push_back({.name = "figure", .study = "s", .at = "LP1"});
    result.study = "s";
    result.quantities = {{"lambda", analysis::Unit::none},
                         {"d(lambda)/d(a)", analysis::Unit::none},
                         {"d(lambda)/d(b)", analysis::Unit::none},
                         {"d(lambda)/d(c)", analysis::Unit::none}};
    const double lambda = 8;
    analysis::Branch branch;
    branch.samples.push_back({.values = {lambda, lambda / 2, -2 * lambda / 0.5, 1}});
    branch.events.push_back({.kind = analysis::EventKind::limit_point, .label = "LP1"});
    result.branches.push_back(branch);
  }
  std::vector<TornadoFigure> figures() { return tornado_figures_of(the_case, {result}, problems); }

  Case the_case{};
  analysis::StudyResult result{};
  std::vector<std::string> problems{};
};

TEST_F(Tornado, SortsRelativeSensitivitiesBySize) {
  const auto found = figures();
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].bars.size(), 2U);
  EXPECT_EQ(found[0].bars[0].parameter, "b");
  EXPECT_DOUBLE_EQ(found[0].bars[0].value, -2);
  EXPECT_EQ(found[0].bars[1].parameter, "a");
  EXPECT_DOUBLE_EQ(found[0].bars[1].value, 1);
}

TEST_F(Tornado, NamesParametersWithoutABar) {
  EXPECT_EQ(figures().at(0).left_out, "their value is 0: c");
}

TEST_F(Tornado, SaysThatThePointIsNotThere) {
  the_case.tornados[0].at = "LP2";
  EXPECT_TRUE(figures().empty());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0], HasSubstr("has no LP2"));
}

TEST_F(Tornado, IsNotDrawnWhereTheQuantityIsZero) {
  result.branches[0].samples[0].values[0] = 0;
  EXPECT_TRUE(figures().empty());
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0], HasSubstr("lambda is 0 at LP1"));
}

TEST_F(Tornado, IsDrawnByGnuplotInEveryFormatWithoutAWarning) {
  the_case.tornados[0].look.formats = {"png", "svg", "pdf"};
  ScratchFolder scratch;
  const PlotOutcome outcome = draw_plots(scratch.path(), the_case, {result});
  EXPECT_THAT(outcome.warnings, IsEmpty());
  for (const char* ending : {".gp", ".png", ".svg", ".pdf"})
    EXPECT_TRUE(
        std::filesystem::exists(scratch.path() / "plots" / (std::string{"figure"} + ending)))
        << ending;
}

TEST_F(Tornado, HasTheSizeThatIsWantedAndIsWrittenForLatex) {
  if (!find_executable("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  SheetLook& look = the_case.tornados[0].look;
  look = {
      .width = 700, .height = 420, .font_size = 10, .font = "Serif", .formats = {"svg", "tikz"}};
  the_case.tornados[0].title = "50 % of a_b";
  ScratchFolder scratch;
  const PlotOutcome outcome = draw_plots(scratch.path(), the_case, {result});
  EXPECT_THAT(outcome.warnings, IsEmpty());
  const std::string svg = text_in(scratch.path() / "plots/figure.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"700\" height=\"420\""));
  EXPECT_THAT(svg, HasSubstr("font-family=\"Serif\""));
  EXPECT_THAT(text_in(scratch.path() / "plots/figure.tex"), HasSubstr("50 \\% of a\\_b"));
}

TEST_F(Tornado, QuotesTextsOfTheCase) {
  the_case.tornados[0].title = "a'; system('x'); '";
  const std::string script = tornado_script(figures().at(0), "", "");
  EXPECT_THAT(script, HasSubstr("figure_title = " + gnuplot_string("a'; system('x'); '")));
}

}  // namespace
}  // namespace springfold::io
