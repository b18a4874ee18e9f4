// Is a mechanism still one that may be given, all along a moved parameter? Private to analysis.
#pragma once

#include <string>
#include <vector>

#include "quantities.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// The first rule that the case breaks, where values of parameters make it so; empty: none.
std::string broken_rule(const model::Mechanism& mechanism, const Study& study);

/// Part of a range of a parameter in which the case may be given, about the case's own value.
struct RuledRange {
  double low = 0, high = 0;
  std::string below{},
      above{};  ///< the rule that it breaks beyond; empty: the range itself ends there

  bool is_cut() const { return !below.empty() || !above.empty(); }
};

/// An end that breaks a rule is drawn back to behind the outermost value that does not, of some evenly between it and
/// the case's own; rules that are broken only in between cut nothing.
/// @param low, high  finite @param parameter  its number in `cases`
RuledRange range_within_rules(const CaseFamily& cases, std::size_t parameter, double low,
                              double high);

/// The first rule that the case breaks with this value; empty: none.
std::string broken_rule_at(const CaseFamily& cases, std::size_t parameter, double value);

/// "k = -1 to 0 is left out: the case may not be given there: " and the rule, for each end that is cut off. Low and
/// high are those of the whole range.
std::vector<std::string> words_of_cut(const RuledRange& range, const std::string& parameter,
                                      double low, double high);

/// "beyond k = 0 the case may not be given: " and the rule, for each end that is cut off.
std::vector<std::string> words_of_beyond(const RuledRange& range, const std::string& parameter);

/// The rows of a study that moves a parameter are looked at, up to 256 of them evenly: where a spring law falls that
/// may not, or a number is out of its range, the result has a doubt that names the value nearest to the start.
void doubt_broken_rules(const Study& study, const ParameterFamily& family,
                        const std::vector<QuantityDefinition>& quantities, StudyResult& result);

}  // namespace springfold::analysis
