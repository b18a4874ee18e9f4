#include "comparison_text.hpp"

#include <cmath>

#include "text.hpp"

namespace springfold::io {
namespace {

std::string signed_rounded(double value, int digits) {
  return (value >= 0 ? "+" : "") + rounded(value, digits);
}

std::string sign_of(Agreement agreement) {
  return agreement == Agreement::equal ? "" : agreement == Agreement::at_least ? ">= " : "<= ";
}

}  // namespace

std::string word_of(Agreement agreement) {
  return agreement == Agreement::equal      ? "equal"
         : agreement == Agreement::at_least ? "at_least"
                                            : "at_most";
}

std::vector<std::string> comparison_cells(const Comparison& comparison) {
  const auto& [expected, ours, holds, is_interrupted] = comparison;
  return {expected.name,
          is_interrupted     ? "not computed"
          : std::isnan(ours) ? "not found"
                             : rounded(ours, 10),
          sign_of(expected.agreement) + rounded(expected.expected, 12),
          std::isnan(ours) || is_interrupted ? "" : signed_rounded(ours - expected.expected, 2),
          rounded(expected.tolerance, 12),
          holds            ? "ok"
          : is_interrupted ? "interrupted"
                           : "NOT OK",
          expected.source};
}

nlohmann::ordered_json comparison_json(const Comparison& comparison) {
  const auto& expected = comparison.expected;
  return {{"name", expected.name},
          {"group", expected.group},
          {"study", expected.study},
          {"run", expected.run},
          {"at", expected.at},
          {"quantity", expected.quantity},
          {"ours", comparison.ours},
          {"reference", expected.expected},
          {"difference", comparison.ours - expected.expected},
          {"tolerance", expected.tolerance},
          {"compare", word_of(expected.agreement)},
          {"holds", comparison.holds},
          {"source", expected.source}};
}

}  // namespace springfold::io
