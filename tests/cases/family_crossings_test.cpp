// Families of equilibria at one load that other branches cross, and families that lie on the edge of the range.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;

constexpr double quarter = std::numbers::pi / 2;

/// A bar of length 1 on a hinge, pressed down; nothing turns it where the hinge has no spring.
StudyResult bar(const std::string& begin, const std::string& joint, const std::string& range) {
  return run("[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [\"cos(" + begin +
             ")\", \"sin(" + begin +
             ")\"]\n[[chain]]\nname = \"bar\"\nelements = [ { joint = \"revolute\", axis = \"z\", "
             "name = \"hinge\", initial = \"" +
             begin + "\"" + joint +
             " }, { rigid = [1, 0] } ]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\n"
             "direction = [0, -1]\nuntil = { " +
             range + " }\nbranches = { depth = 2 }\n")
      .of("press");
}

double hinge_at(const StudyResult& result, const analysis::Sample& sample) {
  return sample.values[column(result, "bar.hinge")];
}

int count(const StudyResult& result, EventKind kind) {
  int number = 0;
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events) number += event.kind == kind;
  return number;
}

TEST(AFamily, InADeadBandHasABranchPointWhereTheBarStandsUpright) {
  for (const std::string begin : {"30*deg", "90*deg", "120*deg"}) {
    const StudyResult result = bar(begin,
                                   ", role = \"preloaded\", spring = { law = \"gap\", stiffness = "
                                   "1, low = \"-20*deg\", high = \"160*deg\" }",
                                   "lambda = [-1, 1], bar.hinge = [\"-100*deg\", \"250*deg\"]");
    EXPECT_TRUE(complete(result)) << begin;
    EXPECT_EQ(result.branches.size(), 3u) << begin;
    for (const Branch& branch : result.branches)
      for (const auto& event : branch.events)
        if (event.kind == EventKind::branch_point) {
          EXPECT_NEAR(hinge_at(result, branch.samples[event.row]), quarter, 1e-9) << begin;
        }
    EXPECT_GT(count(result, EventKind::branch_point), 0) << begin;
  }
}

TEST(AFamily, OfAPendulumIsCrossedWhereItHangsAndWhereItStands) {
  for (const std::string begin : {"30*deg", "-70*deg"}) {
    const StudyResult result = bar(begin, ", role = \"passive\"", "lambda = [-1, 1]");
    EXPECT_TRUE(complete(result)) << begin;
    EXPECT_EQ(result.branches.size(), 5u) << begin;
    for (const Branch& branch : result.branches) {
      const auto& last = branch.samples.back();
      const double load = last.values[column(result, "lambda")];
      if (load == 0) continue;  // the family itself
      EXPECT_NEAR(std::abs(load), 1, 1e-12);
      EXPECT_NEAR(std::cos(hinge_at(result, last)), 0, 1e-9) << begin;
      EXPECT_EQ(last.values[column(result, "index")],
                load * std::sin(hinge_at(result, last)) > 0 ? 1 : 0)
          << begin;
    }
  }
}

TEST(AFamily, OnTheEdgeOfTheRangeIsFollowedAlongIt) {
  const std::string joint =
      ", role = \"preloaded\", spring = { law = \"gap\", stiffness = 1, low = \"90*deg - 0.1\", "
      "high = \"90*deg + 0.1\" }";
  for (const std::string range : {"[0, 2.5]", "[-0.5, 0]"}) {
    const StudyResult result = bar(
        "90*deg", joint, "lambda = " + range + ", bar.hinge = [\"90*deg - 1\", \"90*deg + 1\"]");
    EXPECT_TRUE(complete(result)) << range;
    EXPECT_EQ(count(result, EventKind::unresolved), 0) << range;
    EXPECT_EQ(count(result, EventKind::family), 2) << range;
    double farthest = 0;
    for (const Branch& branch : result.branches)
      for (const auto& sample : branch.samples)
        farthest = std::max(farthest, std::abs(hinge_at(result, sample) - quarter));
    EXPECT_NEAR(farthest, range == "[0, 2.5]" ? 1 : 0.1, 1e-9) << range;
  }
}

/// A hinge whose spring acts beyond upright only: on the other side the bar leans freely.
StudyResult leaning_bar(const std::string& off_upright) {
  return bar("90*deg - " + off_upright,
             ", role = \"preloaded\", spring = { law = \"one_sided\", stiffness = 1, from = "
             "\"90*deg\", side = \"above\" }",
             "lambda = [-0.5, 2.5], bar.hinge = [\"90*deg - 1\", \"90*deg + 1\"]");
}

