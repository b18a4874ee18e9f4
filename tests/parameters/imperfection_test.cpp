// Laws of imperfection sensitivity from the form at the point, against closed forms.
#include "springfold/parameters/imperfection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "parameters/families.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {
namespace {

CriticalStart at_branch_point(Vector x, double lambda) {
  return {.kind = CriticalKind::branch_point, .x = std::move(x), .lambda = lambda, .mu = 0};
}

/// The law of the family's own parameter at a point through which the path leads along `tangent`.
std::optional<ImperfectionLaw> law_at(const Family& family, const CriticalStart& start,
                                      const Direction& tangent) {
  const auto form = reduced_form(family, start, tangent);
  if (!form) return std::nullopt;
  const auto gamma = imperfection_part(family, start, *form);
  return gamma ? imperfection_law(*form, *gamma) : std::nullopt;
}

const Direction upward{Vector::Zero(1), 1};

TEST(ImperfectionLaws, ASymmetricBranchThatFallsLosesTheTwoThirdsPowerOfTheImperfection) {
  // x (1 - l) - x^3 - m: folds at 1 - l = 3 x^2, m = 2 x^3.
  const Family family = family_of<ScalarProblem>([](double m) {
    return ScalarProblem{[=](double x, double l) { return x * (1 - l) - x * x * x - m; },
                         [](double x, double l) { return 1 - l - 3 * x * x; },
                         [](double x, double) { return -x; }};
  });
  const auto law = law_at(family, at_branch_point(Vector::Zero(1), 1), upward);
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 2.0 / 3);
  EXPECT_NEAR(law->coefficient, 3 / std::cbrt(4.0), 1e-10);
  EXPECT_EQ(law->sign, 0);
}

TEST(ImperfectionLaws, DoNotDependOnTheUnitOfTheLoad) {
  // x^2 - sin(u l)^2 - m: branches x = sin(u l) and x = -sin(u l) cross; folds at m = -sin(u l)^2.
  for (const double u : {1.0, 16.0, 256.0}) {
    const Family family = family_of<ScalarProblem>([=](double m) {
      return ScalarProblem{
          [=](double x, double l) { return x * x - std::pow(std::sin(u * l), 2) - m; },
          [](double x, double) { return 2 * x; },
          [=](double, double l) { return -u * std::sin(2 * u * l); }};
    });
    const auto law =
        law_at(family, at_branch_point(Vector::Zero(1), 0), {Vector::Constant(1, 1), 1 / u});
    ASSERT_TRUE(law) << u;
    EXPECT_EQ(law->exponent, 0.5) << u;
    EXPECT_NEAR(u * law->coefficient, 1, 1e-9) << u;
  }
}

TEST(ImperfectionLaws, WhatIsZeroButForRoundingBreaksNoBranch) {
  // sqrt((3 + m)^2 + 16) is the length from (3 + m, 0) to (0, 4), written in two ways: their difference is zero.
  const auto nothing = [](double m) {
    return std::sqrt((3 + m) * (3 + m) + 16) - std::hypot(3 + m, 4.0);
  };
  for (const double force : {1.0, 1e3, 1e6}) {
    const Family family = family_of<ScalarProblem>([=](double m) {
      return ScalarProblem{
          [=](double x, double l) { return x * (1 - l + m) - x * x + force * nothing(m); },
          [=](double x, double l) { return 1 - l + m - 2 * x; },
          [](double x, double) { return -x; }};
    });
    const CriticalStart start = at_branch_point(Vector::Zero(1), 1);
    const auto form = reduced_form(family, start, upward);
    ASSERT_TRUE(form);
    const auto part = imperfection_part(family, start, *form);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->norm(), 0) << force;
  }
}

TEST(ImperfectionLaws, ASymmetricBranchThatRisesIsNotSensitive) {
  const Family family = family_of<ScalarProblem>([](double m) {
    return ScalarProblem{[=](double x, double l) { return x * (1 - l) + x * x * x - m; },
                         [](double x, double l) { return 1 - l + 3 * x * x; },
                         [](double x, double) { return -x; }};
  });
  const auto law = law_at(family, at_branch_point(Vector::Zero(1), 1), upward);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->coefficient, -3 / std::cbrt(4.0), 1e-10);
}

TEST(ImperfectionLaws, WhereBranchesCrossTheLoadFallsWithTheSquareRootForOneSign) {
  // x (1 - l) - x^2 + m: folds at 1 - l = 2 x, x^2 = -m.
  const Family family = family_of<ScalarProblem>([](double m) {
    return ScalarProblem{[=](double x, double l) { return x * (1 - l) - x * x + m; },
                         [](double x, double l) { return 1 - l - 2 * x; },
                         [](double x, double) { return -x; }};
  });
  const auto law = law_at(family, at_branch_point(Vector::Zero(1), 1), upward);
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 0.5);
  EXPECT_NEAR(law->coefficient, 2, 1e-10);
  EXPECT_EQ(law->sign, -1);
}

