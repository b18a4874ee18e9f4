#include "snap_reader.hpp"

#include "csv_points.hpp"

namespace springfold::io {
namespace {

const std::string damping_example = "a table such as { \"leg.knee\" = 0.1 }";

std::vector<JointDampingDraft> read_damping(const TableReader& table, NumberTable& numbers,
                                            Reading& reading) {
  std::vector<JointDampingDraft> list;
  for (const NamedItem& item : named_items(table, "damping", damping_example, reading))
    list.push_back({item.name.name, read_number({item.value, item.name.key}, {Range::positive, ""},
                                                numbers, reading)});
  return list;
}

std::vector<analysis::JointDamping> built(const std::vector<JointDampingDraft>& drafts,
                                          const std::vector<double>& numbers) {
  std::vector<analysis::JointDamping> list;
  for (const JointDampingDraft& draft : drafts) list.push_back({draft.joint, numbers[draft.value]});
  return list;
}

/// A table of the study, or nothing; keys of another kind of study are refused.
TableReader table_of(const TableReader& study, const std::string& name, bool belongs,
                     const std::string& kind, const std::string& example,
                     const std::vector<std::string>& known, Reading& reading) {
  static const Node no_table;
  const Node* node = study.find(name);
  const bool is_table = node != nullptr && node->kind == Node::Kind::table;
  if (node != nullptr && !belongs)
    reading.problems.add(node->place, study.key_of(name),
                         "has no meaning here, need kind = \"" + kind + "\" with it");
  else if (node != nullptr && !is_table)
    reading.problems.add(node->place, study.key_of(name),
                         "got " + described(*node) + ", need " + example);
  return {is_table && belongs ? *node : no_table, study.key_of(name), known, reading};
}

/// `inertia = true`, or a table of settings, which means true.
void read_inertia(const TableReader& snap, NumberTable& numbers, Reading& reading,
                  SnapDraft& draft) {
  static const Node no_table;
  const std::string need = "true, or a table such as { damping_ratio = 0.05 }";
  const Node* node = snap.find("inertia");
  const bool is_settings = node != nullptr && node->kind == Node::Kind::table;
  const bool is_truth = node != nullptr && node->kind == Node::Kind::boolean;
  if (node != nullptr && !is_settings && !is_truth)
    reading.problems.add(node->place, snap.key_of("inertia"),
                         "got " + described(*node) + ", need " + need);
  draft.has_inertia = is_settings || (is_truth && node->number != 0);
  const TableReader table{is_settings ? *node : no_table,
                          snap.key_of("inertia"),
                          {"damping_ratio", "damping"},
                          reading};
  draft.damping_ratio = table.number("damping_ratio", {Range::positive, ""}, numbers,
                                     analysis::InertialSettings{}.damping_ratio);
  draft.inertial_damping = read_damping(table, numbers, reading);
  if (table.has("damping_ratio") && table.has("damping"))
    reading.problems.add(
        table.find("damping_ratio")->place, table.key_of("damping_ratio"),
        "goes with the dampers of the overdamped motion, need either it or damping");
}

/// Levels in a file, one per line.
std::vector<NumberId> read_level_file(const TableReader& table, NumberTable& numbers,
                                      Reading& reading) {
  std::vector<NumberId> levels;
  const auto name = table.required_text("file", "the name of a file beside the case");
  const Node* node = table.find("file");
  if (!name || !reading.files) return levels;
  const auto text = reading.files(*name, node->place, table.key_of("file"));
  if (!text) return levels;
  const std::size_t before = reading.problems.size();
  for (const CsvNumber& level : read_csv_numbers(*text, "a level of lambda", reading.problems))
    levels.push_back(numbers.add({.constant = level.value,
                                  .shown = "",
                                  .place = {text->shown_name, level.line, 1},
                                  .key = table.key_of("file")},
                                 {Range::finite, ""}));
  if (levels.empty() && reading.problems.size() == before)
    reading.problems.add(node->place, table.key_of("file"),
                         "has no levels, need one number per line");
  return levels;
}

void read_levels(const TableReader& study, NumberTable& numbers, Reading& reading,
                 SnapDraft& draft) {
  const std::string example = "a table such as { levels = [1, -1], times = 2 }";
  const TableReader table = table_of(study, "cycle", draft.is_cycle, cycle_kind, example,
                                     {"levels", "file", "times"}, reading);
  const std::string need = "a list of values of lambda";
  if (table.has("levels") && table.has("file"))
    reading.problems.add(table.find("file")->place, table.key_of("file"),
                         "either levels or file, not both");
  if (table.has("file"))
    draft.levels = read_level_file(table, numbers, reading);
  else
    draft.levels = read_numbers(table.list("levels", need), {}, numbers, reading);
  draft.times =
      table.number("times", {Range::small_count, ""}, numbers, analysis::CycleSettings{}.times);
  if (draft.is_cycle && !study.has("cycle") && !study.is_misspelt("cycle"))
    study.require("cycle", example);
  else if (draft.is_cycle && study.has("cycle") && draft.levels.empty() && !table.has("levels") &&
           !table.has("file"))
    table.require("levels", need + ", or file");
}

void read_transitions(const TableReader& study, NumberTable& numbers, Reading& reading,
                      SnapDraft& draft) {
  const TableReader table = table_of(study, "transitions", draft.is_transitions, transitions_kind,
                                     "a table such as { search_at = [0] }",
                                     {"search_at", "barriers_at", "starts", "maximum"}, reading);
  const analysis::TransitionSettings defaults;
  const std::string need = "a list of values of lambda";
  draft.search_at = read_numbers(table.list("search_at", need), {}, numbers, reading);
  draft.barriers_at = read_numbers(table.list("barriers_at", need), {}, numbers, reading);
  draft.search_starts = table.number("starts", {Range::whole, ""}, numbers, defaults.starts);
  draft.maximum = table.number("maximum", {Range::small_count, ""}, numbers, defaults.maximum);
}

}  // namespace

SnapDraft read_snap(const TableReader& study, NumberTable& numbers, Reading& reading) {
  static const Node no_table;
  const analysis::SnapSettings defaults;
  const std::string need = "true, or a table such as { starts = 32 }";
  SnapDraft draft;
  const Node* kind = study.find("kind");
  const auto is = [kind](const char* word) {
    return kind != nullptr && kind->kind == Node::Kind::text && kind->text == word;
  };
  draft.is_cycle = is(cycle_kind);
  draft.is_transitions = is(transitions_kind);
  draft.is_kind = is(snap_kind) || draft.is_cycle || draft.is_transitions;
  draft.on = draft.is_kind;
  const Node* node = study.find("snap");
  const bool is_settings = node != nullptr && node->kind == Node::Kind::table;
  if (node != nullptr && node->kind == Node::Kind::boolean) {
    draft.on = node->number != 0;
    if (draft.is_kind && !draft.on)
      reading.problems.add(node->place, study.key_of("snap"),
                           "got false, but kind = \"" + kind->text + "\" is about jumps");
  } else if (node != nullptr && !is_settings) {
    reading.problems.add(node->place, study.key_of("snap"),
                         "got " + described(*node) + ", need " + need);
  }
  draft.on = draft.on || is_settings;
  const TableReader table{is_settings ? *node : no_table,
                          study.key_of("snap"),
                          {"starts", "seed", "damping", "inertia"},
                          reading};
  // Jumps between many states are searched around their own landing only.
  draft.starts = table.number("starts", {Range::whole, ""}, numbers,
                              draft.is_transitions ? 0 : defaults.starts);
  draft.seed =
      table.number("seed", {Range::whole, ""}, numbers, static_cast<double>(defaults.seed));
  draft.damping = read_damping(table, numbers, reading);
  read_inertia(table, numbers, reading, draft);
  read_levels(study, numbers, reading, draft);
  read_transitions(study, numbers, reading, draft);
  return draft;
}

std::optional<analysis::SnapSettings> build_snap(const SnapDraft& draft,
                                                 const std::vector<double>& numbers) {
  if (!draft.on) return std::nullopt;
  analysis::SnapSettings snap;
  snap.starts = static_cast<int>(numbers[draft.starts]);
  snap.seed = static_cast<std::uint64_t>(numbers[draft.seed]);
  snap.damping = built(draft.damping, numbers);
  if (draft.has_inertia)
    snap.inertia = {.damping_ratio = numbers[draft.damping_ratio],
                    .damping = built(draft.inertial_damping, numbers)};
  const auto values = [&numbers](const std::vector<NumberId>& ids) {
    std::vector<double> list;
    for (const NumberId id : ids) list.push_back(numbers[id]);
    return list;
  };
  if (draft.is_cycle)
    snap.cycle = {.levels = values(draft.levels), .times = static_cast<int>(numbers[draft.times])};
  if (draft.is_transitions)
    snap.transitions = {.search_at = values(draft.search_at),
                        .barriers_at = values(draft.barriers_at),
                        .starts = static_cast<int>(numbers[draft.search_starts]),
                        .maximum = static_cast<int>(numbers[draft.maximum])};
  return snap;
}

}  // namespace springfold::io
