// Starts of the values of a parameter belong to each other as far as they can be followed; paths that leave a point
// that is followed just before it vanishes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// An arm of length L on a spring of three slopes, the middle one of which falls, and a strut at its tip that pushes
/// below `fr`.
std::string arm(const std::string& parameters, const std::string& study) {
  return "[parameters]\n" + parameters + R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = ["L*cos(t0)", "L*sin(t0)"]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "t", initial = "t0", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = ["t0-b2", "t0-b1"], stiffnesses = ["kd", "kb", "ka"], free = "t0", falling = true } },
  { rigid = ["L", 0] } ]
[[spring]]
name = "c"
from_at = ["x0", "y0"]
to = "tip"
law = { law = "one_sided", stiffness = "ks", from = "fr", side = "below" }
[[study]]
name = "s"
control = "load"
direction = ["cos(psi)", "sin(psi)"]
)toml" + study;
}

const std::string first_arm = R"toml(L = 1.8057
psi = 5.2056
t0 = 0.8717
kb = 0.4272
kd = 1.3774
b1 = 0.4687
b2 = 1.4855
x0 = 1.7732
y0 = 2.0202
ks = 0.5295
fr = 1.4511
)toml";

/// At zero load the strut turns the arm to one stable angle, which moves smoothly with `ka`.
TEST(StartsAlongAParameter, GiveTheSameFirstLoadsWhateverTheCaseBeginsWith) {
  const std::string study = R"toml(kind = "critical_load"
until = { lambda = [-6.53, 6.53], arm.t = [-1.989, 3.811] }
critical_load = { of = "loss_of_stability", parameter = "ka", range = [0.9912, 5.2038], values = 13 }
)toml";
  for (const char* ka : {"ka = 2.478\n", "ka = 1.4\n"}) {
    const auto result = run(arm(ka + first_arm, study)).of("s");
    EXPECT_TRUE(result.doubts.empty()) << ka << result.doubts.front();
    ASSERT_EQ(result.branches.size(), 1u) << ka;
    const analysis::Branch& branch = result.branches.front();
    EXPECT_NEAR(branch.samples.front().values.back(), 0.9912, 1e-12) << ka;
    EXPECT_NEAR(value(result, 0, "lambda"), 0.05076701321, 1e-9) << ka;
    EXPECT_NEAR(branch.samples.back().values.back(), 1.670046013, 1e-8) << ka;
  }
}

/// Where the load acts along the arm at its start the straight path has a branch point: on one side of that direction
/// the arm turns to its limit point, on the other one away from it.
TEST(Threshold, IsTheDirectionInWhichThePathLeavesItsLimitPoint) {
  const auto result = run(arm(R"toml(L = 1.3337
psi = 5.0754
t0 = 2.4097
ka = 2.6759
kb = 0.6022
kd = 3.204
b1 = 0.4664
b2 = 1.6216
x0 = 0.2818
y0 = 1.7628
ks = 1.5669
fr = 0.93
)toml",
                              R"toml(kind = "threshold"
until = { lambda = [-6.171, 6.171], arm.t = [-0.4903, 5.3097] }
threshold = { of = "limit_point", parameter = "psi", range = [3.8754, 6.3754], value = "largest" }
)toml"))
                          .of("s");
  ASSERT_TRUE(result.threshold.has_value());
  EXPECT_TRUE(result.threshold->found);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_NEAR(result.threshold->value, 2.4097 + std::numbers::pi, 1e-9);
  EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
}

/// The anchor of the strut lies sqrt(x0^2 + y0^2) = 1.80594 from the foot: there an arm of that length brings its tip
/// to it.
TEST(FirstCriticalLoads, SayWhereTheLengthOfASpringComesToZero) {
  const auto result = run(arm(R"toml(L = 1.874
psi = 2.0026
t0 = 2.5707
ka = 0.9953
kb = 1.1884
kd = 0.6553
b1 = 0.4444
b2 = 1.2461
x0 = -1.0908
y0 = 1.4393
ks = 0.4763
fr = 0.9844
)toml",
                              R"toml(kind = "critical_load"
until = { lambda = [-6.776, 6.776], arm.t = [-0.2154, 5.5846] }
critical_load = { of = "loss_of_stability", parameter = "L", range = [1.1244, 2.811], values = 13 }
)toml"))
                          .of("s");
  int told = 0;
  for (const analysis::Branch& branch : result.branches)
    for (const auto& stop : {branch.backward, branch.forward}) {
      EXPECT_THAT(stop.reason, testing::Not(testing::HasSubstr("another branch may be near")));
      if (stop.reason.find("at the length 0 its force has no direction") == std::string::npos)
        continue;
      ++told;
      EXPECT_THAT(stop.reason, testing::StartsWith("the length of c has come down to"));
    }
  EXPECT_GT(told, 0);
}

