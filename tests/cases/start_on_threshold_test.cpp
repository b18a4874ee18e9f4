// Studies that begin exactly where a spring begins to act or changes its stiffness.
#include <gmock/gmock.h>

#include "case_runs.hpp"
#include "number_text.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// A slider on a spring whose stiffness is 1 up to `from` and `behind` beyond it, without force at 1.
std::string slider(const std::string& from, double behind, const std::string& studies) {
  return "[parameters]\nfrom = " + from +
         "\n[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [1, 0]\n[[chain]]\nname = \"b\"\n"
         "elements = [{ joint = \"prismatic\", axis = \"x\", name = \"s\", role = \"preloaded\", "
         "initial "
         "= 1, spring = { law = \"piecewise_linear\", breakpoints = [\"from\"], stiffnesses = "
         "[1, " +
         number(behind) + "], free = 1 } }]\n" + studies;
}

std::string pulled(const std::string& name, const std::string& more) {
  return "[[study]]\nname = \"" + name + "\"\ncontrol = \"load\"\ndirection = [1, 0]\n" + more;
}

std::vector<std::string> labels_at_start(const analysis::StudyResult& result) {
  std::vector<std::string> labels;
  for (const auto& event : result.branches[0].events) labels.push_back(event.label);
  return labels;
}

TEST(StartOnAThreshold, HasTheSwitchingOfTheSameCurveBegunElsewhere) {
  const Ran ran =
      run(slider("1", 3,
                 pulled("here", "until = { lambda = [-1, 1] }\n") +
                     pulled("deep", "until = { lambda = [-1, 1] }\nbranches = { depth = 1 }\n") +
                     pulled("away", "load = [0.3, 0]\nuntil = { lambda = [-1.3, 0.7] }\n")));
  for (const char* study : {"here", "deep", "away"}) {
    const auto& result = ran.of(study);
    EXPECT_TRUE(complete(result));
    EXPECT_THAT(labels_at_start(result), testing::ElementsAre("EP1", "SA1", "EP2")) << study;
    const auto& event = result.branches[0].events[1];
    EXPECT_NEAR(value(result, event.row, "tip.x"), 1, 1e-12);
    EXPECT_NEAR(value(result, event.row, "stiffness"), 1, 1e-12);
    EXPECT_NEAR(value(result, event.row + 1, "stiffness"), 3, 1e-12);
    EXPECT_EQ(result.branches[0].samples[event.row + 1].event, "SA1");
    for (const std::size_t row : {event.row, event.row + 1}) {
      EXPECT_EQ(value(result, row, "index"), 0);
      EXPECT_EQ(value(result, row, "index_force"), 0);
    }
    EXPECT_THAT(event.detail, testing::HasSubstr("gets stiffer (segment 0 to 1)"));
  }
}

TEST(StartOnAThreshold, HasItsSwitchingHoweverNearTheRangeEnds) {
  for (const char* range : {"[-0.001, 1]", "[-1e-6, 1]", "[-1, 1e-4]", "[-1e-5, 1e-5]"}) {
    const Ran ran =
        run(slider("1", 3, pulled("s", "until = { lambda = " + std::string{range} + " }\n")));
    const auto& result = ran.of("s");
    EXPECT_TRUE(complete(result)) << range;
    EXPECT_THAT(labels_at_start(result), testing::ElementsAre("EP1", "SA1", "EP2")) << range;
    EXPECT_NEAR(value(result, result.branches[0].events[1].row, "lambda"), 0, 1e-12);
  }
}

TEST(StartOnAThreshold, IsFollowedInASecondParameterAndHasRates) {
  // Another stiffness moves the start away from 1 and the threshold with it: the switching stays at the start.
  const std::string two =
      "[parameters]\nk = 1\nc = 2\n[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [1, 0]\n"
      "[[chain]]\nname = \"b\"\nelements = [{ joint = \"prismatic\", axis = \"x\", name = \"s\", "
      "role = "
      "\"preloaded\", initial = 0.5, spring = { law = \"piecewise_linear\", breakpoints = [0.5], "
      "stiffnesses = [\"k\", \"3*k\"], free = 0.5 } }, { joint = \"prismatic\", axis = \"x\", name "
      "= "
      "\"t\", role = \"preloaded\", initial = 0.5, spring = { law = \"linear\", stiffness = \"c\", "
      "free = "
      "0.5 } }]\n";
  const std::string range = "until = { lambda = [-2, 2] }\n";
  const Ran ran =
      run(two +
          pulled("c",
                 "kind = \"critical_curve\"\ncritical_curve = { of = \"SA1\", "
                 "parameter = \"k\", range = [0.5, 2] }\n" +
                     range) +
          pulled("s", "kind = \"sensitivity\"\nsensitivity = { parameters = [\"k\"] }\n" + range));
  const auto& curve = ran.of("c");
  EXPECT_TRUE(complete(curve));
  ASSERT_GT(curve.branches[0].samples.size(), 2u);
  for (std::size_t row = 0; row < curve.branches[0].samples.size(); ++row)
    EXPECT_NEAR(value(curve, row, "lambda"), 0, 1e-12);
  EXPECT_TRUE(complete(ran.of("s")));
  EXPECT_THAT(labels_at_start(ran.of("s")), testing::Contains("SA1"));
}

