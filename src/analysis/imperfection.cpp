#include "imperfection.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/undefined.hpp"

namespace springfold::analysis {
namespace {

/// A rate below this share of a law's coefficient is rounding.
constexpr double no_rate = 1e-9;

/// The branch point to rounding.
continuation::CriticalStart polished(const CaseCurves& curves, const Member& base,
                                     const SpecialPoint& point) {
  const bool is_branch_point = point.kind == EventKind::branch_point;
  const auto& hit = point.hit;
  continuation::CriticalStart start{.kind = is_branch_point
                                                ? continuation::CriticalKind::branch_point
                                                : continuation::CriticalKind::limit_point,
                                    .x = hit.point.x,
                                    .lambda = hit.point.lambda,
                                    .mu = base.mu,
                                    .piece = hit.point.piece,
                                    .corank = hit.multiplicity};
  if (const auto exact = polish_critical(curves.family(), start)) {
    start.x = exact->x;
    start.lambda = exact->lambda;
  }
  return start;
}

}  // namespace

bool PointLaws::enter(const CaseCurves& curves, double rate) {
  rates_.push_back(rate);
  squares_.push_back(false);
  Vector gamma;
  const Member& base = curves.base();
  lambda_scale_ = base.setup.lambda_scale;
  const bool bends = point_->kind == EventKind::branch_point;
  if ((bends || point_->kind == EventKind::limit_point) && !tried_)
    form_ =
        reduced_form(curves.family(), polished(curves, base, *point_), point_->hit.point.tangent);
  tried_ = true;
  if (bends && form_) {
    const auto part = imperfection_part(curves.family(), polished(curves, base, *point_), *form_);
    if (part) gamma = *part / curves.scale();
  }
  // At a branch point the rate says nothing as long as the part that breaks the branch is not known to be zero.
  known_.push_back(!bends || gamma.size() > 0);
  gammas_.push_back(gamma);
  laws_.push_back(breaks(laws_.size()) ? imperfection_law(*form_, gamma) : std::nullopt);
  const bool is_kept = bends && form_ && known_.back() && !breaks(laws_.size() - 1);
  return !is_kept || enter_second_order(curves);
}

/// With e = m^2 in the laws of (o): where branches cross the load falls by C |m| about what the branch point would do,
/// with both signs; the pitchfork's |m|^(4/3) comes behind a rate, where there is one.
bool PointLaws::enter_second_order(const CaseCurves& curves) {
  const auto force = second_order_force(curves.family(), polished(curves, curves.base(), *point_));
  if (!force || force->lpNorm<Eigen::Infinity>() == 0) return true;
  const Vector gamma = form_->W.transpose() * *force / (curves.scale() * curves.scale());
  const double rate = rates_.back() / lambda_scale_;
  auto law = gamma.size() == 1 ? imperfection_law(*form_, gamma) : std::nullopt;
  const bool is_pitchfork = is_symmetric_point(*form_);
  if (is_pitchfork && law && std::abs(rate) > no_rate * std::abs(law->coefficient)) return true;
  squares_.back() = true;
  if (law && is_pitchfork) {
    law->exponent *= 2;
  } else if (law && law->sign > 0) {
    const double falls = towards() * rate;
    const bool is_even = std::abs(rate) <= no_rate * law->coefficient;
    law = {2 * law->exponent, law->coefficient + std::abs(rate),
           is_even ? 0 : (falls < 0 ? 1 : -1)};
  } else {
    law.reset();  // of any sign the bend is only smoothed, or more than one mode vanishes
  }
  laws_.back() = law;
  return is_pitchfork;
}
bool PointLaws::breaks(std::size_t i) const {
  return gammas_[i].size() > 0 && gammas_[i].norm() > 0;
}

bool PointLaws::lacks_law() const {
  if (point_->kind != EventKind::branch_point) return false;
  for (std::size_t i = 0; i < rates_.size(); ++i)
    if (!known_[i] || ((breaks(i) || squares_[i]) && !laws_[i])) return true;
  return false;
}

std::vector<double> PointLaws::values(bool with_worst) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < rates_.size(); ++i) {
    if (!breaks(i) && !squares_[i]) {
      const bool known = known_[i] && !std::isnan(rates_[i]);
      values.insert(values.end(), {known ? 1 : undefined, rates_[i], known ? 0 : undefined});
      continue;
    }
    if (const auto& law = laws_[i])
      values.insert(values.end(), {law->exponent, law->coefficient * lambda_scale_,
                                   static_cast<double>(law->sign)});
    else
      values.insert(values.end(), 3, undefined);
  }
  if (with_worst) put_worst(values);
  return values;
}

/// 1 if lambda grows on the way to the point, -1 if it falls.
double PointLaws::towards() const {
  if (point_->kind == EventKind::limit_point && form_ && form_->by_lambda.size() == 1) {
    const auto law = imperfection_law(*form_, Vector::Ones(1));
    if (law) return law->coefficient * form_->by_lambda[0] < 0 ? -1 : 1;
  }
  return point_->hit.point.tangent.dlambda < 0 ? -1 : 1;
}

/// Imperfections that break the branch outweigh all others; without any, the gradient of lambda counts.
void PointLaws::put_worst(std::vector<double>& values) const {
  const std::size_t count = rates_.size(), at = values.size();
  values.resize(at + 2 + count, undefined);
  if (std::find(known_.begin(), known_.end(), false) != known_.end()) return;
  Index modes = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (breaks(i)) modes = gammas_[i].size();
  Matrix gammas = Matrix::Zero(modes, static_cast<Index>(count));
  double slope = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (breaks(i)) gammas.col(static_cast<Index>(i)) = gammas_[i];
    slope = std::hypot(slope, rates_[i]);
  }
  if (modes > 0) {
    const auto worst = worst_imperfection(*form_, gammas);
    if (!worst) return;
    values[at] = worst->law.exponent;
    values[at + 1] = worst->law.coefficient * lambda_scale_;
    for (std::size_t i = 0; i < count; ++i)
      values[at + 2 + i] = worst->shape[static_cast<Index>(i)];
    return;
  }
  if (!(slope > 0) || std::find(squares_.begin(), squares_.end(), true) != squares_.end()) return;
  // A load that is reached from below is lowered down the gradient, one from above up the gradient; C of the law
  // is what is lost, as for all other exponents.
  const double way = towards();
  values[at] = 1;
  values[at + 1] = slope;
  for (std::size_t i = 0; i < count; ++i) values[at + 2 + i] = -way * rates_[i] / slope;
}

std::vector<std::string> law_columns(const std::vector<std::string>& parameters, bool with_worst) {
  std::vector<std::string> names;
  for (const std::string& name : parameters)
    for (const char* what : {"exponent", "coefficient", "sign"})
      names.push_back(std::string(what) + "(" + name + ")");
  if (!with_worst) return names;
  names.insert(names.end(), {"worst.exponent", "worst.coefficient"});
  for (const std::string& name : parameters) names.push_back("worst.shape(" + name + ")");
  return names;
}

}  // namespace springfold::analysis
