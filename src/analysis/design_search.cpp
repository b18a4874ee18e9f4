#include "design_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace springfold::analysis {
namespace {

/// An inequality or a bound that is as near to its limit decides with others.
constexpr double decides_within = 1e-7;
/// Multipliers that are smaller, relative to the objective's slope, are none.
constexpr double no_multiplier = 1e-7;
/// Below this residual a point is a minimum; beyond it a jump of the requirements ended the search.
constexpr double optimal = 1e-5;
/// Changes are drawn back to what still meets the requirements this closely, relative.
constexpr double closely = 1e-14;
/// A rough search meets the requirements this well, and ends as near to others that end at the same place.
constexpr double roughly_met = 1e-3, alike = 1e-2;
/// So many ends of rough searches are followed to the end.
constexpr int most_followed = 6;
/// Two designs whose sizes differ by less are equally good: the first one is kept.
constexpr double same_size = 1e-9;

/// Number `index` of the sequence of van der Corput (Halton 1960), in (0, 1).
double halton(int index, int base) {
  double value = 0, part = 1;
  for (; index > 0; index /= base) {
    part /= base;
    value += part * (index % base);
  }
  return value;
}

/// The first primes, and after them odd numbers: parameters beyond the tenth are seldom.
int base_of(Index i) {
  constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
  return i < 10 ? primes[i] : static_cast<int>(31 + 2 * (i - 10));
}

}  // namespace

DesignSearch::DesignSearch(const Study& study, const Observer& observer)
    : study_{study}, requirements_{study} {
  observer_ = [this, &observer](int points, double s) {
    if (observer && !observer(points, s)) stopped_ = true;
    return !stopped_;
  };
  const auto& parameters = study.design.parameters;
  const auto& cases = *study.critical.cases;
  const Index n = std::ssize(parameters);
  values_ = units_ = low_ = high_ = Vector(n);
  for (Index i = 0; i < n; ++i) {
    const DesignParameter& parameter = parameters[static_cast<std::size_t>(i)];
    values_[i] = cases.values[requirements_.designs().numbers[static_cast<std::size_t>(i)]];
    units_[i] = parameter.unit > 0 ? parameter.unit
                : values_[i] != 0  ? std::abs(values_[i])
                                   : parameter.high - parameter.low;
    low_[i] = (parameter.low - values_[i]) / units_[i];
    high_[i] = (parameter.high - values_[i]) / units_[i];
  }
  variables_ = {Matrix::Identity(n, n), low_, high_, study.design.changes == ChangeNorm::sum};
  if (!variables_.is_sum) return;
  variables_.combine = Matrix(n, 2 * n);
  variables_.combine << Matrix::Identity(n, n), -Matrix::Identity(n, n);
  variables_.low = Vector::Zero(2 * n);
  variables_.high = Vector(2 * n);
  variables_.high << high_, -low_;
}

double DesignSearch::size_of(const Vector& changes) const {
  return variables_.is_sum ? changes.lpNorm<1>() : changes.norm();
}

std::vector<Way> DesignSearch::first_ways() const {
  std::vector<Way> ways;
  for (const CriticalRequirement& one : study_.design.critical)
    ways.push_back(std::isfinite(one.at_least) ? Way::late : Way::climbing);
  return ways;
}

std::vector<std::vector<Way>> DesignSearch::all_ways() const {
  std::vector<std::vector<Way>> all{first_ways()};
  for (std::size_t i = 0; i < study_.design.critical.size(); ++i) {
    if (all.front()[i] == Way::climbing) continue;
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
      all.push_back(all[k]);
      all.back()[i] = Way::climbing;
    }
  }
  return all;
}

/// The case itself, then points spread over the bounds.
std::vector<Vector> DesignSearch::starts() const {
  std::vector<Vector> list{Vector::Zero(low_.size())};
  for (int k = 1; k < study_.design.starts; ++k) {
    Vector at(low_.size());
    for (Index i = 0; i < at.size(); ++i)
      at[i] = low_[i] + halton(k, base_of(i)) * (high_[i] - low_[i]);
    list.push_back(at);
  }
  return list;
}

