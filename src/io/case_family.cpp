#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "case_draft.hpp"
#include "hold_draft.hpp"
#include "moved_numbers.hpp"
#include "springfold/core/overloaded.hpp"

namespace springfold::io {
namespace {

/// Parts of the model, and per part the draft that it is built from.
struct MovedDrafts {
  model::MovedParts parts{};
  std::vector<const JointDraft*> laws{}, commands{};
  std::vector<const CoupledDraft*> coupled{};
  std::vector<const LineSpringDraft*> lines{};
  std::vector<const ShapeSpringDraft*> shape_laws{};
  std::vector<const LoadDraft*> loads{};
  std::size_t own_loads =
      0;  ///< so many of the loads are the mechanism's, the others behind them the study's
};

/// Numbers that move, of the mechanism and of the study.
struct MovedNumbers {
  std::vector<NumberId> mechanism{}, study{};
};

/// Which numbers of a table move, and which of these no part has asked for yet.
class Moving {
 public:
  Moving(const std::vector<NumberId>& ids, std::size_t size) : moves_(size, false) {
    for (const NumberId id : ids) moves_[id] = true;
    left_ = moves_;
  }
  /// Does one of these move? They are asked for then.
  bool any(const std::vector<NumberId>& ids) {
    bool found = false;
    for (const NumberId id : ids) {
      found = found || moves_[id];
      left_[id] = false;
    }
    return found;
  }
  bool is_done() const {
    return std::none_of(left_.begin(), left_.end(), [](bool left) { return left; });
  }

 private:
  std::vector<bool> moves_, left_;
};

std::vector<NumberId> numbers_of(const SpringDraft& spring) {
  std::vector<NumberId> ids;
  const auto add = [&ids](const std::vector<NumberId>& more) {
    ids.insert(ids.end(), more.begin(), more.end());
  };
  std::visit(Overloaded{[&](const LinearDraft& s) {
                          add({s.stiffness, s.free});
                        },
                        [&](const OneSidedDraft& s) {
                          add({s.stiffness, s.from});
                        },
                        [&](const PiecewiseLinearDraft& s) {
                          add(s.breakpoints);
                          add(s.stiffnesses);
                          add({s.free, s.preload});
                        },
                        [&](const GapDraft& s) {
                          add({s.stiffness, s.low, s.high});
                        },
                        [&](const StopsDraft& s) {
                          add({s.stiffness, s.free, s.stop_stiffness, s.low, s.high});
                        },
                        [&](const TableDraft& s) {
                          add(s.deformations);
                          add(s.torques);
                          add({s.free});
                        },
                        [&](const PolynomialDraft& s) {
                          add(s.coefficients);
                          add({s.free, s.low, s.high});
                        },
                        [&](const FormulaDraft& s) {
                          for (const auto& [step, id] : s.numbers) add({id});
                          add({s.free, s.low, s.high});
                        },
                        [&](const LogarithmicDraft& s) {
                          add({s.stiffness, s.free});
                          if (s.length) add({*s.length});
                        },
                        [&](const PowerDraft& s) {
                          add({s.force, s.depth, s.exponent, s.from});
                        }},
             spring);
  return ids;
}

void find_in_chain(const ChainDraft& chain, std::size_t number, const std::vector<double>& numbers,
                   Moving& moving, MovedDrafts& found) {
  const std::vector<std::size_t> origins = origins_of(chain, numbers);
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    const auto* joint = std::get_if<JointDraft>(&chain.elements[i].content);
    if (joint == nullptr) continue;
    const auto place = std::find(origins.begin(), origins.end(), i) - origins.begin();
    const model::MovedParts::OfChain at{number, static_cast<std::size_t>(place)};
    if (joint->spring && moving.any(numbers_of(*joint->spring))) {
      found.parts.laws.push_back(at);
      found.laws.push_back(joint);
    }
    if (joint->command && moving.any({*joint->command})) {
      found.parts.commands.push_back(at);
      found.commands.push_back(joint);
    }
  }
}

/// Springs of elastic links stand before those that couple joints.
void find_coupled(const ChainDraft& chain, std::size_t number, std::size_t elastic, Moving& moving,
                  MovedDrafts& found) {
  for (std::size_t i = 0; i < chain.coupled.size(); ++i) {
    const CoupledDraft& spring = chain.coupled[i];
    const bool stiffness = moving.any(spring.stiffness), free = moving.any(spring.free);
    if (!stiffness && !free) continue;
    found.parts.coupled.push_back({number, elastic + i});
    found.coupled.push_back(&spring);
  }
}

void find_loads(const std::vector<LoadDraft>& loads, std::size_t first, Moving& moving,
                MovedDrafts& found) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (!moving.any(loads[i].vector)) continue;
    found.parts.loads.push_back(first + i);
    found.loads.push_back(&loads[i]);
  }
}

