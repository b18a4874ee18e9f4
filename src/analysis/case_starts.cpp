// Starts of the curves of a family: from neighbours, from earlier studies, remembered, or none.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "case_curves.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

/// Starts of more are remembered: so many, and so many numbers of their matrices.
constexpr double most_starts = 4096, most_start_numbers = 0x1p22;

}  // namespace

/// Asked where starts are looked for beside others only.
bool CaseCurves::starts_move_freely() const {
  if (!starts_move_freely_)
    starts_move_freely_ =
        base_ && base_->report.found && base_->evaluator().zero_modes(base_->start()) > 0;
  return *starts_move_freely_;
}

bool CaseCurves::keeps_commands(const Study& study) const {
  return !study_.critical.tied && study.start.solve == StartSolve::actuators;
}

/// Under a load, where drives are, or where a parameter of the case is driven, the start enters the equations as the
/// origin of the pose alone.
bool CaseCurves::counts_from_one_origin(const Study& study) {
  return study.control == ControlMode::load || study.control == ControlMode::actuator ||
         study.control == ControlMode::parameter;
}

/// How starts of members other than the first are found.
StartOptions CaseCurves::start_beside(const Study& study) const {
  StartOptions how = study.start;
  how.attempts = 1;
  if (keeps_commands(study)) how.solve = StartSolve::pose;
  return how;
}

bool CaseCurves::solve(Member& member, const statics::StartProblem& problem) const {
  member.first = first_equilibrium(member.setup.system, problem, start_work_);
  member.report.found = member.first.status == statics::StartStatus::found;
  return member.report.found;
}

/// As the case with this value begins, whatever the neighbours are: with as many attempts, and from where the loads let
/// its guess sink. Commands that are not tied are those of the first member.
bool CaseCurves::solve_by_itself(Member& member) const {
  StartOptions how = start_beside(member.study);
  how.attempts = member.study.start.attempts;
  statics::StartProblem problem = start_problem(member.setup, member.study.body, how);
  if (keeps_commands(member.study) && base_) problem.inputs.rho = base_->first.inputs.rho;
  return solve(member, problem);
}

bool CaseCurves::start_enters_equations() const {
  return !counts_from_one_origin(study_) || start_beside(study_).solve != StartSolve::pose;
}

/// What a start beside a neighbour's is sought from.
std::optional<statics::StartProblem> CaseCurves::problem_beside(const Member& member,
                                                                const Member& near) const {
  const StartOptions how = start_beside(member.study);
  statics::StartProblem problem = start_problem(member.setup, member.study.body, how);
  if (near.first.z.size() != problem.z.size()) return std::nullopt;
  problem.foresight = foresight(member.mu, near);
  const auto& body =
      member.setup.system.body_slices[static_cast<std::size_t>(member.study.body - 1)];
  if (how.solve != StartSolve::pose) {
    const Vector given = problem.z.segment(body.t, body.count);
    problem.z = near.first.z;
    problem.z.segment(body.t, body.count) = given;
    if (problem.foresight.z.size() > 0) problem.foresight.z.segment(body.t, body.count) = given;
  } else {
    problem.z = near.first.z;
  }
  if (keeps_commands(member.study)) problem.inputs.rho = (base_ ? *base_ : near).first.inputs.rho;
  if (how.solve == StartSolve::actuators)
    problem.inputs.rho = near.first.inputs.rho;
  else
    problem.foresight.rho.resize(0);
  return problem;
}

/// The start that belongs to the neighbour's; false where that cannot be told.
bool CaseCurves::solve_beside(Member& member, const Member& near) const {
  auto problem = problem_beside(member, near);
  if (!problem) return false;
  problem->is_neighbour = true;
  member.sheet = near.sheet;
  return solve(member, *problem);
}

/// A member on the way to another one, with its start alone.
std::unique_ptr<Member> CaseCurves::on_the_way(double mu, const Member& near) const {
  auto member = std::make_unique<Member>();
  member->mu = mu;
  model::Mechanism mechanism;
  std::optional<ParameterFamily> along;
  std::optional<std::string> way;
  if (!put_numbers(*member, false) && !set_up_anew(*member, &near, false, mechanism, along, way))
    return nullptr;
  if (way || !solve_beside(*member, near)) return nullptr;
  member->first.factors = start_factors(*member);
  return member;
}

