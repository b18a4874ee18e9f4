#include "design_search.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {
namespace {

/// A rough search meets the requirements this well.
constexpr double roughly_met = 1e-3;
/// The end of a rough search is followed if fewer other ends before it are better.
constexpr int most_followed = 3;
/// Where none of the starts leads to a design so many times as many are tried before it is said that none does.
constexpr int times_before_no = 4;
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

/// The first primes, then odd numbers: parameters beyond the tenth are seldom.
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
Vector DesignSearch::start(int k) const {
  Vector at = Vector::Zero(low_.size());
  for (Index i = 0; k > 0 && i < at.size(); ++i)
    at[i] = low_[i] + halton(k, base_of(i)) * (high_[i] - low_[i]);
  return at;
}

std::optional<Assessment> DesignSearch::judge(const Vector& changes, const std::vector<Way>& ways) {
  if (stopped_) return std::nullopt;
  const bool is_last = last_changes_.size() == changes.size() && last_changes_ == changes;
  if (is_last && last_ways_ == ways) return last_;
  std::string why;
  if (!is_last) {
    ++designs_;
    last_design_ = requirements_.trace(values(changes), observer_, why);
    last_changes_ = changes;
  }
  last_ = last_design_ ? requirements_.assess(*last_design_, ways, why) : std::nullopt;
  last_ways_ = ways;
  if (!last_ && !why.empty()) why_ = why;
  return last_;
}

std::optional<Assessment> DesignSearch::assess(const Vector& changes,
                                               const std::vector<Way>& ways) {
  auto at = judge(changes, ways);
  if (!at || at->dg.allFinite()) return at;
  why_ = "a rate by the parameters is not defined there";
  return std::nullopt;
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

std::optional<Assessment> DesignSearch::nearest(const Vector& changes, const std::vector<Way>& ways,
                                                const std::vector<std::size_t>& only) {
  std::vector<std::vector<Way>> all = all_ways();
  std::stable_partition(all.begin(), all.end(), [&](const auto& one) { return one == ways; });
  std::optional<Assessment> best;
  for (const auto& one : all) {
    const auto at = judge(changes, one);
    if (!at || (best && most_missed(*best, only) <= most_missed(*at, only))) continue;
    best = at;
    best->dg = at->dg * units_.asDiagonal();
    if (holds(best, only)) break;
  }
  return best;
}

double DesignSearch::violation_at(const Vector& changes, const std::vector<Way>& ways) {
  const auto at = judge(changes, ways);
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
  const auto is_met = [&] {
    return std::any_of(list.begin(), list.end(),
                       [](const Candidate& one) { return one.violation <= roughly_met; });
  };
  const double all = static_cast<double>(study_.design.starts) * times_before_no;
  for (int k = 0; k < study_.design.starts || (k < all && !is_met()); ++k)
    for (const auto& ways : all_ways()) {
      if (stopped_) return {};
      if (auto found = search_from(ways, start(k), Depth::roughly))
        list.push_back(std::move(*found));
    }
  return list;
}

bool DesignSearch::is_better(const Candidate& a, const Candidate& b) const {
  const bool a_meets = a.violation <= roughly_met, b_meets = b.violation <= roughly_met;
  if (a_meets != b_meets) return a_meets;
  return a_meets ? size_of(a.changes) < size_of(b.changes) : misses_less(a, b);
}

/// A miss of what is wanted as it is worded, a load that is too low, comes before that of the other way to meet it, no
/// critical point at all: their measures are not of one kind.
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

bool DesignSearch::is_same(const Candidate& a, const Candidate& b) const {
  return a.ways == b.ways && are_alike(a.changes, b.changes);
}

/// Those that few before them are better than: what comes later, from more starts, never leads to a worse answer.
std::vector<const DesignSearch::Candidate*> DesignSearch::promising(
    const std::vector<Candidate>& list) const {
  std::vector<const Candidate*> apart, chosen;
  for (const Candidate& one : list) {
    const auto same = [&](const Candidate* other) { return is_same(*other, one); };
    if (std::any_of(apart.begin(), apart.end(), same)) continue;
    const auto better = std::count_if(
        apart.begin(), apart.end(), [&](const Candidate* other) { return is_better(*other, one); });
    apart.push_back(&one);
    if (better < most_followed) chosen.push_back(&one);
  }
  return chosen;
}

/// What is a jump in one way may be none in another: with the way in which the place leads nearest to a minimum, and
/// with the first one of equal ones.
FoundDesign DesignSearch::smoothest(FoundDesign design) {
  conditions(design);
  FoundDesign best;
  for (const auto& ways : all_ways()) {
    const auto found = search_from(ways, design.changes, Depth::to_the_end);
    if (!found || found->violation > design_tolerance) continue;
    FoundDesign other{.status = DesignStatus::met, .changes = found->changes, .ways = ways};
    conditions(other);
    const bool is_first = best.changes.size() == 0;
    if (is_first || other.optimality < best.optimality * (1 - same_size)) best = other;
  }
  if (best.changes.size() == 0) return design;
  return best.is_least || best.optimality <= design.optimality ? best : design;
}

/// To the end, and where a requirement jumps there, along the boundary to the least change.
/// @returns nothing if that leads to a known end
std::optional<FoundDesign> DesignSearch::followed(const Candidate& from, KnownEnds& known) {
  const auto found = search_from(from.ways, from.changes, Depth::to_the_end);
  if (!found) return std::nullopt;
  FoundDesign design;
  const bool is_met = found->violation <= design_tolerance;
  design.status = is_met ? DesignStatus::met : DesignStatus::cannot_be_met;
  design.changes = found->changes;
  design.ways = from.ways;
  design.violation = is_met ? 0 : found->violation;
  conditions(design);
  if (!is_met || design.is_least) return design;
  for (const Vector& other : known.missed)
    if (are_alike(other, design.changes)) return std::nullopt;
  known.missed.push_back(design.changes);
  const JumpProblem problem = jump_problem(design.ways);
  JumpEnd end = drawn_back(problem, design.changes);
  if (end.jumps && !end.jumping.empty())
    end = least_on_boundary(problem, std::move(end), known.least);
  if (end.is_known) return std::nullopt;
  if (end.slope.size() > 0) known.least.push_back(end.changes);
  design.changes = end.changes;
  return end.jumps ? along_jump(std::move(design), end) : smoothest(design);
}

FoundDesign DesignSearch::best_of(const std::vector<Candidate>& list) {
  FoundDesign best;
  KnownEnds ends;
  const auto take = [&](const std::optional<FoundDesign>& found) {
    if (!found) return;
    const bool is_met = found->status == DesignStatus::met;
    const bool best_is_met = best.status == DesignStatus::met;
    const bool better =
        best.changes.size() == 0 || (is_met && !best_is_met) ||
        (is_met && size_of(found->changes) < size_of(best.changes) * (1 - same_size)) ||
        (!is_met && !best_is_met &&
         misses_less({found->ways, found->changes, found->violation},
                     {best.ways, best.changes, best.violation}));
    if (better) best = *found;
  };
  for (const auto* one : promising(list))
    if (!stopped_) take(followed(*one, ends));
  const auto is_worse = [&](const Candidate& than) {
    return best.status != DesignStatus::met ||
           size_of(than.changes) < size_of(best.changes) * (1 - same_size);
  };
  const auto met = met_starts();
  for (const Candidate* one : promising(met)) {
    if (stopped_) break;
    take(followed_to_jump(*one, ends));
    if (is_worse(*one)) take(followed(*one, ends));
    if (is_worse(*one)) take(drawn_to_case(*one));
  }
  return best;
}

FoundDesign DesignSearch::run() {
  FoundDesign best;
  if (holds(nearest(Vector::Zero(low_.size()), first_ways(), {}))) {
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
  return best;
}

}  // namespace springfold::analysis
