#include "springfold/parameters/imperfection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::continuation {
namespace {

/// Terms of the form below this, relative to those that come after them, are zero: at located points they are
/// rounding of about 1e-10.
constexpr double vanishing_term = 1000 * promised_place;

double norm_of(const std::vector<Matrix>& form) {
  double sum = 0;
  for (const Matrix& part : form) sum += part.squaredNorm();
  return std::sqrt(sum);
}

bool has_lambda(const ReducedForm& form) {
  return form.by_lambda.norm() > vanishing_term * std::max(1.0, form.mixed.norm());
}

/// Component along a of A[t, t], over |a|^2: lambda - lambda0 = -1/2 of it on a path that turns back.
double bend_of(const ReducedForm& form, const Vector& t) {
  double sum = 0;
  for (Index i = 0; i < form.by_lambda.size(); ++i)
    sum += form.by_lambda[i] * t.dot(form.quadratic[static_cast<std::size_t>(i)] * t);
  return sum / form.by_lambda.squaredNorm();
}

/// Does lambda grow on the way to the point? At limit points their curvature tells it.
double towards_of(const ReducedForm& form) {
  const double rate = has_lambda(form) ? bend_of(form, form.tangent.dx) : form.tangent.dlambda;
  return rate < 0 ? -1 : 1;
}

bool is_quadratic(const ReducedForm& form) {
  return norm_of(form.quadratic) >
         vanishing_term * std::max(norm_of(form.cubic), form.mixed.norm());
}
bool is_cubic(const ReducedForm& form) {
  return norm_of(form.cubic) > vanishing_term * form.mixed.norm();
}

std::optional<ImperfectionLaw> law_of_one_mode(const ReducedForm& form, double gamma) {
  const double A = form.quadratic[0](0, 0), B = form.mixed(0, 0), D = form.curvature[0];
  const double towards = towards_of(form);
  if (has_lambda(form))  // a gamma m: the limit point moves as the parameter does
    return ImperfectionLaw{1, towards * gamma / form.by_lambda[0], 1};
  if (is_quadratic(form)) {
    // Folds of 1/2 (A xi^2 + 2 B xi l + D l^2) + gamma m: l^2 (B^2 - A D) = 2 A gamma m.
    const double crossing = B * B - A * D;
    if (!(crossing > 0)) return std::nullopt;
    return ImperfectionLaw{0.5, std::sqrt(2 * std::abs(A * gamma) / crossing),
                           A * gamma > 0 ? 1 : -1};
  }
  if (!is_cubic(form) || B == 0) return std::nullopt;
  // Folds of B xi l + 1/6 G xi^3 + gamma m: l = -G/(2 B) xi^2, xi^3 = 3 gamma m/G.
  const double G = form.cubic[0](0, 0);
  const double xi = std::cbrt(3 * gamma / G);
  return ImperfectionLaw{2.0 / 3, towards * G / (2 * B) * xi * xi, 0};
}

/// The leading terms for a unit imperfection, in units in which all coefficients are near one: xi = size u,
/// l = unit L, g = force times what is solved here.
class LeadingTerms {
 public:
  LeadingTerms(const ReducedForm& form, const Vector& gamma) : form_{form}, gamma_{gamma} {
    force_ = gamma.norm();
    if (has_lambda(form) || is_quadratic(form)) {
      exponent_ = has_lambda(form) ? 1 : 0.5;
      size_ = std::sqrt(force_ / norm_of(form.quadratic));
    } else {
      exponent_ = 2.0 / 3;
      size_ = std::cbrt(force_ / norm_of(form.cubic));
    }
    unit_ =
        has_lambda(form) ? force_ / form.by_lambda.norm() : force_ / (size_ * form.mixed.norm());
  }

  Index size() const { return gamma_.size(); }
  static bool symmetric() { return false; }
  double exponent() const { return exponent_; }
  double unit() const { return unit_; }

  bool residual(const Vector& u, double L, Vector& g) const {
    const Vector xi = size_ * u;
    g = gamma_;
    if (has_lambda(form_))
      g += form_.by_lambda * (unit_ * L) + quadratic(xi) / 2;
    else
      g += form_.mixed * xi * (unit_ * L);
    if (exponent_ == 0.5) g += quadratic(xi) / 2 + form_.curvature * (unit_ * unit_ * L * L / 2);
    if (exponent_ > 0.5 && exponent_ < 1) g += cubic_matrix(xi) * xi / 6;
    g /= force_;
    return true;
  }
  bool derivatives(const Vector& u, double L, Matrix& J, Vector& by_L) const {
    const Vector xi = size_ * u;
    if (has_lambda(form_)) {
      J = quadratic_matrix(xi);
      by_L = form_.by_lambda * unit_;
    } else {
      J = form_.mixed * (unit_ * L);
      by_L = form_.mixed * xi * unit_;
    }
    if (exponent_ == 0.5) {
      J += quadratic_matrix(xi);
      by_L += form_.curvature * (unit_ * unit_ * L);
    }
    if (exponent_ > 0.5 && exponent_ < 1) J += cubic_matrix(xi) / 2;
    J *= size_ / force_;
    by_L /= force_;
    return true;
  }

