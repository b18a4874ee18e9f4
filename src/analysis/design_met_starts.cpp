// Searches that begin at designs that meet the requirements, and what is found where one jumps.
#include <algorithm>

#include "design_search.hpp"

namespace springfold::analysis {
namespace {

/// Distances from the case by which places are ordered are known to this part.
constexpr double roughly_placed = 0x1p-4;

}  // namespace

/// Refers to the ways.
JumpProblem DesignSearch::jump_problem(const std::vector<Way>& ways) {
  JumpProblem problem{.low = low_, .high = high_, .is_sum = variables_.is_sum};
  problem.judge = [this, &ways](const Vector& u, const std::vector<std::size_t>& only) {
    return nearest(u, ways, only);
  };
  problem.stopped = [this] { return stopped_; };
  return problem;
}

FoundDesign DesignSearch::along_jump(FoundDesign design, const JumpEnd& end) {
  design.changes = end.changes;
  design.jumps = end.jumps;
  design.jumping = end.jumping;
  design.jump_slope = end.slope;
  conditions(design);
  return design;
}

/// The least slope of paths that are to climb all the way jumps where branches cross: a search by derivatives steps
/// over that, to the smooth boundary of other designs, or none. At a bound a set may begin that is too small for any
/// start, and at whose edge a requirement jumps: the bounds are looked at whatever was found, so that more starts lead
/// to no worse answer.
std::vector<DesignSearch::Candidate> DesignSearch::met_starts() {
  std::vector<Candidate> list;
  const std::vector<Way> ways = first_ways();
  const bool climbs = std::find(ways.begin(), ways.end(), Way::climbing) != ways.end();
  const Vector none = Vector::Zero(low_.size());
  std::vector<Vector> places;
  for (Index i = 0; i < low_.size(); ++i)
    for (const double bound : {low_[i], high_[i]})
      places.emplace_back(bound * Vector::Unit(low_.size(), i));
  for (int k = 1; climbs && k < study_.design.starts; ++k) places.push_back(start(k));
  const JumpProblem problem = jump_problem(ways);
  for (const Vector& from : places)
    if (!stopped_ && holds(nearest(from, ways, {})))
      list.push_back({ways, met_place(bracket(problem, from, none, roughly_placed)), 0});
  return list;
}

/// From the jump on the straight way to the case; nothing where there is none, or if that leads to a known end.
std::optional<FoundDesign> DesignSearch::followed_to_jump(const Candidate& from, KnownEnds& known) {
  const JumpProblem problem = jump_problem(from.ways);
  auto end = jump_between(problem, from.changes, Vector::Zero(low_.size()));
  if (!end || end->jumping.empty()) return std::nullopt;
  *end = least_on_boundary(problem, std::move(*end), known.least);
  if (end->is_known || !holds(nearest(end->changes, from.ways, {}))) return std::nullopt;
  if (end->slope.size() > 0) known.least.push_back(end->changes);
  return along_jump({.status = DesignStatus::met, .changes = end->changes, .ways = from.ways},
                    *end);
}

/// The last design on the straight way to the case: what is known to meet the requirements is an answer, whether or not
/// a search leads on from it.
FoundDesign DesignSearch::drawn_to_case(const Candidate& from) {
  const JumpEnd end = drawn_to(jump_problem(from.ways), from.changes, Vector::Zero(low_.size()));
  return along_jump({.status = DesignStatus::met, .changes = end.changes, .ways = from.ways}, end);
}

}  // namespace springfold::analysis
