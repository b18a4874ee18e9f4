#include "case_curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "dimensionless_parts.hpp"
#include "settle_units.hpp"
#include "springfold/core/scaling.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

/// Beside those of the last calls, those of a grid that neighbouring places share.
constexpr std::size_t members_kept = 64;

/// Starts of more are remembered: so many, and so many numbers of their matrices.
constexpr double most_starts = 4096, most_start_numbers = 0x1p22;

/// Of differences in mu.
constexpr double family_step = 0x1p-9;

/// Members of the grid of differences are as far apart. Those within it of mu on both sides enclose mu: whether det J keeps its
/// sign along the starts is asked at them.
constexpr double grid_step = 4 * family_step;

/// Natural size of the parameter: its range, or its value.
double size_of(const CriticalPointSettings& settings, double value) {
  const double range = settings.high - settings.low;
  const double size = std::isfinite(range) && range > 0 ? range : std::abs(value);
  return size > 0 ? power_of_two_near(size) : 1;
}

std::optional<std::size_t> number_of(const CaseFamily& cases, const std::string& name) {
  const auto found = std::find(cases.names.begin(), cases.names.end(), name);
  if (found == cases.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - cases.names.begin());
}

/// Springs that are counted from the start pose depend on more than their own numbers.
bool counts_from_start(const model::Mechanism& mechanism) {
  for (const model::Chain& chain : mechanism.chains)
    for (const model::Element& element : chain.elements)
      if (const auto* joint = std::get_if<model::Joint>(&element);
          joint != nullptr && joint->spring_from_start)
        return true;
  return false;
}

}  // namespace

Study as_curve(Study curve) {
  curve.kind = StudyKind::force_deflection;
  const std::string& name = curve.critical.parameter;
  std::erase_if(curve.until, [&](const Limit& limit) { return limit.quantity == name; });
  std::erase_if(curve.marks, [&](const Mark& mark) { return mark.quantity == name; });
  return curve;
}

CaseCurves::CaseCurves(const Study& study, std::size_t parameter, double lambda_unit)
    : study_{study},
      parameter_{parameter},
      name_{study.critical.cases->names[parameter]},
      value_{study.critical.cases->values[parameter]},
      scale_{size_of(study.critical, value_)},
      lambda_unit_{lambda_unit} {
  base_ = make(value_ / scale_, nullptr);
}

/// The set-up that the case with this value has, anew. @param again  the member's own memory is used
/// @param along  of control mode parameter: the family along the path
/// @param way    where the start is a state that earlier studies lead to: the way there
/// @returns false where the case has no such parameter, or a neighbour no start
bool CaseCurves::set_up_anew(Member& member, const Member* near, bool again,
                             model::Mechanism& mechanism, std::optional<ParameterFamily>& along,
                             std::optional<std::string>& way) const {
  const CaseFamily& cases = *study_.critical.cases;
  const double value = near == nullptr ? value_ : scale_ * member.mu;
  Variant variant = cases.at({{parameter_, value}});
  if (near != nullptr && !variant.problem.empty()) {
    why_none_ = std::move(variant.problem);
    return false;
  }
  if (variant.is_in_state) way = variant.way;
  member.study = as_curve(std::move(variant.study));
  mechanism = std::move(variant.mechanism);
  if (member.study.control == ControlMode::parameter) {
    const auto lambda = number_of(cases, member.study.parameter);
    if (!lambda) return false;
    const auto family = study_.critical.cases;
    along = ParameterFamily{[family, p = parameter_, value, l = *lambda](double v) {
                              const Variant both = family->at({{p, value}, {l, v}});
                              return Situation{both.mechanism, both.study.constant_load, {}};
                            },
                            cases.values[*lambda]};
  }
  member.setup =
      set_up(mechanism, member.study, along ? &*along : nullptr,
             near == nullptr ? nullptr : &near->setup, again ? &member.setup.system : nullptr);
  if (!variant.problem.empty()) {
    member.report.message = std::move(variant.problem);
    member.report.where = "start.from";
  }
  return true;
}

/// @param member  set up, not yet solved
void CaseCurves::keep_pattern(const Member& member, model::Mechanism mechanism) const {
  const MovingCase& moving = study_.critical.cases->moving;
  const model::MovedParts* parts = moving.moved ? moving.moved(parameter_) : nullptr;
  if (parts == nullptr || member.study.control == ControlMode::parameter ||
      counts_from_start(mechanism))
    return;
  pattern_ = Pattern{std::move(mechanism), moving.put, member.study, member.setup,
                     statics::places_of(member.setup.system, *parts)};
}

