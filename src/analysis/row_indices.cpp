#include "row_indices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "springfold/analysis/event_rows.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::analysis {
namespace {

/// Rows at which an eigenvalue passes zero, so that every count of a matrix there is one of rounding.
struct CriticalRows {
  std::vector<bool> here{};
  std::vector<bool> first_of_two{}, second_of_two{};  ///< rows of one place, of any event
};

/// Beside a spring that rests an eigenvalue of one of the pieces vanishes where half-branches leave.
bool is_critical(EventKind kind) {
  return kind == EventKind::limit_point || is_meeting_of_branches(kind);
}

CriticalRows critical_rows(const Branch& branch) {
  const std::vector<bool> none(branch.samples.size(), false);
  CriticalRows rows{none, none, none};
  for (const Event& event : branch.events) {
    const bool two = has_two_rows(branch, event);
    if (two) rows.first_of_two[event.row] = rows.second_of_two[event.row + 1] = true;
    if (!is_critical(event.kind)) continue;
    rows.here[event.row] = true;
    if (two) rows.here[event.row + 1] = true;
  }
  return rows;
}

/// Rows that are nearer to a special point of those, along the branch on one side of it, than the engine tells points
/// apart.
class RowsBeside {
 public:
  /// @param critical  rows of those points
  RowsBeside(const Branch& branch, const std::vector<bool>& critical)
      : branch_{branch}, is_special_{critical}, is_near_(critical.size(), false) {
    for (const Event& event : branch.events) {
      if (event.kind == EventKind::user_value || event.kind == EventKind::end_of_range) continue;
      is_special_[event.row] = true;
      if (has_two_rows(branch, event)) is_special_[event.row + 1] = true;
    }
    for (std::size_t i = 0; i < critical.size(); ++i)
      if (critical[i])
        for (const std::size_t step : {row_ahead, row_back})
          for (std::size_t k = i + step; is_near(i, k); k += step) is_near_[k] = true;
  }

  /// The first row beyond those beside a point that has no other special point before it; nothing if there is none.
  std::optional<std::size_t> first_beyond(std::size_t point, std::size_t step) const {
    std::size_t k = point + step;
    while (k < is_near_.size() && is_near_[k]) k += step;
    if (k >= is_near_.size() || is_special_[k]) return std::nullopt;
    return k;
  }

  /// Is the row so near to a critical point that not even the eigenvalue that vanishes there is clear of rounding?
  bool is_blurred(std::size_t point, std::size_t row) const {
    constexpr double clear = 8 * continuation::root_of_rounding;
    return distance(point, row) <= clear;
  }

 private:
  bool is_near(std::size_t point, std::size_t row) const {
    if (row >= is_near_.size() || is_special_[row]) return false;
    return distance(point, row) <= continuation::told_apart;
  }
  double distance(std::size_t a, std::size_t b) const {
    const auto s = [&](std::size_t i) { return branch_.samples[i].values.front(); };
    return std::abs(s(a) - s(b));
  }

  const Branch& branch_;
  std::vector<bool> is_special_, is_near_;
};

/// Beside a critical point the eigenvalue that vanishes there is smaller than what rounding of the place makes of it.
/// Rows that are nearer than the engine tells points apart have the counts of the first row beyond them on that side:
/// counts change at special points only. Not so where springs rest: an eigenvalue of one piece passes zero anywhere if
/// its motion leads out of the piece. There a row has the counts of its own pieces as soon as they are clear: a state
/// that is off by e at a distance d from a special point, e d being the rounding, has eigenvalues of the size of d that
/// are off by e.
/// @param critical  the rows of critical points
/// @returns for every row the one whose count it has
std::vector<std::size_t> counted_rows(const Branch& branch, const std::vector<bool>& critical) {
  std::vector<std::size_t> rows(critical.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const RowsBeside beside(branch, critical);
  for (std::size_t i = 0; i < critical.size(); ++i) {
    if (!critical[i]) continue;
    for (const std::size_t step : {row_ahead, row_back})
      if (const auto beyond = beside.first_beyond(i, step))
        for (std::size_t k = i + step; k != *beyond; k += step)
          if (!branch.samples[k].rests || beside.is_blurred(i, k)) rows[k] = *beyond;
  }
  return rows;
}

void take_counts(Branch& branch, const std::vector<std::size_t>& rows, std::size_t quantity) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double count = branch.samples[rows[i]].values[quantity];
    if (!std::isnan(count)) branch.samples[i].values[quantity] = count;
  }
}

