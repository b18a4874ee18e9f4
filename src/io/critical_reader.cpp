#include <algorithm>
#include <array>
#include <string_view>

#include "critical_draft.hpp"
#include "further_curves.hpp"
#include "study_draft.hpp"
#include "study_reader.hpp"

namespace springfold::io {
namespace {

using analysis::StudyKind;

const std::vector<std::string> unwanted_words{"limit_point", "loss_of_stability"};
const std::vector<std::string> stability_words{"control", "dead_load"};
const std::vector<std::string> value_words{"smallest", "largest"};

std::vector<std::string> known_keys(StudyKind kind) {
  switch (kind) {
    case StudyKind::critical_curve:
      return {"of", "parameter", "range", "tied"};
    case StudyKind::threshold:
      return {"of", "parameter", "range", "tied", "index", "value"};
    case StudyKind::critical_load:
      return {"of", "parameter", "range", "tied", "index", "values"};
    default:
      return {"parameters", "tied"};
  }
}

std::string critical_example(StudyKind kind) {
  switch (kind) {
    case StudyKind::critical_curve:
      return "a table such as { of = \"LP1\", parameter = \"k\", range = [0, 1] }";
    case StudyKind::threshold:
    case StudyKind::critical_load:
      return "a table such as { of = \"limit_point\", parameter = \"k\", range = [0, 1] }";
    default:
      return "a table such as { parameters = [\"k\"] }";
  }
}

std::vector<NumberId> read_range(StudyKind kind, const TableReader& table, NumberTable& numbers,
                                 Reading& reading) {
  const bool whole_range = kind == StudyKind::threshold || kind == StudyKind::critical_load;
  const Node* node = whole_range ? table.require("range", "[low, high]") : table.find("range");
  if (node == nullptr) return {};
  if (node->kind != Node::Kind::array || node->items.size() != 2) {
    reading.problems.add(node->place, table.key_of("range"),
                         "got " + described(*node) + ", need [low, high]");
    return {};
  }
  const Range rule = whole_range ? Range::finite : Range::maybe_infinite;
  auto ids = read_numbers(table.list("range", "[low, high]"), {rule, ""}, numbers, reading);
  numbers.require_less(ids[0], ids[1], "low < high");
  return ids;
}

/// Is this the label of a special point of a kind that is followed?
bool is_followed(const std::string& label) {
  constexpr std::array<std::string_view, 8> codes{"LP", "BP", "CL", "SA", "KB", "KS", "SC", "UZ"};
  const std::string_view code = std::string_view{label}.substr(0, 2);
  return std::find(codes.begin(), codes.end(), code) != codes.end() && label.size() > 2 &&
         std::all_of(label.begin() + 2, label.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A row of another study's table: "CP1", "EP2".
bool is_row(const std::string& label) {
  const auto is_letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return label.size() > 2 && is_letter(label[0]) && (is_letter(label[1]) || is_digit(label[1])) &&
         std::all_of(label.begin() + 2, label.end(), is_digit);
}

/// What is wrong with the point at which the curve begins; empty: nothing that can be told now.
std::string problem_of_point(const std::string& point) {
  const auto row = curve_row(point);
  if (!row && !is_followed(point))
    return "got \"" + point +
           "\", need LP, BP, CL, SA, KB, KS, SC or UZ and a number, or a row of another curve such "
           "as "
           "\"STUDY/UZ1\"";
  if (row && !is_row(row->label))
    return "got \"" + point +
           "\", need the label of a row behind the name of the study, as in \"STUDY/UZ1\"";
  if (row && row->label.starts_with("UR"))
    return "got \"" + point + "\", where that curve is not resolved, need another row";
  return {};
}

}  // namespace

std::vector<std::string> critical_keys() {
  return {"critical_curve", "threshold", "sensitivity", "critical_load", "design"};
}

CriticalPointDraft read_critical(StudyKind kind, const TableReader& study, NumberTable& numbers,
                                 Reading& reading) {
  CriticalPointDraft draft;
  const std::string name{to_string(kind)};
  for (const std::string& other : critical_keys())
    if (const Node* node = study.find(other); node != nullptr && other != name)
      reading.problems.add(node->place, study.key_of(other),
                           "has no meaning here, need kind = \"" + other + "\" with it");
  if (!analysis::is_of_critical_points(kind) || kind == StudyKind::design) return draft;
  static const Node no_table;
  const bool needed = kind != StudyKind::sensitivity;
  const Node* node = needed ? study.require(name, critical_example(kind)) : study.find(name);
  const Item item{node ? node : &no_table, study.key_of(name)};
  const bool usable = node != nullptr && is_table(item, critical_example(kind), reading);
  const TableReader table{usable ? *node : no_table, item.key, known_keys(kind), reading};
  draft.tied = table.flag("tied", true);
  if (kind == StudyKind::sensitivity) {
    draft.parameters =
        read_texts(table.list("parameters", "a list of names of parameters"), reading);
    for (std::size_t i = 0; i < draft.parameters.size(); ++i)
      parameter_number(draft.parameters[i], table.find("parameters")->place,
                       table.key_of("parameters"), reading.book, reading.problems);
    for (std::size_t i = 0; i < draft.parameters.size(); ++i)
      if (std::count(draft.parameters.begin(), draft.parameters.begin() + static_cast<long>(i),
                     draft.parameters[i]) == 1)
        reading.problems.add(table.find("parameters")->items[i].place,
                             table.key_of("parameters") + "[" + std::to_string(i + 1) + "]",
                             "got \"" + draft.parameters[i] + "\" twice, need different names");
    return draft;
  }
  if (!usable) return draft;
  if (const auto parameter = table.required_text("parameter", "the name of a parameter")) {
    draft.parameter = *parameter;
    parameter_number(*parameter, table.find("parameter")->place, table.key_of("parameter"),
                     reading.book, reading.problems);
  }
  draft.range = read_range(kind, table, numbers, reading);
  if (kind == StudyKind::critical_curve) {
    draft.point = table.required_text("of", "a special point such as \"LP1\"").value_or("");
    const std::string problem = draft.point.empty() ? "" : problem_of_point(draft.point);
    if (!problem.empty())
      reading.problems.add(table.find("of")->place, table.key_of("of"), problem);
    return draft;
  }
  table.require("of", "\"limit_point\" or \"loss_of_stability\"");
  draft.unwanted = table.choice("of", unwanted_words, 0) == 0
                       ? analysis::Unwanted::limit_point
                       : analysis::Unwanted::loss_of_stability;
  draft.stability = table.choice("index", stability_words, 0) == 0
                        ? analysis::StabilityOf::control
                        : analysis::StabilityOf::dead_load;
  if (kind == StudyKind::critical_load) {
    constexpr double usual_values = 61;
    draft.values = table.number("values", {Range::at_least_two, ""}, numbers, usual_values);
    return draft;
  }
  draft.smallest = table.choice("value", value_words, 0) == 0;
  return draft;
}

void connect_curves(std::vector<StudyDraft>& studies) {
  for (StudyDraft& study : studies)
    if (const auto row = curve_row(study.critical.point)) {
      const auto earlier =
          std::find_if(studies.begin(), studies.end(),
                       [&](const StudyDraft& other) { return other.name == row->study; });
      if (earlier != studies.end())
        study.critical.study = static_cast<std::size_t>(earlier - studies.begin());
    }
}

void build_critical(const CriticalPointDraft& draft, const std::vector<double>& numbers,
                    analysis::CriticalPointSettings& settings) {
  settings.point = draft.point;
  settings.parameter = draft.parameter;
  settings.parameters = draft.parameters;
  if (draft.range.size() == 2) {
    settings.low = numbers[draft.range[0]];
    settings.high = numbers[draft.range[1]];
  }
  settings.tied = draft.tied;
  if (draft.values) settings.values = static_cast<int>(numbers[*draft.values]);
  settings.unwanted = draft.unwanted;
  settings.stability = draft.stability;
  settings.smallest = draft.smallest;
}

}  // namespace springfold::io
