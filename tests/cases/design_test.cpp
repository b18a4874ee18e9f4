// Designs of the planar Orthoglide that meet requirements. Along the diagonal x = y = s the force of the unloaded pose
// (p, p) is, with q = asin(s/L) and c = sqrt(L^2 - s^2),
//
//     F(s) = sqrt(2) ((s + c - rho) (1 - s/c) + Kv q/c),   rho: F(p) = 0,
//
// its limit points are at F'(s) = 0. The expected numbers solve the conditions of Karush, Kuhn and Tucker of each
// problem with 30 digits.
#include "springfold/analysis/design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planar_orthoglide.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {
namespace {

using testing::ElementsAre;

struct Dimensions {
  double Kv = 0.01, p = 0.454, L = 1;
};

/// The Orthoglide of leg length L: that of length 1, its knees and drives in other units of length.
Variant orthoglide(const Dimensions& of, const DesignSettings& design) {
  Study study;
  study.name = "diagonal";
  study.control = ControlMode::load;
  study.direction = Vector::Constant(2, std::sqrt(0.5));
  study.start.pose = Vector::Constant(2, of.p);
  study.start.solve = StartSolve::actuators;
  study.until = {{"deflection", -0.05 * of.L, 0.6 * of.L}};
  study.design = design;
  model::Mechanism mechanism = planar_orthoglide(model::LinearSpring{of.Kv, 0});
  for (model::Chain& chain : mechanism.chains)
    for (model::Element& element : chain.elements)
      if (auto* link = std::get_if<model::RigidLink>(&element)) link->transform.p *= of.L;
  return {mechanism, study};
}

StudyResult designed(const DesignSettings& design, const Dimensions& from = {}) {
  auto family = std::make_shared<CaseFamily>();
  family->names = {"Kv", "p", "L"};
  family->values = {from.Kv, from.p, from.L};
  family->at = [=](const std::vector<std::pair<std::size_t, double>>& values) {
    Dimensions now = from;
    for (const auto& [number, value] : values)
      (number == 0 ? now.Kv : number == 1 ? now.p : now.L) = value;
    return orthoglide(now, design);
  };
  const Variant base = orthoglide(from, design);
  Study study = base.study;
  study.kind = StudyKind::design;
  study.critical.cases = family;
  EXPECT_THAT(problems_in(study, base.mechanism), ElementsAre());
  return run_study(base.mechanism, study);
}

double after(const StudyResult& result, const std::string& name) {
  return design_value(*result.design, "design." + name).value_or(NAN);
}

DesignSettings critical_load(double at_least) {
  DesignSettings design;
  design.starts = 3;
  design.critical = {{.name = "critical_load", .at_least = at_least}};
  return design;
}

TEST(Design, FindsTheLeastStiffnessForACriticalLoad) {
  DesignSettings design = critical_load(0.04);
  design.parameters = {{"Kv", 0.01, 0.2}};
  const StudyResult result = designed(design);
  EXPECT_EQ(result.design->status, DesignStatus::met);
  EXPECT_NEAR(after(result, "Kv"), 0.0243716467202465, 1e-10);
  EXPECT_NEAR(after(result, "critical_load"), 0.04, 1e-10);
  EXPECT_TRUE(result.design->verified);
  EXPECT_THAT(result.design->limits, ElementsAre("critical_load"));
}

TEST(Design, FindsTheLeastChangeOfSeveralParameters) {
  DesignSettings design = critical_load(0.04);
  design.parameters = {{"Kv", 0.005, 0.015}, {"p", 0.227, 0.681}, {"L", 0.5, 1.5}};
  const StudyResult result = designed(design);
  EXPECT_NEAR(after(result, "Kv"), 0.01002949171182791, 1e-8);
  EXPECT_NEAR(after(result, "p"), 0.4288743158820769, 1e-8);
  EXPECT_NEAR(after(result, "L"), 1.061140874786911, 1e-8);
  EXPECT_NEAR(after(result, "change"), 0.08252116451955829, 1e-9);
  EXPECT_TRUE(result.design->verified);
}

TEST(Design, WithTheSumOfChangesTurnsToTheParameterThatCountsMost) {
  DesignSettings design = critical_load(0.04);
  design.changes = ChangeNorm::sum;
  design.starts = 2;
  design.parameters = {{"Kv", 0.005, 0.015}, {"p", 0.227, 0.681}, {"L", 0.5, 1.5}};
  const StudyResult result = designed(design);
  EXPECT_NEAR(after(result, "Kv"), 0.01, 1e-9);
  EXPECT_NEAR(after(result, "p"), 0.454, 1e-9);
  EXPECT_NEAR(after(result, "L"), 1.11116077468982, 1e-9);
}

TEST(Design, FindsWhereLimitPointsMergeWhenNoneIsWanted) {
  DesignSettings design;
  design.critical = {{.name = "no_limit_point", .quantity = "deflection"}};
  design.parameters = {{"Kv", 0, 0.2}};
  const StudyResult result = designed(design);
  EXPECT_NEAR(after(result, "Kv"), 0.02958068452556, 1e-9);
  EXPECT_TRUE(result.design->verified);
}

TEST(Design, ReachesALoadBeyondThatAtWhichLimitPointsMerge) {
  DesignSettings design = critical_load(0.06);  // they merge at 0.0464651
  design.parameters = {{"Kv", 0, 0.2}};
  EXPECT_NEAR(after(designed(design), "Kv"), 0.02958068452556, 1e-9);
}

TEST(Design, ChangesNothingWhereTheRequirementsAreMet) {
  DesignSettings design = critical_load(0.02);
  design.parameters = {{"Kv", 0, 0.2}};
  const StudyResult result = designed(design);
  EXPECT_EQ(result.design->status, DesignStatus::met_at_start);
  EXPECT_EQ(after(result, "Kv"), 0.01);
  EXPECT_EQ(result.design->change, 0);
}

TEST(Design, NamesTheBoundThatLimitsWhatCannotBeMet) {
  DesignSettings design = critical_load(0.04);
  design.parameters = {{"Kv", 0.005, 0.015}};
  const StudyResult result = designed(design);
  EXPECT_EQ(result.design->status, DesignStatus::cannot_be_met);
  EXPECT_NEAR(after(result, "Kv"), 0.015, 1e-9);
  EXPECT_NEAR(after(result, "critical_load"), 0.0310006758828866, 1e-9);
  EXPECT_THAT(result.design->limits, ElementsAre("critical_load", "Kv at its upper bound 0.015"));
  EXPECT_FALSE(result.design->verified);
}

TEST(Design, MeetsAStiffnessAtTheStart) {
  // The slope of F at p over the way along the diagonal, F'(p)/sqrt(2), is linear in Kv.
  DesignSettings design;
  design.stiffness = {{.at_least = 0.5}};
  design.parameters = {{"Kv", 0, 1}};
  const StudyResult result = designed(design);
  EXPECT_TRUE(result.design->verified);
  EXPECT_NEAR(after(result, "Kv"), 0.0840559577036232, 1e-9);
}

TEST(Design, ComesFromEveryStartToTheSameAnswer) {
  DesignSettings design = critical_load(0.04);
  design.parameters = {{"Kv", 0.01, 0.2}};
  design.starts = 1;
  const double alone = after(designed(design), "Kv");
  design.starts = 5;
  EXPECT_NEAR(after(designed(design), "Kv"), alone, 1e-11);
}

}  // namespace
}  // namespace springfold::analysis
