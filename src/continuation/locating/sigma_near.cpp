#include "continuation/locating/sigma_near.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

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

/// Modes whose zeros are nearer to each other than this many of their errors are not told apart.
constexpr double beyond_doubt = 30;

/// Slowest of the m modes that are nearest to zero, per unit of arc length.
double slowest_rate(const SigmaNear& near, double t, Index m) {
  const Svd svd = jacobi_svd(near.at(t), SingularVectors::full, SingularVectors::full);
  const Matrix rates = svd.U.rightCols(m).transpose() * near.slope(t) * svd.V.rightCols(m);
  return singular_values(rates).minCoeff();
}

/// The modes that vanish at t, for all that rounding says: it moves their zeros by an entry over its rate.
/// @param distances  from t, in order of their sizes
std::optional<ZeroOfMode> zero_at(const SigmaNear& near, double t,
                                  const std::vector<std::complex<double>>& distances) {
  for (Index m = 1; m <= std::ssize(distances); ++m) {
    const double off = near.nothing / slowest_rate(near, t, m);
    const double one = std::max(2 * beyond_doubt * off, promised_place);
    if (!std::isfinite(off)) return std::nullopt;
    const auto next = static_cast<std::size_t>(m);
    if (next < distances.size() && std::abs(distances[next]) <= one) continue;
    double mean = 0;
    for (std::size_t i = 0; i < next; ++i) {
      if (!(std::abs(distances[i].imag()) <= one)) return std::nullopt;
      mean += distances[i].real() / static_cast<double>(m);
    }
    return ZeroOfMode{t + mean, off, m};
  }
  return std::nullopt;
}

/// A zero of one mode, or of several at one place, from near it.
std::optional<ZeroOfMode> followed(const SigmaNear& near, double t) {
  constexpr int most_steps = 20;
  const double smallest = few_roundings * (near.entries.b - near.entries.a);
  for (int i = 0; i < most_steps; ++i) {
    const Eigen::VectorXcd found = distances_from(near, t);
    if (found.size() == 0) return std::nullopt;
    std::vector<std::complex<double>> distances(found.begin(), found.end());
    std::sort(distances.begin(), distances.end(),
              [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
    const double step = distances.front().real();
    t += step;
    if (t < near.entries.a || t > near.entries.b) return std::nullopt;
    for (auto& distance : distances) distance -= step;
    const auto zero = zero_at(near, t, distances);
    if (zero && std::abs(step) <= std::max(smallest, zero->off)) return zero;
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
  std::vector<ZeroOfMode> found;
  for (const auto& distance : distances_from(near, t)) {
    const double place = t + distance.real();
    if (std::abs(distance) > reach || place < near.entries.a || place > near.entries.b) continue;
    const auto zero = followed(near, place);
    if (!zero || std::abs(zero->at - t) > reach) return {};
    found.push_back(*zero);
  }
  std::sort(found.begin(), found.end(),
            [](const ZeroOfMode& a, const ZeroOfMode& b) { return a.at < b.at; });
  std::vector<ZeroOfMode> places;
  for (std::size_t i = 0; i < found.size(); i += static_cast<std::size_t>(found[i].m)) {
    const std::size_t next = i + static_cast<std::size_t>(found[i].m);
    if (next > found.size() || found[next - 1].m != found[i].m) return {};
    const double off = std::max(found[i].off, found[next - 1].off);
    if (i > 0) {
      const double doubt = beyond_doubt * (off + found[i - 1].off);
      if (!(found[i].at - found[i - 1].at > std::max(doubt, promised_place))) return {};
    }
    places.push_back({0.5 * (found[i].at + found[next - 1].at), off, found[i].m});
  }
  return places;
}

}  // namespace springfold::continuation
