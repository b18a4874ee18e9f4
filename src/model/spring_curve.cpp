#include "springfold/model/spring_curve.hpp"

#include <algorithm>
#include <cmath>

#include "integer_power.hpp"
#include "quadrature.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;

double real_part(double x) { return x; }
double real_part(const Complex& x) { return x.real(); }

/// ln(1 + x), for real x to the last digit also near 0.
double log_of_1_plus(double x) { return std::log1p(x); }
Complex log_of_1_plus(const Complex& x) {
  return {std::log1p(x.real()), std::atan2(x.imag(), 1 + x.real())};  // |1 + x| to the second order
}

/// Below the range, within it, or above: -1, 0, 1.
template <class S>
int part_at(const DeformationRange& range, const S& u) {
  const double at = real_part(u);
  return at < range.low ? -1 : at > range.high ? 1 : 0;
}

/// Curves within a range that go on straight: `inside(u)` gives the jet there.
template <class S, class Inside>
Jet<S> with_ends(const DeformationRange& range, const S& u, const Inside& inside) {
  const int part = range.held.value_or(part_at(range, u));
  if (part == 0) return inside(u);
  const double end = part < 0 ? range.low : range.high;
  const Jet<S> there = inside(S(end));
  return {there.value + there.slope * (u - end), there.slope, S(0)};
}

/// Energy of the straight part beyond an end, measured from there; 0 of the law itself.
template <class S, class Inside>
S beyond_ends(const DeformationRange& range, int part, const S& u, const Inside& inside) {
  if (part == 0) return S(0);
  const double end = part < 0 ? range.low : range.high;
  const Jet<S> there = inside(S(end));
  const S d = u - end;
  return d * (there.value + 0.5 * there.slope * d);
}

/// u where the law itself holds, else the end behind which the part lies.
template <class S>
S within(const DeformationRange& range, int part, const S& u) {
  return part < 0 ? S(range.low) : part > 0 ? S(range.high) : u;
}

template <class S>
Jet<S> polynomial(const std::vector<double>& a, const S& u) {
  Jet<S> p{};
  for (std::size_t i = a.size(); i-- > 0;) {
    p.bend = p.bend * u + 2.0 * p.slope;
    p.slope = p.slope * u + p.value;
    p.value = p.value * u + a[i];
  }
  return p;
}

template <class S>
Jet<S> torque_at(const PolynomialSpring& s, const S& c) {
  return with_ends(s.range, S(c - s.free),
                   [&s](const S& u) { return polynomial(s.coefficients, u); });
}

template <class S>
S energy_at(const PolynomialSpring& s, const S& c) {
  const auto inside = [&s](const S& u) { return polynomial(s.coefficients, u); };
  const auto raised = [&s](const S& u) {
    S sum(0);
    for (std::size_t i = s.coefficients.size(); i-- > 0;)
      sum = (sum + s.coefficients[i] / static_cast<double>(i + 1)) * u;
    return sum;
  };
  const S u = c - s.free, zero(0);
  const int part = s.range.held.value_or(part_at(s.range, u)), none = part_at(s.range, zero);
  return raised(within(s.range, part, u)) - raised(within(s.range, none, zero)) +
         beyond_ends(s.range, part, u, inside) - beyond_ends(s.range, none, zero, inside);
}

template <class S>
Jet<S> torque_at(const FormulaSpring& s, const S& c) {
  const Jet<S> f = with_ends(s.range, S((c - s.free) * s.coordinate_unit),
                             [&s](const S& u) { return evaluate(s.formula, u); });
  const double per_torque = s.coordinate_unit / s.torque_unit;
  return {f.value / s.torque_unit, f.slope * per_torque, f.bend * (per_torque * s.coordinate_unit)};
}

double energy_at(const FormulaSpring& s, const double& c) {
  const auto inside = [&s](double u) { return evaluate(s.formula, u); };
  const double u = (c - s.free) * s.coordinate_unit, zero = 0;
  const int part = s.range.held.value_or(part_at(s.range, u)), none = part_at(s.range, zero);
  const double energy = integral([&](double v) { return inside(v).value; },
                                 within(s.range, none, zero), within(s.range, part, u)) +
                        beyond_ends(s.range, part, u, inside) -
                        beyond_ends(s.range, none, zero, inside);
  return energy / (s.torque_unit * s.coordinate_unit);
}

Complex energy_at(const FormulaSpring& s, const Complex& c) {
  return {energy_at(s, c.real()), torque_at(s, c.real()).value * c.imag()};
}

template <class S>
Jet<S> torque_at(const LogarithmicSpring& s, const S& c) {
  const S strain = (c - s.free) / s.length;
  const S stretch = 1.0 + strain, slope = s.stiffness / stretch;
  return {s.stiffness * s.length * log_of_1_plus(strain), slope, -slope / (stretch * s.length)};
}

template <class S>
S energy_at(const LogarithmicSpring& s, const S& c) {
  const S strain = (c - s.free) / s.length;
  return s.stiffness * s.length * s.length * ((1.0 + strain) * log_of_1_plus(strain) - strain);
}

/// (p/depth)^exponent, odd where the exponent is not whole.
template <class S>
S odd_power(const S& x, double exponent) {
  if (std::floor(exponent) == exponent || real_part(x) > 0) return power_of(x, exponent);
  if (real_part(x) == 0) return x * std::pow(std::abs(x), exponent - 1);
  return -power_of(S(-x), exponent);
}