  /// The path of the perfect structure at L, on the unloaded side.
  Vector perfect(double L) const {
    const Vector& t = form_.tangent.dx;
    if (has_lambda(form_)) {  // a l + 1/2 A[xi, xi] = 0 along -t
      return -std::sqrt(std::max(0.0, -2 * unit_ * L / bend_of(form_, t))) / size_ * t;
    }
    return t * (unit_ * L / (form_.tangent.dlambda * size_));
  }

 private:
  Matrix quadratic_matrix(const Vector& xi) const {
    Matrix rows(size(), size());
    for (Index i = 0; i < size(); ++i)
      rows.row(i) = xi.transpose() * form_.quadratic[static_cast<std::size_t>(i)];
    return rows;
  }
  Vector quadratic(const Vector& xi) const { return quadratic_matrix(xi) * xi; }
  Matrix cubic_matrix(const Vector& xi) const {
    Matrix rows = Matrix::Zero(size(), size());
    for (Index i = 0; i < size(); ++i)
      for (Index j = 0; j < size(); ++j)
        rows.row(i) +=
            xi[j] * xi.transpose() * form_.cubic[static_cast<std::size_t>(i * size() + j)];
    return rows;
  }

  const ReducedForm& form_;
  const Vector& gamma_;
  double exponent_ = 1, force_ = 1, size_ = 1, unit_ = 1;
};

std::optional<Vector> solved_near(const LeadingTerms& terms, Vector u, double L) {
  Vector g, by_L;
  Matrix J;
  const bool found = settles(30, [&](double) -> std::optional<IterationStep> {
    terms.residual(u, L, g);
    terms.derivatives(u, L, J, by_L);
    const Vector step = -Lu(J).solve(g);
    if (!step.allFinite()) return std::nullopt;
    u += step;
    return IterationStep{step.norm(), refined_step * (1 + u.norm())};
  });
  return found ? std::optional(u) : std::nullopt;
}

/// The imperfect path from the unloaded side to its first critical point. @returns its L
std::optional<double> first_critical(const LeadingTerms& terms, double towards) {
  constexpr double far = 16;  // in units in which the critical point lies near 1
  const auto u = solved_near(terms, terms.perfect(-towards * far), -towards * far);
  if (!u) return std::nullopt;
  TraceOptions options;
  options.step.maximum *= 5;
  const auto rays = rays_from(terms, *u, -towards * far, {}, options);
  if (rays.rays.size() != 2) return std::nullopt;
  const bool second = towards * rays.rays[0].tangent.dlambda < 0;
  std::optional<CriticalStart> found;
  const std::vector<Event> range{
      {"range", [&](const CurvePoint& p) { return far - towards * p.lambda; }, EventAction::stop}};
  trace(terms, *u, -towards * far, rays.rays[second ? 1 : 0], range, options, {},
        [&](const Hit& hit) {
          if (hit.kind != HitKind::limit_point && hit.kind != HitKind::branch_point) return true;
          const bool folds = hit.kind == HitKind::limit_point;
          found = {.kind = folds ? CriticalKind::limit_point : CriticalKind::branch_point,
                   .x = hit.point.x,
                   .lambda = hit.point.lambda,
                   .corank = hit.multiplicity};
          return false;
        });
  if (!found) return std::nullopt;
  // Located on a step, solved for here.
  const Family alone{.at = [&](double) { return std::optional(ProblemView(terms)); }};
  const auto exact = polish_critical(alone, *found);
  return exact ? exact->lambda : found->lambda;
}

/// Entries that are rounding beside the others of their kind are zero: the form is known to about 1e-11.
void leave_out_rounding(double size, Eigen::Ref<Matrix> part) {
  part = (part.array().abs() > one_place * size).select(part, 0);
}

/// The form where dF/dx is symmetric, in the basis of the modes whose first one is the imperfection's: xi = R eta, and
/// the equations are turned as the unknowns are. Where a mirror keeps the structure and the imperfection, terms that
/// are odd in the second mode are rounding and are left out: its branch point on the imperfect path is one then, and no
/// narrow place.
/// @returns nothing where V and W span different spaces
std::optional<ReducedForm> turned_to(const ReducedForm& form, const Vector& gamma) {
  const Matrix turn = form.V.transpose() * form.W;
  const Index k = gamma.size();
  if (!((turn * turn.transpose() - Matrix::Identity(k, k)).norm() <= vanishing_term))
    return std::nullopt;
  const Vector along = (turn * gamma).normalized();
  Matrix R(2, 2);
  R << along[0], -along[1], along[1], along[0];
  const Matrix P = R.transpose() * turn;
  ReducedForm turned = form;
  turned.V = form.V * R;
  turned.W = form.W * P.transpose();
  turned.by_lambda = P * form.by_lambda;
  turned.curvature = P * form.curvature;
  turned.mixed = P * form.mixed * R;
  turned.tangent.dx = R.transpose() * form.tangent.dx;
  const auto at = [k](Index i, Index j) { return static_cast<std::size_t>(i * k + j); };
  for (Index i = 0; i < k; ++i) {
    Matrix A = Matrix::Zero(k, k);
    for (Index e = 0; e < k; ++e) A += P(i, e) * form.quadratic[static_cast<std::size_t>(e)];
    turned.quadratic[static_cast<std::size_t>(i)] = R.transpose() * A * R;
    for (Index j = 0; j < k; ++j) {
      Matrix G = Matrix::Zero(k, k);
      for (Index e = 0; e < k; ++e)
        for (Index u = 0; u < k; ++u) G += P(i, e) * R(u, j) * form.cubic[at(e, u)];
      turned.cubic[at(i, j)] = R.transpose() * G * R;
    }
  }
  leave_out_rounding(turned.mixed.norm(), turned.mixed);
  const double quadratic = norm_of(turned.quadratic), cubic = norm_of(turned.cubic);
  for (Matrix& A : turned.quadratic) leave_out_rounding(quadratic, A);
  for (Matrix& G : turned.cubic) leave_out_rounding(cubic, G);
  return turned;
}

std::optional<ImperfectionLaw> law_of_two_modes(const ReducedForm& form, const Vector& gamma) {
  const bool by_path = !has_lambda(form) && !is_quadratic(form);
  if (by_path && !is_cubic(form)) return std::nullopt;
  if (has_lambda(form) && !is_quadratic(form)) return std::nullopt;
  if (!has_lambda(form) && (form.tangent.dlambda == 0 || form.mixed.norm() == 0))
    return std::nullopt;
  const double towards = towards_of(form);
  std::optional<ImperfectionLaw> law;
  for (const int sign : {1, -1}) {
    const Vector signed_gamma = sign * gamma;
    const LeadingTerms terms(form, signed_gamma);
    const auto L = first_critical(terms, towards);
    if (!L) continue;
    const ImperfectionLaw one{terms.exponent(), -towards * *L * terms.unit(), sign};
    if (by_path) {  // odd in xi: the same with the other sign
      law = one;
      law->sign = 0;
      break;
    }
    // As in a symmetric problem, both signs may lose the same.
    if (law &&
        std::abs(one.coefficient - law->coefficient) <= vanishing_term * std::abs(law->coefficient))
      law->sign = 0;
    else if (!law || one.coefficient > law->coefficient)
      law = one;
  }
  return law;
}

}  // namespace

