#include "continued_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/continuation/numerics.hpp"
#include "springfold/parameters/imperfection.hpp"
#include "springfold/statics/shapes.hpp"
#include "undefined.hpp"

namespace springfold::analysis {

using continuation::CriticalEvent;
using continuation::CriticalPoint;

namespace {

/// Of events at ends of parts: no event of the caller has it.
constexpr int end_of_part = std::numeric_limits<int>::min() + 1;

/// Problems that are kept: those of differences in the parameter about one point.
constexpr std::size_t problems_kept = 32;

bool is_on_bend(double coordinate, double bend) {
  return std::abs(coordinate - bend) <= continuation::promised_place;
}

}  // namespace

ContinuedLaws::ContinuedLaws(const CaseCurves& curves) : curves_{curves} {
  if (!curves.has_base()) return;
  const statics::System& system = curves.base().setup.system;
  const auto add = [&](const model::CompiledSpring& law, bool of_shape, std::size_t number) {
    for (std::size_t c = 0; c < law.curves.size(); ++c)
      if (!model::bends_of(law.curves[c]).empty())
        laws_.push_back({.of_shape = of_shape, .spring = number, .curve = c});
  };
  for (std::size_t i = 0; i < system.springs.size(); ++i) add(system.springs[i].law, false, i);
  for (std::size_t i = 0; i < system.shapes.size(); ++i) add(system.shapes[i].law, true, i);
  if (laws_.empty()) return;
  curves_.follow_in([this](double mu) -> std::optional<CaseCurves::Followed> {
    const Member* const member = curves_.equations_at(mu);
    Held* const held = member == nullptr ? nullptr : at(mu);
    if (held == nullptr) return std::nullopt;
    if (!held->evaluator)
      held->evaluator =
          std::make_unique<Evaluator>(*held->problem, member->study, member->setup.scales);
    return CaseCurves::Followed{member, held->problem.get(), held->evaluator.get()};
  });
}

ContinuedLaws::~ContinuedLaws() { curves_.follow_in({}); }

std::vector<double> ContinuedLaws::bends_of(const statics::System& system, const Law& law) {
  const model::CompiledSpring& spring = spring_of(system, law);
  if (law.curve >= spring.curves.size()) return {};
  return model::bends_of(spring.curves[law.curve]);
}

void ContinuedLaws::hold(statics::System& system) const {
  for (const Law& law : laws_) {
    auto& curves = spring_of(system, law).curves;
    if (law.curve >= curves.size() || law.part > bends_of(system, law).size()) continue;
    model::SpringCurve& curve = curves[law.curve];
    curve = model::part_of(curve, law.part);
  }
}

ContinuedLaws::Held* ContinuedLaws::at(double mu) const {
  const auto known =
      std::find_if(held_.begin(), held_.end(), [&](const Held& held) { return held.mu == mu; });
  if (known != held_.end()) return &*known;
  const Member* member = curves_.equations_at(mu);
  if (member == nullptr) return nullptr;
  if (held_.size() >= problems_kept) held_.pop_front();
  Held held{.mu = mu, .system = std::make_shared<statics::System>(member->setup.system)};
  hold(*held.system);
  PathRule rule = member->setup.rule;
  if (rule.family)
    rule.family = [this, own = std::move(rule.family)](double lambda) {
      auto of_path = own(lambda);
      hold(of_path.first);
      return of_path;
    };
  held.problem =
      std::make_unique<PathProblem>(std::shared_ptr<const statics::System>(held.system), rule);
  return &held_.emplace_back(std::move(held));
}

continuation::Family ContinuedLaws::family() const {
  continuation::Family family = curves_.family();
  if (!laws_.empty())
    family.at = [this](double mu) -> std::optional<continuation::ProblemView> {
      const Held* held = at(mu);
      if (held == nullptr) return std::nullopt;
      return continuation::ProblemView(*held->problem);
    };
  return family;
}

std::optional<double> ContinuedLaws::bend_of_branch(
    const continuation::CriticalStart& point) const {
  if (point.kind != continuation::CriticalKind::branch_point || point.corank != 1)
    return std::nullopt;
  const auto form = continuation::reduced_form(family(), point, {Vector::Zero(point.x.size()), 1});
  if (!form || form->by_lambda.size() != 1 || !continuation::is_symmetric_point(*form))
    return std::nullopt;
  return form->cubic[0](0, 0) / form->mixed(0, 0);
}

std::optional<ContinuedLaws::Place> ContinuedLaws::place_of(const Law& law,
                                                            const CriticalPoint& point) const {
  const Member* member = curves_.equations_at(point.mu);
  if (member == nullptr) return std::nullopt;
  const PathProblem& problem = *member->problem;
  Place place{.bends = bends_of(problem.system(point.lambda), law)};
  if (law.of_shape) {
    const statics::System& turned = problem.turned(point.x, point.lambda);
    place.coordinate =
        statics::shape_state(turned, law.spring, problem.local(point.x, point.lambda),
                             problem.inputs(point.lambda))
            .own;
  } else {
    const Index at = problem.layout().springs[law.spring].coordinate;
    place.coordinate = problem.local(point.x, point.lambda)[at];
  }
  return std::isfinite(place.coordinate) ? std::optional(std::move(place)) : std::nullopt;
}

void ContinuedLaws::hold_at(const CriticalPoint& point) {
  for (Law& law : laws_)
    if (const auto place = place_of(law, point))
      law.part = static_cast<std::size_t>(
          std::upper_bound(place->bends.begin(), place->bends.end(), place->coordinate) -
          place->bends.begin());
  held_.clear();
}

bool ContinuedLaws::cross_at(const CriticalPoint& point) {
  bool crosses = false;
  for (Law& law : laws_) {
    const auto place = place_of(law, point);
    if (!place) continue;
    if (law.part > 0 && is_on_bend(place->coordinate, place->bends[law.part - 1]))
      --law.part;
    else if (law.part < place->bends.size() &&
             is_on_bend(place->coordinate, place->bends[law.part]))
      ++law.part;
    else
      continue;
    crosses = true;
  }
  held_.clear();
  return crosses;
}

std::vector<CriticalEvent> ContinuedLaws::ends() const {
  std::vector<CriticalEvent> events;
  const auto add = [&](std::size_t law, bool above) {
    const auto within = [this, law, above, part = laws_[law].part](const CriticalPoint& point) {
      const auto place = place_of(laws_[law], point);
      const std::size_t bend = above ? part : part - 1;
      if (!place || bend >= place->bends.size()) return undefined;
      const double over = place->coordinate - place->bends[bend];
      return above ? -over : over;
    };
    events.push_back({.name = "bend",
                      .value = within,
                      .action = continuation::EventAction::stop,
                      .of_place = true,
                      .inside = 1,
                      .tag = end_of_part});
  };
  for (std::size_t i = 0; i < laws_.size(); ++i) {
    const auto count = bends_of(curves_.base().setup.system, laws_[i]).size();
    if (laws_[i].part > 0) add(i, false);
    if (laws_[i].part < count) add(i, true);
  }
  return events;
}

bool ContinuedLaws::is_end(const continuation::CriticalHit& hit) { return hit.tag == end_of_part; }

}  // namespace springfold::analysis