template <class S>
Jet<S> torque_at(const PowerSpring& s, const S& c) {
  const double sign = s.below ? -1 : 1, m = s.exponent, k = s.force * m / s.depth;
  const S x = sign * (c - s.from) / s.depth;
  const bool mirrored = real_part(x) < 0 && std::floor(m) != m;  // even derivatives change sign
  const S inside = mirrored ? -x : x;
  const S bend = m == 1 ? S(0) : k * (m - 1) / s.depth * power_of(inside, m - 2);
  return {sign * s.force * odd_power(x, m), k * power_of(inside, m - 1),
          sign * (mirrored ? -bend : bend)};
}

template <class S>
S energy_at(const PowerSpring& s, const S& c) {
  const double sign = s.below ? -1 : 1, m = s.exponent;
  const S x = sign * (c - s.from) / s.depth;
  const bool mirrored = real_part(x) < 0 && std::floor(m) != m;
  return s.force * s.depth / (m + 1) * power_of(mirrored ? S(-x) : x, m + 1);
}

/// The piece in which u lies, and u from where it begins. Left of all: the first one, straight, but where it is the
/// only one.
template <class S>
struct InPiece {
  const CubicPieces::Piece& piece;
  S from;
  double curved;  ///< 0 where it is straight
};

template <class S>
InPiece<S> piece_at(const CubicPieces& s, const S& c) {
  const S u = c - s.free;
  const auto above =
      std::upper_bound(s.pieces.begin(), s.pieces.end(), real_part(u),
                       [](double at, const CubicPieces::Piece& piece) { return at < piece.at; });
  const CubicPieces::Piece& piece = above == s.pieces.begin() ? *above : *(above - 1);
  const bool is_left = above == s.pieces.begin() && s.pieces.size() > 1;
  return {piece, u - piece.at, is_left ? 0.0 : 1.0};
}

template <class S>
Jet<S> torque_at(const CubicPieces& s, const S& c) {
  const auto [p, d, curved] = piece_at(s, c);
  const double a = curved * p.quadratic, b = curved * p.cubic;
  return {p.value + d * (p.slope + d * (a + b * d)), p.slope + d * (2.0 * a + 3.0 * b * d),
          2.0 * a + 6.0 * b * d};
}

template <class S>
S energy_at(const CubicPieces& s, const S& c) {
  const auto [p, d, curved] = piece_at(s, c);
  const double a = curved * p.quadratic, b = curved * p.cubic;
  return p.energy + d * (p.value + d * (p.slope / 2 + d * (a / 3 + b * d / 4.0)));
}

std::vector<double> bends(const DeformationRange& range, double free, double unit) {
  std::vector<double> at;
  for (const double u : {range.low, range.high})
    if (std::isfinite(u)) at.push_back(free + u / unit);
  return at;
}

std::vector<double> bends_in(const PolynomialSpring& s) { return bends(s.range, s.free, 1); }
std::vector<double> bends_in(const FormulaSpring& s) {
  return bends(s.range, s.free, s.coordinate_unit);
}
std::vector<double> bends_in(const LogarithmicSpring&) { return {}; }
std::vector<double> bends_in(const PowerSpring&) { return {}; }
std::vector<double> bends_in(const CubicPieces& s) {
  std::vector<double> at;
  if (s.pieces.size() > 1)
    for (const CubicPieces::Piece& piece : s.pieces) at.push_back(s.free + piece.at);
  return at;
}

/// Curves with a range: of its ends only finite ones are bends.
template <class Curve>
SpringCurve part_within(Curve s, std::size_t part) {
  const bool has_low = std::isfinite(s.range.low);
  s.range.held = static_cast<int>(part) - (has_low ? 1 : 0);
  return s;
}

SpringCurve part_in(const PolynomialSpring& s, std::size_t part) { return part_within(s, part); }
SpringCurve part_in(const FormulaSpring& s, std::size_t part) { return part_within(s, part); }
SpringCurve part_in(const LogarithmicSpring& s, std::size_t) { return s; }
SpringCurve part_in(const PowerSpring& s, std::size_t) { return s; }
SpringCurve part_in(const CubicPieces& s, std::size_t part) {
  CubicPieces::Piece piece = s.pieces[part == 0 ? 0 : part - 1];
  if (part == 0) piece.quadratic = piece.cubic = 0;
  return CubicPieces{{piece}, s.free};
}

}  // namespace

std::vector<double> bends_of(const SpringCurve& curve) {
  return std::visit([](const auto& s) { return bends_in(s); }, curve);
}

SpringCurve part_of(const SpringCurve& curve, std::size_t part) {
  return std::visit([part](const auto& s) { return part_in(s, part); }, curve);
}

template <class S>
Jet<S> torque_of(const SpringCurve& curve, const S& c) {
  return std::visit([&c](const auto& s) { return torque_at(s, c); }, curve);
}

template <class S>
S energy_of(const SpringCurve& curve, const S& c) {
  return std::visit([&c](const auto& s) { return energy_at(s, c); }, curve);
}

template Jet<double> torque_of(const SpringCurve&, const double&);
template Jet<Complex> torque_of(const SpringCurve&, const Complex&);
template double energy_of(const SpringCurve&, const double&);
template Complex energy_of(const SpringCurve&, const Complex&);

}  // namespace springfold::model
