#include "summary_words.hpp"

#include "outline.hpp"
#include "result_access.hpp"
#include "springfold/io/results.hpp"
#include "summary_line.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

std::string sweep_heading(const std::string& study, const std::vector<std::string>& parameters,
                          std::size_t runs) {
  std::string list;
  for (const std::string& name : parameters) list += (list.empty() ? "" : ", ") + name;
  return shown(study) + ", " + counted(static_cast<int>(runs), "run") +
         (list.empty() ? "" : " over " + list) + "\n";
}

}  // namespace

std::string outline_lines(const Case& the_case, const StudyResult& result) {
  std::string text;
  for (const std::string& line : outline_of(the_case, result))
    text += std::string(summary_indent, ' ') + shown(line) + "\n";
  return text;
}

std::vector<std::vector<const StudyResult*>> studies_of(const std::vector<StudyResult>& results) {
  std::vector<std::vector<const StudyResult*>> studies;
  for (const StudyResult& result : results) {
    if (result.row) continue;
    if (studies.empty() || studies.back().front()->study != result.study) studies.emplace_back();
    studies.back().push_back(&result);
  }
  return studies;
}

std::string study_lines(const Case& the_case, const std::vector<const StudyResult*>& runs) {
  const PlannedRun* planned = plan_of(the_case, *runs.front());
  std::string text =
      sweep_heading(runs.front()->study,
                    planned == nullptr ? std::vector<std::string>{} : planned->varied, runs.size());
  for (const std::string& line : study_outline(the_case, runs))
    text += std::string(summary_indent, ' ') + shown(line) + "\n";
  return text;
}

std::string sweep_lines(const Case& the_case, const SweepTable& sweep, int planned,
                        const std::vector<StudyResult>& results) {
  if (planned == 0) return {};
  std::string text =
      sweep_heading(sweep.study, sweep.parameters, static_cast<std::size_t>(planned));
  for (const std::string& sentence : sweep_words(the_case, sweep, results))
    for (const std::string& line : wrapped(sentence, table_width - summary_indent))
      text += std::string(summary_indent, ' ') + line + "\n";
  return text;
}

std::string outline_text(const Case& the_case, const std::vector<StudyResult>& results) {
  std::string text;
  for (const auto& runs : studies_of(results))
    text += runs.size() > 1
                ? study_lines(the_case, runs)
                : heading_of(*runs.front()) + "\n" + outline_lines(the_case, *runs.front());
  for (const SweepTable& sweep : the_case.sweeps)
    text += sweep_lines(the_case, sweep, counts_of(the_case, sweep, results).planned, results);
  return text;
}

}  // namespace springfold::io
