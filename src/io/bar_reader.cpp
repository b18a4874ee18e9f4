// [[bar]].
#include "anchor_reader.hpp"
#include "mechanism_reader.hpp"

namespace springfold::io {
namespace {

/// The name of a bar that has none: "a-b".
std::string read_bar_name(const TableReader& table, const MechanismDraft& draft, Reading& reading) {
  if (table.has("name")) return read_own_name(table, draft, reading);
  const Node *from = table.find("from"), *to = table.find("to");
  std::string name = (from ? from->text : "base") + "-" + (to ? to->text : "");
  if (is_taken(name, draft))
    reading.problems.add(table.place(), table.key_of("name"),
                         "missing, need a name: \"" + name + "\", as it would be called, is taken");
  return name;
}

void read_bar_ends(const TableReader& table, MechanismDraft& draft, BarDraft& bar,
                   Reading& reading) {
  const std::string ends = "the name of a node, of a body, or \"chain.point\"";
  for (const auto& [name, anchor] : {std::pair{"from", &bar.from}, {"to", &bar.to}})
    if (table.required_text(name, ends))
      find_anchor({table.find(name), table.key_of(name)}, draft, true, *anchor, draft.numbers,
                  reading);
  bar.from.at = read_at(table, "from_at", draft, bar.from, draft.numbers, reading);
  bar.to.at = read_at(table, "to_at", draft, bar.to, draft.numbers, reading);
}

/// `law` or `series`, which the elongation counts in.
void read_bar_law(const TableReader& table, NumberTable& numbers, BarDraft& bar, Reading& reading) {
  JointUnits units = units_of(model::JointKind::prismatic, reading.units);
  units.has_length = true;
  const char* const from_free = "laws of bars count from the free length";
  if (table.has("series")) {
    bar.series = read_series(table, units, numbers, reading);
    return refuse_origins(table, bar.series, from_free, reading);
  }
  const Item law{table.find("law"), table.key_of("law")};
  bar.law = read_spring(law, units, numbers, reading);
  if (bar.law) refuse_origin(law, *bar.law, from_free, reading);
}

/// `tension_only` and `compression_only`.
BarDraft::Acts read_acts(const TableReader& table, bool has_law, Reading& reading) {
  const bool tension = table.truth("tension_only", false);
  const bool compression = table.truth("compression_only", false);
  const auto refuse = [&](const char* name, const std::string& what) {
    reading.problems.add(table.find(name)->place, table.key_of(name), what);
  };
  if (tension && compression)
    refuse("compression_only",
           "either tension_only or compression_only, not both: it would carry nothing");
  if (has_law)
    for (const char* name : {"tension_only", "compression_only"})
      if (table.has(name))
        refuse(name,
               "goes with stiffness or EA; of a law say so in the law, such as { law = "
               "\"one_sided\", stiffness = 3, from = 0 }");
  if (tension) return BarDraft::Acts::in_tension;
  return compression ? BarDraft::Acts::in_compression : BarDraft::Acts::both_ways;
}

/// How stiff the bar is: exactly one of `stiffness`, `EA`, `law` and `series`.
void read_bar_force(const TableReader& table, NumberTable& numbers, BarDraft& bar,
                    Reading& reading) {
  std::string got;
  int count = 0;
  for (const char* name : {"stiffness", "EA", "law", "series"})
    if (table.has(name)) got += (count++ > 0 ? " and " : "") + std::string{name};
  if (count != 1)
    reading.problems.add(
        table.place(), table.key(),
        "got " + (count > 0 ? got : "neither stiffness nor EA nor a law nor springs in series") +
            ", need exactly one of them");
  const std::string length = reading.units.length, force = reading.units.force;
  if (table.has("stiffness"))
    bar.stiffness =
        table.number("stiffness", {Range::non_negative, force + "/" + length}, numbers, 0);
  if (table.has("EA")) bar.EA = table.number("EA", {Range::positive, force}, numbers, 0);
  const bool has_law = table.has("law") || table.has("series");
  if (has_law) read_bar_law(table, numbers, bar, reading);
  if (table.has("initial") && !table.has("series"))
    reading.problems.add(table.find("initial")->place, table.key_of("initial"),
                         "only springs in series have it, need series");
  bar.acts = read_acts(table, has_law, reading);
}

/// `free` or `pretension`.
void read_bar_length(const TableReader& table, NumberTable& numbers, BarDraft& bar,
                     Reading& reading) {
  const auto refuse = [&](const std::string& what) {
    reading.problems.add(table.find("pretension")->place, table.key_of("pretension"), what);
  };
  if (table.has("free") && table.has("pretension"))
    refuse("either free or pretension, not both: each says how long the bar is without force");
  else if ((table.has("law") || table.has("series")) && table.has("pretension"))
    refuse("goes with stiffness or EA; of a bar with a law give the free length, free");
  if (table.has("free"))
    bar.free = table.number("free", {Range::non_negative, reading.units.length}, numbers, 0);
  if (table.has("pretension"))
    bar.pretension = table.number("pretension", {Range::finite, reading.units.force}, numbers, 0);
}

BarDraft read_bar(const Item& item, MechanismDraft& draft, Reading& reading) {
  const TableReader table{
      *item.node,
      item.key,
      {"name", "from", "from_at", "to", "to_at", "stiffness", "EA", "law", "series", "initial",
       "tension_only", "compression_only", "free", "pretension"},
      reading};
  BarDraft bar{.place = item.node->place, .key = item.key};
  bar.name = read_bar_name(table, draft, reading);
  read_bar_ends(table, draft, bar, reading);
  read_bar_force(table, draft.numbers, bar, reading);
  read_bar_length(table, draft.numbers, bar, reading);
  return bar;
}

}  // namespace

void read_bars(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading) {
  for (const Item& item : tables) draft.bars.push_back(read_bar(item, draft, reading));
}

}  // namespace springfold::io