bool is_symmetric_point(const ReducedForm& form) {
  return form.by_lambda.size() == 1 && !has_lambda(form) && !is_quadratic(form);
}

std::optional<ImperfectionLaw> imperfection_law(const ReducedForm& form, const Vector& gamma) {
  if (!(gamma.norm() > 0)) return std::nullopt;
  if (gamma.size() == 1) return law_of_one_mode(form, gamma[0]);
  if (gamma.size() != 2) return std::nullopt;
  if (const auto turned = turned_to(form, gamma))
    return law_of_two_modes(*turned, gamma.norm() * Vector::Unit(2, 0));
  return law_of_two_modes(form, gamma);
}

namespace {

/// Laws for one sign are written for m > 0; of the others, which hold for both, the largest entry is positive.
bool is_turned(const ImperfectionLaw& law, const Vector& shape) {
  if (law.sign != 0) return law.sign < 0;
  Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return shape[largest] < 0;
}

}  // namespace

std::optional<WorstImperfection> worst_imperfection(const ReducedForm& form, const Matrix& gammas) {
  const Svd svd = jacobi_svd(gammas, SingularVectors::thin, SingularVectors::thin);
  const Index rank = std::min<Index>(svd.rank, gammas.rows());
  if (rank == 0 || gammas.rows() > 2) return std::nullopt;
  std::optional<WorstImperfection> worst;
  const auto attempt = [&](double angle) -> double {
    Vector c = std::cos(angle) * svd.V.col(0);
    if (rank == 2) c += std::sin(angle) * svd.V.col(1);
    const auto law = imperfection_law(form, gammas * c);
    if (!law) return -infinity;
    if (!worst || law->coefficient > worst->law.coefficient)
      worst = {*law, is_turned(*law, c) ? Vector(-c) : c};
    return law->coefficient;
  };
  if (rank == 1) {
    const double here = attempt(0);
    if (here < 0) attempt(std::numbers::pi);
    return worst;
  }
  // Both signs are tried at every angle: half a turn covers all shapes. Then the best one is refined.
  constexpr int angles = 36;
  double best = 0, most = -infinity;
  for (int i = 0; i < angles; ++i) {
    const double angle = std::numbers::pi * i / angles;
    const double value = attempt(angle);
    if (value > most) best = angle;
    most = std::max(most, value);
  }
  // Golden section: at a smooth maximum the coefficient has twice the digits of the angle.
  constexpr double golden = std::numbers::phi - 1;
  double low = best - std::numbers::pi / angles, high = best + std::numbers::pi / angles;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = attempt(a), at_b = attempt(b);
  while (high - low > root_of_rounding) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - golden * (high - low);
      at_a = attempt(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + golden * (high - low);
      at_b = attempt(b);
    }
  }
  return worst;
}

}  // namespace springfold::continuation