std::optional<Assessment> DesignSearch::assess(const Vector& changes,
                                               const std::vector<Way>& ways) {
  if (stopped_) return std::nullopt;
  if (last_changes_.size() == changes.size() && last_changes_ == changes && last_ways_ == ways)
    return last_;
  ++designs_;
  std::string why;
  last_ = requirements_.assess(values(changes), ways, observer_, why);
  last_changes_ = changes;
  last_ways_ = ways;
  if (!last_) why_ = why;
  return last_;
}

Vector DesignSearch::to_variables(const Vector& changes) const {
  if (!variables_.is_sum) return changes;
  Vector v(2 * changes.size());
  v << changes.cwiseMax(0), (-changes).cwiseMax(0);
  return v;
}

InequalityValues DesignSearch::values_at(const Assessment& at, const Vector& v) const {
  InequalityValues values{.g = at.g, .dg = at.dg * units_.asDiagonal() * variables_.combine};
  values.f = variables_.is_sum ? v.sum() : 0.5 * v.squaredNorm();
  values.df = variables_.is_sum ? Vector::Ones(v.size()) : v;
  return values;
}

Vector DesignSearch::least_changes(const std::vector<Way>& ways, const Vector& from, Depth how) {
  const auto first = assess(from, ways);
  if (!first) return from;
  InequalityProblem problem{variables_.low, variables_.high, first->g.size()};
  problem.at = [&](const Vector& v) -> std::optional<InequalityValues> {
    const auto at = assess(variables_.combine * v, ways);
    return at ? std::optional{values_at(*at, v)} : std::nullopt;
  };
  problem.stopped = [this] { return stopped_; };
  return variables_.combine * search_minimum(problem, to_variables(from), how);
}

/// One more variable, the largest violation, is made small.
Vector DesignSearch::least_violation(const std::vector<Way>& ways, const Vector& from, Depth how) {
  const auto first = assess(from, ways);
  if (!first) return from;
  const Index n = low_.size();
  const double worst = std::max(first->g.maxCoeff(), 0.0);
  InequalityProblem problem{Vector(n + 1), Vector(n + 1), first->g.size()};
  problem.low << low_, 0;
  problem.high << high_, HUGE_VAL;
  problem.at = [&](const Vector& x) -> std::optional<InequalityValues> {
    const auto at = assess(x.head(n), ways);
    if (!at) return std::nullopt;
    InequalityValues values{x[n], Vector::Unit(n + 1, n), (at->g.array() - x[n]).matrix(),
                            Matrix(at->g.size(), n + 1)};
    values.dg << at->dg * units_.asDiagonal(), Vector::Constant(at->g.size(), -1);
    return values;
  };
  problem.stopped = [this] { return stopped_; };
  Vector x(n + 1);
  x << from, worst;
  return search_minimum(problem, x, how).head(n);
}

bool DesignSearch::meets(const Vector& changes) {
  for (const auto& ways : all_ways()) {
    const auto at = assess(changes, ways);
    if (at && at->g.maxCoeff() <= design_tolerance) return true;
  }
  return false;
}

/// Where requirements jump no derivative leads to the place: it is bracketed on the way back to the case.
Vector DesignSearch::drawn_back(Vector changes) {
  double bad = 0, good = 1;
  while (good - bad > closely && !stopped_) {
    const double middle = bad + 0.5 * (good - bad);
    if (middle <= bad || middle >= good) break;
    (meets(middle * changes) ? good : bad) = middle;
  }
  return good * changes;
}

double DesignSearch::violation_at(const Vector& changes, const std::vector<Way>& ways) {
  const auto at = assess(changes, ways);
  return at ? std::max(at->g.maxCoeff(), 0.0) : HUGE_VAL;
}

std::optional<DesignSearch::Candidate> DesignSearch::search_from(const std::vector<Way>& ways,
                                                                 const Vector& from, Depth how) {
  if (!assess(from, ways)) return std::nullopt;
  const double allowed = how == Depth::roughly ? roughly_met : design_tolerance;
  Vector changes = least_changes(ways, from, how);
  double violation = violation_at(changes, ways);
  if (violation > allowed) {
    const Vector nearest = least_violation(ways, std::isfinite(violation) ? changes : from, how);
    const Vector again =
        violation_at(nearest, ways) <= allowed ? least_changes(ways, nearest, how) : nearest;
    changes = violation_at(again, ways) <= violation_at(nearest, ways) + allowed ? again : nearest;
    violation = violation_at(changes, ways);
  }
  return Candidate{ways, changes, violation};
}