/// Follows the neighbour's start to the member, in steps that are short enough for each to be told from the one before.
/// @returns false where it vanishes on the way: then it does so on every longer way as well
bool CaseCurves::walk_to(Member& member, const Member& near) const {
  constexpr int most_steps = 4096;
  constexpr double shortest =
      0x1p-20;  // of the way: so near a start is to where it vanishes, and is followed
  const double way = member.mu - near.mu;
  const auto known = vanished_.find({near.sheet, way > 0});
  if (known != vanished_.end() && (way > 0) == (member.mu >= known->second)) return false;
  std::unique_ptr<Member> here;
  double gone = 0, step = 0.5;
  bool may_grow = false;  // not just behind a step that was too long
  for (int i = 0; i < most_steps && step >= shortest; ++i) {
    const Member& from = here ? *here : near;
    const bool is_last = gone + step >= 1;
    if (is_last && solve_beside(member, from)) return true;
    auto next = is_last ? nullptr : on_the_way(near.mu + (gone + step) * way, from);
    const bool is_told = next != nullptr;
    if (is_told) {
      here = std::move(next);
      gone += step;
      if (may_grow) step *= 2;
    } else {
      step /= 2;
    }
    may_grow = is_told;
  }
  if (step < shortest) vanished_.insert_or_assign({near.sheet, way > 0}, member.mu);
  return false;
}

/// Behind a start that vanishes the member begins as the case with this value does, however it is come to. That may be
/// the start of the neighbour on the other side; next to that it is.
bool CaseCurves::solve_behind(Member& member, const Member& near) const {
  const Member* outward = base_ != nullptr ? neighbours(member.mu).outward : nullptr;
  if (outward != nullptr && outward->sheet == near.sheet) outward = nullptr;
  const bool is_next = outward != nullptr && std::abs(outward->mu - member.mu) <= grid_step;
  if (is_next && solve_beside(member, *outward)) return true;
  member.sheet = ++sheets_;
  if (keeps_commands(member.study) || !solve_by_itself(member))
    return outward != nullptr && solve_beside(member, *outward);
  if (outward != nullptr) {
    constexpr double one_start = 1e-6;  // starts are known better
    const statics::FirstEquilibrium own = member.first;
    if (!solve_beside(member, *outward) || (member.first.z - own.z).norm() > one_start) {
      member.first = own;
      member.sheet = sheets_;
      member.report.found = true;
    }
  }
  if (!member.first.factors) member.first.factors = start_factors(member);
  return true;
}

/// The start that belongs to the neighbour's, or the one behind it; and where there is none, at whatever start is found
/// from the neighbour's. A neutral start does not follow its neighbour, which solves its equations as well.
bool CaseCurves::solve_near(Member& member, const Member& near) const {
  if (starts_move_freely() && solve_by_itself(member)) {
    member.sheet = near.sheet;
    return true;
  }
  if (solve_beside(member, near)) return true;
  // Curves may begin at a member of others, whose parameter is another one: it is no neighbour.
  if (base_ != nullptr && walk_to(member, near)) return true;
  if (solve_behind(member, near)) return true;
  member.sheet = ++sheets_;
  const auto problem = problem_beside(member, near);
  if (!problem || !solve(member, *problem)) return false;
  member.first.factors = start_factors(member);
  return true;
}

/// The start is the state that the earlier studies lead to, whatever the neighbours are.
bool CaseCurves::solve_in_state(Member& member, const std::string& way) const {
  const auto problem = start_problem(member.setup, member.study.body, start_beside(member.study));
  member.sheet = ways_.emplace(way, static_cast<int>(ways_.size())).first->second;
  return solve(member, problem);
}

/// With commands that are given or kept nothing of the start enters the equations of a load or a driven parameter.
std::optional<statics::Inputs> CaseCurves::inputs_without_start(const Member& member,
                                                                const Member& near) const {
  if (start_enters_equations()) return std::nullopt;
  const StartOptions how = start_beside(member.study);
  statics::Inputs inputs = start_problem(member.setup, member.study.body, how).inputs;
  if (keeps_commands(member.study)) inputs.rho = (base_ ? *base_ : near).first.inputs.rho;
  return inputs;
}

/// Most members are asked for their equations alone: where these need no start it is left open.
bool CaseCurves::leave_start_open(Member& member, const Member& near) const {
  if (!base_) return false;
  auto inputs = inputs_on_line(member);
  member.pose_is_known = inputs && known_line(member.mu)->counted.size() > 0;
  if (!inputs) inputs = inputs_without_start(member, near);
  if (!inputs) return false;
  member.first = {};
  member.first.inputs = std::move(*inputs);
  member.report.found = false;
  member.start_is_open = true;
  return true;
}

