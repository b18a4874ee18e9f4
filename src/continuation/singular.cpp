#include "singular.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/continuation/branch_point.hpp"
#include "springfold/continuation/locate.hpp"
#include "zeros.hpp"

namespace springfold::continuation {
namespace {

constexpr double vertical = 1e-10;   // lambda does not change along the curve at all
constexpr double together = 1e-5;    // arc length within which zeros are examined as one point
constexpr double resolution = 1e-6;  // of features of one function
constexpr double rounding = 1e-11;   // of a function against its size

double rate_of(const CurvePoint& p) { return p.tangent.dlambda; }

/// A zero of a watched function, as a point of the curve.
struct Zero {
  CurvePoint point{};
  double before = 0, after = 0;
  bool touches = false;
};

/// One step and the samples on it.
struct Step {
  const Walker& walker;
  const CurvePoint& from;
  double h = 0;
};

/// All zeros of a function of the curve's point on the step.
/// @param noise  values below this are not told from zero
bool zeros_of(const Step& step,
              const std::function<std::optional<double>(const CurvePoint&)>& value,
              const std::vector<double>& values, double noise, std::vector<Zero>& zeros) {
  double scale = 0;
  for (const double v : values) scale = std::max(scale, std::abs(v));
  const auto f = [&](double ds) -> std::optional<double> {
    const auto point = point_at(step.walker, step.from, ds);
    return point ? value(*point) : std::nullopt;
  };
  const ZeroSearch search = find_zeros(f, 0, step.h, std::max(noise, rounding * scale), resolution);
  for (const ZeroOf& zero : search.zeros) {
    if (!(zero.at > 0)) continue;  // belongs to the step before
    auto point = point_at(step.walker, step.from, zero.at);
    for (const double nudge : {1e-9, 1e-8, 1e-7})  // singular to rounding exactly there
      if (!point) point = point_at(step.walker, step.from, zero.at + nudge * step.h);
    if (!point) return false;
    // A change of sign without a zero: the curve was lost in between.
    const auto least = value(*point);
    if (!zero.touches && (!least || std::abs(*least) > 1e-4 * scale)) return false;
    zeros.push_back({std::move(*point), zero.before, zero.after, zero.touches});
  }
  return search.resolved;
}

Hit hit_at(const Step& step, HitKind kind, const char* name, CurvePoint point, double before,
           double after, int multiplicity = 1) {
  Hit hit{.kind = kind, .name = name};
  hit.point = std::move(point);
  hit.point.negative.reset();
  const Direction offset{hit.point.x - step.from.x, hit.point.lambda - step.from.lambda};
  hit.point.s = step.from.s + metric_product(step.walker.weights, offset, step.from.tangent);
  hit.multiplicity = multiplicity;
  hit.s_before = std::min(step.from.s + before, hit.point.s);
  hit.s_after = std::max(step.from.s + after, hit.point.s);
  return hit;
}

/// The branch point nearby with this many zero eigenvalues, if there is one.
std::optional<CurvePoint> branch_point_near(const Step& step, const CurvePoint& near, int m) {
  auto point =
      m == 1 ? refine_branch_point(step.walker, near) : refine_multiple_point(step.walker, near, m);
  if (!point) return std::nullopt;
  const Direction moved{point->x - near.x, point->lambda - near.lambda};
  if (metric_product(step.walker.weights, moved, moved) > together * together) return std::nullopt;
  return point;
}

/// What happens at zeros that lie together: turns of lambda and zeros of eigenvalues.
bool explain(const Step& step, const std::vector<Zero>& turns, const std::vector<Zero>& eigenvalues,
             SingularPoints& result) {
  const Zero& first = turns.empty() ? eigenvalues.front() : turns.front();
  const double before = first.before, after = first.after;
  const auto add = [&](HitKind kind, const char* name, const CurvePoint& point, int m = 1) {
    result.hits.push_back(hit_at(step, kind, name, point, before, after, m));
    return true;
  };
  const auto crossing = std::count_if(eigenvalues.begin(), eigenvalues.end(),
                                      [](const Zero& z) { return !z.touches; });
  const auto turning =
      std::count_if(turns.begin(), turns.end(), [](const Zero& z) { return !z.touches; });
  const int m = std::max<int>(1, static_cast<int>(eigenvalues.size()));
  // A fold: lambda turns and one eigenvalue passes zero.
  if (turning == 1 && turns.size() == 1 && eigenvalues.size() <= 1 &&
      (crossing == 1 || !step.walker.problem.symmetric() || !step.walker.options.branch_points))
    return add(HitKind::limit_point, "limit point", turns.front().point);
  // The branch turns at a branch point, or passes one.
  if (turning == 1 || (turns.empty() && crossing > 0)) {
    for (int k = m; k <= m + (turning == 1 ? 1 : 0); ++k)
      if (const auto point = branch_point_near(step, first.point, k))
        return add(HitKind::branch_point, "branch point", *point,
                   std::max(k, corank_at(step.walker, *point, 1e-9)));
    if (m == 1 && turns.empty()) return add(HitKind::branch_point, "branch point", first.point);
    result.unexplained = static_cast<int>(std::max<long>(1, crossing));
    return false;
  }
  if (turning == 0 && crossing == 0) return add(HitKind::touch, "touch", first.point, m);
  result.unexplained = static_cast<int>(std::max<long>(1, crossing));
  return false;
}

}  // namespace

SingularPoints singular_points(const Walker& walker,
                               const std::vector<const CurvePoint*>& samples) {
  SingularPoints result;
  const Step step{walker, *samples.front(), samples.back()->s - samples.front()->s};
  std::vector<Zero> turns, eigenvalues;
  bool clear = true;

  std::vector<double> rates;
  for (const CurvePoint* p : samples) rates.push_back(rate_of(*p));
  const bool moves =
      std::any_of(rates.begin(), rates.end(), [](double r) { return std::abs(r) > vertical; });
  if (walker.options.limit_points && moves && within_reach(rates))
    clear = zeros_of(
        step, [](const CurvePoint& p) { return std::optional<double>(rate_of(p)); }, rates, 1e-14,
        turns);

  if (walker.options.branch_points && walker.problem.symmetric()) {
    std::vector<Vector> spectra;
    for (const CurvePoint* p : samples)
      if (auto spectrum = spectrum_at(walker, *p)) spectra.push_back(std::move(*spectrum));
    for (Index k = 0; spectra.size() == samples.size() && k < spectra.front().size(); ++k) {
      std::vector<double> values;
      for (const Vector& spectrum : spectra) values.push_back(spectrum[k]);
      if (!within_reach(values)) continue;
      const auto value = [&walker, k](const CurvePoint& p) -> std::optional<double> {
        const auto spectrum = spectrum_at(walker, p);
        return spectrum ? std::optional<double>((*spectrum)[k]) : std::nullopt;
      };
      const double noise = 1e-14 * spectra.front().cwiseAbs().maxCoeff();
      clear = zeros_of(step, value, values, noise, eigenvalues) && clear;
    }
  }
  if (!clear) {
    result.doubt = "special points too close together";
    return result;
  }

  const auto by_place = [](const Zero& a, const Zero& b) { return a.point.s < b.point.s; };
  std::stable_sort(turns.begin(), turns.end(), by_place);
  std::stable_sort(eigenvalues.begin(), eigenvalues.end(), by_place);
  while (!turns.empty() || !eigenvalues.empty()) {
    double first = std::numeric_limits<double>::infinity();
    if (!turns.empty()) first = turns.front().point.s;
    if (!eigenvalues.empty()) first = std::min(first, eigenvalues.front().point.s);
    const auto take = [first](std::vector<Zero>& list) {
      std::vector<Zero> taken;
      while (!list.empty() && list.front().point.s <= first + together) {
        taken.push_back(std::move(list.front()));
        list.erase(list.begin());
      }
      return taken;
    };
    const std::vector<Zero> here_turns = take(turns), here_eigenvalues = take(eigenvalues);
    if (explain(step, here_turns, here_eigenvalues, result)) continue;
    result.doubt = "tangent and eigenvalues do not fit together";
    return result;
  }
  return result;
}

}  // namespace springfold::continuation
