#include "parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bindings.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

const Definition& definition_of(std::size_t i, const std::vector<Parameter>& parameters,
                                const Redefinitions& changes) {
  const auto changed = changes.find(i);
  return changed == changes.end() ? parameters[i].definition : changed->second;
}

/// Depth-first walk along the formulas.
class Evaluation {
 public:
  Evaluation(const std::vector<Parameter>& parameters, const Redefinitions& changes,
             const FormulaBook& book, const std::string& when, Problems& problems)
      : parameters_{parameters}, changes_{changes}, book_{book}, when_{when}, problems_{problems} {
    const std::size_t n = parameters.size();
    result_.values.assign(n, std::numeric_limits<double>::quiet_NaN());
    result_.usable.assign(n, false);
    state_.assign(n, State::untouched);
  }

  Values run() {
    for (std::size_t i = 0; i < parameters_.size(); ++i) visit(i);
    return std::move(result_);
  }

 private:
  enum class State { untouched, on_the_way, done };

  void visit(std::size_t i) {
    if (state_[i] == State::done) return;
    const Definition& definition = definition_of(i, parameters_, changes_);
    if (state_[i] == State::on_the_way) return report_cycle(i, definition);
    state_[i] = State::on_the_way;
    way_.push_back(i);
    bool usable = definition.usable;
    if (definition.formula) {
      for (const std::size_t j : book_.variables_of(*definition.formula)) {
        visit(j);
        usable = usable && result_.usable[j];
      }
    }
    way_.pop_back();
    state_[i] = State::done;
    if (usable) set(i, definition);
  }

  void set(std::size_t i, const Definition& definition) {
    const double value =
        definition.formula ? book_.value(*definition.formula, result_.values) : definition.constant;
    if (!std::isfinite(value)) {
      problems_.add(definition.place, definition.key,
                    "got " + definition.shown + " = " + shortest(value) + ", need a finite number",
                    when_);
      return;
    }
    result_.values[i] = value;
    result_.usable[i] = true;
  }

  void report_cycle(std::size_t i, const Definition& definition) {
    std::string circle;
    for (auto at = std::find(way_.begin(), way_.end(), i); at != way_.end(); ++at)
      circle += parameters_[*at].name + " -> ";
    problems_.add(definition.place, definition.key,
                  "depends on itself: " + circle + parameters_[i].name, when_);
  }

  const std::vector<Parameter>& parameters_;
  const Redefinitions& changes_;
  const FormulaBook& book_;
  const std::string& when_;
  Problems& problems_;
  Values result_{};
  std::vector<State> state_{};
  std::vector<std::size_t> way_{};
};

}  // namespace

Definition read_definition(const Node& node, const std::string& key, const std::string& need,
                           FormulaBook& book, Problems& problems) {
  Definition definition{.shown = described(node), .place = node.place, .key = key};
  if (node.kind == Node::Kind::number) {
    definition.constant = node.number;
    return definition;
  }
  definition.usable = false;
  if (node.kind != Node::Kind::text) {
    problems.add(node.place, key, "got " + described(node) + ", need " + need + " or a formula");
    return definition;
  }
  for (const WrittenPart& part : written_parts(node)) {
    const FormulaBook::Added added = book.add(part.formula);
    const std::string& part_key = part.key.empty() ? key : part.key;
    const std::string& part_need = part.need.empty() ? need : part.need;
    if (!added.id) {
      problems.add(part.place, part_key,
                   "got " + part.shown + ", need " + part_need + " or a formula: " + added.problem);
      return definition;
    }
    definition.parts.push_back(
        {*added.id, part.shown, part.place, part_key, part_need, part.is_angle});
  }
  const FormulaBook::Added added =
      book.add(node.bindings ? with_bindings(node.text, *node.bindings) : node.text);
  if (!added.id) {
    problems.add(node.place, key,
                 "got " + described(node) + ", need " + need + " or a formula: " + added.problem);
    return definition;
  }
  definition.formula = added.id;
  definition.usable = true;
  return definition;
}

Values evaluate(const std::vector<Parameter>& parameters, const Redefinitions& changes,
                const FormulaBook& book, const std::string& when, Problems& problems) {
  return Evaluation{parameters, changes, book, when, problems}.run();
}

std::vector<Update> dependents_of(std::size_t changed, const std::vector<Parameter>& parameters,
                                  const Redefinitions& changes, const FormulaBook& book) {
  std::vector<Update> updates;
  std::vector<bool> moves(parameters.size(), false);
  moves[changed] = true;
  const auto is_new = [&](std::size_t i) {
    const Definition& definition = definition_of(i, parameters, changes);
    if (moves[i] || !definition.formula) return false;
    const auto& used = book.variables_of(*definition.formula);
    return std::any_of(used.begin(), used.end(), [&](std::size_t j) { return moves[j]; });
  };
  // First what moves at all, then in an order in which everything needed is ready.
  std::vector<std::size_t> waiting;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!is_new(i)) continue;
      moves[i] = grows = true;
      waiting.push_back(i);
    }
  }
  while (!waiting.empty()) {
    const auto is_ready = [&](std::size_t i) {
      const auto& used = book.variables_of(*definition_of(i, parameters, changes).formula);
      return std::none_of(used.begin(), used.end(), [&](std::size_t j) {
        return std::find(waiting.begin(), waiting.end(), j) != waiting.end();
      });
    };
    const auto next = std::find_if(waiting.begin(), waiting.end(), is_ready);
    if (next == waiting.end()) break;  // a cycle: reported by evaluate()
    updates.push_back({*next, *definition_of(*next, parameters, changes).formula});
    waiting.erase(next);
  }
  return updates;
}

}  // namespace springfold::io
