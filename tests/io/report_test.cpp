// The HTML page: what is in it, and that texts of a case stay texts.
#include "springfold/io/report.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/case_files.hpp"
#include "io/report_data.hpp"
#include "io/report_lists.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/film.hpp"
#include "springfold/io/postures.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::Not;

class Report : public CaseFiles {
 protected:
  std::string page_of(const std::string& text) {
    read = load(text);
    for (const PlannedRun& run : read.runs) {
      results.push_back(analysis::run_study(run.mechanism, run.plan));
      results.back().study = run.study;
      results.back().run = run.run;
    }
    return report_html(read, results);
  }
  Case read{};
  std::vector<analysis::StudyResult> results{};
};

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64_of({}), "");
  EXPECT_EQ(base64_of({1.0}), "AAAAAAAA8D8=");  // bytes 00 00 00 00 00 00 f0 3f
  EXPECT_EQ(base64_of({0.0, 0.0, 0.0}), std::string(32, 'A'));
}

TEST(Explanation, OfALimitPointSaysWhetherTheMechanismSnapsThere) {
  using analysis::EventKind;
  const auto said = [](std::optional<Stability> before, std::optional<Stability> behind,
                       bool is_load) {
    return explanation_of(EventKind::limit_point, {before, behind}, is_load);
  };
  const auto stable = Stability::stable, driven = Stability::driven, lost = Stability::unstable;
  const auto snaps = HasSubstr("Beyond it the mechanism snaps.");
  EXPECT_THAT(said(stable, lost, true), snaps);
  EXPECT_THAT(said(lost, stable, true), Not(snaps)) << "stability begins here";
  EXPECT_THAT(said(lost, stable, true), HasSubstr("From here on the mechanism stands"));
  EXPECT_THAT(said(stable, driven, true), snaps) << "a load does not drive";
  EXPECT_THAT(said(driven, lost, false), snaps) << "the way turns back";
  EXPECT_THAT(said(stable, driven, false), HasSubstr("as it is driven it goes on"));
  EXPECT_THAT(said(lost, lost, true), HasSubstr("unstable on both sides"));
  EXPECT_THAT(said(lost, driven, true), HasSubstr("unstable on both sides"));
  EXPECT_THAT(said(Stability::unknown, Stability::unknown, true), HasSubstr("is not known"));
  for (const bool is_load : {false, true})
    EXPECT_THAT(said(lost, lost, is_load), Not(HasSubstr("snaps")));
  EXPECT_THAT(said(std::nullopt, lost, true), Not(HasSubstr("snaps"))) << "an end of the branch";
}

TEST_F(Report, NeedsNothingFromElsewhere) {
  if (!has_report()) GTEST_SKIP() << "built without the page";
  const std::string page = page_of(orthoglide_text());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* link : {"src=\"http", "href=\"http", "@import", "@DATA@", "@SCRIPT@", "@D3@"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
  EXPECT_THAT(page, HasSubstr("Michael Bostock"));  // D3's licence goes with it
}

TEST_F(Report, TextsOfTheCaseAreText) {
  if (!has_report()) GTEST_SKIP() << "built without the page";
  const std::string evil =
      R"(</title></script><script>window.injected = 1</script> \"; system(ls))";
  std::string text = replaced(orthoglide_text(), "title = \"test\"", "title = \"" + evil + "\"");
  text = replaced(text, "name = \"Q2\"\nkind", "name = \"Q2 </script><b>\"\nkind");
  text = replaced(text, "study = \"Q2\"", "study = \"Q2 </script><b>\"");
  const std::string page = page_of(text);
  EXPECT_THAT(page, Not(HasSubstr("<script>window")));
  EXPECT_THAT(page, Not(HasSubstr("</script><b>")));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/title&gt;&lt;/script&gt;&lt;script&gt;window.injected"));
  EXPECT_THAT(page, HasSubstr("Q2 \\u003c/script>\\u003cb>"));
}

TEST_F(Report, EveryRowHasItsPostureInTheSameParts) {
  page_of(orthoglide_text());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const RowScenes scenes{read.runs[i], results[i]};
    const auto first = scenes.scene_of(results[i].branches.at(0).samples.at(0));
    ASSERT_TRUE(first);
    for (const analysis::Sample& row : results[i].branches[0].samples) {
      const auto scene = scenes.scene_of(row);
      ASSERT_TRUE(scene);
      EXPECT_EQ(scene->points.size(), first->points.size());
      EXPECT_EQ(scene->loads.size(), first->loads.size());
      EXPECT_EQ(scene->springs.size(), first->springs.size());
    }
  }
}

