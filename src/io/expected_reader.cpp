#include <algorithm>
#include <array>

#include "compared_quantity.hpp"
#include "jump_access.hpp"
#include "plot_reader.hpp"
#include "study_reader.hpp"

namespace springfold::io {
namespace {

const std::vector<std::string> agreement_words{"equal", "at_least", "at_most"};
const std::vector<std::string> side_words{"after", "before"};

/// Whether the point is one that there can be, and `near` is there if and only if it is needed.
void check_point(const TableReader& table, const std::string& at, Reading& reading) {
  const bool is_code = is_event_code(at) || at == any_row || at == "J";
  if (is_code && !table.has("near"))
    reading.problems.add(table.find("at")->place, table.key_of("at"),
                         "got \"" + at + "\", which may be several points: need near = { " +
                             "quantity = value } too, or a number: \"" + at + "1\"");
  if (table.has("near") && !is_code)
    reading.problems.add(table.find("near")->place, table.key_of("near"),
                         "goes with at = \"LP\" and the like, the code of a special point "
                         "without a number, and with at = \"row\"");
  if (at == "start" || at == "end" || is_code || is_event_label(at) || target_number(at) ||
      is_jump_place(at))
    return;
  reading.problems.add(table.find("at")->place, table.key_of("at"),
                       "got \"" + at +
                           "\", need \"start\", \"end\", an event such as \"LP1\", \"target 2\" "
                           "of a study of commands, or the code of an event or \"row\" and `near`");
}

std::vector<NearDraft> read_near(const TableReader& table, NumberTable& numbers, Reading& reading) {
  std::vector<NearDraft> near;
  for (const NamedItem& item :
       named_items(table, "near", "a table such as { deflection = 0.1 }", reading))
    near.push_back({item.name, read_number({item.value, item.name.key}, {}, numbers, reading)});
  if (table.has("near") && near.empty())
    reading.problems.add(table.find("near")->place, table.key_of("near"),
                         "need at least one quantity and its value");
  return near;
}

/// General ones are checked here, other quantities when the mechanism is built.
NamedPlace read_quantity(const TableReader& table, Reading& reading) {
  const auto name = table.required_text("quantity", "a quantity such as \"force\" or \"count.LP\"");
  if (!name) return {};
  const Place place = table.find("quantity")->place;
  const std::string prefix = "count.";
  if (const std::string column = jump_column(*name); column != *name)
    return column.empty() ? NamedPlace{} : NamedPlace{column, place, table.key_of("quantity")};
  if (is_general_quantity(*name)) return {};
  if (!name->starts_with(prefix)) return {*name, place, table.key_of("quantity")};
  std::vector<std::string> known;
  for (const std::string& general : general_quantities())
    if (general.starts_with(prefix)) known.push_back(general.substr(prefix.size()));
  reading.problems.add(place, table.key_of("quantity"),
                       "got \"" + *name + "\", need count. and one of " + choices(known));
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

ExpectedDraft read_wanted(const TableReader& table, Reading& reading) {
  ExpectedDraft draft;
  ExpectedValue& value = draft.value;
  value.at = table.text("at").value_or("start");
  if (table.has("at") || table.has("near")) check_point(table, value.at, reading);
  draft.near = read_near(table, draft.numbers, reading);
  draft.quantity = read_quantity(table, reading);
  if (const auto quantity = table.text("quantity")) value.quantity = *quantity;
  if (const auto per = table.text("per")) {
    value.per = *per;
    draft.per = {*per, table.find("per")->place, table.key_of("per")};
  }
  if (table.has("side"))
    value.side = table.choice("side", side_words, 0) == 1 ? Side::before : Side::after;
  draft.factor = table.number("factor", {}, draft.numbers, 1);
  return draft;
}

std::vector<ExpectedDraft> read_expected(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies, Reading& reading) {
  static const std::vector<std::string> keys{
      "name", "group", "study",    "run",    "at",     "near",      "quantity",
      "per",  "side",  "expected", "factor", "source", "tolerance", "compare"};
  std::vector<ExpectedDraft> drafts;
  for (const Item& item : tables) {
    const TableReader table{*item.node, item.key, keys, reading};
    ExpectedDraft draft = read_wanted(table, reading);
    ExpectedValue& value = draft.value;
    value.name = table.required_text("name", "a name").value_or("");
    value.group = table.text("group").value_or("");
    value.source = table.text("source").value_or("");
    value.agreement = std::array{Agreement::equal, Agreement::at_least,
                                 Agreement::at_most}[table.choice("compare", agreement_words, 0)];
    draft.expected = table.required_number("expected", {}, draft.numbers);
    draft.tolerance = table.required_number("tolerance", {Range::non_negative, ""}, draft.numbers);
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
