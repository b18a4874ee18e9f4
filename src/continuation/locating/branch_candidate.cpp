#include <algorithm>
#include <cmath>

#include "continuation/locating/branch_point.hpp"
#include "continuation/locating/cluster.hpp"
#include "continuation/locating/reduced_equation.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/chebyshev.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// Is lambda's rate zero at this very place? Interpolants know better than points beside it, wide ones
/// because rounding matters less, narrow ones where the curve is not smooth enough. How far they
/// differ shows what can be told.
bool turns_at(const TestedStep& arc, double t) {
  std::vector<double> distances;  // from t to the turn
  for (const double share : half_decades<3>()) {
    const auto curve = curve_near(arc, t, share * (arc.high() - arc.low()));
    if (!curve) continue;
    const Index n = curve->values.rows() - 1;
    const double h = small_share * (curve->b - curve->a);
    const double change = (curve->slope(t + h)[n] - curve->slope(t - h)[n]) / (2 * h);
    distances.push_back(-curve->slope(t)[n] / change);
  }
  std::erase_if(distances, [](double d) { return !std::isfinite(d); });
  if (distances.empty()) return false;
  const auto [low, high] = std::minmax_element(distances.begin(), distances.end());
  const double nearest = std::min(std::abs(*low), std::abs(*high));
  return *low * *high <= 0 ? *high - *low <= blurred
                           : nearest <= same_point + std::min(*high - *low, small_share * blurred);
}

/// Removes what is left of the residual within the directions that dF sees well.
void polish(const TestedStep& arc, CurvePoint& point, Index corank) {
  const auto& walker = arc.walker();
  Vector F;
  for (int i = 0; i < 2; ++i) {
    const auto E = arc.matrix(point);
    if (!E || !walker.problem.residual(point.x, point.lambda, point.piece, F)) return;
    const Borders borders = borders_of(*E, corank);
    const Index n = F.size();
    Matrix right = Matrix::Zero(n + 1 + corank, 1);
    right.topRows(n) = -F;
    const auto step = solve_with(*E, borders, right);
    if (!step || step->topRows(n + 1).norm() > poor) return;
    point.x += step->col(0).head(n);
    point.lambda += (*step)(n, 0);
  }
}

/// Are exactly m singular values of E small here, with a gap to the others?
bool has_corank(const TestedStep& arc, const CurvePoint& point, Index m) {
  const auto E = arc.matrix(point);
  if (!E) return false;
  const Vector values = least_singular_values(*E, m + 1);
  return values[m - 1] <= small_share * values[m];
}

/// Several modes of soft springs beside a stiff member are all small against it, also where one of them alone has lost
/// its stiffness. Do m of them vanish beside the others, to what is told apart, after rows and columns have been
/// brought to one size?
bool vanish_together(const TestedStep& arc, const CurvePoint& point, Index m) {
  if (m < 2 || arc.walker().problem.structured()) return true;
  const auto own = equilibrated_jacobian(arc.walker(), point);
  if (!own) return false;
  const Vector values = divided_svd(own->J).values;
  const Index kept = values.size() - m;
  const double others = kept > 0 ? values[kept - 1] : 1;  // entries a little away are of size 1
  return values[kept] <= told_apart * others;
}

/// How far another place is from an interpolated one, along the interpolated curve and aside of it.
struct Offset {
  double at = 0;  ///< arc length of the other place
  double along = 0, aside = 0;
};

Offset offset_of(const TestedStep& arc, const Singularity& place, const CurvePoint& interpolated,
                 const CurvePoint& other) {
  const Index n = other.x.size();
  Offset offset{.at = way_to(arc.walker().weights, arc.from(), other)};
  offset.along = offset.at - place.at;
  const Direction aside{other.x - interpolated.x - offset.along * place.along.head(n),
                        other.lambda - interpolated.lambda - offset.along * place.along[n]};
  offset.aside = length_of(arc.walker(), aside);
  return offset;
}

/// Takes over the exact place of a branch point, if it is this one: near the interpolated place, and on
/// the interpolated curve. Otherwise the interpolated one stays, with what is known of its error.
/// @param near  how many modes come near to zero there, those that vanish among them
/// @returns false when the curves pass each other there, or the place is not known
bool settle_place(const TestedStep& arc, const Singularity& place, Index m, Index near,
                  Candidate& found) {
  const int corank = static_cast<int>(m);
  const double reach = std::clamp(near_share * place.free, together, branch_point_reach);
  const auto exact = place_branch_point(arc.walker(), found.point, corank, 2 * reach);
  found.off = place.doubt;
  if (exact) {
    const Offset offset = offset_of(arc, place, found.point, exact->point);
    const bool is_it = std::abs(offset.along) <= reach && offset.aside <= 10 * same_point;
    if (is_it && exact->off > poor) return false;
    if (is_it && exact->misfit <= same_point) {
      if (exact->left <= branches_apart) {
        found.point = exact->point;
        found.at = offset.at;
        found.off = std::max(exact->off, exact->misfit);
        found.before = std::min(found.before, offset.at);
        found.after = std::max(found.after, offset.at);
        return true;
      }
      arc.note_passing();
      return false;
    }
    found.off = std::max({found.off, exact->misfit, std::abs(offset.along), offset.aside});
  }
  if (!(place.doubt <= same_point) || found.off > poor) return false;
  // A branch point somewhat farther away says that rounding has shaped the interpolants.
  const auto other = place_branch_point(arc.walker(), found.point, corank);
  if (other && other->misfit <= same_point && other->off <= poor) return false;
  // Where several modes are near, one alone cannot be reduced to: what is left is asked for in all of them.
  const auto left = [&] {
    return left_of_residual(arc.walker(), found.point, static_cast<int>(near));
  };
  const double beside = left();
  polish(arc, found.point, m);
  // At the very point the problem may not be defined.
  return std::min(beside, left()) <= branches_apart;
}

