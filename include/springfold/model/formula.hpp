// Formulas in one variable as data, with exact first and second derivatives.
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

namespace springfold::model {

/// One step of a formula. Its operands are results of earlier steps.
struct FormulaStep {
  enum class Operation {
    number,    ///< `number`
    variable,  ///< the deformation
    add,
    subtract,
    multiply,
    divide,
    power,
    negate,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    asinh,
    acosh,
    atanh,
    exp,
    log,
    sqrt,
  };
  Operation operation = Operation::number;
  std::size_t a = 0, b = 0;  ///< operands: numbers of steps before this one
  double number = 0;
};

/// The last step gives the value. No steps: zero.
struct Formula {
  std::vector<FormulaStep> steps{};
};

/// Value, first and second derivative.
template <class S>
struct Jet {
  S value{}, slope{}, bend{};
};

/// By forward differentiation of every step: exact but for rounding. Not finite where the formula or
/// a derivative is. For S = double and std::complex<double>.
template <class S>
Jet<S> evaluate(const Formula& formula, const S& variable);

extern template Jet<double> evaluate(const Formula&, const double&);
extern template Jet<std::complex<double>> evaluate(const Formula&, const std::complex<double>&);

}  // namespace springfold::model