std::vector<DesignSearch::Candidate> DesignSearch::candidates() {
  std::vector<Candidate> list;
  for (const auto& ways : all_ways())
    for (const Vector& from : starts()) {
      if (stopped_) return {};
      if (auto found = search_from(ways, from, Depth::roughly)) list.push_back(std::move(*found));
    }
  const auto better = [this](const Candidate& a, const Candidate& b) {
    const bool a_meets = a.violation <= roughly_met, b_meets = b.violation <= roughly_met;
    if (a_meets != b_meets) return a_meets;
    return a_meets ? size_of(a.changes) < size_of(b.changes) : misses_less(a, b);
  };
  std::stable_sort(list.begin(), list.end(), better);
  return list;
}

/// A miss of what is wanted as it is worded, a load that is too low, comes before that of the other way to meet it, no critical
/// point at all: their measures are not of one kind.
bool DesignSearch::misses_less(const Candidate& a, const Candidate& b) const {
  const auto other_ways = [](const Candidate& c, const std::vector<Way>& first) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < first.size(); ++i) count += c.ways[i] != first[i] ? 1 : 0;
    return count;
  };
  if (std::isfinite(a.violation) != std::isfinite(b.violation)) return std::isfinite(a.violation);
  const std::vector<Way> first = first_ways();
  const std::size_t of_a = other_ways(a, first), of_b = other_ways(b, first);
  return of_a != of_b ? of_a < of_b : a.violation < b.violation;
}

/// The first ones that are not alike are followed to the end.
FoundDesign DesignSearch::best_of(const std::vector<Candidate>& list) {
  FoundDesign best;
  std::vector<const Candidate*> done;
  for (const Candidate& one : list) {
    const bool known = std::any_of(done.begin(), done.end(), [&](const Candidate* other) {
      return other->ways == one.ways &&
             (other->changes - one.changes).norm() <= alike * (1 + one.changes.norm());
    });
    if (known || std::ssize(done) >= most_followed || stopped_) continue;
    done.push_back(&one);
    const auto found = search_from(one.ways, one.changes, Depth::to_the_end);
    if (!found) continue;
    const bool meets_all = found->violation <= design_tolerance;
    const bool best_meets = best.status == DesignStatus::met;
    const bool better =
        best.changes.size() == 0 || (meets_all && !best_meets) ||
        (meets_all && size_of(found->changes) < size_of(best.changes) * (1 - same_size)) ||
        (!meets_all && !best_meets &&
         misses_less(*found, {best.ways, best.changes, best.violation}));
    if (!better) continue;
    best.status = meets_all ? DesignStatus::met : DesignStatus::cannot_be_met;
    best.changes = found->changes;
    best.ways = one.ways;
    best.violation = meets_all ? 0 : found->violation;
  }
  return best;
}

