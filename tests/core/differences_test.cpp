#include "springfold/core/differences.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace springfold
