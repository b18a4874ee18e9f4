// First critical loads at which springs rest, as those of a mast between cables without pretension, over a parameter.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// A mast of length L on a hinge, held by cables from (-0.9, 0) and from (b, h), all without force. A cable that is
/// stretched alone holds P = k L u^2, u the horizontal part of its direction.
std::string mast(const std::string& parameters, const std::string& studies) {
  return "[parameters]\nc = 0\nk = 1\n" + parameters + R"toml(
[[body]]
name = "top"
task_space = "xy"
pose = [0, "L"]
[[chain]]
name = "mast"
elements = [{ joint = "revolute", axis = "z", name = "a", initial = "90*deg" }, { rigid = ["L", 0] }]
[[spring]]
name = "left"
from_at = [-0.9, 0]
to = "top"
law = { law = "one_sided", stiffness = "k*k1", from = "sqrt(0.81 + L^2) - c" }
[[spring]]
name = "right"
from_at = ["b", "h"]
to = "top"
law = { law = "one_sided", stiffness = "k*k2", from = "sqrt(b^2 + (L - h)^2) - c" }
)toml" + studies;
}

const std::string askew = "k1 = 3.1\nk2 = 4.7\nL = 1.3\nb = 1.1\nh = 0.1\n";
const std::string mirrored = "k1 = 2\nk2 = 2\nL = 1.3\nb = 0.9\nh = 0\n";

std::string study(const std::string& kind, const std::string& keys, double up_to = 40) {
  return "[[study]]\nname = \"s\"\nkind = \"" + kind +
         "\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { lambda = [0, " +
         std::to_string(up_to) + "], mast.a = [\"10*deg\", \"170*deg\"] }\n" + keys;
}

/// u^2 L of the cables.
double left_part(double L = 1.3) { return 0.81 * L / (0.81 + L * L); }
double right_part(double L = 1.3) { return 1.21 * L / (1.21 + (L - 0.1) * (L - 0.1)); }

StudyResult run_study(const std::string& text) {
  StudyResult result = run(text).of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  return result;
}

std::vector<std::size_t> rows_of_kinks(const StudyResult& result) {
  std::vector<std::size_t> rows;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::branching_kink) rows.push_back(event.row);
  return rows;
}

std::string detail_of_first_kink(const StudyResult& result) {
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::branching_kink) return event.detail;
  return {};
}

TEST(CriticalLoadsAtRest, MoveWithTheStiffnessOfTheCableThatIsStretchedThere) {
  const StudyResult result = run_study(mast(
      askew, study("sensitivity", "sensitivity = { parameters = [\"k1\", \"k2\", \"L\"] }\n")));
  const auto rows = rows_of_kinks(result);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(value(result, rows[0], "lambda"), 3.1 * left_part(), 1e-10);
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(k1)"), left_part(), 1e-10);
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(k2)"), 0, 1e-10);
  const double square = 0.81 + 1.69;
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(L)"),
              3.1 * 0.81 * (0.81 - 1.69) / (square * square), 1e-8);
  EXPECT_NEAR(value(result, rows[1], "d(lambda)/d(k1)"), 0, 1e-10);
  EXPECT_NEAR(value(result, rows[1], "d(lambda)/d(k2)"), right_part(), 1e-10);
}

TEST(CriticalLoadsAtRest, AreThatOfTheCableThatGivesWayFirstOverAStiffness) {
  const StudyResult result =
      run_study(mast(askew, study("critical_load",
                                  "critical_load = { of = \"loss_of_stability\", parameter "
                                  "= \"k1\", range = [1, 12], values = 12 }\n")));
  ASSERT_EQ(result.branches.size(), 2u);
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(sample.values[column(result, "lambda")],
                  std::min(sample.values.back() * left_part(), 4.7 * right_part()), 1e-9);
  EXPECT_NEAR(result.branches[0].samples.front().values.back(), 1, 1e-12);
  EXPECT_NEAR(result.branches[0].samples.back().values.back(), 4.7 * right_part() / left_part(),
              1e-9);
  EXPECT_NEAR(result.branches[1].samples.back().values.back(), 12, 1e-12);
}

/// At k1 = 2, one of the values that are sampled, half-branches leave to both sides.
TEST(CriticalLoadsAtRest, OfMirroredCablesAreTheLesserOneOnEachSideOfTheirMeeting) {
  const StudyResult result =
      run_study(mast(mirrored, study("critical_load",
                                     "critical_load = { of = \"loss_of_stability\", parameter "
                                     "= \"k1\", range = [1, 3], values = 5 }\n")));
  ASSERT_EQ(result.branches.size(), 2u);
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(sample.values[column(result, "lambda")],
                  std::min(sample.values.back(), 2.0) * left_part(), 1e-9);
  EXPECT_NEAR(result.branches[0].samples.back().values.back(), 2, 1e-9);
  EXPECT_NEAR(result.branches[1].samples.front().values.back(), 2, 1e-9);
}

