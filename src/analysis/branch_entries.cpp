#include "branch_entries.hpp"

#include <algorithm>

#include "branch_rows.hpp"
#include "row_indices.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;

/// Rotations go on from row to row, both ways from the start, also beyond whole turns.
void count_turns(std::vector<Entry>& entries, std::size_t start, const PathProblem& problem) {
  entries[start].turns = problem.turns(entries[start].point.x);
  for (std::size_t i = start + 1; i < entries.size(); ++i)
    entries[i].turns = problem.turns(entries[i].point.x, &entries[i - 1].turns);
  for (std::size_t i = start; i-- > 0;)
    entries[i].turns = problem.turns(entries[i].point.x, &entries[i + 1].turns);
}

/// A special point and the start part smooth curves; a row of a kink belongs to the side that it is seen from.
void note_switches(std::vector<Entry>& entries, std::size_t start, const PathProblem& problem) {
  if (problem.switch_count() == 0) return;
  for (std::size_t first = 0, end = 0; first < entries.size(); first = end) {
    std::vector<const CurvePoint*> points;
    const auto goes_on = [&](std::size_t i) {
      const Entry &before = entries[i - 1], &next = entries[i];
      const bool is_parted = i == start || next.leaving ||
                             (before.hit != nullptr && !before.leaving) ||
                             before.point.piece != next.point.piece;
      return !is_parted;
    };
    for (end = first; end < entries.size() && (end == first || goes_on(end)); ++end)
      points.push_back(&entries[end].point);
    std::vector<KnownSwitches> known = known_switches(problem, points);
    for (std::size_t i = first; i < end; ++i) entries[i].known = std::move(known[i - first]);
  }
}

/// Neighbours with the same answer together.
void note_resting(const Entry& entry, std::size_t row, const Evaluator& evaluator, Branch& branch) {
  const auto rows = resting_rows(entry.point, entry.known, row, evaluator);
  branch.samples[row].rests = rows.has_value();
  if (rows) add_resting(*rows, branch.resting);
}

Sample sample_of(const RowMaking& making, const Entry& e) {
  return {making.evaluator.values(making.quantities, e.point, &e.turns, e.known),
          piece_text(making.problem.system(e.point.lambda), e.point.piece), ""};
}

/// Special points, both ends, the start, and the accepted points beside each of them: counts beside a special point are
/// told from these.
std::vector<bool> wanted_in_any_case(const std::vector<Entry>& entries, std::size_t start) {
  std::vector<bool> wanted(entries.size(), false);
  const auto mark = [&](std::size_t i) {
    wanted[i] = true;
    std::size_t k = i;
    while (k > 0 && entries[--k].is_between) {
    }
    wanted[k] = true;
    for (k = std::min(i + 1, entries.size() - 1); k + 1 < entries.size() && entries[k].is_between;)
      ++k;
    wanted[k] = true;
  };
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].hit != nullptr) mark(i);
  for (const std::size_t i : {std::size_t{0}, start, entries.size() - 1}) mark(i);
  return wanted;
}

void leave_out_between(std::vector<Entry>& entries, std::size_t& start) {
  const auto is_between = [](const Entry& e) { return e.is_between; };
  const auto before = entries.begin() + static_cast<std::ptrdiff_t>(start);
  start -= static_cast<std::size_t>(std::count_if(entries.begin(), before, is_between));
  std::erase_if(entries, is_between);
}

/// Takes out what an interrupted branch does without. @param done  of the first entries the rows are made
void thin(const RowMaking& making, std::size_t done, std::vector<Entry>& entries, Branch& branch) {
  constexpr std::size_t soon_written = 1'000'000;  // numbers: about a fifth of a second
  const bool keeps_between = done * making.quantities.size() <= soon_written;
  const std::vector<bool> wanted = wanted_in_any_case(entries, branch.start_row);
  std::vector<Entry> kept;
  std::vector<Sample> samples;
  std::size_t start = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Entry& e = entries[i];
    if (i == branch.start_row) start = kept.size();
    const bool is_kept = wanted[i] || (e.is_between ? i < done && keeps_between
                                                    : i < done || making.asking->has_a_moment());
    if (!is_kept) continue;
    samples.push_back(i < done ? std::move(branch.samples[i]) : sample_of(making, e));
    kept.push_back(std::move(e));
  }
  branch.start_row = start;
  branch.samples = std::move(samples);
  entries = std::move(kept);
}

}  // namespace