/// Two nodes on bars to three points and a strut between them. Where the first one folds away from the second the strut
/// is slack, and the second one rests on its own bars, at the very length of another strut: what rounding makes of that
/// is no event.
TEST(CriticalCurves, PassAStrutThatRestsElsewhere) {
  const auto ran = run(R"toml(
[parameters]
s1 = -0.0758
a = 0.9535
h = 0.4262
[[node]]
name = "f0"
at = ["1.1181*a", -0.1788]
fixed = true
[[node]]
name = "f1"
at = ["-0.5915*a", 0.011]
fixed = true
[[node]]
name = "f2"
at = ["-0.6231*a", 0.0606]
fixed = true
[[node]]
name = "n0"
at = [-0.071, "h"]
[[node]]
name = "n1"
at = [0.5521, "h"]
[[bar]]
from = "f0"
to = "n0"
stiffness = 0.8187
[[bar]]
from = "f1"
to = "n0"
stiffness = 2.1264
pretension = "2.1264*s1"
[[bar]]
from = "f2"
to = "n0"
stiffness = 0.5818
pretension = 0.06847786
[[bar]]
from = "f0"
to = "n1"
stiffness = 0.6163
[[bar]]
from = "f1"
to = "n1"
stiffness = 2.6206
[[bar]]
from = "f2"
to = "n1"
stiffness = 1.4496
compression_only = true
[[bar]]
from = "n0"
to = "n1"
stiffness = 2.7307
compression_only = true
[[study]]
name = "path"
body = "n0"
control = "load"
direction = ["sin(-0.4867)", "-cos(-0.4867)"]
until = { lambda = [-2.947, 2.947], n0.y = [-2.5, 3] }
[[study]]
name = "s"
kind = "critical_curve"
body = "n0"
control = "load"
direction = ["sin(-0.4867)", "-cos(-0.4867)"]
until = { lambda = [-2.947, 2.947], n0.y = [-2.5, 3] }
critical_curve = { of = "LP2", parameter = "s1", range = [-0.1958, 0.0742] }
)toml");
  const auto& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  EXPECT_NEAR(samples.front().values.back(), -0.1958, 1e-12);
  EXPECT_NEAR(samples.back().values.back(), 0.0742, 1e-12);
  std::vector<double> loads;
  for (const auto& event : ran.of("path").branches.at(0).events)
    if (event.label == "LP2") loads.push_back(value(ran.of("path"), event.row, "lambda"));
  ASSERT_EQ(loads.size(), 1u);
  const auto own = std::ranges::find_if(
      samples, [](const auto& sample) { return std::abs(sample.values.back() + 0.0758) < 1e-12; });
  ASSERT_NE(own, samples.end());
  EXPECT_NEAR(own->values[column(result, "lambda")], loads[0], 1e-10);
}

/// A point on two slides whose knees have springs beyond an angle: 15 degrees that of x, 0.1 that of y. At py = sin(15
/// deg) the first one touches at the start itself, where the drives are set.
std::string two_slides(
    const std::string& py, const std::string& study,
    const std::string& law = R"(law = "one_sided", stiffness = 0.05, from = "15*deg")") {
  return "[parameters]\npy = " + py + R"toml(
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { )toml" +
         law + R"toml( } },
  { rigid = [-1, 0] } ]
[[chain]]
name = "y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "one_sided", stiffness = 0.05, from = 0.1 } },
  { rigid = [0, -1] } ]
[[study]]
name = "s"
control = "load"
direction = [0.8, 0.6]
start = { pose = [0.42, "py"], solve = "actuators" }
until = { lambda = [0, 3], "x.knee" = ["-80*deg", "80*deg"], "y.knee" = ["-80*deg", "80*deg"] }
)toml" + study;
}

