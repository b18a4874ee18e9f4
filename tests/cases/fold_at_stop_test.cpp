// A stop just behind the limit point of a slider: which of the two is told, down to the smallest distance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

/// P(q) = q^3 - 3 a q + k max(0, q - g), with P(-3) taken off; it turns at q = -sqrt(a) = -1 unless g lies before that.
std::string slider_with_stop(const std::string& g, const std::string& study,
                             const std::string& k = "4") {
  return R"toml(
[parameters]
a = 1
k = )toml" +
         k + R"toml(
g = ")toml" +
         g + R"toml("
[[body]]
name = "n"
task_space = "xy"
pose = [-3, 0]
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "q", role = "preloaded", initial = -3, spring = { law = "polynomial", coefficients = [0, "-3*a", 0, 1], falling = true } }]
[[spring]]
name = "stop"
from_at = [-10, 0]
to = "n"
law = { law = "one_sided", stiffness = "k", from = "10 + g" }
[[study]]
name = "s"
control = "load"
direction = [1, 0]
load = ["-27 + 9*a", 0]
start = { pose = [-3, 0] }
until = { n.x = [-3.2, 3] }
)toml" + study;
}

TEST(FoldAtStop, TheGapAtWhichBucklingEndsIsConfirmedByTracingBesideIt) {
  const auto result =
      run(slider_with_stop("0.5",
                           "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
                           "\"g\", range = [-2, 0.5], value = \"largest\" }\n"))
          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, -1, 1e-9);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(FoldAtStop, ADesignWithThatGapIsConfirmedToo) {
  // Beside g = -1 the load falls by no more than 3 (g + 1)^2 between the fold and the corner.
  for (const std::string k : {"3.01", "4", "40"}) {
    SCOPED_TRACE(k);
    const auto result =
        run(slider_with_stop("0.5",
                             "kind = \"design\"\ndesign = { parameters = { g = [-2, 0.5] }, "
                             "no_limit_point = {} }\n",
                             k))
            .of("s");
    ASSERT_TRUE(result.design);
    EXPECT_EQ(result.design->status, analysis::DesignStatus::met);
    EXPECT_NEAR(result.design->parameters.at(0).after, -1, 1e-7);
    EXPECT_TRUE(result.design->verified);
    EXPECT_THAT(result.design->message, testing::HasSubstr("confirmed at a relative distance of"));
    EXPECT_TRUE(result.doubts.empty());
  }
}

/// Over a the first fold, q = -sqrt(a), meets the stop at a = g^2. There it and the corner are born in which the load
/// rises again, up to a = g^2 + k / 3, where the load falls behind the stop too: there the corner and the folds q^2 = a
/// - k / 3 meet.
TEST(FoldAtStop, LimitPointsAreFollowedBeyondTheStop) {
  using analysis::EventKind;
  constexpr double g = -0.5, k = 0.6;
  const auto result =
      run(slider_with_stop(
              "-0.5",
              "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = "
              "\"a\", range = [0.05, 2] }\n",
              "0.6"))
          .of("s");
  ASSERT_EQ(result.branches.size(), 3U);
  EXPECT_TRUE(complete(result));
  const auto at = [&](const analysis::Sample& row, const std::string& name) {
    const auto found = std::find_if(result.quantities.begin(), result.quantities.end(),
                                    [&](const auto& q) { return q.name == name; });
    return row.values.at(static_cast<std::size_t>(found - result.quantities.begin()));
  };
  for (std::size_t piece = 0; piece < 3; ++piece)
    for (const analysis::Sample& row : result.branches[piece].samples) {
      const double a = at(row, "a"), q = at(row, "n.x");
      const double slope = 3 * q * q - 3 * a + (piece == 2 ? k : 0);
      EXPECT_NEAR(piece == 1 ? q - g : slope, 0, 1e-10) << piece << " " << a;
      EXPECT_EQ(q > g + 1e-9, piece == 2 && std::abs(q - g) > 1e-9) << piece << " " << a;
      EXPECT_NEAR(at(row, "lambda"), q * q * q - 3 * a * q + k * std::max(0.0, q - g) + 27 - 9 * a,
                  1e-10);
    }
  const auto place_of = [&](std::size_t piece, EventKind kind) {
    for (const analysis::Event& event : result.branches[piece].events)
      if (event.kind == kind) return at(result.branches[piece].samples[event.row], "a");
    return std::nan("");
  };
  EXPECT_NEAR(place_of(0, EventKind::fold_meets_activation), g * g, 1e-9);
  EXPECT_NEAR(place_of(1, EventKind::corner_loses_reversal), g * g + k / 3, 1e-9);
  EXPECT_NEAR(place_of(2, EventKind::cusp), k / 3, 1e-9);
  EXPECT_NEAR(at(result.branches[2].samples.back(), "a"), 2, 1e-9);
}

