// Zeeman's curve: all places of the hand at which the wheel of cases/string-toy flips.
#include <gtest/gtest.h>

#include <algorithm>

#include "springfold/analysis/run.hpp"
#include "springfold/io/postures.hpp"

namespace springfold::io {
namespace {

class ZeemansCurve : public testing::Test {
 protected:
  const Case toy = load_case(SPRINGFOLD_SOURCE_DIR "/cases/string-toy/case.toml");
  const PlannedRun& run = *std::find_if(toy.runs.begin(), toy.runs.end(),
                                        [](const PlannedRun& r) { return r.study == "edge"; });
  const analysis::StudyResult result = analysis::run_study(run.mechanism, run.plan, &*run.family);

  double value(const analysis::Sample& row, const std::string& name) const {
    const auto& all = result.quantities;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.name == name; });
    return row.values[static_cast<std::size_t>(found - all.begin())];
  }
};

TEST_F(ZeemansCurve, EndsWhereItCloses) {
  ASSERT_EQ(result.branches.size(), 1U);
  const analysis::Branch& curve = result.branches.front();
  EXPECT_TRUE(curve.forward.complete) << curve.forward.reason;
  EXPECT_TRUE(curve.backward.complete) << curve.backward.reason;
  for (const char* name : {"c", "lambda", "pin.x", "pin.y"})
    EXPECT_NEAR(value(curve.samples.front(), name), value(curve.samples.back(), name), 1e-10)
        << name;
  EXPECT_EQ(
      std::count_if(curve.events.begin(), curve.events.end(),
                    [](const analysis::Event& e) { return e.kind == analysis::EventKind::cusp; }),
      4);
}

TEST_F(ZeemansCurve, IsDrawnAtTheValuesOfBothParameters) {
  const RowScenes scenes{run, result};
  for (const analysis::Sample& row : result.branches.front().samples) {
    const auto scene = scenes.scene_of(row);
    ASSERT_TRUE(scene);
    const auto string =
        std::find_if(scene->springs.begin(), scene->springs.end(),
                     [](const drawing::SpringPart& s) { return s.name == "hand-string"; });
    ASSERT_NE(string, scene->springs.end());
    const auto& hand = scene->points[string->from];
    EXPECT_NEAR(hand[0], value(row, "c"), 1e-12);
    EXPECT_NEAR(hand[1], value(row, "lambda"), 1e-12);
  }
}

}  // namespace
}  // namespace springfold::io
