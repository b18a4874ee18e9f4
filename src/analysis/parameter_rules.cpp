#include "parameter_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "frozen.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

constexpr std::size_t most_looks = 256;

/// What a sentence is about that begins with the number of one of these parts; nothing if it does not.
template <typename Part>
const Part* part_of(std::string_view& problem, std::string_view kind,
                    const std::vector<Part>& parts) {
  if (!problem.starts_with(kind)) return nullptr;
  const char* const end = problem.data() + problem.size();
  std::size_t number = 0;
  const auto [at, error] = std::from_chars(problem.data() + kind.size(), end, number);
  if (error != std::errc{} || at == end || *at != ']' || number == 0 || number > parts.size())
    return nullptr;
  problem = {at + 1, end};
  return &parts[number - 1];
}

/// Sentences of problems_in() begin with the number of the part in the mechanism, which a case may have written
/// otherwise: a bar may be a spring between points. They are told with its name, by which results speak of it.
std::string with_name(const model::Mechanism& mechanism, const std::string& problem) {
  std::string_view rest{problem};
  std::string name;
  if (const auto* body = part_of(rest, "body[", mechanism.bodies)) name = body->name;
  if (const auto* load = part_of(rest, "load[", mechanism.loads)) name = load->name;
  if (const auto* line = part_of(rest, "spring[", mechanism.line_springs)) name = line->name;
  if (const auto* shape = part_of(rest, "shape[", mechanism.shape_springs)) name = shape->name;
  if (const auto* chain = part_of(rest, "chain[", mechanism.chains)) {
    name = chain->name;
    std::string_view behind = rest;
    const model::Element* element = part_of(behind, ".elements[", chain->elements);
    const auto* joint = element != nullptr ? std::get_if<model::Joint>(element) : nullptr;
    if (joint != nullptr && !joint->name.empty()) {
      name += "." + joint->name;
      rest = behind;
    }
  }
  return name.empty() ? problem : name + std::string{rest};
}

/// The first rule that a mechanism breaks, with the part's name; empty: none.
std::string first_problem(const model::Mechanism& mechanism) {
  const std::vector<std::string> problems = model::problems_in(mechanism);
  return problems.empty() ? "" : with_name(mechanism, problems.front());
}

/// Values of the parameter in the rows, each once, the nearest to the start first.
std::vector<double> values_of(const StudyResult& result, std::size_t lambda, double start) {
  std::vector<double> values;
  for (const Branch& branch : result.branches)
    for (const Sample& sample : branch.samples) values.push_back(sample.values[lambda]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<double> some;
  const std::size_t step = values.size() / most_looks + 1;
  for (std::size_t i = 0; i < values.size(); i += step) some.push_back(values[i]);
  if (!values.empty()) some.push_back(values.back());
  std::stable_sort(some.begin(), some.end(), [start](double a, double b) {
    return std::abs(a - start) < std::abs(b - start);
  });
  return some;
}

/// Between the case's own value and an end of a range so many more are asked.
constexpr int looks_between = 8;

/// Rules of the case's numbers, for values of one parameter.
class RulesOverParameter {
 public:
  RulesOverParameter(const CaseFamily& cases, std::size_t parameter)
      : cases_{cases},
        parameter_{parameter},
        own_{cases.values[parameter]},
        mechanism_{cases.at({{parameter, own_}}).mechanism},
        in_place_{cases.moving.moved && cases.moving.moved(parameter) != nullptr} {}

  double own() const { return own_; }
  /// The first rule that is broken; empty: none.
  std::string broken(double value) {
    if (!in_place_ || !cases_.moving.put(parameter_, value, mechanism_))
      mechanism_ = cases_.at({{parameter_, value}}).mechanism;
    return first_problem(mechanism_);
  }

 private:
  const CaseFamily& cases_;
  std::size_t parameter_ = 0;
  double own_ = 0;
  model::Mechanism mechanism_{};
  bool in_place_ = false;
};

/// The last value within the rules on the way from one that is to one that is not. Rules end at short numbers, mostly
/// 0: such a one is taken before the one that halving finds.
double end_of_rules(RulesOverParameter& rules, double good, double bad) {
  constexpr double nearest = 0x1p-46;  // of the way
  constexpr int digits = 12;
  const double from = good, way = std::abs(bad - good);
  while (std::abs(bad - good) > nearest * way) {
    const double middle = good + 0.5 * (bad - good);
    (rules.broken(middle).empty() ? good : bad) = middle;
  }
  double shortest = 0;
  if (std::abs(good) > 2 * nearest * way) {
    const std::string text = rounded(good, digits);
    std::from_chars(text.data(), text.data() + text.size(), shortest);
  }
  const bool on_way =
      (shortest - from) * (bad - from) >= 0 && std::abs(shortest - from) <= std::abs(bad - from);
  return on_way && rules.broken(shortest).empty() ? shortest : good;
}

/// Towards one end: cut where that end breaks a rule, behind the outermost value that is within them. Empty: it is not
/// cut.
std::string cut_towards(RulesOverParameter& rules, double& end) {
  const double way = end - rules.own();
  std::string rule = rules.broken(end);
  if (rule.empty()) return {};
  double bad = end;
  for (int i = looks_between - 1; i >= 0; --i) {
    const double value = rules.own() + way * i / looks_between;
    if (rules.broken(value).empty()) {
      end = end_of_rules(rules, value, bad);
      return rule;
    }
    bad = value;
  }
  return {};
}

}  // namespace

