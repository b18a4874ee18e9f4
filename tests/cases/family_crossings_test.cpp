// Families of equilibria at one load that other branches cross, and families that lie on the edge of the range.
#include <gmock/gmock.h>

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

}  // namespace
}  // namespace springfold::io
