// What decides the answer of a design search: the conditions of Karush, Kuhn and Tucker.
#include <algorithm>
#include <cmath>
#include <limits>

#include "design_search.hpp"

namespace springfold::analysis {
namespace {

/// An inequality or a bound that is as near to its limit decides with others.
constexpr double decides_within = 1e-7;
/// Multipliers that are smaller, relative to the objective's slope, are none.
constexpr double no_multiplier = 1e-7;
/// Below this residual a point is a minimum.
constexpr double optimal = 1e-5;

}  // namespace

/// The objective's slope, and those of the inequalities and bounds that decide.
struct DesignSearch::Conditions {
  struct Cause {
    enum Kind { inequality, jump, bound } kind = inequality;
    Index which = 0;  ///< of a bound: its variable + 1, of a lower one negative
  };
  Vector df{};
  std::vector<Vector> rows{};
  std::vector<Cause> causes{};  ///< of the rows

  void add(Cause cause, const Vector& head, double last) {
    Vector row = Vector::Zero(df.size());
    row.head(head.size()) = head;
    if (head.size() < df.size()) row[head.size()] = last;
    rows.push_back(row);
    causes.push_back(cause);
  }
};

/// For the nearest miss the objective is a further variable, the largest violation.
DesignSearch::Conditions DesignSearch::balance(const FoundDesign& design,
                                               const Assessment& at) const {
  using Cause = Conditions::Cause;
  const bool is_met = design.status == DesignStatus::met;
  const Vector v = is_met ? to_variables(design.changes) : design.changes;
  InequalityValues values = values_at(at, to_variables(design.changes));
  if (!is_met) values.dg = at.dg * units_.asDiagonal();
  Conditions all{.df = is_met ? values.df : Vector(Vector::Unit(v.size() + 1, v.size()))};
  for (Index i = 0; i < at.g.size(); ++i)
    if (at.g[i] >= design.violation - decides_within * std::max(1.0, design.violation))
      all.add({Cause::inequality, i}, values.dg.row(i).transpose(), -1);
  if (is_met && design.jump_slope.size() > 0)
    all.add({Cause::jump, 0}, variables_.combine.transpose() * design.jump_slope, 0);
  const Vector &low = is_met ? variables_.low : low_, &high = is_met ? variables_.high : high_;
  for (Index i = 0; i < v.size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      const double bound = side < 0 ? low[i] : high[i];
      if (std::abs(v[i] - bound) <= decides_within * std::max(1.0, std::abs(bound)))
        all.add({Cause::bound, side < 0 ? -i - 1 : i + 1}, side * Vector::Unit(v.size(), i), 0);
    }
  return all;
}

void DesignSearch::name_bound(FoundDesign& design, Index which) const {
  const Index n = low_.size(), variable = std::abs(which) - 1;
  const bool in_parts = design.status == DesignStatus::met && variables_.is_sum;
  if (in_parts && which < 0) return;  // no change in this direction
  const bool is_low = (in_parts && variable >= n) || which < 0;
  design.bounds[static_cast<std::size_t>(variable % n)] =
      is_low ? BoundState::at_low : BoundState::at_high;
}

/// The objective's slope is balanced by those of the inequalities and bounds that decide. A requirement that jumps is
/// balanced by the normal of its boundary; relaxing it a little does nothing, so that its multiplier is none.
void DesignSearch::conditions(FoundDesign& design) {
  design.bounds.assign(static_cast<std::size_t>(low_.size()), BoundState::free);
  design.limiting.clear();
  design.multipliers.clear();
  design.optimality = std::numeric_limits<double>::quiet_NaN();
  design.is_least = false;
  const auto at = judge(design.changes, design.ways);
  if (!at) return;
  using Cause = Conditions::Cause;
  const Conditions all = balance(design, *at);
  Matrix rows(std::ssize(all.rows), all.df.size());
  for (Index i = 0; i < rows.rows(); ++i)
    rows.row(i) = all.rows[static_cast<std::size_t>(i)].transpose();
  if (!rows.allFinite()) return;  // nothing shows that the change is the least one
  const Vector m = multipliers(all.df, rows);
  const Vector rest = rows.rows() > 0 ? Vector(all.df + rows.transpose() * m) : all.df;
  const double size = all.df.norm();
  design.optimality = size > 0 ? rest.norm() / size : 0;
  design.is_least = design.optimality <= optimal;
  const auto add = [&](std::size_t requirement, double multiplier) {
    const auto known = std::find(design.limiting.begin(), design.limiting.end(), requirement);
    const auto number = static_cast<std::size_t>(known - design.limiting.begin());
    if (known == design.limiting.end()) {
      design.limiting.push_back(requirement);
      design.multipliers.push_back(0);
    }
    design.multipliers[number] += multiplier;
  };
  for (Index i = 0; i < m.size(); ++i) {
    const Cause cause = all.causes[static_cast<std::size_t>(i)];
    if (m[i] * rows.row(i).norm() <= no_multiplier * std::max(size, no_multiplier)) continue;
    if (cause.kind == Cause::inequality)
      add(at->of[static_cast<std::size_t>(cause.which)], m[i]);
    else if (cause.kind == Cause::bound)
      name_bound(design, cause.which);
    else
      for (const std::size_t one : design.jumping) add(one, 0);
  }
}

Vector DesignSearch::inwards(const FoundDesign& design, double size) {
  const auto at = judge(design.changes, design.ways);
  Vector way = Vector::Zero(low_.size());
  if (!at) return way;
  for (Index i = 0; i < at->g.size(); ++i) {
    if (at->g[i] < -decides_within) continue;
    const Vector slope = units_.cwiseProduct(at->dg.row(i).transpose());
    if (slope.norm() > 0) way -= slope.normalized();
  }
  if (design.jump_slope.size() > 0) way -= design.jump_slope.normalized();
  if (way.norm() > 0) way = size * way.normalized();
  return (design.changes + way).cwiseMax(low_).cwiseMin(high_) - design.changes;
}

}  // namespace springfold::analysis