TEST(AFamily, BegunFromTheSideEndsInOneKinkWhereTheBarStandsUpright) {
  for (const std::string off : {"0.3", "1e-2", "1e-4", "1e-5", "1e-6", "1e-7"}) {
    SCOPED_TRACE(off);
    const StudyResult result = leaning_bar(off);
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(count(result, EventKind::family), 1);
    EXPECT_EQ(count(result, EventKind::branch_point), 0);
    EXPECT_EQ(count(result, EventKind::stability_change), 0);
    const std::vector<double> loads = lambdas(result, EventKind::branching_kink);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_NEAR(loads[0], 0, 1e-12);
    for (const auto& event : result.branches[0].events)
      if (event.kind == EventKind::branching_kink) {
        EXPECT_NEAR(hinge_at(result, result.branches[0].samples[event.row]), quarter, 1e-10);
      }
    double half_branch = 0;  // where the spring alone bears the bar
    for (const Branch& branch : result.branches)
      for (const auto& event : branch.events)
        half_branch =
            std::max(half_branch, branch.samples[event.row].values[column(result, "lambda")] *
                                      (event.kind == EventKind::branching_kink));
    EXPECT_NEAR(half_branch, 1, 1e-10);
  }
}

TEST(AFamily, BegunNearerToItsEndThanPointsAreToldApartIsNotSaidToBeComplete) {
  for (const std::string off : {"1e-8", "1e-9"}) EXPECT_FALSE(complete(leaning_bar(off))) << off;
}

TEST(AFamily, OfTwoLinksInADeadBandThatEndsUprightIsOne) {
  // The foot turns freely from 0 to d, at no load: where it stands upright the straight column crosses, at d the spring
  // acts.
  for (const double d : {1e-4, 1e-2, 0.3}) {
    SCOPED_TRACE(d);
    const std::string begin = std::to_string(0.4 * d);
    const StudyResult result =
        run("[[body]]\nname = \"top\"\ntask_space = \"xy\"\npose = [\"-2*sin(" + begin +
            ")\", \"2*cos(" + begin +
            ")\"]\n[[chain]]\nname = \"mast\"\nelements = [ { joint = \"revolute\", axis = \"z\", "
            "name = \"foot\", role = \"preloaded\", initial = " +
            begin +
            ", spring = { law = \"gap\", stiffness = 1.3, low = 0, high = " + std::to_string(d) +
            " } }, { rigid = [0, 1] }, { joint = \"revolute\", axis = \"z\", name = \"knee\", role "
            "= "
            "\"preloaded\", spring = { law = \"linear\", stiffness = 0.7 } }, { rigid = [0, 1] } "
            "]\n[[study]]\nname = \"press\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { "
            "lambda = [-0.3, 0.3], mast.foot = [-1, 1] }\nbranches = { depth = 1 }\n")
            .of("press");
    EXPECT_TRUE(complete(result));
    EXPECT_EQ(count(result, EventKind::family), 1);
    EXPECT_EQ(count(result, EventKind::stability_change), 0);
    EXPECT_EQ(lambdas(result, EventKind::branching_kink).size(), 1u);
  }
}

/// A gravity-balanced arm whose spring between (0, a) and b along the arm is too stiff by a share e: with the payload P
/// at its end the potential is (e m g - P) L (1 - sin theta), so that all positions are equilibria at P = e m g. Its
/// matrix is a small difference of large terms there.
TEST(AFamily, LeavesTheUprightStateOfAnArmAtThePayloadThatBalancesIt) {
  for (const char* share : {"1e-1", "1e-3", "1e-5"}) {
    const auto result =
        run(std::string("gravity = [0, -9.81]\n[parameters]\nexcess = ") + share + R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 0.73]
mass = 2.3
[[chain]]
name = "arm"
elements = [ { joint = "revolute", axis = "z", name = "theta", initial = "90*deg" }, { rigid = [0.44, 0] }, { point = "p", at = [0, 0] }, { rigid = [0.29, 0] } ]
[[spring]]
name = "balance"
from_at = [0, 0.31]
to = "arm.p"
stiffness = "2.3*9.81*0.73/(0.31*0.44)*(1 + excess)"
[[study]]
name = "s"
control = "load"
direction = [0, -1]
until = { lambda = [-5, 5], arm.theta = ["-80*deg", "260*deg"] }
branches = { depth = 1 }
)toml")
            .of("s");
    EXPECT_TRUE(analysis::complete(result)) << share;
    ASSERT_EQ(result.branches.size(), 3u) << share;
    const double balanced = std::stod(share) * 2.3 * 9.81;
    for (const std::size_t number : {1u, 2u}) {
      const auto& branch = result.branches[number];
      const auto is_family = [](const analysis::Event& e) {
        return e.kind == analysis::EventKind::family;
      };
      EXPECT_EQ(std::ranges::count_if(branch.events, is_family), 1) << share;
      for (const auto& sample : branch.samples)
        EXPECT_NEAR(sample.values[static_cast<std::size_t>(column(result, "lambda"))], balanced,
                    1e-9 * balanced + 1e-11);
      EXPECT_LT(branch.samples.size(), 400u) << share;
    }
  }
}

}  // namespace
}  // namespace springfold::io
