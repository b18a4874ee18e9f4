#include "singular.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "springfold/continuation/branch_point.hpp"
#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {
namespace {

constexpr double vertical = 1e-10;  // lambda does not change along the curve at all
constexpr double together = 1e-5;   // arc length within which zeros are examined as one point

double rate_of(const CurvePoint& p) { return p.tangent.dlambda; }

bool crosses(double a, double b) { return (a < 0 && b >= 0) || (a > 0 && b <= 0); }

/// Samples of one step with what is watched on them.
struct Watched {
  const Walker& walker;
  const CurvePoint& from;
  std::vector<double> ds{};       ///< step length of every sample
  std::vector<double> rates{};    ///< tangent's lambda-component
  std::vector<Vector> spectra{};  ///< eigenvalues, if the problem is symmetric
};

struct Zero {
  CurvePoint point{};
  double before = 0, after = 0;
};

/// Extremum of a sampled function that may reach zero without changing sign between the samples:
/// the parabola through three of them comes close.
bool may_touch(double f0, double fm, double f1) {
  if ((f0 < 0) != (fm < 0) || (f0 < 0) != (f1 < 0)) return false;
  const double a = 2 * (f0 + f1) - 4 * fm, b = 4 * fm - 3 * f0 - f1;
  if (a == 0) return false;
  const double t = -b / (2 * a);
  if (!(t > 0 && t < 1)) return false;
  const double extremum = f0 + t * (b + t * a);
  const double least = std::min(std::abs(f0), std::abs(f1));
  return (extremum < 0) != (f0 < 0) || std::abs(extremum) < 0.1 * least;
}

/// Stationary point of f near ds by the quartic through five points: error O(h^4).
std::optional<double> stationary(const std::function<std::optional<double>(double)>& f, double ds,
                                 double h) {
  double v[5];
  for (int i = 0; i < 5; ++i) {
    const auto value = f(ds + (i - 2) * h);
    if (!value) return std::nullopt;
    v[i] = *value;
  }
  const double d1 = (v[0] - 8 * v[1] + 8 * v[3] - v[4]) / 12,
               d2 = (-v[0] + 16 * v[1] - 30 * v[2] + 16 * v[3] - v[4]) / 12;
  const double d3 = (-v[0] + 2 * v[1] - 2 * v[3] + v[4]) / 2,
               d4 = v[0] - 4 * v[1] + 6 * v[2] - 4 * v[3] + v[4];
  double t = 0;
  for (int i = 0; i < 20; ++i)
    t -= (d1 + t * (d2 + t * (d3 / 2 + t * d4 / 6))) / (d2 + t * (d3 + t * d4 / 2));
  return std::abs(t) < 2 ? std::optional<double>(ds + t * h) : std::nullopt;
}

enum class TouchKind { none, touches, crosses_twice };

struct Touch {
  TouchKind kind = TouchKind::none;
  double ds = 0;
};

/// Minimum of |f| on a step on which f keeps its sign at the samples.
Touch find_touch(const std::function<std::optional<double>(double)>& f, double h, double f0) {
  const auto size = [&](double ds) {
    const auto value = f(ds);
    return value ? (f0 < 0 ? -*value : *value) : 0.0;
  };
  std::uintmax_t most = 60;
  const auto [ds, least] = boost::math::tools::brent_find_minima(size, 0.0, h, 40, most);
  const double scale = std::max(size(0), size(h));
  if (least < -1e-11 * scale) return {TouchKind::crosses_twice, ds};
  if (least > 1e-10 * scale) return {};
  const auto refined = stationary(f, ds, std::min(2e-3, 0.1 * h));
  return {TouchKind::touches, refined ? *refined : ds};
}

Hit hit_at(const Watched& w, HitKind kind, const char* name, CurvePoint point, double before,
           double after, int multiplicity = 1) {
  Hit hit{.kind = kind, .name = name};
  hit.point = std::move(point);
  hit.point.negative.reset();
  const Direction offset{hit.point.x - w.from.x, hit.point.lambda - w.from.lambda};
  hit.point.s = w.from.s + metric_product(w.walker.weights, offset, w.from.tangent);
  hit.multiplicity = multiplicity;
  hit.s_before = std::min(w.from.s + before, hit.point.s);
  hit.s_after = std::max(w.from.s + after, hit.point.s);
  return hit;
}

std::optional<CurvePoint> refine(const Walker& walker, const CurvePoint& near, int multiplicity) {
  return multiplicity == 1 ? refine_branch_point(walker, near)
                           : refine_multiple_point(walker, near, multiplicity);
}

/// Zeros of the tangent's lambda-component between the samples.
bool find_turns(const Watched& w, std::vector<Zero>& turns) {
  for (std::size_t i = 0; i + 1 < w.ds.size(); ++i) {
    if (std::max(std::abs(w.rates[i]), std::abs(w.rates[i + 1])) <= vertical) continue;
    if (!crosses(w.rates[i], w.rates[i + 1])) continue;
    const auto located = locate(w.walker, w.from, w.ds[i], w.ds[i + 1], rate_of);
    if (!located) return false;
    turns.push_back({located->point, located->before, located->after});
  }
  return true;
}

/// Zeros of all eigenvalues between the samples.
bool find_eigenvalue_zeros(const Watched& w, std::vector<Zero>& zeros) {
  for (std::size_t i = 0; i + 1 < w.spectra.size(); ++i)
    for (Index k = 0; k < w.spectra[i].size(); ++k) {
      if (!crosses(w.spectra[i][k], w.spectra[i + 1][k])) continue;
      const auto zero = eigenvalue_zero(w.walker, w.from, w.ds[i], w.ds[i + 1], k);
      if (!zero) return false;
      zeros.push_back({zero->point, zero->before, zero->after});
    }
  std::stable_sort(zeros.begin(), zeros.end(),
                   [](const Zero& a, const Zero& b) { return a.point.s < b.point.s; });
  return true;
}

/// A turn without an eigenvalue that changes sign: the branch turns at a branch point.
bool add_turning_branch_point(const Watched& w, const Zero& turn, SingularPoints& result) {
  for (const int corank : {1, 2, 3}) {
    const auto point = refine(w.walker, turn.point, corank);
    if (!point) continue;
    const Direction moved{point->x - turn.point.x, point->lambda - turn.point.lambda};
    if (metric_product(w.walker.weights, moved, moved) > together * together) continue;
    result.hits.push_back(hit_at(w, HitKind::branch_point, "branch point", *point, turn.before,
                                 turn.after, std::max(corank, corank_at(w.walker, *point, 1e-9))));
    return true;
  }
  return false;
}

/// Eigenvalue zeros without a turn: branch points, those close together as one of higher
/// multiplicity if such a point exists, else one by one.
bool add_branch_points(const Watched& w, std::vector<Zero> zeros, SingularPoints& result) {
  while (!zeros.empty()) {
    const auto end = std::find_if(zeros.begin(), zeros.end(), [&](const Zero& z) {
      return z.point.s - zeros.front().point.s > together;
    });
    const auto m = static_cast<int>(end - zeros.begin());
    if (m > 1) {
      const auto point = refine(w.walker, zeros.front().point, m);
      if (!point) {
        result.unexplained = m;
        return false;
      }
      result.hits.push_back(hit_at(w, HitKind::branch_point, "branch point", *point,
                                   zeros.front().before, (end - 1)->after, m));
    } else {
      const auto point = refine(w.walker, zeros.front().point, 1);
      result.hits.push_back(hit_at(w, HitKind::branch_point, "branch point",
                                   point ? *point : zeros.front().point, zeros.front().before,
                                   zeros.front().after));
    }
    zeros.erase(zeros.begin(), end);
  }
  return true;
}

/// Looks for zeros without change of sign of one watched function.
bool add_touch(const Watched& w, const std::vector<double>& values,
               const std::function<double(const CurvePoint&)>& value, SingularPoints& result) {
  if (values.size() != 3 || !may_touch(values[0], values[1], values[2])) return true;
  const auto f = [&](double ds) -> std::optional<double> {
    const auto point = point_at(w.walker, w.from, ds);
    return point ? std::optional<double>(value(*point)) : std::nullopt;
  };
  const Touch touch = find_touch(f, w.ds.back(), values[0]);
  if (touch.kind == TouchKind::none) return true;
  if (touch.kind == TouchKind::crosses_twice) return false;
  const auto point = point_at(w.walker, w.from, touch.ds);
  if (!point) return false;
  for (const Hit& hit : result.hits)
    if (std::abs(hit.point.s - point->s) <= together) return true;  // known by another name
  result.hits.push_back(hit_at(w, HitKind::touch, "touch", *point, 0, w.ds.back()));
  return true;
}

Watched watch(const Walker& walker, const std::vector<const CurvePoint*>& samples) {
  Watched w{walker, *samples.front()};
  for (const CurvePoint* sample : samples) {
    w.ds.push_back(sample->s - samples.front()->s);
    w.rates.push_back(rate_of(*sample));
    const auto spectrum = walker.problem.symmetric() && walker.options.branch_points
                              ? spectrum_at(walker, *sample)
                              : std::nullopt;
    if (spectrum) w.spectra.push_back(*spectrum);
  }
  if (w.spectra.size() != samples.size()) w.spectra.clear();
  return w;
}

}  // namespace