/// Does Sigma leave a multiple branch point in a bend, because it vanishes once more nearby? At a point that
/// stands alone it grows with the distance; where lambda turns, at least one of its modes does.
bool has_company(const TestedStep& arc, const Candidate& found, Index m) {
  constexpr double nearer = 1.0 / 8, bent = 3;
  const auto E = arc.matrix(found.point);
  if (!E) return false;
  const Borders borders = borders_of(*E, m);
  const double far = aside_share * arc.length();
  for (const double side : {-1.0, 1.0}) {
    const double at = found.at + side * far;
    if (at < arc.low() || at > arc.high()) continue;
    const auto beyond = arc.sigma(at, borders);
    const auto near = arc.sigma(found.at + side * nearer * far, borders);
    if (!beyond || !near) continue;
    if (found.turns ? shrunk(*beyond, *near).maxCoeff() * bent < nearer
                    : nearer * beyond->norm() > bent * near->norm())
      return true;
  }
  return false;
}

/// Gives a branch point the exact direction of its branch, where second derivatives tell it; otherwise what of its
/// direction lies in the kernel.
/// @returns lambda's rate there, if the direction is exact
std::optional<double> settle_tangent(const TestedStep& arc, Index m, CurvePoint& point) {
  const auto e = reduce(arc.walker(), point, static_cast<int>(m));
  if (!e) return std::nullopt;
  const Index n = point.x.size();
  Vector along(n + 1);
  along << point.tangent.dx, point.tangent.dlambda;
  const Vector in_kernel = e->N.transpose() * along.cwiseProduct(e->root);
  const auto c = quadratic_direction(*e, in_kernel, 0.05);
  const Vector d = (e->N * c.value_or(in_kernel)).cwiseQuotient(e->root);
  const Direction tangent = unit_direction(arc.walker(), d);
  if (metric_product(arc.walker().weights, tangent, point.tangent) < 0.99) return std::nullopt;
  point.tangent = tangent;
  return c ? std::optional<double>(tangent.dlambda) : std::nullopt;
}

/// Does lambda turn at this branch point?
bool branch_turns(const TestedStep& arc, Index m, Candidate& found) {
  const auto rate = settle_tangent(arc, m, found.point);
  if (!rate) return turns_at(arc, found.at);
  if (std::abs(*rate) > 10 * flat_rate) return false;
  const auto before = arc.rate(found.at - blurred), after = arc.rate(found.at + blurred);
  return before && after ? (*before < 0) != (*after < 0) : turns_at(arc, found.at);
}

}  // namespace

std::optional<Interpolant> curve_near(const TestedStep& arc, double t, double length) {
  const auto [a, b] = window_around(t, length, arc.low(), arc.high());
  return interpolated_curve(
      [&](double ds) -> const std::optional<CurvePoint>& { return arc.point(ds); }, a, b);
}

std::optional<Candidate> candidate_at(const TestedStep& arc, const Singularity& place,
                                      const std::vector<ZeroOf>& zeros, Index m, bool touches,
                                      Index near) {
  const Index n = arc.from().x.size();
  if (m > n)
    return std::nullopt;  // dF/d(x, lambda) has no more rows that could depend on each other
  Candidate result{.at = place.at, .before = zeros.front().before, .after = zeros.back().after};
  result.point = arc.from();
  result.point.x = place.u.head(n);
  result.point.lambda = place.u[n];
  result.point.tangent = unit_direction(arc.walker(), place.along);
  result.multiplicity = touches ? 2 : static_cast<int>(m);  // two may have merged in rounding
  result.kind = touches ? HitKind::touch : HitKind::branch_point;
  result.odd = m % 2 == 1 && !touches;
  if (!settle_place(arc, place, m, std::max(m, near), result) ||
      !has_corank(arc, result.point, m) || !vanish_together(arc, result.point, m))
    return std::nullopt;
  result.turns = touches ? turns_at(arc, place.at) : branch_turns(arc, m, result);
  if (m > 1 && has_company(arc, result, m)) return std::nullopt;
  return result;
}

}  // namespace springfold::continuation
