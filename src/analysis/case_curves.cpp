#include "case_curves.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/scaling.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

constexpr std::size_t members_kept = 24;

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

/// lambda in the units of the first member.
void rescale(PathRule& rule, double factor) {
  rule.t_rate *= factor;
  rule.rho_rate *= factor;
  rule.W_rate *= factor;
  rule.load_rate *= factor;
}

}  // namespace

continuation::CurvePoint Member::start() const {
  continuation::CurvePoint start;
  start.x = problem->reduce(first.z);
  start.lambda = setup.lambda_start;
  start.piece = first.piece;
  count_negative(*problem, start);
  return start;
}

const QuantityDefinition* Member::quantity(const std::string& name) const {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const auto& q) { return q.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

Study as_curve(const Study& study) {
  Study curve = study;
  curve.kind = StudyKind::force_deflection;
  const std::string& name = study.critical.parameter;
  std::erase_if(curve.until, [&](const Limit& limit) { return limit.quantity == name; });
  std::erase_if(curve.marks, [&](const Mark& mark) { return mark.quantity == name; });
  return curve;
}

CaseCurves::CaseCurves(const Study& study, std::size_t parameter)
    : study_{study},
      parameter_{parameter},
      name_{study.critical.cases->names[parameter]},
      value_{study.critical.cases->values[parameter]},
      scale_{size_of(study.critical, value_)} {
  base_ = make(value_ / scale_, nullptr);
}

std::unique_ptr<Member> CaseCurves::make(double mu, const Member* near) const {
  const CaseFamily& cases = *study_.critical.cases;
  const double value = near == nullptr ? value_ : scale_ * mu;
  const Variant variant = cases.at({{parameter_, value}});
  auto member = std::make_unique<Member>();
  member->mu = mu;
  member->study = as_curve(variant.study);
  std::optional<ParameterFamily> along;
  if (member->study.control == ControlMode::parameter) {
    const auto lambda = number_of(cases, member->study.parameter);
    if (!lambda) return nullptr;
    const auto family = study_.critical.cases;
    along = ParameterFamily{[family, p = parameter_, value, l = *lambda](double v) {
                              const Variant both = family->at({{p, value}, {l, v}});
                              return Situation{both.mechanism, both.study.constant_load, {}};
                            },
                            cases.values[*lambda]};
  }
  Setup& setup = member->setup;
  setup = set_up(variant.mechanism, member->study, along ? &*along : nullptr,
                 near == nullptr ? nullptr : &near->setup);
  if (near == nullptr) {
    member->first = find_start(setup, member->study, member->report);
  } else {
    if (setup.lambda_scale != near->setup.lambda_scale) {
      if (along) return nullptr;
      rescale(setup.rule, near->setup.lambda_scale / setup.lambda_scale);
      setup.lambda_scale = near->setup.lambda_scale;
    }
    if (!solve_near(*member, *near)) return nullptr;
  }
  if (near == nullptr && !member->report.found) return member;
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(member->study.body - 1)];
  setup.rule.t_start = member->first.z.segment(body.t, body.count);
  setup.rule.rho_start = member->first.inputs.rho;
  hold_free_part(member->study, member->first, setup);
  member->problem = std::make_unique<PathProblem>(setup.system, setup.rule);
  member->evaluator = std::make_unique<Evaluator>(*member->problem, member->study, setup.scales);
  member->quantities = quantities_of(member->study, setup.system, setup.scales, setup.lambda_scale,
                                     lambda_unit_of(member->study, setup.system));
  return member;
}

/// The start of a neighbour is the first guess. Commands that are not tied are those of the first member.
bool CaseCurves::solve_near(Member& member, const Member& near) const {
  Study how = member.study;
  how.start.attempts = 1;
  const bool keeps = !study_.critical.tied && how.start.solve == StartSolve::actuators;
  if (keeps) how.start.solve = StartSolve::pose;
  statics::StartProblem problem = start_problem(member.setup, how);
  const Vector guess = problem.z;
  if (near.first.z.size() != guess.size()) return false;
  problem.z = near.first.z;
  if (how.start.solve != StartSolve::pose) {
    const auto& body = member.setup.system.body_slices[static_cast<std::size_t>(how.body - 1)];
    problem.z.segment(body.t, body.count) = guess.segment(body.t, body.count);
  }
  if (keeps) problem.inputs.rho = base_->first.inputs.rho;
  if (how.start.solve == StartSolve::actuators) problem.inputs.rho = near.first.inputs.rho;
  problem.is_neighbour = true;
  member.first = first_equilibrium(member.setup.system, problem);
  member.report.found = member.first.status == statics::StartStatus::found;
  return member.report.found;
}

const Member* CaseCurves::at(double mu) const {
  if (!base_ || !base_->report.found || !std::isfinite(mu)) return nullptr;
  if (mu == base_->mu) return base_.get();
  const Member* near = base_.get();
  for (auto i = recent_.begin(); i != recent_.end(); ++i) {
    if ((*i)->mu == mu) {
      recent_.splice(recent_.begin(), recent_, i);
      return recent_.front().get();
    }
    if (std::abs((*i)->mu - mu) < std::abs(near->mu - mu)) near = i->get();
  }
  auto made = make(mu, near);
  if (!made) return nullptr;
  recent_.push_front(std::move(made));
  if (recent_.size() > members_kept) recent_.pop_back();
  return recent_.front().get();
}

continuation::Family CaseCurves::family() const {
  return {.at = [this](double mu) -> std::optional<continuation::ProblemView> {
            const Member* member = at(mu);
            if (member == nullptr) return std::nullopt;
            return continuation::ProblemView(*member->problem);
          },
          .step = 0x1p-9};
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
