#include "springfold/model/formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using Operation = FormulaStep::Operation;

/// operation(x, number) or operation(x), with x = the variable.
Formula of_variable(Operation operation, double number = 0) {
  return {{{Operation::variable}, {Operation::number, 0, 0, number}, {operation, 0, 1}}};
}

struct Function {
  Operation operation;
  double number, x, value;
};

TEST(Formula, FunctionsAreThoseOfMathematics) {
  const double x = 0.37;
  for (const Function& f : {Function{Operation::add, 2.5, x, x + 2.5},
                            {Operation::subtract, 2.5, x, x - 2.5},
                            {Operation::multiply, 2.5, x, x * 2.5},
                            {Operation::divide, 2.5, x, x / 2.5},
                            {Operation::power, 2.5, x, std::pow(x, 2.5)},
                            {Operation::power, 3, -x, -x * x * x},
                            {Operation::power, -2, -x, 1 / (x * x)},
                            {Operation::negate, 0, x, -x},
                            {Operation::sin, 0, x, std::sin(x)},
                            {Operation::cos, 0, x, std::cos(x)},
                            {Operation::tan, 0, x, std::tan(x)},
                            {Operation::asin, 0, x, std::asin(x)},
                            {Operation::acos, 0, x, std::acos(x)},
                            {Operation::atan, 0, x, std::atan(x)},
                            {Operation::atan2, -1.5, x, std::atan2(x, -1.5)},
                            {Operation::sinh, 0, x, std::sinh(x)},
                            {Operation::cosh, 0, x, std::cosh(x)},
                            {Operation::tanh, 0, x, std::tanh(x)},
                            {Operation::asinh, 0, x, std::asinh(x)},
                            {Operation::acosh, 0, 1 + x, std::acosh(1 + x)},
                            {Operation::atanh, 0, x, std::atanh(x)},
                            {Operation::exp, 0, x, std::exp(x)},
                            {Operation::log, 0, x, std::log(x)},
                            {Operation::sqrt, 0, x, std::sqrt(x)}}) {
    const Formula formula = of_variable(f.operation, f.number);
    EXPECT_DOUBLE_EQ(evaluate(formula, f.x).value, f.value) << int(f.operation);
  }
}

TEST(Formula, FirstAndSecondDerivativesAreThoseOfComplexSteps) {
  constexpr double step = 1e-30;
  for (int i = int(Operation::add); i <= int(Operation::sqrt); ++i) {
    const auto operation = static_cast<Operation>(i);
    for (const double x : {0.37, 0.81}) {
      const double at = operation == Operation::acosh ? 1 + x : x;
      const Formula formula = of_variable(operation, 2.5);
      const Jet<double> jet = evaluate(formula, at);
      const Jet<Complex> off = evaluate(formula, Complex(at, step));
      EXPECT_NEAR(jet.slope, off.value.imag() / step, 1e-13 * (1 + std::abs(jet.slope))) << i;
      EXPECT_NEAR(jet.bend, off.slope.imag() / step, 1e-12 * (1 + std::abs(jet.bend))) << i;
    }
  }
}

TEST(Formula, WholePowersHaveAllDerivativesAtZero) {
  const auto power = [](double exponent) {
    return evaluate(of_variable(Operation::power, exponent), 0.0);
  };
  EXPECT_EQ(power(1).value, 0);
  EXPECT_EQ(power(1).slope, 1);
  EXPECT_EQ(power(1).bend, 0);
  EXPECT_EQ(power(2).slope, 0);
  EXPECT_EQ(power(2).bend, 2);
  EXPECT_EQ(power(3).bend, 0);
  EXPECT_EQ(power(0).value, 1);
  EXPECT_EQ(power(0).slope, 0);
}

TEST(Formula, AVariableExponentIsAnExponential) {  // 3^x
  const Formula formula{
      {{Operation::number, 0, 0, 3}, {Operation::variable}, {Operation::power, 0, 1}}};
  const Jet<double> jet = evaluate(formula, 1.7);
  const double ln3 = std::log(3.0);
  EXPECT_NEAR(jet.value, std::pow(3, 1.7), 1e-14);
  EXPECT_NEAR(jet.slope, ln3 * jet.value, 1e-14);
  EXPECT_NEAR(jet.bend, ln3 * ln3 * jet.value, 1e-13);
}

TEST(Formula, IsNotFiniteOutsideItsDomain) {
  EXPECT_FALSE(std::isfinite(evaluate(of_variable(Operation::sqrt), -1.0).value));
  EXPECT_FALSE(std::isfinite(evaluate(of_variable(Operation::log), 0.0).value));
}

}  // namespace
}  // namespace springfold::model
