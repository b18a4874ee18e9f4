// Critical loads of the planar Orthoglide in a second parameter. Closed forms: along the diagonal the force is
// affine in the stiffness of the knee springs, F = F0(s) + Kv G(s); limit points are at Kv = -F0'(s)/G'(s).
#include <gtest/gtest.h>

#include <cmath>

#include "planar_orthoglide.hpp"

namespace springfold::analysis {
namespace {

struct Knees {
  double Kv = 0.01, p = 0.454, from = 0;
  bool one_sided = false;
};

/// Pushed along the diagonal under dead load; parameters Kv, p and from.
Study orthoglide_study(StudyKind kind, const Knees& knees, const Study& settings) {
  const auto variant = [settings](const Knees& k) {
    const model::SpringLaw law = k.one_sided
                                     ? model::SpringLaw(model::OneSidedSpring{
                                           k.Kv, k.from, model::OneSidedSpring::Side::above})
                                     : model::SpringLaw(model::LinearSpring{k.Kv, 0});
    Study study = settings;
    study.name = "diagonal";
    study.control = ControlMode::load;
    study.direction = Vector::Constant(2, std::sqrt(0.5));
    study.start.pose = Vector::Constant(2, k.p);
    study.start.solve = StartSolve::actuators;
    study.until = {{"deflection", -0.05, 0.6}};
    return Variant{planar_orthoglide(law), study};
  };
  auto family = std::make_shared<CaseFamily>();
  family->names = {"Kv", "p", "from"};
  family->values = {knees.Kv, knees.p, knees.from};
  family->at = [=](const std::vector<std::pair<std::size_t, double>>& values) {
    Knees k = knees;
    for (const auto& [number, value] : values)
      (number == 0 ? k.Kv : number == 1 ? k.p : k.from) = value;
    return variant(k);
  };
  Study study = variant(knees).study;
  study.kind = kind;
  study.critical.cases = family;
  return study;
}

StudyResult threshold_of_springs(const Knees& knees) {
  Study settings;
  settings.critical.parameter = "Kv";
  settings.critical.low = 0.001;
  settings.critical.high = 0.3;
  const Study study = orthoglide_study(StudyKind::threshold, knees, settings);
  EXPECT_TRUE(problems_in(study, study.critical.cases->at({}).mechanism).empty());
  return run_study(study.critical.cases->at({}).mechanism, study);
}

TEST(Threshold, OfOneSidedSpringsIsTheClosedForm) {
  const double pi_12 = std::acos(-1.0) / 12;
  for (const auto& [p, Kv] : {std::pair{0.40, 0.07151820723046}, {0.454, 0.04448287320527}}) {
    const auto result =
        threshold_of_springs({.Kv = 0.01, .p = p, .from = pi_12, .one_sided = true});
    ASSERT_TRUE(result.threshold && result.threshold->found) << p;
    EXPECT_NEAR(result.threshold->value, Kv, 1e-9);
    EXPECT_EQ(result.threshold->decides, "cusp");
    EXPECT_TRUE(result.threshold->verified);
    EXPECT_TRUE(complete(result));
  }
}

TEST(Threshold, IsReachedBySpringsThatAreSlackAtFirst) {
  const auto result = threshold_of_springs({.Kv = 0.02, .from = 0.5, .one_sided = true});
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, 0.0761782013797, 1e-9);
}

TEST(Threshold, DoesNotExistWhereTheFoldComesBeforeTheSprings) {
  const auto result = threshold_of_springs({.Kv = 0.02, .from = 0.65, .one_sided = true});
  ASSERT_TRUE(result.threshold);
  EXPECT_FALSE(result.threshold->found);
  EXPECT_NE(result.threshold->message.find("no value of Kv"), std::string::npos);
  EXPECT_TRUE(complete(result));
}

TEST(CriticalCurve, OfTheActivationAngleEndsWhereTheFoldMeetsTheActivation) {
  Study settings;
  settings.critical.parameter = "from";
  settings.critical.low = 0.5;
  settings.critical.high = 0.8;
  settings.critical.point = "LP1";
  const Study study = orthoglide_study(StudyKind::critical_curve,
                                       {.Kv = 0.02, .from = 0.7, .one_sided = true}, settings);
  const auto result = run_study(study.critical.cases->at({}).mechanism, study);
  const auto ends = events_of_kind(result, EventKind::fold_meets_activation);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_NEAR(at_event(result, ends[0], "from"), 0.6128694882106, 1e-9);
}

TEST(Sensitivity, OfTheCriticalForceIsTheClosedForm) {
  for (const bool tied : {true, false}) {
    Study settings;
    settings.critical.tied = tied;
    settings.critical.parameters = {"Kv", "p"};
    const Study study = orthoglide_study(StudyKind::sensitivity, {}, settings);
    const auto result = run_study(study.critical.cases->at({}).mechanism, study);
    const auto points = events_of_kind(result, EventKind::limit_point);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_NEAR(at_event(result, points[0], "d(lambda)/d(Kv)"),
                tied ? 0.75365181210671 : 1.1361737271593, 1e-9);
    if (tied) {
      EXPECT_NEAR(at_event(result, points[0], "d(lambda)/d(p)"), -0.19630115582107, 1e-9);
    }
  }
}

}  // namespace
}  // namespace springfold::analysis
