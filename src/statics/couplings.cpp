#include "springfold/statics/couplings.hpp"

#include <algorithm>

#include "springfold/core/sparse_matrices.hpp"

namespace springfold::statics {
namespace {

/// Fewer unknowns are solved for faster without regard to zeros: measured with n-by-n nets of bars.
constexpr Index fewest_unknowns = 120;

/// One in so many of them may be held together at a time, by a member or in the elimination.
constexpr Index share = 4;

void append_pose(const System& system, Index first, std::vector<Index>& list) {
  for (const BodySlice& body : system.body_slices)
    if (body.t == first)
      for (Index k = 0; k < body.count; ++k) list.push_back(first + k);
}

void append_point(const System& system, std::size_t point, std::vector<Index>& list) {
  for (const Index z : system.points[point].z)
    if (z >= 0) list.push_back(z);
}

std::vector<Index> of_chain(const System& system, const ChainSlice& slice) {
  std::vector<Index> list;
  for (Index k = 0; k < slice.x_count; ++k) list.push_back(slice.x + k);
  for (Index k = 0; k < slice.F_count; ++k) list.push_back(slice.F + k);
  if (slice.from >= 0) append_pose(system, slice.from, list);
  if (slice.to >= 0) append_pose(system, slice.to, list);
  return list;
}

}  // namespace

std::vector<std::vector<Index>> couplings(const System& system) {
  std::vector<std::vector<Index>> lists;
  for (const BodySlice& body : system.body_slices) {
    lists.emplace_back();
    append_pose(system, body.t, lists.back());
  }
  for (const ChainSlice& slice : system.chain_slices) lists.push_back(of_chain(system, slice));
  for (const PointLoad& load : system.loads) {
    lists.emplace_back();
    append_point(system, load.point, lists.back());
  }
  for (const PointSpring& spring : system.line_springs) {
    lists.emplace_back();
    append_point(system, spring.from, lists.back());
    append_point(system, spring.to, lists.back());
  }
  for (const PointShape& shape : system.shapes) {
    lists.emplace_back();
    for (const std::size_t point : shape.points) append_point(system, point, lists.back());
    for (Index k = 0; k < shape.inner_count; ++k) lists.back().push_back(shape.inner + k);
  }
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lists;
}

bool prefers_sparse(const System& system) {
  if (system.size < fewest_unknowns || system.redundant > 0 || system.chains_coupled) return false;
  const bool turns = std::any_of(
      system.mechanism.bodies.begin(), system.mechanism.bodies.end(),
      [](const model::Body& body) { return body.task_space == model::TaskSpace::spatial; });
  if (turns) return false;
  for (const PointLoad& load : system.loads)
    if (load.number >= 0 &&
        !model::is_conservative(system.mechanism,
                                system.mechanism.loads[static_cast<std::size_t>(load.number)]))
      return false;
  const auto lists = couplings(system);
  const auto few = [&system](Index count) { return share * count <= system.size; };
  return std::all_of(lists.begin(), lists.end(),
                     [&few](const auto& list) { return few(std::ssize(list)); }) &&
         few(SparseLayout(system.size, lists).largest_front());
}

}  // namespace springfold::statics
