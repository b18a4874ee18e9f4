#include "cycle_access.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::ordered_json;
using analysis::CycleStep;
using analysis::LoadCycle;
using analysis::StudyResult;

const std::string level_word = "level ";

const LoadCycle* cycle_of(const StudyResult& result) {
  return result.snap && result.snap->cycle ? &*result.snap->cycle : nullptr;
}

std::string step_text(const StudyResult& result, const CycleStep& step, const std::string& energy) {
  const std::string lambda =
      "lambda = " + rounded(column_value(result, step.at, "lambda"), summary_digits);
  const std::string place = ", on branch " + std::to_string(step.at.branch);
  if (step.jump == 0)
    return summary_line(step.level == 0 ? "start" : level_word + std::to_string(step.level),
                        lambda + place);
  return summary_line("", "jump J" + std::to_string(step.jump) + " at " + lambda + ", released " +
                              rounded(step.released, summary_digits) + energy + place);
}

}  // namespace

bool is_cycle_place(const std::string& at) {
  if (at == "cycle") return true;
  if (!at.starts_with(level_word)) return false;
  const std::string number = at.substr(level_word.size());
  return !number.empty() && number.size() < 7 && number.front() != '0' &&
         std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

double cycle_value(const ExpectedValue& expected, const StudyResult& result) {
  const LoadCycle* cycle = cycle_of(result);
  if (cycle == nullptr) return nothing;
  const std::string& quantity = expected.quantity;
  if (expected.at != "cycle") {
    const int level = std::stoi(expected.at.substr(level_word.size()));
    for (const CycleStep& step : cycle->steps)
      if (step.level == level && step.jump == 0) {
        if (quantity == "area") return step.area;
        if (quantity == "energy_after") return step.at.energy;
        return column_value(result, step.at, quantity);
      }
    return nothing;
  }
  if (quantity == "jumps") return cycle->jumps;
  if (quantity == "released") return cycle->released;
  if (quantity == "energy_change") return cycle->energy_change;
  if (quantity == "area") return cycle->area;
  if (quantity == "gap") return cycle->gap;
  if (quantity == "loop") return cycle->loop;
  if (quantity == "loop_released") return cycle->loop_released;
  if (quantity == "closed") return cycle->closed_with >= 0 ? 1 : 0;
  if (quantity == "complete") return cycle->end == LoadCycle::End::complete ? 1 : 0;
  return nothing;
}

std::string cycle_lines(const StudyResult& result, const UnitLabels& units) {
  const LoadCycle* cycle = cycle_of(result);
  if (cycle == nullptr) return "";
  const std::string energy = " " + unit_label(analysis::Unit::energy, result.lambda_unit, units);
  std::string text;
  for (const CycleStep& step : cycle->steps) text += step_text(result, step, energy);
  if (cycle->end != LoadCycle::End::complete)
    text += summary_line("cycle", "NOT COMPLETE, on the way to level " +
                                      std::to_string(cycle->level) + ": " + to_string(cycle->end));
  if (cycle->closed_with >= 0)
    text += summary_line(
        "loop", rounded(cycle->loop, summary_digits) + energy + ", released by its jumps " +
                    rounded(cycle->loop_released, summary_digits) + energy + ", difference " +
                    rounded(cycle->loop - cycle->loop_released, 2) + energy);
  text +=
      summary_line("cycle", std::to_string(cycle->jumps) + " jumps released " +
                                rounded(cycle->released, summary_digits) + energy +
                                ", Pi changed by " + rounded(cycle->energy_change, summary_digits) +
                                energy + "; area less both " + rounded(cycle->gap, 2) + energy);
  return text;
}

Json cycle_json(const StudyResult& result) {
  const LoadCycle* cycle = cycle_of(result);
  if (cycle == nullptr) return nullptr;
  Json steps = Json::array();
  for (const CycleStep& step : cycle->steps)
    steps.push_back({{"level", step.level},
                     {"jump", step.jump},
                     {"lambda", column_value(result, step.at, "lambda")},
                     {"branch", step.at.branch},
                     {"potential", step.at.energy},
                     {"released", step.released},
                     {"area", step.area}});
  return {{"end", to_string(cycle->end)},
          {"level", cycle->level},
          {"steps", steps},
          {"jumps", cycle->jumps},
          {"released", cycle->released},
          {"energy_change", cycle->energy_change},
          {"area", cycle->area},
          {"gap", cycle->gap},
          {"closed_with", cycle->closed_with},
          {"loop", cycle->loop},
          {"loop_released", cycle->loop_released}};
}

std::string cycles_csv(const std::vector<StudyResult>& results) {
  const std::vector<std::string> names =
      columns_where(results, [](const StudyResult& result) { return cycle_of(result) != nullptr; });
  if (names.empty()) return "";
  std::string csv = "study,run,label,step,level,jump,to_branch,potential,released,area";
  for (const auto& name : names) csv += "," + csv_text(name);
  csv += "\n";
  for (const auto& result : results) {
    const LoadCycle* cycle = cycle_of(result);
    if (cycle == nullptr) continue;
    for (std::size_t k = 0; k < cycle->steps.size(); ++k) {
      const CycleStep& step = cycle->steps[k];
      csv += csv_text(result.study) + "," + std::to_string(result.run) + "," +
             csv_text(result.label) + "," + std::to_string(k) + "," + std::to_string(step.level) +
             "," + (step.jump > 0 ? "J" + std::to_string(step.jump) : "") + "," +
             std::to_string(step.at.branch) + "," + csv_number(step.at.energy) + "," +
             csv_number(step.released) + "," + csv_number(step.area);
      for (const auto& name : names) csv += "," + csv_number(column_value(result, step.at, name));
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace springfold::io