std::optional<RestingRows> resting_rows(const CurvePoint& point, const KnownSwitches& known,
                                        std::size_t row, const Evaluator& evaluator) {
  const auto found = evaluator.resting_index_of(QuantityDefinition::Kind::index, point, known);
  if (!found) return std::nullopt;
  using Stable = RestingRows::Stable;
  return RestingRows{row, row,
                     found->verdict == Definiteness::positive       ? Stable::yes
                     : found->verdict == Definiteness::not_positive ? Stable::no
                                                                    : Stable::undecided,
                     static_cast<int>(found->fewest), static_cast<int>(found->most)};
}

/// Points and special points of one direction in the order of s, without the start.
std::vector<Entry> entries_of(const Curve& curve, std::vector<CurvePoint>&& between) {
  std::vector<Entry> entries;
  entries.reserve(curve.points.size() + between.size() + 2 * curve.hits.size());
  std::size_t h = 0, b = 0;
  const auto add_between = [&](double s) {
    for (; b < between.size() && between[b].s < s; ++b)
      entries.push_back({.point = std::move(between[b]), .is_between = true});
  };
  const auto add_hit = [&](const Hit& hit) {
    add_between(hit.point.s);
    entries.push_back({.point = hit.point, .hit = &hit});
    // Where there are several ways out the trace ended and none of them belongs to this branch.
    if (hit.leaving.size() == 1)
      entries.push_back({.point = hit.leaving.front(), .hit = &hit, .leaving = true});
  };
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    while (h < curve.hits.size() && curve.hits[h].point.s <= curve.points[i].s)
      add_hit(curve.hits[h++]);
    add_between(curve.points[i].s);
    entries.push_back({.point = curve.points[i]});
  }
  while (h < curve.hits.size()) add_hit(curve.hits[h++]);
  return entries;
}

/// The start, once for every special point that lies on it.
std::vector<Entry> entries_at(const CurvePoint& start, const std::vector<Hit>& hits) {
  if (hits.empty()) return {{.point = start}};
  std::vector<Entry> entries;
  for (const Hit& hit : hits) {
    entries.push_back({.point = hit.point, .hit = &hit});
    if (hit.leaving.size() == 1)
      entries.push_back({.point = hit.leaving.front(), .hit = &hit, .leaving = true});
  }
  return entries;
}

/// The same curve walked the other way: s and tangents change sign, kinks swap their sides.
std::vector<Entry> reversed(std::vector<Entry> entries) {
  std::reverse(entries.begin(), entries.end());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Entry& e = entries[i];
    e.point.s = -e.point.s;
    e.point.tangent.dx = -e.point.tangent.dx;
    e.point.tangent.dlambda = -e.point.tangent.dlambda;
    const bool pair = i + 1 < entries.size() && e.leaving && entries[i + 1].hit == e.hit;
    if (pair) {
      e.leaving = false;
      entries[i + 1].leaving = true;
    }
  }
  return entries;
}

bool add_rows(const RowMaking& making, std::vector<Entry>& entries, Branch& branch) {
  const std::size_t all = entries.size();
  if (making.asking != nullptr && !making.asking->goes_on())
    leave_out_between(entries, branch.start_row);
  count_turns(entries, branch.start_row, making.problem);
  note_switches(entries, branch.start_row, making.problem);
  branch.samples.reserve(entries.size());
  const auto goes_on = [&](const Entry& e) {
    if (making.asking == nullptr) return true;
    return e.is_between ? making.asking->goes_on() : making.asking->has_a_moment();
  };
  std::size_t i = 0;
  for (; i < entries.size() && goes_on(entries[i]); ++i) {
    branch.samples.push_back(sample_of(making, entries[i]));
    note_resting(entries[i], i, making.evaluator, branch);
  }
  if (i == entries.size()) return i == all;
  thin(making, i, entries, branch);
  branch.resting.clear();
  for (std::size_t k = 0; k < entries.size(); ++k)
    note_resting(entries[k], k, making.evaluator, branch);
  return false;
}

}  // namespace springfold::analysis
