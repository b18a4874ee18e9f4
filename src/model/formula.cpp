#include "springfold/model/formula.hpp"

#include <cmath>

#include "integer_power.hpp"

namespace springfold::model {
namespace {

using Operation = FormulaStep::Operation;

/// f(g): value, first and second derivative of f at g.
template <class S>
Jet<S> chained(const Jet<S>& g, const S& f, const S& slope, const S& bend) {
  return {f, slope * g.slope, bend * g.slope * g.slope + slope * g.bend};
}

template <class S>
Jet<S> product(const Jet<S>& a, const Jet<S>& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope,
          a.bend * b.value + 2.0 * a.slope * b.slope + a.value * b.bend};
}

template <class S>
Jet<S> sum(const Jet<S>& a, const Jet<S>& b, double sign) {
  return {a.value + sign * b.value, a.slope + sign * b.slope, a.bend + sign * b.bend};
}

template <class S>
Jet<S> quotient(const Jet<S>& a, const Jet<S>& b) {
  const S q = a.value / b.value;
  const S slope = (a.slope - q * b.slope) / b.value;
  return {q, slope, (a.bend - 2.0 * slope * b.slope - q * b.bend) / b.value};
}

template <class S>
Jet<S> logarithm(const Jet<S>& g) {
  const S inverse = 1.0 / g.value;
  return chained<S>(g, std::log(g.value), inverse, -inverse * inverse);
}

template <class S>
Jet<S> exponential(const Jet<S>& g) {
  const S e = std::exp(g.value);
  return chained<S>(g, e, e, e);
}

/// Factors that are zero make a term zero, whatever stands behind them: 0^-1 is not finite.
template <class S>
S term(double factor, const S& base, double exponent) {
  return factor == 0 ? S(0) : factor * power_of(base, exponent);
}

template <class S>
Jet<S> power(const Jet<S>& base, const Jet<S>& exponent, bool constant, double p) {
  if (!constant) return exponential(product(exponent, logarithm(base)));
  return chained<S>(base, power_of(base.value, p), term(p, base.value, p - 1),
                    term(p * (p - 1), base.value, p - 2));
}

/// atan2(y, x) has the derivatives of atan(y/x), also where x is zero.
template <class S>
Jet<S> angle(const Jet<S>& y, const Jet<S>& x) {
  const S r2 = y.value * y.value + x.value * x.value;
  const S top = x.value * y.slope - y.value * x.slope;
  const S r2_slope = 2.0 * (y.value * y.slope + x.value * x.slope);
  const S top_slope = x.value * y.bend - y.value * x.bend;
  const S slope = top / r2;
  S value;
  if constexpr (std::is_same_v<S, double>)
    value = std::atan2(y.value, x.value);
  else  // to the first order in the imaginary part
    value = S(std::atan2(y.value.real(), x.value.real()),
              (x.value.real() * y.value.imag() - y.value.real() * x.value.imag()) /
                  (y.value.real() * y.value.real() + x.value.real() * x.value.real()));
  return {value, slope, (top_slope - slope * r2_slope) / r2};
}

template <class S>
Jet<S> function_of(Operation operation, const Jet<S>& g) {
  const S x = g.value;
  switch (operation) {
    case Operation::sin:
      return chained<S>(g, std::sin(x), std::cos(x), -std::sin(x));
    case Operation::cos:
      return chained<S>(g, std::cos(x), -std::sin(x), -std::cos(x));
    case Operation::tan: {
      const S t = std::tan(x), slope = 1.0 + t * t;
      return chained<S>(g, t, slope, 2.0 * t * slope);
    }
    case Operation::asin: {
      const S inner = 1.0 - x * x, slope = 1.0 / std::sqrt(inner);
      return chained<S>(g, std::asin(x), slope, x * slope / inner);
    }
    case Operation::acos: {
      const S inner = 1.0 - x * x, slope = -1.0 / std::sqrt(inner);
      return chained<S>(g, std::acos(x), slope, x * slope / inner);
    }
    case Operation::atan: {
      const S slope = 1.0 / (1.0 + x * x);
      return chained<S>(g, std::atan(x), slope, -2.0 * x * slope * slope);
    }
    case Operation::sinh:
      return chained<S>(g, std::sinh(x), std::cosh(x), std::sinh(x));
    case Operation::cosh:
      return chained<S>(g, std::cosh(x), std::sinh(x), std::cosh(x));
    case Operation::tanh: {
      const S t = std::tanh(x), e = 1.0 / std::cosh(x), slope = e * e;
      return chained<S>(g, t, slope, -2.0 * t * slope);
    }
    case Operation::asinh: {
      const S inner = 1.0 + x * x, slope = 1.0 / std::sqrt(inner);
      return chained<S>(g, std::asinh(x), slope, -x * slope / inner);
    }
    case Operation::acosh: {
      const S inner = x * x - 1.0, slope = 1.0 / std::sqrt(inner);
      return chained<S>(g, std::acosh(x), slope, -x * slope / inner);
    }
    case Operation::atanh: {
      const S slope = 1.0 / (1.0 - x * x);
      return chained<S>(g, std::atanh(x), slope, 2.0 * x * slope * slope);
    }
    case Operation::exp:
      return exponential(g);
    case Operation::log:
      return logarithm(g);
    case Operation::sqrt: {
      const S root = std::sqrt(x), slope = 0.5 / root;
      return chained<S>(g, root, slope, -0.5 * slope / x);
    }
    default:
      return g;
  }
}

template <class S>
Jet<S> result_of(const Formula& formula, const FormulaStep& step,
                 const std::vector<Jet<S>>& results, const S& variable) {
  const auto a = [&]() -> const Jet<S>& { return results[step.a]; };
  const auto b = [&]() -> const Jet<S>& { return results[step.b]; };
  switch (step.operation) {
    case Operation::number:
      return {S(step.number), S(0), S(0)};
    case Operation::variable:
      return {variable, S(1), S(0)};
    case Operation::add:
      return sum(a(), b(), 1);
    case Operation::subtract:
      return sum(a(), b(), -1);
    case Operation::multiply:
      return product(a(), b());
    case Operation::divide:
      return quotient(a(), b());
    case Operation::power: {
      const FormulaStep& exponent = formula.steps[step.b];
      return power(a(), b(), exponent.operation == Operation::number, exponent.number);
    }
    case Operation::negate:
      return {-a().value, -a().slope, -a().bend};
    case Operation::atan2:
      return angle(a(), b());
    default:
      return function_of(step.operation, a());
  }
}

}  // namespace

template <class S>
Jet<S> evaluate(const Formula& formula, const S& variable) {
  if (formula.steps.empty()) return {};
  std::vector<Jet<S>> results;
  results.reserve(formula.steps.size());
  for (const FormulaStep& step : formula.steps)
    results.push_back(result_of(formula, step, results, variable));
  return results.back();
}

template Jet<double> evaluate(const Formula&, const double&);
template Jet<std::complex<double>> evaluate(const Formula&, const std::complex<double>&);

}  // namespace springfold::model