TEST(ImperfectionLaws, ALimitPointMovesWithTheImperfection) {
  // l = x - x^3/3 + 0.7 m, limit point at x = 1.
  const Family family = family_of<ScalarProblem>([](double m) {
    return graph([=](double x) { return x - x * x * x / 3 + 0.7 * m; },
                 [](double x) { return 1 - x * x; });
  });
  CriticalStart start = at_branch_point(Vector::Ones(1), 2.0 / 3);
  start.kind = CriticalKind::limit_point;
  const auto law = law_at(family, start, {Vector::Ones(1), 0});
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 1);
  EXPECT_NEAR(law->coefficient, -0.7, 1e-10) << "the load is raised";
}

TEST(ImperfectionLaws, TheShallowArchHasItsPublishedCoefficient) {
  const double e = 3, p = e + 3 * std::sqrt(e * e - 4);
  const Family family = family_of<Given>([=](double m) { return arch(e, m); });
  // q2 = 0 on the symmetric path; its branch point is at q1^2 = e^2 - 4, where 16 + 4 S = 0.
  const Vector q{{std::sqrt(e * e - 4), 0}};
  const auto law = law_at(family, at_branch_point(q, p), {Vector{{-1, 0}}, 1});
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 2.0 / 3);
  EXPECT_NEAR(law->coefficient, 1.4049861429538, 1e-9);
  // Critical loads of imperfect arches (34-digit Newton) come to it.
  double before = HUGE_VAL;
  for (const auto& [m, load] :
       {std::pair{0.1, 9.4062121678254}, {0.01, 9.6430193096047}, {1e-4, 9.7051770421122}}) {
    const double gap = std::abs((p - load) / std::cbrt(m * m) - law->coefficient);
    EXPECT_LT(gap, before);
    before = gap;
  }
  EXPECT_LT(before, 1e-3);
}

TEST(ImperfectionLaws, AugustisColumnHasTheLawOfItsDoubleBranchPoint) {
  for (const double angle : {0.25, 0.75, -0.25}) {
    const double psi = angle * std::numbers::pi;
    const Family family = family_of<Given>([=](double m) { return augusti(m, psi); });
    const auto start = at_branch_point(Vector::Zero(2), 1);
    const auto law = law_at(family, start, {Vector::Zero(2), 1});
    ASSERT_TRUE(law);
    EXPECT_EQ(law->exponent, 2.0 / 3);
    // |imperfection| = sqrt(2) eps at 45 degrees: (3/2)^(2/3) per eps^(2/3).
    EXPECT_NEAR(law->coefficient * std::cbrt(2.0), std::pow(1.5, 2.0 / 3), 1e-9);
  }
}

/// Across the imperfection the column is a mirror image of itself, but for the rounding of the direction.
TEST(ImperfectionLaws, AlongAnAxisOfSymmetryDoNotDependOnRounding) {
  const auto start = at_branch_point(Vector::Zero(2), 1);
  const auto law_along = [&](double psi) {
    return law_at(family_of<Given>([=](double m) { return augusti(m, psi); }), start,
                  {Vector::Zero(2), 1});
  };
  const auto along = law_along(0);
  ASSERT_TRUE(along);
  for (const double off : {1e-12, -5e-11, 3e-10}) {
    const auto law = law_along(off);
    ASSERT_TRUE(law) << "off by " << off;
    EXPECT_EQ(law->exponent, along->exponent);
    EXPECT_NEAR(law->coefficient, along->coefficient, 1e-7) << "off by " << off;
  }
}

