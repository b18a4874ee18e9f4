#include <algorithm>

#include "plot_reader.hpp"

namespace springfold::io {
namespace {

const std::vector<std::string> event_codes{"LP", "BP", "SA", "CL", "KB", "KS",
                                           "TP", "FM", "UZ", "EP", "UR"};

/// "LP1": a code and a number from 1.
bool is_event_label(const std::string& text) {
  if (text.size() < 3 || text[2] == '0') return false;
  const bool digits =
      std::all_of(text.begin() + 2, text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits &&
         std::find(event_codes.begin(), event_codes.end(), text.substr(0, 2)) != event_codes.end();
}

void check_point(const TableReader& table, const std::string& at, Reading& reading) {
  if (at == "start" || at == "end" || is_event_label(at)) return;
  reading.problems.add(table.find("at")->place, table.key_of("at"),
                       "got \"" + at + "\", need \"start\", \"end\" or an event such as \"LP1\"");
}

/// "count.LP" is checked here, other quantities when the mechanism is built.
NamedPlace read_quantity(const TableReader& table, Reading& reading) {
  const auto name = table.required_text("quantity", "a quantity such as \"force\" or \"count.LP\"");
  if (!name) return {};
  const Place place = table.find("quantity")->place;
  const std::string prefix = "count.";
  if (!name->starts_with(prefix)) return {*name, place, table.key_of("quantity")};
  const std::string code = name->substr(prefix.size());
  if (std::find(event_codes.begin(), event_codes.end(), code) == event_codes.end())
    reading.problems.add(place, table.key_of("quantity"),
                         "got \"" + *name + "\", need count. and one of " + choices(event_codes));
  return {};
}

int read_run(const TableReader& table, const StudyDraft& study, Reading& reading) {
  const Node* node = table.find("run");
  if (!node) return 1;
  const double value = node->number;
  const bool whole = node->kind == Node::Kind::number && value >= 1 && value <= 1e6 &&
                     value == static_cast<int>(value);
  if (whole && (value <= study.runs() || !study.runs_known)) return static_cast<int>(value);
  reading.problems.add(node->place, table.key_of("run"),
                       "got " + described(*node) + ", need the number of a run of \"" + study.name +
                           "\", which has " + std::to_string(study.runs()));
  return 1;
}

}  // namespace

std::vector<ExpectedDraft> read_expected(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies, Reading& reading) {
  static const std::vector<std::string> keys{"name",   "group",    "study",    "run",
                                             "at",     "quantity", "expected", "factor",
                                             "source", "tolerance"};
  std::vector<ExpectedDraft> drafts;
  for (const Item& item : tables) {
    const TableReader table{*item.node, item.key, keys, reading};
    ExpectedDraft draft;
    ExpectedValue& value = draft.value;
    value.name = table.required_text("name", "a name").value_or("");
    value.group = table.text("group").value_or("");
    value.source = table.text("source").value_or("");
    value.at = table.text("at").value_or("start");
    if (table.has("at")) check_point(table, value.at, reading);
    draft.quantity = read_quantity(table, reading);
    if (const auto quantity = table.text("quantity")) value.quantity = *quantity;
    draft.expected = table.required_number("expected", {}, draft.numbers);
    draft.tolerance = table.required_number("tolerance", {Range::non_negative, ""}, draft.numbers);
    draft.factor = table.number("factor", {}, draft.numbers, 1);
    value.study = table.required_text("study", "the name of a study").value_or("");
    if (!value.study.empty())
      draft.study =
          study_number(value.study, {table.find("study"), table.key_of("study")}, studies, reading);
    if (draft.study) value.run = read_run(table, studies[*draft.study], reading);
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

}  // namespace springfold::io