/// What set_up_anew() gives, by changing what the parameter moves. @param again  the member is one of these
/// @returns false where that is not all
bool CaseCurves::put_numbers(Member& member, bool again) const {
  if (!pattern_ || !pattern_->put(parameter_, scale_ * member.mu, pattern_->mechanism))
    return false;
  Setup& setup = member.setup;
  if (again) {
    setup.rule = pattern_->setup.rule;
  } else {
    member.study = pattern_->study;
    setup = pattern_->setup;
  }
  const model::MovedParts& parts = pattern_->places.parts;
  put_dimensionless(pattern_->mechanism, parts, setup.scales, setup.system.mechanism);
  if (!statics::renew(pattern_->places, setup.system)) return false;
  if (!parts.loads.empty())
    setup.rule.symmetric = non_conservative_loads(pattern_->mechanism, member.study).empty();
  return true;
}

/// @param spare  not asked for any more: its memory is used
std::unique_ptr<Member> CaseCurves::make(double mu, const Member* near,
                                         std::unique_ptr<Member> spare) const {
  const bool again = spare != nullptr;
  auto member = again ? std::move(spare) : std::make_unique<Member>();
  member->forget_columns();
  member->mu = mu;
  member->columns_of = base_.get();
  Setup& setup = member->setup;
  model::Mechanism mechanism;
  std::optional<ParameterFamily> along;
  std::optional<std::string> way;
  if (near == nullptr) {
    if (!set_up_anew(*member, nullptr, false, mechanism, along, way)) return nullptr;
    if (!member->report.message.empty()) return member;
    if (way) ways_.emplace(*way, 0);
    const ParameterFamily* const path = along ? &*along : nullptr;
    member->first = find_start(setup, member->study, member->report);
    if (!member->report.found) return member;
    // The units that the curve is traced in, which those of neighbours keep.
    settle_units(mechanism, member->study, path, member->first, setup);
    reach_range(mechanism, member->study, path, member->first, setup);
    if (lambda_unit_ > 1)
      enlarge_lambda_unit(mechanism, member->study, path, lambda_unit_, member->first, setup);
    member->first.factors = start_factors(*member);
  } else {
    if (!put_numbers(*member, again)) {
      if (!set_up_anew(*member, near, again, mechanism, along, way)) return nullptr;
      if (!pattern_ && !way) keep_pattern(*member, std::move(mechanism));
    }
    if (!recall_start(*member) &&
        !(way ? solve_in_state(*member, *way) : solve_near(*member, *near))) {
      why_none_.clear();
      return nullptr;
    }
  }
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(member->study.body - 1)];
  setup.rule.t_start = member->first.z.segment(body.t, body.count);
  setup.rule.rho_start = member->first.inputs.rho;
  hold_free_part(member->study, member->first, setup);
  if (again) {
    member->problem->renew(setup.rule);
    return member;
  }
  // The member keeps the system, and its place.
  const std::shared_ptr<const statics::System> own(std::shared_ptr<void>{}, &setup.system);
  member->problem = std::make_unique<PathProblem>(own, setup.rule);
  return member;
}

bool CaseCurves::keeps_commands(const Study& study) const {
  return !study_.critical.tied && study.start.solve == StartSolve::actuators;
}

/// How starts of members other than the first are found.
StartOptions CaseCurves::start_beside(const Study& study) const {
  StartOptions how = study.start;
  how.attempts = 1;
  if (keeps_commands(study)) how.solve = StartSolve::pose;
  return how;
}

/// The start that belongs to the neighbour's. Where that cannot be told, which is farther away or behind a start that
/// vanishes, the member begins as the case with this value does, whatever the neighbours are; and where that finds nothing,
/// at whatever start is found from the neighbour's. Commands that are not tied are those of the first member.
bool CaseCurves::solve_near(Member& member, const Member& near) const {
  const StartOptions how = start_beside(member.study);
  const bool keeps = keeps_commands(member.study);
  statics::StartProblem problem = start_problem(member.setup, member.study.body, how);
  if (near.first.z.size() != problem.z.size()) return false;
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
  if (keeps) problem.inputs.rho = base_->first.inputs.rho;
  if (how.solve == StartSolve::actuators)
    problem.inputs.rho = near.first.inputs.rho;
  else
    problem.foresight.rho.resize(0);
  const auto is_found = [&](const statics::StartProblem& from) {
    member.first = first_equilibrium(member.setup.system, from, start_work_);
    return member.first.status == statics::StartStatus::found;
  };
  problem.is_neighbour = true;
  member.sheet = near.sheet;
  member.report.found = is_found(problem);
  if (member.report.found) return true;
  member.sheet = ++sheets_;
  problem.is_neighbour = false;
  const auto own = [&] { return start_problem(member.setup, member.study.body, how); };
  member.report.found = (!keeps && is_found(own())) || is_found(problem);
  if (member.report.found) member.first.factors = start_factors(member);
  return member.report.found;
}