TEST(CriticalLoadsAtRest, AreLargestWhereTheMastIsAsLongAsTheFootIsFar) {
  const StudyResult result =
      run_study(mast(askew, study("critical_load",
                                  "critical_load = { of = \"loss_of_stability\", parameter "
                                  "= \"L\", range = [0.5, 3], values = 6 }\n")));
  ASSERT_EQ(result.branches.size(), 1u);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], 3.1 * left_part(sample.values.back()),
                1e-10);
  const auto& events = result.branches[0].events;
  const auto largest = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == EventKind::extremum;
  });
  ASSERT_NE(largest, events.end());
  EXPECT_NEAR(result.branches[0].samples[largest->row].values.back(), 0.9, 1e-8);
}

TEST(CriticalLoadsAtRest, HaveACurveOfTheSecondOneToo) {
  const StudyResult result =
      run_study(mast(askew, study("critical_curve",
                                  "critical_curve = { of = \"KB2\", parameter = "
                                  "\"L\", range = [0.5, 3] }\n")));
  ASSERT_EQ(result.branches.size(), 1u);
  EXPECT_GT(result.branches[0].samples.size(), 5u);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], 4.7 * right_part(sample.values.back()),
                1e-10);
}

TEST(CriticalLoadsAtRest, LeaveARangeOfLoadsAtAThreshold) {
  const StudyResult result =
      run_study(mast(askew, study("threshold",
                                  "threshold = { of = \"loss_of_stability\", parameter = \"k1\", "
                                  "range = [1, 30] }\n",
                                  2)));
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_NEAR(result.threshold->value, 2 / left_part(), 1e-9);
}

TEST(CriticalLoadsAtRest, AreReachedByADesign) {
  const StudyResult result = run_study(
      mast(askew, study("design",
                        "[study.design]\nparameters = { k1 = [1, 20] }\n"
                        "critical_load = { at_least = 2, of = \"loss_of_stability\" }\n")));
  ASSERT_TRUE(result.design);
  EXPECT_TRUE(result.design->verified);
  EXPECT_NEAR(result.design->parameters.at(0).after, 2 / left_part(), 1e-8);
}

/// Both cables have to be stiffened: the load of the mast is the lesser one of theirs.
TEST(CriticalLoadsAtRest, OfMirroredCablesAreMadeSafeTogetherByADesign) {
  const StudyResult result = run_study(
      mast(mirrored, study("design",
                           "[study.design]\nparameters = { k1 = [1, 9], k2 = [1, 9] }\n"
                           "critical_load = { at_least = 1.7, of = \"loss_of_stability\" }\n")));
  ASSERT_TRUE(result.design);
  EXPECT_TRUE(result.design->verified);
  for (const auto& parameter : result.design->parameters)
    EXPECT_NEAR(parameter.after, 1.7 / left_part(), 1e-8);
  EXPECT_LT(result.design->designs, 200);
}

TEST(CriticalLoadsAtRest, OfMirroredCablesHaveARateByWhatMovesBothAndToldNoneByWhatMovesOne) {
  const StudyResult result = run_study(
      mast(mirrored, study("sensitivity", "sensitivity = { parameters = [\"k\", \"k1\"] }\n")));
  const auto rows = rows_of_kinks(result);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(k)"), 2 * left_part(), 1e-10);
  EXPECT_TRUE(std::isnan(value(result, rows[0], "d(lambda)/d(k1)")));
  EXPECT_THAT(detail_of_first_kink(result), testing::HasSubstr("no rate by k1: half-branches"));
}

/// With c both cables are stretched in the upright state: from there on both hold it.
TEST(CriticalLoadsAtRest, DoNotMoveWithAPretensionWhichIsTold) {
  const StudyResult result =
      run_study(mast(askew, study("sensitivity", "sensitivity = { parameters = [\"c\"] }\n")));
  const auto rows = rows_of_kinks(result);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(std::isnan(value(result, rows[0], "d(lambda)/d(c)")));
  EXPECT_THAT(detail_of_first_kink(result),
              testing::HasSubstr("no rate by c: springs rest at KB1"));
}

