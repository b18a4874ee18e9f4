#include "case_curves.hpp"

#include <algorithm>
#include <cmath>

#include "dimensionless_parts.hpp"
#include "settle_units.hpp"
#include "springfold/core/scaling.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "start.hpp"
#include "undefined.hpp"

namespace springfold::analysis {
namespace {

/// Beside those of the last calls, those of a grid that neighbouring places share.
constexpr std::size_t members_kept = 32;

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

CaseCurves::CaseCurves(const Study& study, std::size_t parameter, const Member& from,
                       std::vector<std::pair<std::string, double>> held)
    : study_{study},
      parameter_{parameter},
      name_{study.critical.cases->names[parameter]},
      value_{study.critical.cases->values[parameter]},
      scale_{size_of(study.critical, value_)},
      held_{std::move(held)},
      begins_at_member_{true} {
  base_ = make(value_ / scale_, &from);
  if (!base_) without_start_.emplace(value_ / scale_, why_none_);
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
  if (near == nullptr) return true;
  member.setup.rule.lambda_measure = near->setup.rule.lambda_measure;
  const statics::System &own = member.setup.system, &of_others = near->setup.system;
  const bool is_alike =
      own.size == of_others.size && own.switches.size() == of_others.switches.size();
  if (!is_alike) why_none_ = "the mechanism has other unknowns or springs there";
  return is_alike;
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
  member->start_is_open = member->pose_is_known = false;
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
    if (!recall_start(*member) && (way || !leave_start_open(*member, *near)) &&
        !(way ? solve_in_state(*member, *way) : solve_near(*member, *near)) &&
        !go_without_start(*member, *near)) {
      why_none_.clear();
      return nullptr;
    }
  }
  if (near != nullptr && counts_from_one_origin(member->study)) {
    // The origin of the pose's unknowns is the same for all: a start that vanishes moves at any rate before.
    setup.rule.t_start = (base_ ? *base_ : *near).setup.rule.t_start;
    setup.rule.t_counted = member->pose_is_known ? known_line(mu)->counted : member->counted_from();
  } else {
    setup.rule.t_start = member->start_pose();
  }
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

const Member* CaseCurves::at(double mu) const {
  Member* const member = member_at(mu);
  if (member != nullptr && member->start_is_open) settle_start(*member);
  return member != nullptr && member->report.found ? member : nullptr;
}

const Member* CaseCurves::equations_at(double mu) const {
  Member* const member = member_at(mu);
  if (member != nullptr && member->start_is_open && !member->pose_is_known) settle_start(*member);
  return member;
}

/// Of those whose start is known: the nearest ones on both sides.
CaseCurves::Neighbours CaseCurves::neighbours(double mu) const {
  const auto is_known = [](const auto& entry) { return entry.second.member->report.found; };
  const auto middle = recent_.lower_bound(mu);
  const auto above = std::find_if(middle, recent_.end(), is_known);
  const auto below = std::find_if(std::make_reverse_iterator(middle), recent_.rend(), is_known);
  const Member* up = above != recent_.end() ? above->second.member.get() : nullptr;
  const Member* down = below != recent_.rend() ? below->second.member.get() : nullptr;
  const bool base_is_below = base_->mu <= mu;
  Neighbours beside{base_is_below ? down : up, base_is_below ? up : down};
  const bool is_behind_base =
      beside.inward != nullptr &&
      (base_is_below ? beside.inward->mu < base_->mu : beside.inward->mu > base_->mu);
  if (beside.inward == nullptr || is_behind_base) beside.inward = base_.get();
  return beside;
}

/// The neighbour whose start the one at mu belongs to: the nearest one. Where those on both sides are different ones,
/// that on the side of the first member: starts are followed away from it as far as they exist.
const Member& CaseCurves::nearest(double mu) const {
  const auto [inward, outward] = neighbours(mu);
  const bool is_outward = outward != nullptr && outward->sheet == inward->sheet &&
                          std::abs(outward->mu - mu) < std::abs(inward->mu - mu);
  return is_outward ? *outward : *inward;
}

/// A member of another sheet than the neighbour's, between it and mu, that was let go: mu belongs to that one.
std::optional<double> CaseCurves::let_go_between(double mu) const {
  const Member& inward = *neighbours(mu).inward;
  const bool ahead = mu > inward.mu;
  auto known = starts_.lower_bound(mu);
  if (ahead && known == starts_.begin()) return std::nullopt;
  if (ahead) --known;
  const bool is_between =
      known != starts_.end() && (ahead ? known->first > inward.mu : known->first < inward.mu);
  if (!is_between || known->first == mu || known->second.sheet == inward.sheet) return std::nullopt;
  return known->first;
}

Member* CaseCurves::member_at(double mu) const {
  if (!base_ || !(base_->report.found || begins_at_member_) || !std::isfinite(mu)) return nullptr;
  if (mu == base_->mu) return base_.get();
  const auto known = recent_.find(mu);
  if (known != recent_.end()) {
    calls_.splice(calls_.begin(), calls_, known->second.call);
    return known->second.member.get();
  }
  if (without_start_.contains(mu)) return nullptr;
  look_for_line(mu);
  if (const auto between = let_go_between(mu); between && !starts_.contains(mu))
    member_at(*between);
  const Member& near = nearest(mu);
  decltype(recent_)::node_type oldest;  // its memory and that of its call are used again
  std::list<double> call;
  if (recent_.size() >= members_kept) {
    const bool is_needed = calls_.back() == near.mu;
    oldest = recent_.extract(is_needed ? *std::prev(calls_.end(), 2) : calls_.back());
    keep_start(*oldest.mapped().member);
    call.splice(call.begin(), calls_, oldest.mapped().call);
  }
  auto made = make(mu, &near, oldest ? std::move(oldest.mapped().member) : nullptr);
  if (!made) {
    if (without_start_.size() >= members_kept) without_start_.clear();
    without_start_.emplace(mu, why_none_);
    return nullptr;
  }
  if (!oldest) {
    calls_.push_front(mu);
    return recent_.emplace(mu, Recent{std::move(made), calls_.begin()}).first->second.member.get();
  }
  call.front() = mu;
  calls_.splice(calls_.begin(), call);
  oldest.key() = mu;
  oldest.mapped().member = std::move(made);
  return recent_.insert(std::move(oldest)).position->second.member.get();
}

std::string CaseCurves::why_none(double mu) const {
  const auto known = without_start_.find(mu);
  const bool is_told = known != without_start_.end() && !known->second.empty();
  return "there is no start" + (is_told ? ": " + known->second : std::string{});
}

continuation::Family CaseCurves::family() const {
  return {.at = [this](double mu) -> std::optional<continuation::ProblemView> {
            const Member* member = member_at(mu);
            if (member == nullptr) return std::nullopt;
            return continuation::ProblemView(*member->problem);
          },
          .step = step_of_family,
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
