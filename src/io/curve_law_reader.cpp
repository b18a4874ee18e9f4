// Spring laws that follow a curve: polynomial, formula, logarithm, power.
#include <algorithm>
#include <limits>

#include "bindings.hpp"
#include "law_formula.hpp"
#include "spring_reader.hpp"

namespace springfold::io {
namespace {

/// `range = [low, high]` of the deformation, for a law that is a polynomial or a formula.
template <class Draft>
void read_range(const TableReader& t, const SpringReader& reader, Draft& draft) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  draft.low = reader.numbers.add(-endless);
  draft.high = reader.numbers.add(endless);
  const Node* range = t.find("range");
  if (!range) return;
  const std::string need = "a list of two numbers, low < high [" + reader.units.coordinate + "]";
  const std::vector<Item> items = t.list("range", need);
  if (range->kind == Node::Kind::array && items.size() != 2)
    reader.report(t, "range", "got " + described(*range) + ", need " + need);
  if (items.size() != 2) return;
  const Rule rule{Range::maybe_infinite, reader.units.coordinate};
  draft.low = read_number(items[0], rule, reader.numbers, reader.reading);
  draft.high = read_number(items[1], rule, reader.numbers, reader.reading);
  reader.numbers.require_less(draft.low, draft.high, "low < high");
}

/// The law's own rules, once the numbers are known: does it rise, has it a value?
template <class Draft>
void require_usable(const SpringReader& reader, const Draft& draft, std::vector<NumberId> ids) {
  ids.insert(ids.end(), {draft.free, draft.low, draft.high});
  reader.numbers.require(
      ids, reader.item.node->place, reader.item.key,
      [draft, ids](const std::vector<double>& values) -> std::string {
        std::vector<double> numbers;
        for (std::size_t i = 0; i < ids.size(); ++i) {
          numbers.resize(std::max(numbers.size(), ids[i] + 1));
          numbers[ids[i]] = values[i];
        }
        if (!(numbers[draft.low] < numbers[draft.high])) return {};  // already reported
        const auto problems = model::problems_in(law_of(draft, numbers));
        return problems.empty() ? std::string{} : problems.front();
      },
      true);
}

}  // namespace

SpringDraft read_polynomial(const SpringReader& reader) {
  const TableReader t = reader.table({"coefficients", "free", "range", "falling"});
  const std::string need =
      "a list of numbers: torque = c0 + c1 u + c2 u^2 + ... with u = coordinate - free";
  PolynomialDraft draft{.free = reader.free(t), .falling = t.truth("falling", false)};
  const Node* list = t.require("coefficients", need);
  draft.coefficients = read_numbers(t.list("coefficients", need), {Range::finite, ""},
                                    reader.numbers, reader.reading);
  constexpr std::size_t most = 100;
  if (list && list->kind == Node::Kind::array &&
      (draft.coefficients.empty() || draft.coefficients.size() > most))
    reader.report(t, "coefficients",
                  "got " + described(*list) + ", need 1 to " + std::to_string(most) + " numbers");
  read_range(t, reader, draft);
  if (draft.coefficients.size() <= most) require_usable(reader, draft, draft.coefficients);
  return draft;
}

SpringDraft read_formula_law(const SpringReader& reader) {
  const TableReader t = reader.table({"formula", "free", "range", "falling"});
  FormulaDraft draft{.free = reader.free(t), .falling = t.truth("falling", false)};
  read_range(t, reader, draft);
  const std::string need =
      "a text such as \"k*u + k3*u^3\" with u = coordinate - free [" + reader.units.torque + "]";
  const Node* node = t.find("formula");
  const auto text = t.required_text("formula", need);
  if (!text) return draft;
  const auto refuse = [&](const std::string& problem) {
    reader.report(t, "formula", "got " + described(*node) + ", need " + need + ": " + problem);
  };
  const auto& parameters = reader.reading.book.variables();
  if (std::find(parameters.begin(), parameters.end(), "u") != parameters.end())
    refuse("u is also a parameter of the case, which needs another name");
  if (node->bindings && node->bindings->find("u"))
    refuse("u is also an index or a name of the template, which needs another name");
  const std::string bound = node->bindings ? with_bindings(*text, *node->bindings) : *text;
  LawFormula law = read_law_formula(bound, "u");
  if (!law.problem.empty()) {  // what was read of it is no formula
    refuse(law.problem);
    return draft;
  }
  draft.formula = std::move(law.formula);
  std::vector<NumberId> ids;
  for (const auto& [step, part] : law.numbers) {
    const FormulaBook::Added added = reader.reading.book.add(part);
    if (!added.id) refuse(added.problem);
    const Definition definition{.formula = added.id,
                                .usable = added.id.has_value(),
                                .shown = "\"" + part + "\"",
                                .place = node->place,
                                .key = t.key_of("formula")};
    ids.push_back(reader.numbers.add(definition, {Range::finite, ""}));
    draft.numbers.emplace_back(step, ids.back());
  }
  require_usable(reader, draft, std::move(ids));
  return draft;
}

SpringDraft read_logarithmic(const SpringReader& reader) {
  const TableReader t = reader.table({"stiffness", "length", "free"});
  LogarithmicDraft draft{.stiffness = reader.stiffness(t, "stiffness"), .free = reader.free(t)};
  if (!reader.units.has_length || t.has("length"))
    draft.length =
        t.required_number("length", {Range::positive, reader.units.coordinate}, reader.numbers);
  return draft;
}

SpringDraft read_power(const SpringReader& reader) {
  const TableReader t = reader.table({"force", "depth", "exponent", "from", "side"});
  PowerDraft draft{
      .force =
          t.required_number("force", {Range::non_negative, reader.units.torque}, reader.numbers),
      .depth = t.number("depth", {Range::positive, reader.units.coordinate}, reader.numbers, 1),
      .exponent = t.required_number("exponent", {Range::at_least_one, ""}, reader.numbers),
      .from = t.number("from", {Range::finite, reader.units.coordinate}, reader.numbers, 0)};
  draft.below = reader.below(t);
  return draft;
}

}  // namespace springfold::io
