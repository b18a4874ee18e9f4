// A truss that snaps through and a vertical spring at its apex: force within 2 % of its mean over the middle half of
// the way. At height y, bars of length and stiffness 1, half span a, the force is T(y) + kv (l0 - y) with T(y) = 2 y
// (1/sqrt(a^2 + y^2) - 1), odd in y: the mean is kv l0. The least change is where the deviation T(y) - kv y is as large
// at an inner place as at the end; solved with 25 digits for half span 1 and height 0.5.
#include <gtest/gtest.h>

#include "analysis/steep_truss.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::analysis {
namespace {

const double bar = std::sqrt(1.25);  // of the truss of half span 1, in whose units the numbers are
const SteepTruss truss{1 / bar};

Variant with_spring(double kv, double l0, const DesignSettings& design) {
  using namespace model;
  Mechanism mechanism = truss.mechanism();
  Chain spring;
  spring.name = "spring";
  spring.elements.push_back(
      Joint{.name = "slide", .kind = JointKind::prismatic, .axis = Vec3<double>::UnitX()});
  spring.elements.push_back(Joint{.name = "length",
                                  .kind = JointKind::prismatic,
                                  .axis = Vec3<double>::UnitY(),
                                  .role = JointRole::compliant,
                                  .spring = LinearSpring{kv, l0},
                                  .initial = truss.height()});
  mechanism.chains.push_back(spring);
  Study study;
  study.name = "push";
  study.control = ControlMode::pose;
  study.direction = Vector{{0.0, -1.0}};
  study.start.solve = StartSolve::wrench;
  study.until = {{"deflection", 0, 2 * truss.height()}};
  study.design = design;
  return {mechanism, study};
}

TEST(Design, HoldsTheForceOfATrussConstantByASpring) {
  const double kv = 0.1, l0 = 0.5 / bar, h = truss.height();
  DesignSettings design;
  design.starts = 3;
  design.parameters = {{"kv", 0.01, 1}, {"l0", 0, 5}};
  design.constant =
      ConstantRequirement{.from = 0.5 * h, .to = 1.5 * h, .within = 0.02, .mean_at_least = 0.02};
  auto family = std::make_shared<CaseFamily>();
  family->names = {"kv", "l0"};
  family->values = {kv, l0};
  family->at = [=](const std::vector<std::pair<std::size_t, double>>& values) {
    std::vector<double> now{kv, l0};
    for (const auto& [number, value] : values) now[number] = value;
    return with_spring(now[0], now[1], design);
  };
  const Variant base = with_spring(kv, l0, design);
  Study study = base.study;
  study.kind = StudyKind::design;
  study.critical.cases = family;
  ASSERT_TRUE(problems_in(study, base.mechanism).empty());
  const StudyResult result = run_study(base.mechanism, study);
  ASSERT_TRUE(result.design);
  const auto after = [&](const char* name) { return design_value(*result.design, name).value(); };
  EXPECT_EQ(result.design->status, DesignStatus::met) << result.design->message;
  EXPECT_TRUE(result.design->verified);
  EXPECT_NEAR(after("design.kv"), 0.185805469759326, 1e-8);
  EXPECT_NEAR(after("design.l0"), 1.11009188764314 / bar, 1e-7);
  EXPECT_NEAR(after("design.constant.deviation"), 0.02, 1e-9);
}

}  // namespace
}  // namespace springfold::analysis
