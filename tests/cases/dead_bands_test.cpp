// Bars that nothing holds within a dead band: under no load they stand anywhere there, which is one family of
// equilibria.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;

const std::string top_body = "[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1]\n";
const std::string press_study =
    "[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\n"
    "until = { lambda = [-0.5, 2.5], mast.foot = [-1, 1] }\nbranches = { depth = 1 }\n";

/// A bar of length 1 on a torsion spring of stiffness 1 with backlash.
StudyResult with_backlash(const std::string& gap) {
  return run(top_body +
             "[[chain]]\nname = \"mast\"\nelements = [ { joint = \"revolute\", axis = \"z\", name "
             "= \"foot\", role = \"preloaded\", spring = { law = \"gap\", stiffness = 1, low = -" +
             gap + ", high = " + gap + " } }, { rigid = [0, 1] } ]\n" + press_study)
      .of("press");
}

/// Free to the left; to the right a spring of stiffness 1, on a second chain.
StudyResult held_on_one_side() {
  return run(top_body + R"([[chain]]
name = "mast"
elements = [ { joint = "revolute", axis = "z", name = "foot" }, { rigid = [0, 1] } ]
[[chain]]
name = "guide"
elements = [ { joint = "revolute", axis = "z", name = "foot", role = "preloaded", spring = { law = "one_sided", stiffness = 1, from = 0, side = "below" } }, { joint = "prismatic", axis = "y", name = "slide", initial = 1 } ]
)" + press_study)
      .of("press");
}

double angle(const StudyResult& result, const analysis::Sample& sample) {
  return sample.values[column(result, "mast.foot")];
}

/// Rows satisfy lambda sin(angle) = torque; within the band lambda is zero.
template <class Torque>
void expect_equilibrium(const StudyResult& result, const Torque& torque) {
  for (const Branch& branch : result.branches)
    for (const auto& sample : branch.samples) {
      const double a = angle(result, sample), load = sample.values[column(result, "lambda")];
      EXPECT_NEAR(load * std::sin(a), torque(a), 1e-12) << a;
    }
}

std::vector<const Branch*> with_families(const StudyResult& result) {
  std::vector<const Branch*> list;
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.kind == EventKind::family) list.push_back(&branch);
  return list;
}

TEST(DeadBand, AroundTheStartIsOneFamilyToEachSideAndABranchAtEachEnd) {
  for (const double gap : {0.1, 0.01}) {
    const StudyResult result = with_backlash(gap == 0.1 ? "0.1" : "0.01");
    EXPECT_TRUE(complete(result)) << gap;
    EXPECT_EQ(result.branches.size(), 3U) << gap;  // the upright mast passes through the start
    const auto families = with_families(result);
    ASSERT_EQ(families.size(), 2U) << gap;
    for (const Branch* branch : families) {
      int switchings = 0;
      for (const auto& event : branch->events) {
        EXPECT_THAT(event.kind, testing::AnyOf(EventKind::branch_point, EventKind::family,
                                               EventKind::switching, EventKind::end_of_range))
            << event.label << " " << event.detail;
        if (event.kind != EventKind::switching) continue;
        ++switchings;
        EXPECT_NEAR(std::abs(angle(result, branch->samples[event.row])), gap, 1e-10);
      }
      EXPECT_EQ(switchings, 1) << gap;
      EXPECT_NEAR(std::abs(angle(result, branch->samples.back())), 1, 1e-10);
    }
    expect_equilibrium(result, [gap](double a) {
      return a > gap ? a - gap : a < -gap ? a + gap : 0.0;
    });
  }
}

TEST(DeadBand, ThatBeginsAtTheStartIsOneFamily) {
  const StudyResult result = held_on_one_side();
  EXPECT_TRUE(complete(result));
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events)
      EXPECT_NE(event.kind, EventKind::unresolved) << event.detail;
  const auto families = with_families(result);
  ASSERT_EQ(families.size(), 1U);
  EXPECT_NEAR(angle(result, families[0]->samples.back()), 1, 1e-10);
  expect_equilibrium(result, [](double a) { return std::min(a, 0.0); });
}

/// Two links; the band of the upper hinge is so narrow that rounding has the sign of what lambda does along it.
TEST(DeadBands, OfNextToNothingEndWhereTheSpringActsAndNothingTurnsBack) {
  for (const char* band : {"low = -3.9e-7, high = 7.8e-7", "low = -4e-6, high = 2e-6"}) {
    const StudyResult result =
        run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [0, 1.34]\n[[chain]]\nname = "
            "\"col\"\nelements = [ { joint = \"revolute\", axis = \"-z\", name = \"h0\", role = "
            "\"preloaded\", spring = { law = \"linear\", stiffness = 0.62 } }, { rigid = [0, 0.74] "
            "}, { joint = \"revolute\", axis = \"-z\", name = \"h1\", role = \"preloaded\", spring "
            "= "
            "{ law = \"gap\", stiffness = 0.2, " +
            std::string(band) +
            " } }, { rigid = [0, 0.6] } ]\n[[study]]\nname = \"press\"\ncontrol = "
            "\"load\"\ndirection = [0, -1]\nuntil = { lambda = [-0.5, 2], col.h0 = [-0.6, 0.6], "
            "col.h1 = [-0.6, 0.6] }\nbranches = { depth = 1 }\n")
            .of("press");
    EXPECT_TRUE(complete(result)) << band;
    int families = 0;
    for (const Branch& branch : result.branches)
      for (const auto& event : branch.events) {
        EXPECT_NE(event.kind, EventKind::corner_limit_point) << band << " " << event.label;
        families += event.kind == EventKind::family ? 1 : 0;
      }
    EXPECT_EQ(families, 2) << band;
  }
}

}  // namespace
}  // namespace springfold::io
