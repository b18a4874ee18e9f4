// Starts in neutral equilibrium: any state of the motion that nothing resists is one, and the case's guess says which.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A bar of length 1 turns freely from the angle t0 until its end meets a stop at height 0.8.
std::string free_bar(const std::string& study) {
  return R"toml(
[parameters]
t0 = 0.4
c = 1
[[body]]
name = "tip"
task_space = "planar"
pose = ["cos(t0)", "sin(t0)", "t0"]
[[chain]]
name = "bar"
elements = [ { joint = "revolute", axis = "z", name = "hinge", initial = "t0" }, { rigid = [1, 0] } ]
[[spring]]
name = "stop"
shape = "line"
of = ["tip", { on = "base", at = [0, 0] }, { on = "base", at = [1, 0] }]
law = { law = "one_sided", stiffness = "c", from = 0.8 }
[[study]]
name = "s"
control = "mixed"
direction = [0, 0, 1]
until = { deflection = [-0.3, 0.8] }
)toml" + study;
}

TEST(NeutralStarts, ThatAParameterTurnsMoveTheContactBehindThem) {
  const analysis::StudyResult result = run(free_bar("kind = \"sensitivity\"\n")).of("s");
  const auto& events = result.branches.at(0).events;
  const auto contact = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == analysis::EventKind::switching;
  });
  ASSERT_NE(contact, events.end());
  EXPECT_NEAR(value(result, contact->row, "lambda"), std::asin(0.8) - 0.4, 1e-10);
  EXPECT_NEAR(value(result, contact->row, "d(lambda)/d(t0)"), -1, 1e-9);
  EXPECT_NEAR(value(result, contact->row, "d(lambda)/d(c)"), 0, 1e-9);
}

TEST(NeutralStarts, AreThoseOfTheCaseAllAlongACriticalCurve) {
  const auto ran = run(
      free_bar("kind = \"critical_curve\"\ncritical_curve = { of = \"SA1\", parameter = \"t0\", "
               "range = [0.2, 0.6] }\n"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  for (const auto& sample : samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")],
                std::asin(0.8) - sample.values[column(result, "t0")], 1e-10);
}

}  // namespace
}  // namespace springfold::io
