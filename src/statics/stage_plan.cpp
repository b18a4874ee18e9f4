#include <algorithm>
#include <cassert>
#include <numeric>

#include "springfold/statics/stages.hpp"

namespace springfold::statics {
namespace {

/// Of one body, for a chain in stages: such blocks are kept on the stack.
constexpr std::size_t most_root_unknowns = 8;

const model::Anchor* anchor_of(const System& system, const PointLoad& load) {
  return load.number < 0 ? nullptr
                         : &system.mechanism.loads[static_cast<std::size_t>(load.number)].on;
}

/// Chain on which a load or weight acts, or -1. The chains' points come first, in order.
Index chain_of(const System& system, const PointLoad& load) {
  if (const model::Anchor* on = anchor_of(system, load)) return on->chain;
  std::size_t first = 0;
  for (std::size_t i = 0; i < system.mechanism.chains.size(); ++i) {
    first += system.mechanism.chains[i].points.size();
    if (load.point < first) return static_cast<Index>(i);
  }
  return -1;
}

bool is_conservative(const System& system, const PointLoad& load) {
  return load.number < 0 || load.about_one_axis ||
         model::is_conservative(system.mechanism,
                                system.mechanism.loads[static_cast<std::size_t>(load.number)]);
}

/// Chains at the two ends of a line spring, -1 for bodies.
std::pair<Index, Index> chains_of(const System& system, std::size_t spring) {
  const model::LineSpring& s = system.mechanism.line_springs[spring];
  return {s.from.chain, s.to.chain};
}

bool is_along_z(const model::Mat3<double>& R) {
  return R(0, 2) == 0 && R(1, 2) == 0 && R(2, 0) == 0 && R(2, 1) == 0;
}

/// Do all rotations keep the direction z exactly?
bool turns_about_z(const model::CompiledChain& chain) {
  const auto may_turn = [](model::TaskSpace space) { return space == model::TaskSpace::spatial; };
  if (chain.space == model::TaskSpace::spatial) return false;
  if (chain.from_moves && may_turn(chain.from_space)) return false;
  return std::all_of(chain.joints.begin(), chain.joints.end(), [](const auto& joint) {
    return is_along_z(joint.before.R) &&
           (!joint.revolute || (joint.axis[0] == 0 && joint.axis[1] == 0));
  });
}

std::vector<Index> joints_with_coordinate(const ChainSlice& slice) {
  std::vector<Index> joints;
  for (std::size_t j = 0; j < slice.joint_coordinate.size(); ++j)
    if (slice.joint_coordinate[j] >= 0) joints.push_back(static_cast<Index>(j));
  return joints;
}

bool belongs(const ChainSlice& slice, const CoordinateGroup& group) {
  return !group.coordinates.empty() && group.coordinates.front() >= slice.x &&
         group.coordinates.front() < slice.x + slice.x_count;
}

/// Where stages begin: as many coordinates as asked for, and no coupled spring between two stages.
std::vector<Index> cut(const System& system, const ChainSlice& slice, Index wanted) {
  std::vector<Index> reach(static_cast<std::size_t>(slice.x_count), 0);  // who must come along
  for (const CoordinateGroup& group : system.coupled) {
    if (!belongs(slice, group)) continue;
    const auto [low, high] =
        std::minmax_element(group.coordinates.begin(), group.coordinates.end());
    Index& entry = reach[static_cast<std::size_t>(*low - slice.x)];
    entry = std::max(entry, *high - slice.x);
  }
  std::vector<Index> first{0};
  Index held = -1;
  for (Index i = 0; i < slice.x_count; ++i) {
    held = std::max(held, reach[static_cast<std::size_t>(i)]);
    if (i + 1 - first.back() >= wanted && held <= i) first.push_back(i + 1);
  }
  if (first.back() != slice.x_count || slice.x_count == 0) first.push_back(slice.x_count);
  return first;
}

/// The system without other chains; `chain` -1: without any. z = (x, F of the chain, poses).
class PartMaker {
 public:
  PartMaker(const System& whole, Index chain) : whole_{whole}, chain_{chain} {
    if (chain >= 0) slice_ = &whole.chain_slices[static_cast<std::size_t>(chain)];
    own_ = slice_ != nullptr ? slice_->x_count + slice_->F_count : 0;
  }

