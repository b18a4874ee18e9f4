#include "continuation/kinks/switch_rates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "continuation/locating/reduced_equation.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {

bool KnownRate::has_sign() const { return std::abs(value) > error; }

double switch_rate(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& along) {
  return dg_dx.row(j).dot(along.dx) + dg_dlambda[j] * along.dlambda;
}

bool read_switches(const Walker& walker, const CurvePoint& p, Workspace::Switches& at) {
  return walker.problem.switches(p.x, p.lambda, at.g) &&
         walker.problem.switch_gradients(p.x, p.lambda, at.dg_dx, at.dg_dlambda);
}

double rate_along(const Workspace::Switches& at, Index j, const CurvePoint& p) {
  return switch_rate(at.dg_dx, at.dg_dlambda, j, p.tangent);
}

SwitchRates::SwitchRates(const Walker& walker, const CurvePoint& at) : walker_{walker}, at_{at} {}

SwitchRates::~SwitchRates() = default;

namespace {

/// How much J y changes, per length, where the point moves by D_c v; nothing outside the domain.
std::optional<Vector> change_along(const Walker& walker, const CurvePoint& at,
                                   const EquilibratedJacobian& own, const Vector& v,
                                   const Vector& y) {
  const Index n = own.J.rows();
  const Vector moved = poor * own.columns.cwiseProduct(v);
  Linearisation there;
  if (!linearise_densely(walker.problem, at.x + moved.head(n), at.lambda + moved[n], at.piece,
                         there))
    return std::nullopt;
  const Vector direction = own.columns.cwiseProduct(y);
  const Vector rates = there.dF_dx * direction.head(n) + direction[n] * there.dF_dlambda;
  return Vector((own.rows.cwiseProduct(rates) - own.J * y) / poor);
}

}  // namespace

/// The bordered equations along one tangent, solved.
struct SwitchRates::Solved {
  Vector along{};  ///< D_c^-1 tangent, whose direction is y0
  Lu factors{};
  Vector y{};
  Vector change{};  ///< of J y, by what the point may be off along the weakest direction
};

const SwitchRates::Solved* SwitchRates::solve_along(const Vector& along) {
  if (solved_ && (solved_->along == along || solved_->along == -along)) return solved_.get();
  constexpr int until_it_settles = 4;
  const EquilibratedJacobian& own = *equations_;
  const Index n = own.J.rows();
  const double length = along.norm();
  Matrix B(n + 1, n + 1);
  B << own.J, along.transpose() / length;
  if (!B.allFinite()) return nullptr;
  auto now = std::make_unique<Solved>(Solved{.along = along, .factors = Lu(B)});
  now->y = length * now->factors.solve(Vector::Unit(n + 1, n));
  // The least singular value and its vector, by inverse iteration.
  Vector v = irregular_columns(n + 1, 1).col(0).normalized();
  double inverse_square = 0;
  for (int i = 0; i < until_it_settles; ++i) {
    const Vector next = now->factors.solve(Vector(now->factors.solve_transposed(v)));
    inverse_square = next.norm();
    v = next / inverse_square;
  }
  if (!v.allFinite() || !now->y.allFinite()) return nullptr;
  const auto change = change_along(walker_, at_, own, v, now->y);
  if (!change) return nullptr;
  // A corrected point is off by the last correction that is not made.
  now->change = refined_step * std::sqrt(inverse_square) * *change;
  solved_ = std::move(now);
  return solved_.get();
}

KnownRate SwitchRates::of(const Matrix& dg_dx, const Vector& dg_dlambda, Index j,
                          const Direction& tangent) {
  const KnownRate seen{switch_rate(dg_dx, dg_dlambda, j, tangent), infinity};
  if (walker_.problem.structured()) return seen;
  if (!asked_) {
    asked_ = true;
    if (auto own = equilibrated_jacobian(walker_, at_))
      equations_ = std::make_unique<EquilibratedJacobian>(std::move(*own));
  }
  if (!equations_) return seen;
  const Index n = equations_->J.rows();
  Vector gradient(n + 1), along(n + 1);
  gradient << dg_dx.row(j).transpose(), dg_dlambda[j];
  gradient = gradient.cwiseProduct(equations_->columns);
  along << tangent.dx, tangent.dlambda;
  along = along.cwiseQuotient(equations_->columns);
  const Solved* solved = solve_along(along);
  if (solved == nullptr) return seen;
  const double sign = solved->along == along ? 1 : -1;
  const Vector& y = solved->y;
  const Vector w = solved->factors.solve_transposed(gradient);
  const double error = 2 * exact_model * w.head(n).norm() * y.norm() +
                       2 * std::abs(w.head(n).dot(solved->change)) +
                       refined_step * gradient.cwiseAbs().dot(y.cwiseAbs());
  const double value = sign * gradient.dot(y);
  return std::isfinite(error) && std::isfinite(value) ? KnownRate{value, error} : seen;
}

KnownRate known_rate(const Walker& walker, const CurvePoint& at, const Matrix& dg_dx,
                     const Vector& dg_dlambda, Index j, const Direction& tangent) {
  return SwitchRates(walker, at).of(dg_dx, dg_dlambda, j, tangent);
}

double sure_rate(const Walker& walker, const CurvePoint& p, const Matrix& dg_dx,
                 const Vector& dg_dlambda, Index j) {
  const double rate = switch_rate(dg_dx, dg_dlambda, j, p.tangent);
  if (std::abs(rate) > one_place) return rate;
  const KnownRate known = known_rate(walker, p, dg_dx, dg_dlambda, j, p.tangent);
  return known.has_sign() ? known.value : 0;
}

double sure_rate(const Walker& walker, const Workspace::Switches& at, Index j,
                 const CurvePoint& p) {
  return sure_rate(walker, p, at.dg_dx, at.dg_dlambda, j);
}

/// A corrected point is off by the last correction that is not made, and by what is left of the equations, terms that
/// round, times the inverse of the bordered matrix: across a stiff member by as little as that is stiff.
double error_of_value(const Walker& walker, const CurvePoint& at, const Matrix& dg_dx,
                      const Vector& dg_dlambda, Index j) {
  Linearisation linear;
  if (walker.problem.structured() ||
      !linearise_densely(walker.problem, at.x, at.lambda, at.piece, linear))
    return infinity;
  const Index n = at.x.size();
  Matrix B(n + 1, n + 1);
  B << linear.dF_dx, linear.dF_dlambda, walker.weights.cwiseProduct(at.tangent.dx).transpose(),
      at.tangent.dlambda;
  Vector gradient(n + 1);
  gradient << dg_dx.row(j).transpose(), dg_dlambda[j];
  const double terms = (linear.dF_dx.cwiseAbs() * at.x.cwiseAbs() +
                        std::abs(at.lambda) * linear.dF_dlambda.cwiseAbs())
                           .lpNorm<Eigen::Infinity>();
  const double size = std::max({1.0, at.x.lpNorm<Eigen::Infinity>(), std::abs(at.lambda)});
  const Vector answers = Lu(B.transpose()).solve(gradient);
  const double error = refined_step * (size * gradient.lpNorm<1>() +
                                       std::max(1.0, terms) * answers.head(n).lpNorm<1>());
  return std::isfinite(error) ? error : infinity;
}

}  // namespace springfold::continuation