/// A second stop on the way, q > -0.2, of stiffness 1.5, takes the folds q^2 = a - 0.2 up at a = 0.24, lets them go on
/// as a corner up to a = 0.74, and then as q^2 = a - 0.7.
TEST(FoldAtStop, LimitPointsAreFollowedBeyondASecondStop) {
  using analysis::EventKind;
  const auto result = run(slider_with_stop("-0.5", R"toml(kind = "critical_curve"
critical_curve = { of = "LP1", parameter = "a", range = [0.05, 2] }
[[spring]]
name = "second"
from_at = [-10, 0]
to = "n"
law = { law = "one_sided", stiffness = 1.5, from = 9.8 }
)toml",
                                           "0.6"))
                          .of("s");
  EXPECT_TRUE(complete(result));
  const auto found = std::find_if(result.quantities.begin(), result.quantities.end(),
                                  [](const auto& q) { return q.name == "a"; });
  const auto a = static_cast<std::size_t>(found - result.quantities.begin());
  std::vector<std::pair<EventKind, double>> ends;
  for (const analysis::Branch& piece : result.branches)
    for (const analysis::Event& event : piece.events)
      if (event.kind != EventKind::end_of_range)
        ends.emplace_back(event.kind, piece.samples[event.row].values[a]);
  const std::vector<std::pair<EventKind, double>> expected{{EventKind::fold_meets_activation, 0.25},
                                                           {EventKind::corner_loses_reversal, 0.45},
                                                           {EventKind::fold_meets_activation, 0.24},
                                                           {EventKind::corner_loses_reversal, 0.74},
                                                           {EventKind::cusp, 0.7}};
  ASSERT_EQ(ends.size(), expected.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_EQ(ends[i].first, expected[i].first) << i;
    EXPECT_NEAR(ends[i].second, expected[i].second, 1e-9) << i;
  }
}

TEST(FoldAtStop, ALoadThatFallsAndRisesAgainHasBothTurnsOrNone) {
  using analysis::EventKind;
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    SCOPED_TRACE(gap);
    const auto result =
        run(slider_with_stop("-1 + " + std::to_string(gap * 1e9) + "e-9", "")).of("s");
    const auto turns = lambdas(result, EventKind::limit_point);
    EXPECT_EQ(lambdas(result, EventKind::corner_limit_point).size(), turns.size());
    EXPECT_EQ(turns.size(), gap >= 1e-6 ? 1U : turns.size());
  }
}

TEST(FoldAtStop, ItsHeadlineNamesEveryKindOfPointOnce) {
  const auto ran = run(slider_with_stop(
      "-0.5",
      "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = \"a\", range = "
      "[0.05, 2] }\n",
      "0.6"));
  ASSERT_EQ(ran.of("s").branches.size(), 3U);
  const std::string told = summary_table(ran.read, ran.results);
  const std::string headline = told.substr(0, told.find("curve  "));
  EXPECT_THAT(headline, testing::ContainsRegex("[0-9] FA"));
  for (const std::string code : {"FA", "CR", "CP", "EX"}) {
    const auto first = headline.find(" " + code);
    if (first == std::string::npos) continue;
    EXPECT_EQ(headline.find(" " + code, first + 1), std::string::npos) << headline;
  }
}

}  // namespace
}  // namespace springfold::io