/// Karush, Kuhn and Tucker: the objective's slope is balanced by those of the inequalities and bounds that decide.
void DesignSearch::conditions(FoundDesign& design) {
  const Index n = low_.size();
  design.bounds.assign(static_cast<std::size_t>(n), BoundState::free);
  design.limiting.clear();
  design.multipliers.clear();
  design.optimality = std::numeric_limits<double>::quiet_NaN();
  const auto at = assess(design.changes, design.ways);
  if (!at) return;
  const bool is_met = design.status == DesignStatus::met;
  const Vector v = is_met ? to_variables(design.changes) : design.changes;
  InequalityValues values = values_at(*at, is_met ? v : to_variables(design.changes));
  if (!is_met) values.dg = at->dg * units_.asDiagonal();
  const Vector low = is_met ? variables_.low : low_, high = is_met ? variables_.high : high_;
  const Index extra = is_met ? 0 : 1;
  Vector df = Vector::Zero(v.size() + extra);
  if (is_met)
    df = values.df;
  else
    df[v.size()] = 1;
  std::vector<Vector> rows;
  std::vector<std::pair<bool, Index>> what;  // a bound or an inequality, which
  for (Index i = 0; i < at->g.size(); ++i) {
    if (at->g[i] < design.violation - decides_within * std::max(1.0, design.violation)) continue;
    Vector row = Vector::Zero(df.size());
    row.head(v.size()) = values.dg.row(i).transpose();
    if (!is_met) row[v.size()] = -1;
    rows.push_back(row);
    what.emplace_back(false, i);
  }
  for (Index i = 0; i < v.size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      const double bound = side < 0 ? low[i] : high[i];
      if (std::abs(v[i] - bound) > decides_within * std::max(1.0, std::abs(bound))) continue;
      rows.push_back(side * Vector::Unit(df.size(), i));
      what.emplace_back(true, side < 0 ? -i - 1 : i + 1);
    }
  Matrix all(std::ssize(rows), df.size());
  for (Index i = 0; i < all.rows(); ++i) all.row(i) = rows[static_cast<std::size_t>(i)].transpose();
  const Vector m = multipliers(df, all);
  const Vector rest = all.rows() > 0 ? Vector(df + all.transpose() * m) : df;
  const double size = df.norm();
  design.optimality = size > 0 ? rest.norm() / size : 0;
  for (Index i = 0; i < m.size(); ++i) {
    const auto [is_bound, which] = what[static_cast<std::size_t>(i)];
    const double weight = m[i] * all.row(i).norm();
    if (weight <= no_multiplier * std::max(size, no_multiplier)) continue;
    if (!is_bound) {
      const std::size_t requirement = at->of[static_cast<std::size_t>(which)];
      const auto known = std::find(design.limiting.begin(), design.limiting.end(), requirement);
      if (known == design.limiting.end()) {
        design.limiting.push_back(requirement);
        design.multipliers.push_back(m[i]);
      } else {
        design.multipliers[static_cast<std::size_t>(known - design.limiting.begin())] += m[i];
      }
      continue;
    }
    const Index variable = std::abs(which) - 1;
    const bool falls = is_met && variables_.is_sum && variable >= n;
    if (is_met && variables_.is_sum && which < 0) continue;  // no change in this direction
    const bool is_low = falls || which < 0;
    design.bounds[static_cast<std::size_t>(variable % n)] =
        is_low ? BoundState::at_low : BoundState::at_high;
  }
}

FoundDesign DesignSearch::run() {
  FoundDesign best;
  if (meets(Vector::Zero(low_.size()))) {
    best.status = DesignStatus::met_at_start;
    best.changes = Vector::Zero(low_.size());
    best.ways = first_ways();
    best.bounds.assign(static_cast<std::size_t>(low_.size()), BoundState::free);
    return best;
  }
  best = best_of(candidates());
  best.stopped = stopped_;
  if (stopped_ || best.changes.size() == 0) {
    best.status = DesignStatus::unresolved;
    best.why = stopped_ ? "interrupted" : why_;
    if (best.changes.size() == 0) best.changes = Vector::Zero(low_.size());
    best.ways = first_ways();
    best.bounds.assign(static_cast<std::size_t>(low_.size()), BoundState::free);
    return best;
  }
  conditions(best);
  if (best.status == DesignStatus::met && !(best.optimality <= optimal)) {
    best.changes = drawn_back(best.changes);
    conditions(best);
  }
  return best;
}

Vector DesignSearch::inwards(const FoundDesign& design, double size) {
  const auto at = assess(design.changes, design.ways);
  Vector way = Vector::Zero(low_.size());
  if (!at) return way;
  for (Index i = 0; i < at->g.size(); ++i) {
    if (at->g[i] < -decides_within) continue;
    const Vector slope = units_.cwiseProduct(at->dg.row(i).transpose());
    if (slope.norm() > 0) way -= slope.normalized();
  }
  if (way.norm() > 0) way = size * way.normalized();
  return (design.changes + way).cwiseMax(low_).cwiseMin(high_) - design.changes;
}

}  // namespace springfold::analysis
