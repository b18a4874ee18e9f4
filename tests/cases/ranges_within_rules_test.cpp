// Ranges of a parameter that reach beyond what a case may be given with: a spring whose stiffness would be negative. A
// truss of one bar to a guided apex, of length L with L^2 = 1 + y^2 and L0 at y = 1/2, and a spring of stiffness kv:
// the load is (L0 - L) y / L + kv (1/2 - y).
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;

const double guided_length0 = std::sqrt(1.25);

double limit_of_guided_truss(double kv) {
  // d/dy of the load: L0/L^3 - 1 - kv
  const double L = std::cbrt(guided_length0 / (1 + kv)), y = std::sqrt(L * L - 1);
  return (guided_length0 - L) * y / L + kv * (0.5 - y);
}

std::string guided_truss(const std::string& study, const std::string& kv = "0.05") {
  return "[parameters]\nkv = " + kv + R"toml(
[[node]]
name = "left"
at = [-1, 0]
fixed = true
[[node]]
name = "apex"
at = [0, 0.5]
fixed = ["x"]
[[bar]]
from = "left"
to = "apex"
stiffness = 1
[[spring]]
name = "v"
shape = "line"
of = ["apex", { on = "base", at = [-1, 0] }, { on = "base", at = [1, 0] }]
law = { law = "linear", stiffness = "kv", free = 0.5 }
[[study]]
name = "s"
control = "load"
body = "apex"
direction = [0, -1]
until = { apex.y = [-0.9, 0.9] }
)toml" + study;
}

TEST(RangesWithinRules, ACriticalCurveWithoutARangeEndsWhereTheCaseMayNotBeGiven) {
  const auto result =
      run(guided_truss("kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = "
                       "\"kv\" }\n"))
          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& branch = result.branches[0];
  for (const auto* stop : {&branch.backward, &branch.forward}) {
    EXPECT_TRUE(stop->complete);
    EXPECT_THAT(stop->reason, HasSubstr("may not be given"));
    EXPECT_THAT(stop->reason, HasSubstr("stiffness"));
  }
  for (std::size_t i = 0; i < branch.samples.size(); ++i)
    EXPECT_NEAR(std::abs(value(result, i, "lambda") - value(result, i, "kv") * 0.5),
                limit_of_guided_truss(value(result, i, "kv")) - value(result, i, "kv") * 0.5,
                1e-10);
  EXPECT_NEAR(value(result, 0, "kv"), 0, 1e-15);
  EXPECT_NEAR(value(result, branch.samples.size() - 1, "kv"), 0, 1e-15);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(RangesWithinRules, AThresholdIsLookedForWhereTheCaseMayBeGiven) {
  const auto text = [](const std::string& range) {
    return guided_truss(
        "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
        "\"kv\", range = " +
        range + " }\n");
  };
  const auto result = run(text("[-1, 2]")).of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, guided_length0 - 1, 1e-9);
  EXPECT_THAT(result.threshold->message, HasSubstr("kv = -1 to 0 is left out"));
  EXPECT_TRUE(complete(result));

  const auto none = run(text("[-2, -1]")).of("s");
  EXPECT_FALSE(none.start.found);
  EXPECT_THAT(none.start.message, HasSubstr("stiffness"));
}

TEST(RangesWithinRules, TheRuleIsToldOfWhatTheCaseCallsByName) {
  const std::string threshold =
      "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = \"kv\", range = "
      "[-1, 2] }\n";
  const auto told = [](const std::string& text) {
    const auto result = run(text).of("s");
    return result.threshold ? result.threshold->message : std::string{};
  };
  // A spring of a distance.
  EXPECT_THAT(told(guided_truss(threshold)), HasSubstr("may not be given there: v: law.stiffness"));
  // Bars: one that pushes only is a spring of a distance as well, the other one is none.
  const auto with_stay = [&](const std::string& kind) {
    std::string text = guided_truss(threshold);
    const std::string spring = "law = { law = \"linear\", stiffness = \"kv\", free = 0.5 }";
    text.replace(text.find(spring), spring.size(), "stiffness = 0.05\nfree = 0.5");
    return text.insert(text.find("[[study]]"),
                       "[[bar]]\nname = \"stay\"\nfrom = \"base\"\nfrom_at = [0, -1]\nto = "
                       "\"apex\"\nstiffness = \"kv\"\n" +
                           kind);
  };
  for (const std::string kind : {"", "compression_only = true\n"})
    EXPECT_THAT(told(with_stay(kind)), HasSubstr("may not be given there: stay: ")) << kind;
  // A spring of a joint.
  EXPECT_THAT(told(R"toml(
[parameters]
kv = 1
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [ { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "linear", stiffness = "kv" } }, { rigid = [0, 1] } ]
[[study]]
name = "s"
control = "load"
direction = [0, -1]
until = { bar.q = [-1, 1], lambda = [-0.1, 1.5] }
kind = "threshold"
threshold = { of = "loss_of_stability", parameter = "kv", range = [-1, 2] }
)toml"),
              HasSubstr("may not be given there: bar.q: spring.stiffness"));
}

TEST(RangesWithinRules, BeyondThemIsToldWhereARangeThatWasAskedForEnds) {
  const auto loads =
      run(guided_truss("kind = \"critical_load\"\ncritical_load = { of = \"limit_point\", "
                       "parameter = \"kv\", range = [-0.05, 0.1], values = 7 }\n"))
          .of("s");
  const auto curve =
      run(guided_truss("mark = { kv = [0] }\nkind = \"critical_curve\"\n"
                       "critical_curve = { of = \"LP1\", parameter = \"kv\", range = "
                       "[-0.05, 0.1] }\n"))
          .of("s");
  for (const auto& result : {loads, curve}) {
    ASSERT_EQ(result.branches.size(), 1U);
    const auto& branch = result.branches[0];
    EXPECT_NEAR(value(result, 0, "kv"), -0.05, 1e-12);
    EXPECT_NEAR(value(result, 0, "lambda"), limit_of_guided_truss(-0.05), 1e-10);
    EXPECT_THAT(branch.backward.reason, HasSubstr("beyond kv = 0 the case may not be given"));
    EXPECT_TRUE(result.doubts.empty());
  }
  EXPECT_EQ(lambdas(curve, analysis::EventKind::user_value).size(), 1U);
}

TEST(RangesWithinRules, ADesignKeepsToWhatTheCaseMayBeGivenWith) {
  const auto bounded = [](const std::string& low) {
    return run(guided_truss("kind = \"design\"\n[study.design]\nparameters = { kv = [" + low +
                                ", 2] }\nscale = { kv = 1 }\nno_limit_point = {}\n",
                            "0.001"))
        .of("s");
  };
  const auto far = bounded("-1"), near = bounded("0");
  ASSERT_TRUE(far.design && near.design);
  EXPECT_EQ(far.design->parameters[0].low, 0);
  EXPECT_NEAR(far.design->parameters[0].after, guided_length0 - 1, 1e-6);
  EXPECT_NEAR(near.design->parameters[0].after, guided_length0 - 1, 1e-6);
  EXPECT_THAT(far.design->message, HasSubstr("kv = -1 to 0 is left out"));
}

}  // namespace
}  // namespace springfold::io