TEST(CriticalCurves, GoOnWhereASpringSwitchesAtTheStartItself) {
  const double kink = std::sin(15 * std::numbers::pi / 180);
  for (const char* kind : {"critical_load", "critical_curve"}) {
    SCOPED_TRACE(kind);
    const bool of_load = std::string{kind} == "critical_load";
    const auto result =
        run(two_slides("0.2", "kind = \"" + std::string{kind} +
                                  "\"\nmark = { py = [0.22, 0.2587, 0.2589, 0.3] }\n" + kind +
                                  (of_load ? " = { of = \"loss_of_stability\", values = 9, "
                                           : " = { of = \"LP1\", ") +
                                  "parameter = \"py\", range = [0.15, 0.35] }\n"))
            .of("s");
    EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
    ASSERT_EQ(result.branches.size(), 1u);
    const analysis::Branch& branch = result.branches.front();
    EXPECT_TRUE(branch.forward.complete && branch.backward.complete);
    EXPECT_NEAR(branch.samples.front().values.back(), 0.15, 1e-9);
    EXPECT_NEAR(branch.samples.back().values.back(), 0.35, 1e-9);
    EXPECT_TRUE(std::any_of(branch.samples.begin(), branch.samples.end(), [&](const auto& row) {
      return std::abs(row.values.back() - kink) < 1e-9;
    })) << "the kink has a row of its own";
    int marks = 0;
    for (const analysis::Event& event : branch.events) {
      if (event.kind != analysis::EventKind::user_value) continue;
      ++marks;
      const double py = branch.samples[event.row].values.back();
      const auto path =
          run(two_slides(std::to_string(py), "kind = \"force_deflection\"\n")).of("s");
      const auto limits = lambdas(path, analysis::EventKind::limit_point);
      ASSERT_FALSE(limits.empty());
      EXPECT_NEAR(value(result, event.row, "lambda"), limits.front(), 1e-9);
    }
    EXPECT_EQ(marks, 4);
  }
}

/// Weak kinks are crossed by steps: the curve must not creep there.
TEST(CriticalCurves, TakeNoMorePointsWhereASpringChangesItsStiffnessALittleAtTheStart) {
  for (const char* second : {"0.0528", "0.0511", "0.045", "0.04", "0.03"}) {
    SCOPED_TRACE(second);
    const std::string law =
        std::string{"law = \"piecewise_linear\", breakpoints = [\"15*deg\"], "} +
        "stiffnesses = [0.0529, " + second + "], free = \"15*deg\"";
    const auto result =
        run(two_slides(
                "0.2",
                "kind = \"critical_curve\"\nmark = { py = [0.2587, 0.2589] }\n"
                "critical_curve = { of = \"LP1\", parameter = \"py\", range = [0.15, 0.35] }\n",
                law))
            .of("s");
    EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
    ASSERT_EQ(result.branches.size(), 1u);
    const analysis::Branch& branch = result.branches.front();
    EXPECT_TRUE(branch.forward.complete && branch.backward.complete);
    EXPECT_LT(branch.samples.size(), 150U);
    int marks = 0;
    for (const analysis::Event& event : branch.events) {
      EXPECT_NE(event.kind, analysis::EventKind::unresolved);
      if (event.kind != analysis::EventKind::user_value) continue;
      ++marks;
      const double py = branch.samples[event.row].values.back();
      const auto path =
          run(two_slides(std::to_string(py), "kind = \"force_deflection\"\n", law)).of("s");
      const auto limits = lambdas(path, analysis::EventKind::limit_point);
      ASSERT_FALSE(limits.empty());
      EXPECT_NEAR(value(result, event.row, "lambda"), limits.front(), 1e-9);
    }
    EXPECT_GE(marks, 2);
  }
}

TEST(CriticalCurves, BeginAtAKinkAsElsewhere) {
  for (const char* py : {"\"sin(15*deg)\"", "\"sin(15*deg)+1e-12\"", "\"sin(15*deg)-1e-8\""}) {
    SCOPED_TRACE(py);
    const auto result =
        run(two_slides(py,
                       "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", "
                       "parameter = \"py\", range = [0.15, 0.35] }\n"))
            .of("s");
    EXPECT_TRUE(result.doubts.empty()) << result.doubts.front();
    ASSERT_EQ(result.branches.size(), 1u);
    const analysis::Branch& branch = result.branches.front();
    EXPECT_TRUE(branch.forward.complete && branch.backward.complete);
    EXPECT_NEAR(branch.samples.front().values.back(), 0.15, 1e-9);
    EXPECT_NEAR(branch.samples.back().values.back(), 0.35, 1e-9);
    EXPECT_LT(branch.samples.size(), 100U);
  }
}

/// The cusp at p = 0.47955 lies within the differences' reach of the kink at sin(28.66 deg) = 0.47962.
TEST(CriticalCurves, SayWhereTheyCannotBeFollowedOverAKink) {
  const std::string law = R"(law = "one_sided", stiffness = 0.05, from = "28.66*deg")";
  for (const char* study : {"kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter "
                            "= \"py\", range = [0.05, "
                            "0.6] }\n",
                            "kind = \"critical_load\"\ncritical_load = { of = \"limit_point\", "
                            "parameter = \"py\", range = "
                            "[0.3, 0.6], values = 4 }\n",
                            "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
                            "\"py\", range = [0.3, 0.6] "
                            "}\n"}) {
    SCOPED_TRACE(study);
    const auto result = run(two_slides("0.35", study, law)).of("s");
    EXPECT_FALSE(analysis::complete(result) && result.doubts.empty());
  }
}

}  // namespace
}  // namespace springfold::io
