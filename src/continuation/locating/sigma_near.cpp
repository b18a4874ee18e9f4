#include "continuation/locating/sigma_near.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::continuation {
namespace {

Matrix squared(const Vector& list) {
  const auto m = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(list.size()))));
  return list.reshaped(m, m);
}

/// Distances from t at which Sigma, moving on as it does there, is singular.
Eigen::VectorXcd distances_from(const SigmaNear& near, double t) {
  const Matrix share = Lu(near.slope(t)).solve(-near.at(t));
  return share.allFinite() ? eigenvalues(share) : Eigen::VectorXcd{};
}

/// One mode's zero from near it, and how far rounding moves it: the mode's entry over its rate.
std::optional<ZeroOfMode> followed(const SigmaNear& near, double t) {
  constexpr int most_steps = 20;
  const double smallest = few_roundings * (near.entries.b - near.entries.a);
  for (int i = 0; i < most_steps; ++i) {
    const Eigen::VectorXcd distances = distances_from(near, t);
    if (distances.size() == 0) return std::nullopt;
    const auto nearest =
        std::min_element(distances.begin(), distances.end(),
                         [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
    const double step = nearest->real();
    t += step;
    if (t < near.entries.a || t > near.entries.b) return std::nullopt;
    const Svd svd = jacobi_svd(near.at(t), SingularVectors::full, SingularVectors::full);
    const Index last = svd.values.size() - 1;
    const double rate = std::abs(svd.U.col(last).dot(near.slope(t) * svd.V.col(last)));
    const double off = near.nothing / rate;
    if (std::abs(step) <= std::max(smallest, off)) return ZeroOfMode{t, off};
  }
  return std::nullopt;
}

}  // namespace

Matrix SigmaNear::at(double t) const { return squared(entries(t)); }
Matrix SigmaNear::slope(double t) const { return squared(entries.slope(t)); }

std::optional<SigmaNear> sigma_near(const TestedStep& arc, double t, double length, Index m) {
  const auto curve = curve_near(arc, t, length);
  if (!curve) return std::nullopt;
  const Index n = arc.from().x.size();
  CurvePoint centre = arc.from();
  centre.x = (*curve)(t).head(n);
  centre.lambda = (*curve)(t)[n];
  const auto E = arc.matrix(centre);
  if (!E) return std::nullopt;
  const Borders borders = borders_of(*E, m);
  const auto entries_at = [&](double ds) -> std::optional<Vector> {
    const auto entries = arc.sigma(ds, borders);
    return entries ? std::optional<Vector>(entries->reshaped()) : std::nullopt;
  };
  auto entries = interpolate(entries_at, curve->a, curve->b);
  if (!entries) return std::nullopt;
  SigmaNear near{*curve, std::move(*entries)};
  for (const double t_between : near.entries.checks()) {
    const auto there = entries_at(t_between);
    if (!there) return std::nullopt;
    near.error = std::max(near.error, (*there - near.entries(t_between)).norm());
  }
  near.nothing = 8 * sigma_noise(*E, borders) +
                 residual_level * near.entries.values.cwiseAbs().maxCoeff() + 3 * near.error;
  return near;
}

std::vector<ZeroOfMode> modes_near(const SigmaNear& near, double t, double reach) {
  constexpr double beyond_doubt = 30;
  std::vector<ZeroOfMode> found;
  for (const auto& distance : distances_from(near, t)) {
    const double place = t + distance.real();
    if (std::abs(distance) > reach || place < near.entries.a || place > near.entries.b) continue;
    const auto zero = followed(near, place);
    if (!zero || !(std::abs(distance.imag()) <= zero->off)) return {};
    found.push_back(*zero);
  }
  std::sort(found.begin(), found.end(),
            [](const ZeroOfMode& a, const ZeroOfMode& b) { return a.at < b.at; });
  for (std::size_t i = 1; i < found.size(); ++i) {
    const double doubt = beyond_doubt * (found[i].off + found[i - 1].off);
    if (!(found[i].at - found[i - 1].at > std::max(doubt, promised_place))) return {};
  }
  return found;
}

}  // namespace springfold::continuation
