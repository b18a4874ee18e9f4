#include "springfold/core/differences.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace springfold {
namespace {

std::optional<Vector> sine_and_exponential(double p) { return Vector{{std::sin(p), std::exp(p)}}; }

double error_at(double h) {
  const double p = 0.7;
  const auto rate = six_point_derivative(sine_and_exponential, p, h);
  return (*rate - Vector{{std::cos(p), std::exp(p)}}).norm();
}

TEST(SixPointDerivative, HasAnErrorOfOrderSix) {
  for (const double h : {0.8, 0.4, 0.2}) {
    const double ratio = error_at(h) / error_at(h / 2);
    EXPECT_GT(ratio, 64 * 0.8) << "h = " << h;
    EXPECT_LT(ratio, 64 * 1.2) << "h = " << h;
  }
}

TEST(SixPointDerivative, KeepsTwelveDigitsAtTheRecommendedStep) {
  for (const double h : {0x1p-6, 1e-2, 0x1p-8}) EXPECT_LT(error_at(h), 1e-12) << "h = " << h;
}

TEST(SixPointDerivative, IsExactForPolynomialsUpToDegreeSix) {
  for (int degree = 0; degree <= 6; ++degree) {
    const auto power = [degree](double p) -> std::optional<Vector> {
      return Vector::Constant(1, std::pow(p, degree));
    };
    const auto rate = six_point_derivative(power, 1.5, 0.25);
    const double exact = degree == 0 ? 0 : degree * std::pow(1.5, degree - 1);
    EXPECT_NEAR((*rate)[0], exact, 1e-12) << "degree " << degree;
  }
}

TEST(SixPointDerivative, HasNoValueWhereTheFunctionHasNone) {
  const auto root = [](double p) -> std::optional<Vector> {
    if (p < 0) return std::nullopt;
    return Vector::Constant(1, std::sqrt(p));
  };
  EXPECT_FALSE(six_point_derivative(root, 0.02, 0.01).has_value());
  EXPECT_TRUE(six_point_derivative(root, 0.04, 0.01).has_value());
}

TEST(GridDerivative, IsExactForPolynomialsUpToDegreeSeven) {
  for (int degree = 0; degree <= 7; ++degree) {
    const auto power = [degree](double p) -> std::optional<Vector> {
      return Vector::Constant(1, std::pow(p, degree));
    };
    for (const double p : {1.5, 1.6, 1.75}) {
      const double exact = degree == 0 ? 0 : degree * std::pow(p, degree - 1);
      EXPECT_NEAR(grid_derivative(power, p, 0.25)->value[0], exact, 1e-11 * std::max(1.0, exact));
    }
  }
}

TEST(GridDerivative, KeepsTwelveDigitsAtTheRecommendedStepWhereverItIsTaken) {
  for (const double h : {0x1p-6, 0x1p-7, 0x1p-8})
    for (const double p : {0.7, 0.703, 0.71, 0.75, -0.7})
      EXPECT_LT(
          (grid_derivative(sine_and_exponential, p, h)->value - Vector{{std::cos(p), std::exp(p)}})
              .norm(),
          1e-12)
          << "h = " << h << ", p = " << p;
}

TEST(GridDerivative, DoubtsItselfMoreThanItIsOff) {
  for (const double h : {0.2, 0.1, 0.05})
    for (const double p : {0.7, 0.71, 0.75}) {
      const auto rate = grid_derivative(sine_and_exponential, p, h);
      EXPECT_GT(rate->doubt, (rate->value - Vector{{std::cos(p), std::exp(p)}}).norm()) << h;
    }
}

TEST(GridDerivative, DoubtsItselfAcrossAKink) {
  const auto kink = [](double p) -> std::optional<Vector> {
    return Vector::Constant(1, std::max(0.0, p - 0.701));
  };
  EXPECT_GT(grid_derivative(kink, 0.7, 0x1p-7)->doubt, 1e-3);
  EXPECT_LT(grid_derivative(kink, 0.6, 0x1p-7)->doubt, 1e-12);
}

TEST(GridDerivative, ExpectsItsErrorWithinTwoOrdersWhereTheFunctionIsSmooth) {
  for (const double h : {0.2, 0.1, 0.05})
    for (const double p : {0.71, 0.74}) {
      const auto rate = grid_derivative(sine_and_exponential, p, h);
      const double error =
          (rate->value - Vector{{std::cos(p), std::exp(p)}}).lpNorm<Eigen::Infinity>();
      EXPECT_GT(rate->expected_error, 0.1 * error) << h;
      EXPECT_LT(rate->expected_error, 100 * error) << h;
    }
}

TEST(GridDerivative, ExpectsALargeErrorWhereOnlyItsLastPlaceLiesBehindAJump) {
  const double h = 0x1p-7;
  const auto jump = [&](double p) -> std::optional<Vector> {
    return Vector::Constant(1, p < 0.5 + 0.5 * h ? 1 + std::sin(p) : std::sin(p));
  };
  // Places from 0.5 on, which is the first.
  EXPECT_GT(grid_derivative(jump, 0.5 + 3.5 * h, h)->expected_error, 1e-2);
  EXPECT_LT(grid_derivative(jump, 0.5 + 4.5 * h, h)->expected_error, 1e-12);
}

TEST(RoughGridDerivative, IsThatOfTheCubicThroughFourPlaces) {
  for (int degree = 0; degree <= 3; ++degree) {
    const auto power = [degree](double p) -> std::optional<Vector> {
      return Vector::Constant(1, std::pow(p, degree));
    };
    const double exact = degree == 0 ? 0 : degree * std::pow(1.6, degree - 1);
    EXPECT_NEAR(rough_grid_derivative(power, 1.6, 0.25)->value[0], exact, 1e-11);
  }
  const auto rate = rough_grid_derivative(sine_and_exponential, 0.703, 0x1p-7);
  EXPECT_LT((rate->value - Vector{{std::cos(0.703), std::exp(0.703)}}).norm(), 1e-6);
}

TEST(GridDerivative, AsksForTheSamePlacesOfNeighbours) {
  std::set<double> places;
  for (const double p : {0.51, 0.5101, 0.511, 0.514})
    grid_derivative(
        [&](double at) -> std::optional<Vector> {
          places.insert(at);
          return Vector::Zero(1);
        },
        p, 0x1p-6);
  EXPECT_EQ(places.size(), 8u);
}

TEST(GridDerivative, AsksForNoMorePlacesThanItsOrdersNeedToAgree) {
  const auto places_of = [](const auto& f, std::size_t expected) {
    std::set<double> places;
    const auto rate = grid_derivative(
        [&](double at) {
          places.insert(at);
          return f(at);
        },
        0.703, 0x1p-10, 1e-9);
    EXPECT_EQ(places.size(), expected);
    return rate->value;
  };
  const auto line = [](double p) -> std::optional<Vector> { return Vector::Constant(1, 3 * p); };
  EXPECT_NEAR(places_of(line, 4)[0], 3, 1e-12);
  const Vector wave = places_of(sine_and_exponential, 6);
  EXPECT_LT((wave - Vector{{std::cos(0.703), std::exp(0.703)}}).norm(), 2e-12);
}

TEST(GridDerivative, HasNoValueWhereTheFunctionHasNone) {
  const auto root = [](double p) -> std::optional<Vector> {
    if (p < 0) return std::nullopt;
    return Vector::Constant(1, std::sqrt(p));
  };
  EXPECT_FALSE(grid_derivative(root, 0x1p-6, 0x1p-7).has_value());
  EXPECT_TRUE(grid_derivative(root, 0x1p-5, 0x1p-7).has_value());
}

}  // namespace
}  // namespace springfold