SingularPoints singular_points(const Walker& walker,
                               const std::vector<const CurvePoint*>& samples) {
  SingularPoints result;
  const Watched w = watch(walker, samples);
  std::vector<Zero> turns, zeros;
  if (walker.options.limit_points && !find_turns(w, turns)) {
    result.doubt = "a limit point could not be located";
    return result;
  }
  if (!find_eigenvalue_zeros(w, zeros)) {
    result.doubt = "the number of negative eigenvalues jumps";
    return result;
  }
  for (const Zero& turn : turns) {
    const auto match = std::find_if(zeros.begin(), zeros.end(), [&](const Zero& z) {
      return std::abs(z.point.s - turn.point.s) <= together;
    });
    if (match != zeros.end() || w.spectra.empty()) {
      if (match != zeros.end()) zeros.erase(match);
      result.hits.push_back(
          hit_at(w, HitKind::limit_point, "limit point", turn.point, turn.before, turn.after));
    } else if (!add_turning_branch_point(w, turn, result)) {
      result.doubt = "lambda turns back but no eigenvalue passes zero";
      return result;
    }
  }
  if (!add_branch_points(w, std::move(zeros), result)) {
    result.doubt = "several eigenvalues pass zero too close together";
    return result;
  }
  bool clear = !walker.options.limit_points || add_touch(w, w.rates, rate_of, result);
  for (Index k = 0; !w.spectra.empty() && clear && k < w.spectra.front().size(); ++k) {
    std::vector<double> values;
    for (const Vector& spectrum : w.spectra) values.push_back(spectrum[k]);
    clear = add_touch(
        w, values,
        [&walker, k](const CurvePoint& p) {
          const auto spectrum = spectrum_at(walker, p);
          return spectrum ? (*spectrum)[k] : 0.0;
        },
        result);
  }
  if (!clear) result.doubt = "something passes zero to and fro";
  return result;
}

}  // namespace springfold::continuation