  DensePart make() {
    System& s = part_.system;
    s.body_slices = whole_.body_slices;
    for (BodySlice& body : s.body_slices) body.t = moved(body.t);
    s.mechanism.bodies = whole_.mechanism.bodies;
    s.first_pose = s.first_inner = own_;
    s.load_size = whole_.load_size;
    s.size = own_ + whole_.size - whole_.first_pose;
    s.commands = whole_.commands;
    if (chain_ >= 0) add_chain();
    for (std::size_t i = 0; i < whole_.loads.size(); ++i)
      if (chain_of(whole_, whole_.loads[i]) == chain_) {
        part_.loads.push_back(i);
        PointLoad load = whole_.loads[i];
        load.point = add_point(load.point);
        s.loads.push_back(load);
      }
    for (std::size_t i = 0; i < whole_.line_springs.size(); ++i) {
      const auto [from, to] = chains_of(whole_, i);
      if (std::max(from, to) != chain_) continue;
      part_.line_springs.push_back(i);
      PointSpring spring = whole_.line_springs[i];
      spring.from = add_point(spring.from);
      spring.to = add_point(spring.to);
      s.line_springs.push_back(spring);
    }
    for (Index k = 0; k < own_; ++k) part_.places.push_back(slice_->x + k);
    for (Index k = whole_.first_pose; k < whole_.size; ++k) part_.places.push_back(k);
    return std::move(part_);
  }

 private:
  Index moved(Index z) const {
    if (z < 0) return z;
    return z >= whole_.first_pose ? z - whole_.first_pose + own_ : z - slice_->x;
  }

  void add_chain() {
    System& s = part_.system;
    ChainSlice slice = *slice_;
    slice.x = 0;
    slice.F = slice.x_count;
    slice.from = moved(slice.from);
    slice.to = moved(slice.to);
    for (Index& z : slice.joint_coordinate) z = moved(z);
    for (Index& z : slice.z_of) z = moved(z);
    s.chains = {whole_.chains[static_cast<std::size_t>(chain_)]};
    s.chain_slices = {slice};
    for (std::size_t i = 0; i < whole_.springs.size(); ++i) {
      CoordinateSpring spring = whole_.springs[i];
      if (spring.coordinate < slice_->x || spring.coordinate >= slice_->x + slice_->x_count)
        continue;
      part_.springs.push_back(i);
      spring.coordinate = moved(spring.coordinate);
      spring.first_switch = static_cast<Index>(s.switches.size());
      for (const double b : spring.law.breakpoints)
        s.switches.push_back({spring.coordinate, b, s.springs.size()});
      s.springs.push_back(std::move(spring));
    }
    for (std::size_t g = 0; g < whole_.coupled.size(); ++g) {
      CoordinateGroup group = whole_.coupled[g];
      if (!belongs(*slice_, group)) continue;
      part_.groups.push_back(g);
      for (Index& z : group.coordinates) z = moved(z);
      s.coupled.push_back(std::move(group));
    }
  }

  std::size_t add_point(std::size_t point) {
    part_.points.push_back(point);
    PointSlice slice = whole_.points[point];
    for (Index& z : slice.z) z = moved(z);
    part_.system.points.push_back(std::move(slice));
    return part_.system.points.size() - 1;
  }

  const System& whole_;
  Index chain_;
  const ChainSlice* slice_ = nullptr;
  Index own_ = 0;
  DensePart part_{};
};

/// Lays out variables and fronts.
class Planner {
 public:
  Planner(const System& system, const std::vector<std::vector<Index>>& root_columns,
          const StageOptions& options)
      : system_{system}, options_{options}, columns_{root_columns} {
    if (columns_.empty())
      for (const BodySlice& body : system.body_slices) {
        columns_.emplace_back(static_cast<std::size_t>(body.count));
        std::iota(columns_.back().begin(), columns_.back().end(), body.t - system.first_pose);
      }
  }

  StagePlan plan() {
    plan_.chain_unknowns = system_.first_pose;
    for (const auto& list : columns_)
      for (const Index column : list)
        plan_.root_unknowns = std::max(plan_.root_unknowns, column + 1);
    plan_.pattern.root_first = plan_.chain_unknowns;
    plan_.pattern.root_count = plan_.root_unknowns;
    next_ = plan_.size();
    for (std::size_t i = 0; i < system_.chains.size(); ++i) add_chain(i);
    plan_.dense.push_back(PartMaker(system_, -1).make());
    plan_.pattern.size = next_;
    plan_.auxiliary_pairs = (next_ - plan_.size()) / 2;
    return std::move(plan_);
  }

 private:
  /// Root unknowns of a body, as variables of the pattern.
  std::vector<Index> root_of(Index body) const {
    if (body == 0) return {};
    std::vector<Index> list = columns_[static_cast<std::size_t>(body - 1)];
    for (Index& column : list) column += plan_.chain_unknowns;
    return list;
  }