std::optional<MovedDrafts> moved_drafts(const MechanismDraft& draft,
                                        const std::vector<LoadDraft>& loads,
                                        const MovedNumbers& moved,
                                        const std::vector<double>& numbers) {
  Moving moving(moved.mechanism, numbers.size());
  const auto last = std::max_element(moved.study.begin(), moved.study.end());
  std::size_t own = last == moved.study.end() ? 0 : *last + 1;
  for (const LoadDraft& load : loads)
    for (const NumberId id : load.vector) own = std::max(own, id + 1);
  Moving of_study(moved.study, own);
  MovedDrafts found{.own_loads = draft.loads.size()};
  const model::Mechanism built = build_mechanism(draft, numbers);
  for (std::size_t c = 0; c < draft.chains.size(); ++c) {
    find_in_chain(draft.chains[c], c, numbers, moving, found);
    find_coupled(draft.chains[c], c,
                 built.chains[c].coupled_springs.size() - draft.chains[c].coupled.size(), moving,
                 found);
  }
  for (std::size_t i = 0; i < draft.springs.size(); ++i) {
    if (!moving.any({draft.springs[i].stiffness, draft.springs[i].free})) continue;
    found.parts.lines.push_back(i);
    found.lines.push_back(&draft.springs[i]);
  }
  for (std::size_t i = 0; i < draft.shape_springs.size(); ++i) {
    const ShapeSpringDraft& spring = draft.shape_springs[i];
    if (!spring.law || !moving.any(numbers_of(*spring.law))) continue;
    found.parts.shape_laws.push_back(i);
    found.shape_laws.push_back(&spring);
  }
  find_loads(draft.loads, 0, moving, found);
  find_loads(loads, draft.loads.size(), of_study, found);
  // Bars may be as long as they are drawn, with the drives where they are commanded.
  const bool moves_bars = !found.commands.empty() && !draft.bars.empty();
  if (!moving.is_done() || !of_study.is_done() || moves_bars) return std::nullopt;
  return found;
}

void put_parts(const MovedDrafts& drafts, const std::vector<double>& numbers,
               const std::vector<double>& own, model::Mechanism& mechanism) {
  const model::MovedParts& parts = drafts.parts;
  const auto joint_at = [&](const model::MovedParts::OfChain& at) -> model::Joint& {
    return std::get<model::Joint>(mechanism.chains[at.chain].elements[at.part]);
  };
  for (std::size_t i = 0; i < parts.laws.size(); ++i)
    joint_at(parts.laws[i]).spring = law_of(*drafts.laws[i]->spring, numbers);
  for (std::size_t i = 0; i < parts.commands.size(); ++i)
    joint_at(parts.commands[i]).command = numbers[*drafts.commands[i]->command];
  for (std::size_t i = 0; i < parts.coupled.size(); ++i) {
    const auto& [chain, number] = parts.coupled[i];
    put_numbers(*drafts.coupled[i], numbers, mechanism.chains[chain].coupled_springs[number]);
  }
  for (std::size_t i = 0; i < parts.lines.size(); ++i) {
    model::LineSpring& line = mechanism.line_springs[parts.lines[i]];
    line.stiffness = numbers[drafts.lines[i]->stiffness];
    line.free = numbers[drafts.lines[i]->free];
  }
  for (std::size_t i = 0; i < parts.shape_laws.size(); ++i)
    mechanism.shape_springs[parts.shape_laws[i]].law = law_of(*drafts.shape_laws[i]->law, numbers);
  for (std::size_t i = 0; i < parts.loads.size(); ++i) {
    const std::size_t number = parts.loads[i];
    const std::vector<double>& from = number < drafts.own_loads ? numbers : own;
    mechanism.loads[number].vector = load_vector_of(*drafts.loads[i], from);
  }
}

/// Formulas to be evaluated again, in order, where one parameter has another value.
struct MovedFormulas {
  std::vector<Update> parameters{}, mechanism{}, study{};
  std::optional<MovedDrafts> parts{};  ///< where nothing else depends on them
};

std::vector<NumberId> targets_of(const std::vector<Update>& updates) {
  std::vector<NumberId> targets;
  for (const Update& update : updates) targets.push_back(update.target);
  return targets;
}

/// All numbers of a case, of which most stay where one parameter has another value.
class CaseNumbers {
 public:
  CaseNumbers(std::shared_ptr<const CaseDraft> draft, std::size_t study, int run,
              const Values& parameters)
      : draft_{std::move(draft)}, study_{study}, run_{run}, parameters_{parameters} {
    mechanism_ = draft_->mechanism.numbers.values(draft_->book, parameters_).values;
    own_ = from().numbers.values(draft_->book, parameters_).values;
    all_usable_ =
        std::all_of(parameters_.usable.begin(), parameters_.usable.end(), [](bool u) { return u; });
  }