/// The start is the state that the earlier studies lead to, whatever the neighbours are.
bool CaseCurves::solve_in_state(Member& member, const std::string& way) const {
  const auto problem = start_problem(member.setup, member.study.body, start_beside(member.study));
  member.sheet = ways_.emplace(way, static_cast<int>(ways_.size())).first->second;
  member.first = first_equilibrium(member.setup.system, problem, start_work_);
  member.report.found = member.first.status == statics::StartStatus::found;
  return member.report.found;
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
    if (member.sheet != near.sheet) return;
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
  if (nodes.size() < most) take(*base_);
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

/// Four members of the grid of differences, two on each side of mu. Where the numbers that the equations are linear in lie
/// on a line there, the equations do too, at any state: two members tell the derivative.
std::optional<double> CaseCurves::line(double mu) const {
  constexpr std::size_t most = 4096;
  if (!pattern_) return std::nullopt;
  const double first = (std::floor(mu / grid_step) - 1) * grid_step;
  auto known = lines_.find(first);
  if (known == lines_.end()) {
    if (lines_.size() >= most) lines_.clear();
    known = lines_.emplace(first, is_line(first, grid_step)).first;
  }
  if (!known->second) return std::nullopt;
  const double last = first + 3 * grid_step;
  return mu - first > last - mu ? first : last;
}

const Member* CaseCurves::at(double mu) const {
  if (!base_ || !base_->report.found || !std::isfinite(mu)) return nullptr;
  if (mu == base_->mu) return base_.get();
  const auto above = recent_.lower_bound(mu);
  if (above != recent_.end() && above->first == mu) {
    calls_.splice(calls_.begin(), calls_, above->second.call);
    return above->second.member.get();
  }
  if (without_start_.contains(mu)) return nullptr;
  const Member* near = base_.get();
  const auto take_nearer = [&](const Member* other) {
    if (std::abs(other->mu - mu) < std::abs(near->mu - mu)) near = other;
  };
  if (above != recent_.end()) take_nearer(above->second.member.get());
  if (above != recent_.begin()) take_nearer(std::prev(above)->second.member.get());
  std::unique_ptr<Member> oldest;
  if (recent_.size() >= members_kept) {
    const bool is_needed = calls_.back() == near->mu;
    const auto old = recent_.find(is_needed ? *std::prev(calls_.end(), 2) : calls_.back());
    oldest = std::move(old->second.member);
    keep_start(*oldest);
    calls_.erase(old->second.call);
    recent_.erase(old);
  }
  auto made = make(mu, near, std::move(oldest));
  if (!made) {
    if (without_start_.size() >= members_kept) without_start_.clear();
    without_start_.emplace(mu, why_none_);
    return nullptr;
  }
  calls_.push_front(mu);
  return recent_.emplace(mu, Recent{std::move(made), calls_.begin()}).first->second.member.get();
}

std::string CaseCurves::why_none(double mu) const {
  const auto known = without_start_.find(mu);
  const bool is_told = known != without_start_.end() && !known->second.empty();
  return "there is no start" + (is_told ? ": " + known->second : std::string{});
}

continuation::Family CaseCurves::family() const {
  return {.at = [this](double mu) -> std::optional<continuation::ProblemView> {
            const Member* member = at(mu);
            if (member == nullptr) return std::nullopt;
            return continuation::ProblemView(*member->problem);
          },
          .step = family_step,
          .line = [this](double mu) { return line(mu); }};
}

continuation::CurvePoint CaseCurves::point_of(const continuation::CriticalPoint& point,
                                              const Piece& piece) {
  return {.s = point.s,
          .x = point.x,
          .lambda = point.lambda,
          .tangent = {point.dx, point.dlambda},
          .piece = piece};
}

}  // namespace springfold::analysis