TEST(ImperfectionLaws, TheWorstImperfectionOfAugustisColumnIsAt45Degrees) {
  const auto start = at_branch_point(Vector::Zero(2), 1);
  Matrix gammas(2, 2);
  std::optional<ReducedForm> form;
  for (const Index i : {0, 1}) {
    const Family family = family_of<Given>(
        [=](double m) { return augusti(m, std::numbers::pi / 2 * static_cast<double>(i)); });
    form = reduced_form(family, start, {Vector::Zero(2), 1});
    ASSERT_TRUE(form);
    gammas.col(i) = *imperfection_part(family, start, *form);
  }
  const auto worst = worst_imperfection(*form, gammas);
  ASSERT_TRUE(worst);
  EXPECT_NEAR(worst->law.coefficient * std::cbrt(2.0), std::pow(1.5, 2.0 / 3), 1e-9);
  EXPECT_NEAR(std::abs(worst->shape[0]), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(std::abs(worst->shape[1]), std::sqrt(0.5), 1e-6);
}

TEST(ImperfectionLaws, TracedImperfectColumnsOfAugustiComeToTheirLaw) {
  double before = HUGE_VAL;
  for (const auto& [eps, known] :
       {std::pair{0.05, 0.81568488176849}, {0.01, 0.93821138848778}, {0.001, 0.98684634950518}}) {
    const Given column = augusti(std::sqrt(2.0) * eps, std::numbers::pi / 4);
    const Vector start = Vector::Constant(2, eps);  // in equilibrium without load
    const auto rays = rays_from(column, start, 0, {}, {}).rays;
    ASSERT_EQ(rays.size(), 2U);
    std::optional<double> first;
    trace(column, start, 0, rays[rays[0].tangent.dlambda > 0 ? 0 : 1], {}, {}, {},
          [&](const Hit& hit) {
            first = hit.point.lambda;
            return false;
          });
    ASSERT_TRUE(first);
    EXPECT_NEAR(*first, known, 1e-9);
    const double gap = std::abs((1 - *first) / std::pow(eps, 2.0 / 3) - std::pow(1.5, 2.0 / 3));
    EXPECT_LT(gap, before);
    before = gap;
  }
}

TEST(ImperfectionLaws, AMonkeySaddleLosesTheSquareRootInThreeDirections) {
  // V = (1 - l) (x^2 + y^2)/2 - (x^3 - 3 x y^2)/3 + m (x cos + y sin): on y = 0 as where branches cross.
  Matrix gammas = Matrix::Zero(2, 2);
  std::optional<ReducedForm> form;
  const auto start = at_branch_point(Vector::Zero(2), 1);
  for (const Index i : {0, 1}) {
    const Family family = family_of<Given>([=](double m) {
      Given saddle;
      saddle.n = 2;
      saddle.F = [=](const Vector& u, double l) {
        Vector F{{(1 - l) * u[0] - u[0] * u[0] + u[1] * u[1], (1 - l) * u[1] + 2 * u[0] * u[1]}};
        F[i] += m;
        return F;
      };
      saddle.J = [](const Vector& u, double l) {
        return Matrix{{1 - l - 2 * u[0], 2 * u[1]}, {2 * u[1], 1 - l + 2 * u[0]}};
      };
      saddle.by_lambda = [](const Vector& u, double) { return Vector(-u); };
      return saddle;
    });
    form = reduced_form(family, start, {Vector::Zero(2), 1});
    ASSERT_TRUE(form);
    gammas.col(i) = *imperfection_part(family, start, *form);
  }
  const auto along = imperfection_law(*form, gammas.col(0));
  ASSERT_TRUE(along);
  EXPECT_EQ(along->exponent, 0.5);
  EXPECT_NEAR(along->coefficient, 2, 1e-9);
  EXPECT_EQ(along->sign, -1);
  const auto worst = worst_imperfection(*form, gammas);
  ASSERT_TRUE(worst);
  EXPECT_NEAR(worst->law.coefficient, 2, 1e-9);
  // One of the three directions of -x: cos(3 angle) = -1.
  EXPECT_NEAR(std::cos(3 * std::atan2(worst->shape[1], worst->shape[0])), -1, 1e-9);
}

TEST(ImperfectionLaws, AHilltopLosesInProportionToTheImperfection) {
  // F = (m - x eta, -l - eta^2 - x^2/2) at y = 1 + eta: l = -eta^2 - m^2/(2 eta^2), largest -sqrt(2) |m|.
  const Family family = family_of<Given>([](double m) {
    Given hill;
    hill.n = 2;
    hill.F = [=](const Vector& u, double l) {
      return Vector{{u[0] * (1 - u[1]) + m, -l + u[1] - std::pow(u[1], 3) / 3 - u[0] * u[0] / 2}};
    };
    hill.J = [](const Vector& u, double) {
      return Matrix{{1 - u[1], -u[0]}, {-u[0], 1 - u[1] * u[1]}};
    };
    hill.by_lambda = [](const Vector&, double) { return Vector{{0, -1}}; };
    return hill;
  });
  const auto law = law_at(family, at_branch_point(Vector{{0, 1}}, 2.0 / 3), {Vector{{0, 1}}, 0});
  ASSERT_TRUE(law);
  EXPECT_EQ(law->exponent, 1);
  EXPECT_NEAR(law->coefficient, std::sqrt(2.0), 1e-9);
}

TEST(ImperfectionLaws, AParameterThatKeepsTheBranchBreaksNothing) {
  const Family family = family_of<ScalarProblem>([](double m) {
    return ScalarProblem{[=](double x, double l) { return x * (1 + m - l) - x * x * x; },
                         [=](double x, double l) { return 1 + m - l - 3 * x * x; },
                         [](double x, double) { return -x; }};
  });
  EXPECT_FALSE(law_at(family, at_branch_point(Vector::Zero(1), 1), upward));
}

}  // namespace
}  // namespace springfold::continuation
