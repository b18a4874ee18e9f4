// Values at which a shape has an edge as |x| has at 0, and what is smooth there: the distance of two points and that of
// a point from a line in space at 0, the angle in space at 0 and pi.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "springfold/model/shape.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::model {

/// An edge of alpha: alpha = at + side * delta, delta >= 0.
struct ShapeEdge {
  double at = 0;
  double side = 1;
  bool turns = false;  ///< an angle
};

/// The edge next to alpha; nothing of shapes that have none.
/// @param points  how many the shape has
inline std::optional<ShapeEdge> edge_of(const CompiledShape& shape, std::size_t points,
                                        double alpha) {
  if (shape.kind == ShapeKind::path && points == 2 && !shape.closed) return ShapeEdge{};
  if (shape.in_plane) return std::nullopt;
  if (shape.kind == ShapeKind::line) return ShapeEdge{};
  if (shape.kind != ShapeKind::angle) return std::nullopt;
  const double turn = std::numbers::pi, half_turns = std::round(alpha / turn);
  return ShapeEdge{half_turns * turn, alpha < half_turns * turn ? -1.0 : 1.0, true};
}

/// A function sigma of the points that is smooth at the edge: sigma = delta^2/2, of an angle 1 - cos(delta).
/// @param p, out  as evaluate_shape() has them
template <class S>
void evaluate_about_edge(const CompiledShape& shape, const ShapeEdge& edge, const VectorOf<S>& p,
                         ShapeValue<S>& out) {
  using detail::Form;
  out.value = S(0);
  out.gradient.setZero(p.size());
  out.hessian.setZero(p.size(), p.size());
  if (shape.kind == ShapeKind::path) {
    constexpr std::array<std::array<Index, 2>, 1> ends{{{1, 0}}};
    const Form<S, 1> square = detail::inner<S, 1>(detail::differences<S>(p, ends), 0, 0);
    return detail::spread<S, 1>(detail::composed<S, 1>(square, S(0.5) * square.value, S(0.5), S(0)),
                                ends, out);
  }
  if (shape.kind == ShapeKind::line) {
    constexpr std::array<std::array<Index, 2>, 2> ends{{{2, 1}, {0, 1}}};
    const detail::Vectors<S, 2> d = detail::differences<S>(p, ends);
    const Form<S, 2> square = detail::product<S, 2>(
        detail::cross_square<S, 2>(d, 0, 1), detail::power<S, 2>(detail::inner<S, 2>(d, 0, 0), -1));
    return detail::spread<S, 2>(detail::composed<S, 2>(square, S(0.5) * square.value, S(0.5), S(0)),
                                ends, out);
  }
  constexpr std::array<std::array<Index, 2>, 2> ends{{{0, 1}, {2, 1}}};
  const detail::Vectors<S, 2> d = detail::differences<S>(p, ends);
  const Form<S, 2> cosine = detail::product<S, 2>(
      detail::inner<S, 2>(d, 0, 1),
      detail::product<S, 2>(detail::power<S, 2>(detail::inner<S, 2>(d, 0, 0), -0.5),
                            detail::power<S, 2>(detail::inner<S, 2>(d, 1, 1), -0.5)));
  const S sign(edge.at == 0 ? -1 : 1);
  detail::spread<S, 2>(detail::composed<S, 2>(cosine, S(1) + sign * cosine.value, sign, S(0)), ends,
                       out);
}

/// Derivatives of an energy U(alpha) by sigma.
struct EdgeSlopes {
  double slope = 0, curvature = 0;
};

/// U(alpha) is smooth in the points where it has no slope at the edge: with f(delta) = dU/ddelta
///
///     dU/dsigma = f/sigma',    d2U/dsigma2 = (f' - f sigma''/sigma')/sigma'^2,
///
/// and by the first terms of f near the edge. @returns nothing where U has a slope there
inline std::optional<EdgeSlopes> slopes_about_edge(const CompiledSpring& law, std::size_t segment,
                                                   const ShapeEdge& edge, double alpha) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double least = std::cbrt(eps);  // below it terms of third order are less than rounding
  const double k = law.stiffness(segment, edge.at);
  if (!(std::abs(law.torque(segment, edge.at)) <= 8 * eps * std::abs(k) * std::max(1.0, edge.at)))
    return std::nullopt;
  const double delta = std::abs(alpha - edge.at);
  if (delta < least) {
    const double r = edge.side * law.stiffness_rate(segment, edge.at);
    // f = k delta + r delta^2/2; of an angle 1/sin(delta) = 1/delta + delta/6.
    const double turn = edge.turns ? k / 3 : 0;
    return EdgeSlopes{k + r * delta / 2, turn + (delta > 0 ? r / (2 * delta) : 0)};
  }
  const double first = edge.turns ? std::sin(delta) : delta;
  const double second = edge.turns ? std::cos(delta) : 1;
  const double f = edge.side * law.torque(segment, alpha);
  return EdgeSlopes{f / first,
                    (law.stiffness(segment, alpha) - f * second / first) / (first * first)};
}

}  // namespace springfold::model