  void add_chain(std::size_t i) {
    const ChainSlice& slice = system_.chain_slices[i];
    const model::Chain& ends = system_.mechanism.chains[i];
    ChainStages chain;
    chain.from_root = root_of(ends.from);
    chain.to_root = root_of(ends.to);
    chain.staged = has_stage_form(system_, i, options_) &&
                   std::max(chain.from_root.size(), chain.to_root.size()) <= most_root_unknowns;
    chain.joints = joints_with_coordinate(slice);
    chain.first_front = plan_.pattern.front_count();
    plan_.dense.emplace_back();
    if (chain.staged) {
      chain.rank = turns_about_z(system_.chains[i]) ? 1 : 3;
      chain.first = cut(system_, slice, options_.coordinates);
      add_groups(slice, chain);
      add_loads(i, chain);
      add_fronts(i, chain);
    } else {
      plan_.dense.back() = PartMaker(system_, static_cast<Index>(i)).make();
      std::vector<Index> variables;
      append(variables, slice.x, slice.x_count + slice.F_count);
      append(variables, chain.from_root);
      append(variables, chain.to_root);
      add_front(plan_.pattern, variables, true);
    }
    plan_.chains.push_back(std::move(chain));
  }

  void add_groups(const ChainSlice& slice, ChainStages& chain) const {
    for (std::size_t g = 0; g < system_.coupled.size(); ++g) {
      if (!belongs(slice, system_.coupled[g])) continue;
      const Index any = system_.coupled[g].coordinates.front() - slice.x;
      const auto next = std::upper_bound(chain.first.begin(), chain.first.end(), any);
      chain.groups.push_back({next - chain.first.begin() - 1, g});
    }
    std::stable_sort(chain.groups.begin(), chain.groups.end(),
                     [](const StageGroup& a, const StageGroup& b) { return a.stage < b.stage; });
  }

  void add_loads(std::size_t i, ChainStages& chain) const {
    for (std::size_t l = 0; l < system_.loads.size(); ++l) {
      const PointLoad& load = system_.loads[l];
      if (chain_of(system_, load) != static_cast<Index>(i)) continue;
      const auto joints = static_cast<Index>(system_.points[load.point].point.joints.size());
      chain.loads.push_back({l, joints});
    }
    std::stable_sort(chain.loads.begin(), chain.loads.end(),
                     [](const StageLoad& a, const StageLoad& b) { return a.joints > b.joints; });
  }

  /// Order in a front: coordinates, moment and turn that come in, moment that goes out, wrench, poses.
  void add_fronts(std::size_t i, ChainStages& chain) {
    const ChainSlice& slice = system_.chain_slices[i];
    const Index stages = chain.stage_count(), r = chain.rank;
    const bool moves = system_.chains[i].from_moves;
    chain.auxiliary = next_;
    next_ += 2 * r * (moves ? stages : stages - 1);
    for (Index s = 0; s < stages; ++s) {
      const Index own = chain.auxiliary + 2 * r * (moves ? s : s - 1);  // moment, then turn
      const Index first = chain.first[static_cast<std::size_t>(s)];
      std::vector<Index> variables;
      append(variables, slice.x + first, chain.first[static_cast<std::size_t>(s + 1)] - first);
      if (moves || s > 0) append(variables, own, 2 * r);
      if (s + 1 < stages) append(variables, own + 2 * r, r);
      append(variables, slice.F, slice.F_count);
      if (s == 0) append(variables, chain.from_root);
      if (s + 1 == stages) append(variables, chain.to_root);
      add_front(plan_.pattern, variables, s + 1 == stages);
    }
  }

  static void append(std::vector<Index>& list, Index first, Index count) {
    for (Index k = 0; k < count; ++k) list.push_back(first + k);
  }
  static void append(std::vector<Index>& list, const std::vector<Index>& more) {
    list.insert(list.end(), more.begin(), more.end());
  }

  const System& system_;
  StageOptions options_;
  std::vector<std::vector<Index>> columns_;
  StagePlan plan_{};
  Index next_ = 0;
};

}  // namespace

bool has_stage_form(const System& system, std::size_t chain, const StageOptions& options) {
  for (std::size_t s = 0; s < system.line_springs.size(); ++s) {
    const auto [from, to] = chains_of(system, s);
    if (from == static_cast<Index>(chain) || to == static_cast<Index>(chain)) return false;
  }
  for (const PointLoad& load : system.loads)
    if (chain_of(system, load) == static_cast<Index>(chain) &&
        (load.about_one_axis || !is_conservative(system, load)))
      return false;
  const std::vector<Index> first = cut(system, system.chain_slices[chain], options.coordinates);
  for (std::size_t s = 0; s + 1 < first.size(); ++s)
    if (first[s + 1] - first[s] > std::max(options.largest, options.coordinates)) return false;
  return true;
}

bool has_stage_form(const System& system) {
  if (system.redundant > 0 || system.chains_coupled || !system.shapes.empty()) return false;
  return std::all_of(system.loads.begin(), system.loads.end(), [&](const PointLoad& load) {
    return chain_of(system, load) < 0 || is_conservative(system, load);
  });
}

StagePlan plan_stages(const System& system, const std::vector<std::vector<Index>>& root_columns,
                      const StageOptions& options) {
  assert(has_stage_form(system));
  return Planner(system, root_columns, options).plan();
}

}  // namespace springfold::statics
