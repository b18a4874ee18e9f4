// Every case of the library as a picture: its parts are where the results say, its words can be read.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "springfold/analysis/run.hpp"
#include "springfold/io/postures.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

std::vector<fs::path> library() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(SPRINGFOLD_SOURCE_DIR "/cases"))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("case") && name.ends_with(".toml"))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Only the start of the run: one row.
PlannedRun start_of(PlannedRun run) {
  run.plan.kind = analysis::StudyKind::equilibrium;
  run.plan.until.clear();
  run.plan.marks.clear();
  run.plan.branches = {};
  run.plan.snap.reset();
  // At the start they are zero, and an equilibrium has no lambda.
  std::erase_if(run.mechanism.loads, [](const model::Load& load) { return load.with_lambda; });
  return run;
}

/// The first run of every study that has a start.
std::vector<PlannedRun> starts_of(const Case& the_case) {
  std::vector<PlannedRun> runs;
  for (const PlannedRun& run : the_case.runs)
    if (run.run == 1 && !analysis::is_of_commands(run.plan.kind)) runs.push_back(start_of(run));
  return runs;
}

void expect_points_of_columns(const analysis::StudyResult& result, const drawing::Scene& scene,
                              const std::string& where) {
  const auto& values = result.branches.front().samples.front().values;
  for (const drawing::NamedPoint& point : scene.names)
    for (Index axis = 0; axis < (scene.is_planar ? 2 : 3); ++axis)
      for (std::size_t i = 0; i < result.quantities.size(); ++i)
        if (result.quantities[i].name == point.name + "." + "xyz"[axis]) {
          EXPECT_NEAR(scene.points[point.at][axis], values[i], 1e-9 * drawing::size_of(scene))
              << where << " " << point.name;
        }
}

TEST(Pictures, TheLibraryIsThere) { EXPECT_GT(library().size(), 70U); }

TEST(Pictures, EveryCaseDrawsAsItIsGivenAndItsWordsCanBeRead) {
  for (const fs::path& file : library()) {
    const Case the_case = load_case(file);
    const drawing::Panel panel = guess_panel(the_case.runs.front(), "guess");
    for (const bool is_perspective : {false, true})
      EXPECT_THAT(
          unreadable_words(drawing::illustrate({panel}, {.is_perspective = is_perspective})),
          IsEmpty())
          << file;
  }
}

TEST(Pictures, InEveryEquilibriumTheChainsEndWhereTheirBodiesAre) {
  for (const fs::path& file : library()) {
    const Case the_case = load_case(file);
    for (const PlannedRun& run : starts_of(the_case)) {
      const auto result = analysis::run_study_after(run.history, run.mechanism, run.plan);
      if (!result.start.found) continue;
      const std::string where = file.string() + " " + run.study;
      const auto panel = RowScenes{run, result}.panel_of(result.branches.front().samples.front(),
                                                         run.study, the_case.units);
      ASSERT_TRUE(panel) << where;
      EXPECT_LT(drawing::largest_gap(panel->scene), 1e-9) << where;
      expect_points_of_columns(result, panel->scene, where);
      EXPECT_THAT(unreadable_words(drawing::illustrate({*panel}, {.title = the_case.title})),
                  IsEmpty())
          << where;
    }
  }
}

TEST(Pictures, AllPosturesOfATracedBranchClose) {
  const Case the_case = load_case(SPRINGFOLD_SOURCE_DIR "/cases/toggle/case.toml");
  const PlannedRun& run = the_case.runs.front();
  const auto result = analysis::run_study_after(run.history, run.mechanism, run.plan);
  const RowScenes scenes{run, result};
  ASSERT_TRUE(scenes.has_postures());
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) {
      const auto scene = scenes.scene_of(row);
      ASSERT_TRUE(scene);
      EXPECT_LT(drawing::largest_gap(*scene), 1e-9);
    }
  std::vector<drawing::Panel> panels;
  for (const FoundRow& found : special_rows(result))
    panels.push_back(*scenes.panel_of(*found.row, found.title, the_case.units));
  EXPECT_GT(panels.size(), 3U);  // start, two ends, a limit point
  EXPECT_THAT(unreadable_words(drawing::illustrate(panels, {})), IsEmpty());
}

TEST(Pictures, ASpringCountedFromTheStartIsRelaxedThere) {
  const Case the_case = load_case(SPRINGFOLD_SOURCE_DIR "/cases/toggle/case.toml");
  model::Mechanism mechanism = the_case.runs.front().mechanism;
  analysis::Study study = the_case.runs.front().plan;
  const auto is_sprung = [](const model::Joint& j) { return j.spring && !j.spring_from_start; };
  for (model::Chain& chain : mechanism.chains)
    for (model::Element& element : chain.elements)
      if (auto* joint = std::get_if<model::Joint>(&element); joint && is_sprung(*joint)) {
        joint->spring = model::LinearSpring{.stiffness = 1};
        joint->spring_from_start = true;
      }
  PlannedRun run{.mechanism = mechanism, .plan = study};
  run = start_of(run);
  const auto result = analysis::run_study_after(run.history, run.mechanism, run.plan);
  ASSERT_TRUE(result.start.found);
  const auto scene = RowScenes{run, result}.scene_of(result.branches.front().samples.front());
  ASSERT_TRUE(scene);
  double energy = 0;
  for (const drawing::SpringPart& spring : scene->springs) energy += spring.energy;
  const auto& quantities = result.quantities;
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name == "energy") {
      EXPECT_NEAR(energy, result.branches.front().samples.front().values[i], 1e-12);
    }
}

}  // namespace
}  // namespace springfold::io