std::string broken_rule(const model::Mechanism& mechanism, const Study& study) {
  if (std::string problem = first_problem(mechanism); !problem.empty()) return problem;
  const std::vector<std::string> problems = problems_in(study, mechanism);
  return problems.empty() ? "" : problems.front();
}

std::string broken_rule_at(const CaseFamily& cases, std::size_t parameter, double value) {
  return RulesOverParameter(cases, parameter).broken(value);
}

RuledRange range_within_rules(const CaseFamily& cases, std::size_t parameter, double low,
                              double high) {
  RuledRange range{.low = low, .high = high};
  RulesOverParameter rules(cases, parameter);
  if (!rules.broken(rules.own()).empty()) return range;
  if (low < rules.own()) range.below = cut_towards(rules, range.low);
  if (high > rules.own()) range.above = cut_towards(rules, range.high);
  return range;
}

std::vector<std::string> words_of_cut(const RuledRange& range, const std::string& parameter,
                                      double low, double high) {
  std::vector<std::string> words;
  const auto say = [&](double from, double to, const std::string& rule) {
    words.push_back(parameter + " = " + rounded(from) + " to " + rounded(to) +
                    " is left out: the case may not be given there: " + rule);
  };
  if (!range.below.empty()) say(low, range.low, range.below);
  if (!range.above.empty()) say(range.high, high, range.above);
  return words;
}

std::vector<std::string> words_of_beyond(const RuledRange& range, const std::string& parameter) {
  std::vector<std::string> words;
  const auto say = [&](double from, const std::string& rule) {
    if (!rule.empty())
      words.push_back("beyond " + parameter + " = " + rounded(from) +
                      " the case may not be given: " + rule);
  };
  say(range.low, range.below);
  say(range.high, range.above);
  return words;
}

void doubt_broken_rules(const Study& study, const ParameterFamily& family,
                        const std::vector<QuantityDefinition>& quantities, StudyResult& result) {
  if (!model::problems_in(family.at(family.value).mechanism).empty()) return;
  for (const double value :
       values_of(result, column_of(QuantityDefinition::Kind::lambda, quantities), family.value)) {
    const std::string problem = first_problem(family.at(value).mechanism);
    if (problem.empty()) continue;
    result.doubts.push_back("at " + study.parameter + " = " + rounded(value) +
                            " the mechanism breaks a rule, and beyond it may too: " + problem);
    return;
  }
}

}  // namespace springfold::analysis