TEST(BetweenEqualSegments, NothingSwitchesAtTheStartOrElsewhere) {
  const Ran ran =
      run(slider("1", 1,
                 pulled("here", "until = { lambda = [-1, 1] }\n") +
                     pulled("away", "load = [0.3, 0]\nuntil = { lambda = [-1, 1] }\n")));
  for (const char* study : {"here", "away"})
    EXPECT_THAT(labels_at_start(ran.of(study)), testing::ElementsAre("EP1", "EP2")) << study;
}

TEST(StartOnAThreshold, OfTwoSpringsAtOnceHasOneSwitching) {
  const Ran ran =
      run("[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [1, 0]\n[[chain]]\nname = "
          "\"b\"\nelements = "
          "[{ joint = \"prismatic\", axis = \"x\", name = \"s\", role = \"preloaded\", initial = "
          "0.5, spring = { "
          "law = \"piecewise_linear\", breakpoints = [0.5], stiffnesses = [1, 3], free = 0.5 } }, "
          "{ joint = "
          "\"prismatic\", axis = \"x\", name = \"t\", role = \"preloaded\", initial = 0.5, spring "
          "= { law = "
          "\"piecewise_linear\", breakpoints = [0.5], stiffnesses = [2, 1], free = 0.5 } }]\n" +
          pulled("s", "until = { lambda = [-1, 1] }\n"));
  const auto& result = ran.of("s");
  EXPECT_THAT(labels_at_start(result), testing::ElementsAre("EP1", "SA1", "EP2"));
  const auto row = result.branches[0].events[1].row;
  EXPECT_NEAR(value(result, row, "stiffness"), 2.0 / 3, 1e-12);
  EXPECT_NEAR(value(result, row + 1, "stiffness"), 3.0 / 4, 1e-12);
}

/// A strut that leans against its hinge, which carries to one side alone and stands on that threshold without a load,
/// held by a guy.
std::string leaning_strut(const std::string& control, double load_from) {
  return "[parameters]\npsi = " + number(load_from) + "\nt0 = 0.1756\n" +
         strut_that_gives(R"({ law = "one_sided", stiffness = 1.1708, from = "t0" })", "25.1978") +
         R"toml([[spring]]
name = "guy"
from_at = [-1.0491, 0]
to = "tip"
stiffness = 0.8022
free = "sqrt((sin(t0) + 1.0491)^2 + cos(t0)^2)"
[[study]]
name = "margin"
kind = "critical_curve"
direction = ["sin(psi)", "-cos(psi)"]
until = { strut.along = [-0.98, 3], strut.hinge = [-3.1, 3.1], lambda = [-0.6, 6] }
critical_curve = { of = "LP1", parameter = "psi", range = ["-30*deg", "40*deg"] }
control = ")toml" +
         control + "\"\n";
}

/// Rounding has the side of the hinge at the start, another one for every direction of the load.
TEST(CurvesFromThresholds, HaveTheSameCuspFromEveryStartAndUnderTheDisplacement) {
  std::vector<double> cusps;
  for (const char* control : {"load", "mixed"})
    for (const double from : {-0.185, -0.1815, -0.181}) {
      const auto margin = run(leaning_strut(control, from)).of("margin");
      for (const analysis::Branch& piece : margin.branches)
        for (const analysis::Event& event : piece.events)
          if (event.kind == analysis::EventKind::cusp)
            cusps.push_back(value(margin, piece, event.row, "psi"));
    }
  ASSERT_EQ(cusps.size(), 6u);
  for (const double psi : cusps) EXPECT_NEAR(psi, cusps.front(), 1e-9);
}

}  // namespace
}  // namespace springfold::io