/// A bar on a hinge with a torsion spring, upright under a load of twice its critical one: three equilibria.
std::string upright_bar_text(const std::string& study) {
  return R"toml([[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [0, 1] },
]
[[study]]
name = "study"
)toml" + study;
}

TEST_F(Report, EquilibriaOfASearchAreRowsWithPostures) {
  page_of(upright_bar_text("kind = \"equilibria\"\nload = [0, -2]\n"));
  const auto run = nlohmann::json::parse(report_data(read, results))["runs"][0];
  ASSERT_EQ(run["branches"].size(), 1U);
  const auto& list = run["branches"][0];
  EXPECT_EQ(list["form"], "points");
  EXPECT_EQ(list["file"], "equilibria/study-1.csv");
  EXPECT_EQ(list["rows"], results[0].equilibria->list.size());
  EXPECT_GE(list["rows"], 3);  // upright, and to both sides: q = 2 sin q
  EXPECT_EQ(list["events"][0]["label"], "EQ1");
  EXPECT_EQ(run["mechanisms"].size(), 1U);
}

TEST_F(Report, NodesOfAMapThatAreNotHeldHaveNoPosture) {
  page_of(R"toml([[body]]
name = "tool"
task_space = "xy"
pose = [0.5, 0.5]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "shoulder", role = "actuated", value = 0, stiffness = 1 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "elbow", role = "actuated", value = 1.5, stiffness = 1 },
  { rigid = [1, 0] },
]
[[study]]
name = "reach"
kind = "map"
axes = [{ pose = "x", from = 1, to = 3, points = 3 }, { pose = "y", from = 0.5, to = 0.6, points = 2 }]
)toml");
  const auto run = nlohmann::json::parse(report_data(read, results))["runs"][0];
  EXPECT_EQ(run["map"]["axes"][0]["points"], 3);
  EXPECT_EQ(run["map"]["quantity"], "K_trans_min");
  const auto& list = run["branches"][0];
  EXPECT_EQ(list["form"], "nodes");
  EXPECT_EQ(list["rows"], 6);
  const RowScenes scenes{read.runs[0], results[0]};
  const auto& nodes = results[0].branches[0].samples;
  EXPECT_TRUE(scenes.scene_of(nodes[0]));   // at (1, 0.5), within the arm's reach of 2
  EXPECT_FALSE(scenes.scene_of(nodes[2]));  // at (3, 0.5)
  const auto texts = list["status"]["texts"].get<std::vector<std::string>>();
  EXPECT_EQ(texts[list["status"]["of"][0].get<std::size_t>()], "ok");
  EXPECT_THAT(texts[list["status"]["of"][2].get<std::size_t>()], HasSubstr("unreachable"));
}

TEST_F(Report, AreasOnWhichSpringsActHaveOutlines) {
  read = load_case(SPRINGFOLD_SOURCE_DIR "/cases/shape-springs/case-pyramid.toml");
  const PlannedRun& planned = read.runs.front();
  PlannedRun run = planned;
  run.plan.trace.maximum_points = 3;
  results.push_back(analysis::run_study(run.mechanism, run.plan));
  results.back().study = planned.study;
  const auto page = nlohmann::json::parse(report_data(read, results));
  const auto& outlines = page["runs"][0]["mechanisms"][0]["outlines"];
  const auto points = page["runs"][0]["mechanisms"][0]["points"].get<std::size_t>();
  ASSERT_FALSE(outlines.empty());
  for (const auto& outline : outlines)
    for (const auto& corner : outline["corners"]) EXPECT_LT(corner.get<std::size_t>(), points);
}