TEST(CriticalLoadsAtRest, HaveNoCurveInAPretension) {
  const auto result = run(mast(askew, study("critical_curve",
                                            "critical_curve = { of = \"KB1\", parameter = "
                                            "\"c\", range = [-0.05, 0.05] }\n")))
                          .of("s");
  EXPECT_FALSE(result.start.found);
  EXPECT_THAT(result.start.message, testing::HasSubstr("springs rest at KB1"));
}

/// Three equal cables around a mast in space: it gives way towards one of them, with the other two stretched, each by
/// half of what it would be in their own direction: P = (1/4 + 1/4) k L u^2.
TEST(CriticalLoadsAtRest, OfThreeCablesInSpaceAreHalfOfWhatOneHoldsInItsOwnPlane) {
  std::string text = R"toml(
[parameters]
k = 2
[[body]]
name = "top"
task_space = "xyz"
pose = [0, 0, 1.25]
[[chain]]
name = "mast"
elements = [{ joint = "revolute", axis = "x", name = "a" }, { joint = "revolute", axis = "y", name = "b" }, { rigid = [0, 0, 1.25] }]
)toml";
  for (const std::string angle : {"90", "210", "330"})
    text += "[[spring]]\nname = \"cable" + angle + "\"\nfrom_at = [\"0.8*cos(" + angle +
            "*deg)\", \"0.8*sin(" + angle +
            "*deg)\", 0]\nto = \"top\"\nlaw = { law = \"one_sided\", stiffness = \"k\", from = "
            "\"sqrt(0.64 + 1.25^2)\" }\n";
  text +=
      "[[study]]\nname = \"s\"\nkind = \"critical_load\"\ncontrol = \"load\"\ndirection = [0, "
      "0, -1]\nuntil = { lambda = [0, 10], mast.a = [\"-60*deg\", \"60*deg\"] }\ncritical_load "
      "= { of = \"loss_of_stability\", parameter = \"k\", range = [1, 5], values = 3 }\n";
  const StudyResult result = run_study(text);
  ASSERT_EQ(result.branches.size(), 1u);
  const double part = 0.5 * 1.25 * 0.64 / (0.64 + 1.25 * 1.25);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], sample.values.back() * part, 1e-10);
}

/// Three links of length 1; the hinge at the foot is stiffer to one side, the upper one hardly turns. With the upper
/// two as one link (c1 - 3 P)(c2 - 2 P) = 4 P^2.
TEST(CriticalLoadsAtRest, BesideAHingeThatHardlyTurnsMoveAsIfItWereFixed) {
  for (const char* stiff : {"1e7", "1e9"}) {
    SCOPED_TRACE(stiff);
    const StudyResult result = run_study(
        std::string("[parameters]\nc1 = 1\nc2 = 5\n[[body]]\nname = \"top\"\ntask_space = "
                    "\"xy\"\npose = [0, 3]\n[[chain]]\nname = \"mast\"\nelements = [{ joint = "
                    "\"revolute\", axis = \"z\", name = \"a\", role = \"preloaded\", spring = { "
                    "law = \"piecewise_linear\", breakpoints = [0], stiffnesses = [\"c1\", "
                    "\"c1 + 0.7\"] } }, { rigid = [0, 1] }, { joint = \"revolute\", axis = "
                    "\"z\", role = \"preloaded\", spring = { law = \"linear\", stiffness = "
                    "\"c2\" } }, { rigid = [0, 1] }, { joint = \"revolute\", axis = \"z\", role "
                    "= \"preloaded\", spring = { law = \"linear\", stiffness = ") +
        stiff + " } }, { rigid = [0, 1] }]\n" +
        "[[study]]\nname = \"s\"\nkind = \"sensitivity\"\ncontrol = \"load\"\ndirection = "
        "[0, -1]\nuntil = { lambda = [0, 2], mast.a = [\"-70*deg\", \"70*deg\"] }\nsensitivity "
        "= { parameters = [\"c1\", \"c2\"] }\n");
    const auto rows = rows_of_kinks(result);
    ASSERT_GE(rows.size(), 1u);
    const double P = (17 - std::sqrt(17.0 * 17 - 40)) / 4;
    EXPECT_NEAR(value(result, rows[0], "lambda"), P, 1e-7);
    const double by_load = 3 * (5 - 2 * P) + 2 * (1 - 3 * P) + 8 * P;
    EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(c1)"), (5 - 2 * P) / by_load, 1e-7);
    EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(c2)"), (1 - 3 * P) / by_load, 1e-7);
  }
}

}  // namespace
}  // namespace springfold::io