/// Special points of the curve may exist where the path has no start, as behind a start that meets its own limit point.
/// @param near  gives the place from which starts beside this one are looked for
/// @returns false where the equations need a start
bool CaseCurves::go_without_start(Member& member, const Member& near) const {
  auto inputs = inputs_without_start(member, near);
  if (!inputs) return false;
  member.first = near.first;
  member.first.inputs = std::move(*inputs);
  member.report.found = false;
  member.sheet = ++sheets_;
  return true;
}

/// The start that was left open, or that there is none.
void CaseCurves::settle_start(Member& member) const {
  const Member& near = nearest(member.mu);
  member.start_is_open = member.pose_is_known = false;
  if (!solve_near(member, near)) go_without_start(member, near);
  member.setup.rule.t_counted = member.counted_from();
  member.problem->count_from(member.setup.rule.t_counted);
}

/// What neighbours are compared with. Long chains have none.
std::shared_ptr<const Lu> CaseCurves::start_factors(const Member& member) const {
  const statics::System& system = member.setup.system;
  if (statics::prefers_stages(system)) return nullptr;
  const auto problem = start_problem(member.setup, member.study.body, start_beside(member.study));
  return factors_at(system, problem, member.first, start_work_);
}

/// By the polynomial through up to four members around mu. Where they stand close together it would magnify their
/// rounding: none nearer to another than half its distance from mu is taken.
statics::Foresight CaseCurves::foresight(double mu, const Member& near) const {
  constexpr std::size_t most = 4;
  std::vector<const Member*> nodes;
  nodes.reserve(most);
  nodes.push_back(&near);
  const auto take = [&](const Member& member) {
    const double away = std::abs(member.mu - mu);
    if (!member.report.found || member.sheet != near.sheet) return;
    const bool apart = std::none_of(nodes.begin(), nodes.end(), [&](const Member* other) {
      return std::abs(other->mu - member.mu) <= 0.5 * away;
    });
    if (apart) nodes.push_back(&member);
  };
  auto above = recent_.lower_bound(mu), below = above;
  while (nodes.size() < most && (above != recent_.end() || below != recent_.begin())) {
    const bool upwards =
        below == recent_.begin() ||
        (above != recent_.end() && above->first - mu < mu - std::prev(below)->first);
    take(upwards ? *(above++)->second.member : *(--below)->second.member);
  }
  if (nodes.size() < most && base_) take(*base_);
  statics::Foresight expected{.z = Vector::Zero(near.first.z.size()),
                              .rho = Vector::Zero(near.first.inputs.rho.size()),
                              .factors = near.first.factors};
  const auto is_beside = [&](double side) {
    return std::any_of(nodes.begin(), nodes.end(), [&](const Member* member) {
      const double away = side * (member->mu - mu);
      return away > 0 && away <= grid_step;
    });
  };
  expected.enclosed = is_beside(1) && is_beside(-1);
  for (const Member* member : nodes) {
    double weight = 1;
    for (const Member* other : nodes)
      if (other != member) weight *= (mu - other->mu) / (member->mu - other->mu);
    if (member->first.z.size() != expected.z.size() ||
        member->first.inputs.rho.size() != expected.rho.size())
      return {.factors = near.first.factors};
    expected.z += weight * member->first.z;
    expected.rho += weight * member->first.inputs.rho;
  }
  return expected;
}

/// What a member costs most is its start, and rows are written where the curve has been.
void CaseCurves::keep_start(Member& member) const {
  if (!member.report.found) return;
  const double n = std::max(1.0, static_cast<double>(member.first.z.size()));
  const double most = std::min(most_starts, most_start_numbers / (n * n));
  if (static_cast<double>(starts_.size()) >= most) starts_.clear();
  starts_.insert_or_assign(member.mu, KnownStart{member.sheet, std::move(member.first)});
}

bool CaseCurves::recall_start(Member& member) const {
  const auto known = starts_.find(member.mu);
  if (known == starts_.end()) return false;
  member.sheet = known->second.sheet;
  member.first = std::move(known->second.first);
  member.report.found = true;
  starts_.erase(known);
  return true;
}

}  // namespace springfold::analysis
