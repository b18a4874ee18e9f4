#include "snap_reader.hpp"

namespace springfold::io {

SnapDraft read_snap(const TableReader& study, NumberTable& numbers, Reading& reading) {
  static const Node nothing;
  const analysis::SnapSettings defaults;
  const std::string need = "true, or a table such as { starts = 32 }";
  SnapDraft draft;
  const Node* kind = study.find("kind");
  draft.is_kind = kind != nullptr && kind->kind == Node::Kind::text && kind->text == snap_kind;
  draft.on = draft.is_kind;
  const Node* node = study.find("snap");
  const bool is_settings = node != nullptr && node->kind == Node::Kind::table;
  if (node != nullptr && node->kind == Node::Kind::boolean) {
    draft.on = node->number != 0;
    if (draft.is_kind && !draft.on)
      reading.problems.add(node->place, study.key_of("snap"),
                           "got false, but kind = \"snap_through\" is about jumps");
  } else if (node != nullptr && !is_settings) {
    reading.problems.add(node->place, study.key_of("snap"),
                         "got " + described(*node) + ", need " + need);
  }
  draft.on = draft.on || is_settings;
  const TableReader table{
      is_settings ? *node : nothing, study.key_of("snap"), {"starts", "seed", "damping"}, reading};
  draft.starts = table.number("starts", {Range::whole, ""}, numbers, defaults.starts);
  draft.seed =
      table.number("seed", {Range::whole, ""}, numbers, static_cast<double>(defaults.seed));
  for (const NamedItem& item :
       named_items(table, "damping", "a table such as { \"leg.knee\" = 0.1 }", reading))
    draft.damping.push_back({item.name.name, read_number({item.value, item.name.key},
                                                         {Range::positive, ""}, numbers, reading)});
  return draft;
}

std::optional<analysis::SnapSettings> build_snap(const SnapDraft& draft,
                                                 const std::vector<double>& numbers) {
  if (!draft.on) return std::nullopt;
  analysis::SnapSettings snap;
  snap.starts = static_cast<int>(numbers[draft.starts]);
  snap.seed = static_cast<std::uint64_t>(numbers[draft.seed]);
  for (const JointDampingDraft& damping : draft.damping)
    snap.damping.push_back({damping.joint, numbers[damping.value]});
  return snap;
}

}  // namespace springfold::io
