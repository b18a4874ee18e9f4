#include "parameter_rules.hpp"

#include <algorithm>
#include <cmath>

#include "frozen.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

constexpr std::size_t most_looks = 256;

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

}  // namespace

void doubt_broken_rules(const Study& study, const ParameterFamily& family,
                        const std::vector<QuantityDefinition>& quantities, StudyResult& result) {
  if (!model::problems_in(family.at(family.value).mechanism).empty()) return;
  for (const double value :
       values_of(result, column_of(QuantityDefinition::Kind::lambda, quantities), family.value)) {
    const auto problems = model::problems_in(family.at(value).mechanism);
    if (problems.empty()) continue;
    result.doubts.push_back(
        "at " + study.parameter + " = " + rounded(value) +
        " the mechanism breaks a rule, and beyond it may too: " + problems.front());
    return;
  }
}

}  // namespace springfold::analysis