/// A roller is lifted from y = 0; the area of the triangle (0, 5), (6, 5), (3, y) is 3 (5 - y). A bladder pushes where
/// it is below 12: y > 1.
TEST_F(Report, TellsInWhichRowsAnAreaActs) {
  page_of(R"toml([[body]]
name = "tip"
task_space = "xy"
pose = [3, 3]
[[chain]]
name = "post"
elements = [
  { rigid = [3, 0] },
  { joint = "prismatic", axis = "y", name = "slide", role = "virtual", stiffness = 1, initial = 3 },
  { joint = "prismatic", axis = "x", name = "side", role = "virtual", stiffness = 1 },
]
[[spring]]
name = "bladder"
shape = "area"
of = [{ on = "base", at = [0, 5] }, "tip", { on = "base", at = [6, 5] }]
law = { law = "one_sided", stiffness = 1, from = 12, side = "below" }
[[study]]
name = "push"
control = "pose"
direction = [0, 1]
until = { deflection = [0, 2.5] }
)toml");
  const auto list = nlohmann::json::parse(report_data(read, results))["runs"][0]["branches"][0];
  std::vector<double> acts;
  for (const analysis::Sample& row : results[0].branches[0].samples) {
    const RowScenes scenes{read.runs[0], results[0]};
    acts.push_back(scenes.scene_of(row).value().outlines.at(0).acts ? 1.0 : 0.0);
  }
  EXPECT_THAT(acts, testing::Contains(1.0));
  EXPECT_THAT(acts, testing::Contains(0.0));
  EXPECT_EQ(list["outlines"], base64_of(acts));
}

TEST_F(Report, RunsWithoutCurvesNameTheTableOfTheirStudy) {
  read = load(upright_bar_text(R"toml(control = "load"
direction = [0, -1]
until = { lambda = [0, 1.2] }
vary = { parameter = "k", values = [1, 2], table = [{ name = "P", at = "BP1", quantity = "lambda" }], curves = false }
[parameters]
k = 1
)toml"));
  for (const PlannedRun& run : read.runs) {
    analysis::StudyResult& result = results.emplace_back();
    result.study = run.study;
    result.run = run.run;
  }
  const auto runs = nlohmann::json::parse(report_data(read, results))["runs"];
  ASSERT_EQ(runs.size(), 2U);
  for (const auto& run : runs) EXPECT_EQ(run["table"], "sweeps/study.csv");
}

TEST_F(Report, JumpsEndAtTheirLandingAlsoWhereTheirMotionWasKept) {
  read = load_case(SPRINGFOLD_SOURCE_DIR "/cases/snap-through/case-toggle.toml");
  const PlannedRun& planned = read.runs.front();
  const auto result = analysis::run_study(planned.mechanism, planned.plan);
  ASSERT_TRUE(result.snap);
  const PageLists page = page_lists_of(planned, result, {}, "", read.units);
  std::size_t judged = 0;
  for (const analysis::Jump& jump : result.snap->jumps) {
    ASSERT_FALSE(jump.motion.empty());
    for (const PageRows& list : page.lists) {
      if (list.form != RowsForm::jump || list.points.front().label != jump.label) continue;
      EXPECT_THAT(list.rows.back()->values,
                  testing::Pointwise(testing::NanSensitiveDoubleEq(), jump.landing.values));
      EXPECT_EQ(list.points.front().row, list.rows.size() - 1);
      ++judged;
    }
    const FilmOutcome outcome = film_of(planned, result, read.units, {.jump = jump.label});
    const auto landing = RowScenes{planned, result}.scene_of(
        {.values = jump.landing.values, .piece = jump.landing.piece});
    EXPECT_EQ(outcome.film.frames.back().panel.scene.points, landing.value().points);
  }
  EXPECT_EQ(judged, result.snap->jumps.size());
  EXPECT_GE(judged, 1U);
}

}  // namespace
}  // namespace springfold::io