/// Rows at which springs rest have the answer of the row that they are counted at.
void settle_resting(Branch& branch, const std::vector<std::size_t>& rows) {
  if (branch.resting.empty()) return;
  std::vector<const RestingRows*> at(rows.size(), nullptr);
  for (const RestingRows& known : branch.resting)
    for (std::size_t i = known.first; i <= known.last; ++i) at[i] = &known;
  std::vector<RestingRows> settled;
  for (Sample& sample : branch.samples) sample.rests = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (at[rows[i]] == nullptr) continue;
    RestingRows next = *at[rows[i]];
    next.first = next.last = i;
    add_resting(next, settled);
    branch.samples[i].rests = true;
  }
  branch.resting = std::move(settled);
}

/// The smaller of the counts before and behind a row, or the one that is known: along a family none is.
double smaller_beside(const Branch& branch, const CriticalRows& rows, std::size_t row,
                      std::size_t quantity) {
  const std::size_t before = rows.second_of_two[row] ? row - 1 : row;
  double value = before > 0 ? branch.samples[before - 1].values[quantity] : std::nan("");
  for (std::size_t k = row + (rows.first_of_two[row] ? 2 : 1); k < branch.samples.size(); ++k) {
    const double next = branch.samples[k].values[quantity];
    const bool is_special = !branch.samples[k].event.empty();
    if (std::isnan(next) && is_special) continue;
    return std::isnan(value) ? next : std::fmin(value, next);
  }
  return value;
}

/// The count of the side of a switching to which a row belongs, which its own matrix does not tell: that of the row
/// next to it on this side. Along a family none is known.
double count_of_side(const Branch& branch, const CriticalRows& rows, std::size_t row,
                     std::size_t quantity) {
  const auto& samples = branch.samples;
  if (rows.first_of_two[row]) return samples[row - 1].values[quantity];
  std::size_t next = row + 1;
  while (next + 1 < samples.size() && std::isnan(samples[next].values[quantity]) &&
         !samples[next].event.empty())
    ++next;
  return samples[next].values[quantity];
}

/// A count that is taken from the rows beside means what it means there.
void rest_as_neighbours(Branch& branch, const std::vector<bool>& taken) {
  std::vector<Sample>& rows = branch.samples;
  std::vector<bool> rests(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    rests[i] =
        rows[i].rests ||
        (taken[i] && ((i > 0 && rows[i - 1].rests) || (i + 1 < rows.size() && rows[i + 1].rests)));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].rests = rests[i];
}

}  // namespace

void add_resting(const RestingRows& next, std::vector<RestingRows>& list) {
  const bool goes_on = !list.empty() && list.back().last + 1 == next.first &&
                       list.back().stable == next.stable && list.back().fewest == next.fewest &&
                       list.back().most == next.most;
  if (goes_on)
    list.back().last = next.last;
  else
    list.push_back(next);
}

void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities) {
  const CriticalRows critical = critical_rows(branch);
  const bool has_driven = std::any_of(quantities.begin(), quantities.end(), [](const auto& q) {
    return q.kind == QuantityDefinition::Kind::index_driven;
  });
  // The count that a change of stability is about: that of the driven load if there is one, else that under dead load.
  std::vector<bool> changes = critical.here;
  for (const Event& event : branch.events)
    if (event.kind == EventKind::stability_change) changes[event.row] = true;
  settle_resting(branch, counted_rows(branch, critical.here));
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto kind = quantities[q].kind;
    if (kind != QuantityDefinition::Kind::index && kind != QuantityDefinition::Kind::index_force &&
        kind != QuantityDefinition::Kind::index_pose &&
        kind != QuantityDefinition::Kind::index_driven)
      continue;
    const auto of_changes =
        has_driven ? QuantityDefinition::Kind::index_driven : QuantityDefinition::Kind::index_force;
    const std::vector<bool>& at_zero = kind == of_changes ? changes : critical.here;
    // Of the count with all bodies held nothing is known between special points.
    if (kind != QuantityDefinition::Kind::index_pose)
      take_counts(branch, counted_rows(branch, at_zero), q);
    for (std::size_t i = 0; i < branch.samples.size(); ++i) {
      double& value = branch.samples[i].values[q];
      const bool unknown = std::isnan(value) && !branch.samples[i].event.empty();
      const bool has_side = (critical.first_of_two[i] && i > 0) ||
                            (critical.second_of_two[i] && i + 1 < branch.samples.size());
      if (unknown && has_side && !at_zero[i])
        value = count_of_side(branch, critical, i, q);
      else if (unknown || at_zero[i])
        value = smaller_beside(branch, critical, i, q);
    }
  }
  rest_as_neighbours(branch, critical.here);
}

}  // namespace springfold::analysis