  analysis::Variant at(const std::vector<std::pair<std::size_t, double>>& values) const {
    std::vector<double> numbers = mechanism_, own = own_;
    std::vector<double> variables = parameters_.values;
    if (values.size() == 1 && all_usable_ && put(values.front(), variables, numbers, own))
      return built(numbers, own, std::move(variables));
    Redefinitions changes = from().changes(run_);
    for (const auto& [number, value] : values) changes[number] = Definition{.constant = value};
    Problems ignored;  // what has no value becomes NaN, and the curve ends there
    Values all = evaluate(draft_->parameters, changes, draft_->book, "", ignored);
    const auto mechanism = draft_->mechanism.numbers.values(draft_->book, all).values;
    own = from().numbers.values(draft_->book, all).values;
    return built(mechanism, own, std::move(all.values));
  }

  const model::MovedParts* moved_parts(std::size_t parameter) const {
    if (!all_usable_) return nullptr;
    const MovedFormulas& moved = moved_by(parameter);
    return moved.parts ? &moved.parts->parts : nullptr;
  }

  bool put_moved(std::size_t parameter, double value, model::Mechanism& mechanism) const {
    const MovedFormulas& moved = moved_by(parameter);
    thread_local std::vector<double> numbers, own, variables;  // for their memory
    numbers = mechanism_;
    own = own_;
    variables = parameters_.values;
    if (!moved.parts || !all_usable_ || !put({parameter, value}, variables, numbers, own))
      return false;
    put_parts(*moved.parts, numbers, own, mechanism);
    return true;
  }

 private:
  const StudyDraft& from() const { return draft_->studies[study_]; }

  const MovedFormulas& moved_by(std::size_t parameter) const {
    const std::scoped_lock lock{busy_};
    const auto known = moved_.find(parameter);
    if (known != moved_.end()) return known->second;
    MovedFormulas moved;
    moved.parameters =
        dependents_of(parameter, draft_->parameters, from().changes(run_), draft_->book);
    std::vector<bool> moves(parameters_.values.size(), false);
    moves[parameter] = true;
    for (const Update& update : moved.parameters) moves[update.target] = true;
    moved.mechanism = draft_->mechanism.numbers.updates_for(moves, draft_->book);
    moved.study = from().numbers.updates_for(moves, draft_->book);
    moved.parts = moved_drafts(draft_->mechanism, from().loads,
                               {targets_of(moved.mechanism), targets_of(moved.study)}, mechanism_);
    return moved_.emplace(parameter, std::move(moved)).first->second;
  }

  /// False where a parameter has no value: nothing that needs it has one then, whatever its formula gives.
  bool put(const std::pair<std::size_t, double>& value, std::vector<double>& variables,
           std::vector<double>& numbers, std::vector<double>& own) const {
    const MovedFormulas& moved = moved_by(value.first);
    variables[value.first] = value.second;
    if (!std::isfinite(value.second)) return false;
    for (const Update& update : moved.parameters) {
      variables[update.target] = draft_->book.value(update.formula, variables);
      if (!std::isfinite(variables[update.target])) return false;
    }
    for (const Update& update : moved.mechanism)
      numbers[update.target] = draft_->book.value(update.formula, variables);
    for (const Update& update : moved.study)
      own[update.target] = draft_->book.value(update.formula, variables);
    return true;
  }

  analysis::Variant built(const std::vector<double>& numbers, const std::vector<double>& own,
                          std::vector<double> parameters) const {
    const auto body = static_cast<std::size_t>(from().body - 1);
    analysis::Variant variant{
        build_mechanism(draft_->mechanism, numbers),
        build_study(from(), draft_->mechanism.bodies[body].task_space, own, draft_->parameters),
        std::move(parameters)};
    for (model::Load& load : build_loads(from().loads, own))
      variant.mechanism.loads.push_back(std::move(load));
    add_holds(from().history, variant.mechanism);
    return variant;
  }

  std::shared_ptr<const CaseDraft> draft_;
  std::size_t study_ = 0;
  int run_ = 0;
  Values parameters_;
  std::vector<double> mechanism_{}, own_{};
  bool all_usable_ = false;
  mutable std::mutex busy_{};
  mutable std::map<std::size_t, MovedFormulas> moved_{};
};

}  // namespace

std::shared_ptr<const analysis::CaseFamily> cases_of(std::shared_ptr<const CaseDraft> draft,
                                                     std::size_t study, int run,
                                                     const Values& parameters) {
  auto family = std::make_shared<analysis::CaseFamily>();
  for (const Parameter& parameter : draft->parameters) family->names.push_back(parameter.name);
  family->values = parameters.values;
  const auto cases = std::make_shared<const CaseNumbers>(std::move(draft), study, run, parameters);
  family->at = [cases](const auto& values) { return cases->at(values); };
  family->moving = {
      .moved = [cases](std::size_t parameter) { return cases->moved_parts(parameter); },
      .put =
          [cases](std::size_t parameter, double value, model::Mechanism& mechanism) {
            return cases->put_moved(parameter, value, mechanism);
          }};
  return family;
}

}  // namespace springfold::io
