#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text.hpp"

namespace springfold::io {
namespace {

constexpr double largest_whole = 9007199254740992.0;  // 2^53: every whole number below is exact
constexpr double largest_count = 1e6, most_segments = 5000;
constexpr double largest_size = 1e100;  // an energy has three factors: their product must be finite

bool is_too_large(Range range, double value) {
  return range != Range::maybe_infinite && std::isfinite(value) && std::abs(value) > largest_size;
}

bool holds(Range range, double value) {
  const bool whole = std::floor(value) == value && value <= largest_whole;
  switch (range) {
    case Range::finite:
      return std::isfinite(value);
    case Range::non_negative:
      return std::isfinite(value) && value >= 0;
    case Range::positive:
      return std::isfinite(value) && value > 0;
    case Range::maybe_infinite:
      return !std::isnan(value);
    case Range::whole:
      return whole && value >= 0;
    case Range::at_least_one:
      return std::isfinite(value) && value >= 1;
    case Range::at_least_two:
      return whole && value >= 2 && value <= largest_count;
    case Range::small_count:
      return whole && value >= 1 && value <= largest_count;
    case Range::segment_count:
      return whole && value >= 1 && value <= most_segments;
  }
  return false;
}

std::string range_in_words(Range range) {
  switch (range) {
    case Range::finite:
      return "a finite number";
    case Range::non_negative:
      return "a number >= 0";
    case Range::positive:
      return "a number > 0";
    case Range::maybe_infinite:
      return "a number, inf or -inf";
    case Range::whole:
      return "a whole number >= 0";
    case Range::at_least_one:
      return "a number >= 1";
    case Range::at_least_two:
      return "a whole number from 2 to 1000000";
    case Range::small_count:
      return "a whole number from 1 to 1000000";
    case Range::segment_count:
      return "a whole number from 1 to 5000";
  }
  return "a number";
}

/// "-0.5" or "\"Kv - 1\" = -0.5".
std::string shown_definition(const Definition& definition, double value) {
  return definition.formula ? definition.shown + " = " + shortest(value) : shortest(value);
}

}  // namespace

std::string need_of(const Rule& rule) {
  return range_in_words(rule.range) + (rule.unit.empty() ? "" : " [" + rule.unit + "]");
}

NumberId NumberTable::add(double constant) {
  entries_.push_back({{.constant = constant}, {.range = Range::maybe_infinite}});
  return entries_.size() - 1;
}

NumberId NumberTable::add(const Definition& definition, const Rule& rule) {
  entries_.push_back({definition, rule});
  return entries_.size() - 1;
}

void NumberTable::require_less(NumberId lower, NumberId upper, const std::string& what) {
  const Definition& at = entries_[upper].definition;
  relations_.push_back({{lower, upper}, false, at.place, at.key, what, {}});
}

void NumberTable::require_nonzero(const std::vector<NumberId>& ids, const Place& place,
                                  const std::string& key, const std::string& what) {
  relations_.push_back({ids, true, place, key, what, {}});
}

void NumberTable::require(const std::vector<NumberId>& ids, const Place& place,
                          const std::string& key,
                          std::function<std::string(const std::vector<double>&)> problem_in,
                          bool infinite) {
  relations_.push_back({ids, false, place, key, "", std::move(problem_in), infinite});
}

Values NumberTable::values(const FormulaBook& book, const Values& parameters) const {
  Values result;
  for (const auto& [definition, rule] : entries_) {
    bool usable = definition.usable;
    if (definition.formula)
      for (const std::size_t i : book.variables_of(*definition.formula))
        usable = usable && parameters.usable[i];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (usable)
      value = definition.formula ? book.value(*definition.formula, parameters.values)
                                 : definition.constant;
    if (usable && !std::isfinite(value))
      for (std::size_t i = definition.parts.size(); i-- > 0;)
        if (!std::isfinite(book.value(definition.parts[i].formula, parameters.values)))
          result.part_at_fault[result.values.size()] = i;
    result.values.push_back(value);
    result.usable.push_back(usable);
  }
  return result;
}

std::string NumberTable::broken(const Relation& relation, const Values& values) const {
  const auto unusable = [&values](NumberId id) { return !values.usable[id]; };
  if (std::any_of(relation.ids.begin(), relation.ids.end(), unusable)) return {};
  if (relation.problem_in) {
    std::vector<double> numbers;
    for (const NumberId id : relation.ids) numbers.push_back(values.values[id]);
    const bool fit = std::all_of(numbers.begin(), numbers.end(), [&relation](double number) {
      return relation.infinite ? !std::isnan(number) : std::isfinite(number);
    });
    return fit ? relation.problem_in(numbers) : "";
  }
  const auto zero = [&values](NumberId id) { return values.values[id] == 0; };
  if (relation.nonzero) {
    const bool all_zero = std::all_of(relation.ids.begin(), relation.ids.end(), zero);
    return all_zero ? "got zeros only, need a vector with a length: " + relation.what : "";
  }
  const double lower = values.values[relation.ids[0]], upper = values.values[relation.ids[1]];
  if (!(lower >= upper)) return {};
  return "got " + shown_definition(entries_[relation.ids[1]].definition, upper) +
         ", need more than " + shortest(lower) + " (" + relation.what + ")";
}

void NumberTable::check(const Values& values, const std::string& when, Problems& problems,
                        std::vector<bool>& reported) const {
  reported.resize(entries_.size() + relations_.size(), false);
  for (NumberId id = 0; id < entries_.size(); ++id) {
    const auto& [definition, rule] = entries_[id];
    const double value = values.values[id];
    const bool too_large = is_too_large(rule.range, value);
    if (reported[id] || !values.usable[id] || (holds(rule.range, value) && !too_large)) continue;
    reported[id] = true;
    if (const auto part = values.part_at_fault.find(id); part != values.part_at_fault.end()) {
      const DefinitionPart& at = definition.parts[part->second];
      problems.add(at.place, at.key,
                   "got " + at.shown + ", which has no finite value, need " + at.need, when);
      continue;
    }
    problems.add(
        definition.place, definition.key,
        "got " + shown_definition(definition, value) + ", need " +
            (too_large ? "at most 1e100 in size, as products of larger numbers are infinite"
                       : need_of(rule) + rule.hint),
        definition.formula ? when : "");
  }
  for (std::size_t i = 0; i < relations_.size(); ++i) {
    const std::string problem = broken(relations_[i], values);
    if (problem.empty() || reported[entries_.size() + i]) continue;
    reported[entries_.size() + i] = true;
    const auto has_formula = [this](NumberId id) {
      return entries_[id].definition.formula.has_value();
    };
    const auto& ids = relations_[i].ids;
    const bool varies = std::any_of(ids.begin(), ids.end(), has_formula);
    problems.add(relations_[i].place, relations_[i].key, problem, varies ? when : "");
  }
}

std::vector<Update> NumberTable::updates_for(const std::vector<bool>& moves,
                                             const FormulaBook& book) const {
  std::vector<Update> updates;
  for (NumberId id = 0; id < entries_.size(); ++id) {
    const auto& formula = entries_[id].definition.formula;
    if (!formula) continue;
    const auto& used = book.variables_of(*formula);
    if (std::any_of(used.begin(), used.end(), [&](std::size_t i) { return moves[i]; }))
      updates.push_back({id, *formula});
  }
  return updates;
}

}  // namespace springfold::io
