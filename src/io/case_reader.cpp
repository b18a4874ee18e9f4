#include <algorithm>
#include <set>

#include "case_draft.hpp"
#include "mechanism_reader.hpp"
#include "plot_reader.hpp"
#include "repetition.hpp"
#include "study_reader.hpp"

namespace springfold::io {
namespace {

constexpr std::size_t most_parameters = 1000;

const std::vector<std::string> case_keys{"title",    "include", "units",   "parameters", "gravity",
                                         "template", "body",    "node",    "chain",      "spring",
                                         "bar",      "load",    "study",   "plot",       "map_plot",
                                         "expected", "tornado", "picture", "report"};

/// Tables of one name in all files that may have them; each file numbers its own.
std::vector<Item> tables_of(const std::vector<Document>& documents, const std::string& name,
                            Reading& reading) {
  std::vector<Item> items;
  const auto& parts = parts_of_mechanism();
  const bool mechanism = std::find(parts.begin(), parts.end(), name) != parts.end();
  for (const Document& document : documents) {
    const Node* node = document.root.find(name);
    if (!node || (document.included && !mechanism)) continue;
    const std::vector<Item> more = list_of_tables({node, name}, reading);
    items.insert(items.end(), more.begin(), more.end());
  }
  return items;
}

void check_included(const Document& document, Problems& problems) {
  if (!document.included) return;
  for (const NodeEntry& entry : document.root.entries)
    if (entry.key == "study" || entry.key == "plot" || entry.key == "map_plot" ||
        entry.key == "tornado" || entry.key == "picture" || entry.key == "expected" ||
        entry.key == "report")
      problems.add(entry.place, entry.key,
                   "belongs into the case file itself, not into an included file");
}

UnitLabels read_units(const std::vector<Document>& documents, Reading& reading) {
  UnitLabels units;
  for (const Document& document : documents) {
    const Node* node = document.root.find("units");
    if (!node || !is_table({node, "units"}, "a table [units]", reading)) continue;
    const TableReader table{*node, "units", {"length", "force"}, reading};
    units.length = table.text("length").value_or(units.length);
    units.force = table.text("force").value_or(units.force);
  }
  return units;
}

/// [report]: the page of every run. Written alone, without keys, it is wanted.
bool read_report(const std::vector<Document>& documents, Reading& reading) {
  const Node* node = documents.back().root.find("report");
  if (!node || !is_table({node, "report"}, "a table [report]", reading)) return false;
  return TableReader{*node, "report", {"write"}, reading}.flag("write", true);
}

/// Right-hand sides by name, in the order in which the names first occur; later files win.
std::vector<NodeEntry> parameter_entries(const std::vector<Document>& documents,
                                         Problems& problems) {
  std::vector<NodeEntry> entries;
  for (const Document& document : documents) {
    const Node* node = document.root.find("parameters");
    if (!node) continue;
    if (node->kind != Node::Kind::table) {
      problems.add(node->place, "parameters",
                   "got " + described(*node) + ", need a table [parameters]");
      continue;
    }
    for (const NodeEntry& entry : node->entries) {
      const auto has_name = [&entry](const NodeEntry& other) { return other.key == entry.key; };
      const auto known = std::find_if(entries.begin(), entries.end(), has_name);
      const std::string key = "parameters." + entry.key;
      if (!is_identifier(entry.key))
        problems.add(entry.place, key,
                     "need a name of letters, digits and '_' that does not begin with a digit");
      else if (is_formula_word(entry.key))
        problems.add(entry.place, key, "formulas keep this name for themselves, need another one");
      else if (known != entries.end())
        *known = entry;
      else if (entries.size() < most_parameters)
        entries.push_back(entry);
      else
        return problems.add(entry.place, key, "more than 1000 parameters"), entries;
    }
  }
  return entries;
}

Definition read_parameter(const NodeEntry& entry, Reading& reading) {
  const std::string key = "parameters." + entry.key;
  const Node* value = &entry.value;
  std::string value_key = key;
  if (value->kind == Node::Kind::table) {
    const TableReader table{*value, key, {"value", "unit", "description"}, reading};
    table.text("unit");
    table.text("description");
    value = table.require("value", "a number or a formula");
    value_key = table.key_of("value");
  }
  if (!value) return {.usable = false};
  return read_definition(*value, value_key, "a number", reading.book, reading.problems);
}

/// Who changes the value of an included parameter need not say its unit again.
std::map<std::string, std::string> parameter_units(const std::vector<Document>& documents) {
  std::map<std::string, std::string> units;
  for (const Document& document : documents) {
    const Node* node = document.root.find("parameters");
    if (!node || node->kind != Node::Kind::table) continue;
    for (const NodeEntry& entry : node->entries) {
      const bool is_table = entry.value.kind == Node::Kind::table;
      const Node* unit = is_table ? entry.value.find("unit") : nullptr;
      if (unit && unit->kind == Node::Kind::text && !unit->text.empty())
        units[entry.key] = unit->text;
    }
  }
  return units;
}

void read_parameters(const std::vector<NodeEntry>& entries,
                     const std::map<std::string, std::string>& overrides, CaseDraft& draft,
                     Reading& reading) {
  for (const NodeEntry& entry : entries)
    draft.parameters.push_back({entry.key, read_parameter(entry, reading)});
  const Place command_line{"--set", 0, 0};
  for (const auto& [name, text] : overrides) {
    const auto number = parameter_number(name, command_line, name, reading.book, reading.problems);
    const Node node = plain_node(Node::Kind::text, command_line, 0, text);
    const Definition definition =
        read_definition(node, name, "a number", reading.book, reading.problems);
    if (number) draft.parameters[*number].definition = definition;
  }
}

void read_expectations(const std::vector<Document>& files, CaseDraft& draft, Reading& reading) {
  for (const Document& file : files) {
    const TableReader root{file.root, "", {"notes", "value"}, reading};
    draft.notes = read_texts(root.list("notes", "a list of texts"), reading);
    draft.expected = read_expected(root.tables("value"), draft.studies, reading);
  }
}

/// @param others  tables that do instead of it
void require_table(const std::vector<Document>& documents, const std::string& name,
                   Problems& problems, const std::string& others = "") {
  for (const Document& document : documents) {
    if (document.root.find(name)) return;
    constexpr std::size_t most_looked_at = 100;
    std::size_t looked_at = 0;  // among very many keys a misspelt one is not looked for
    for (const NodeEntry& entry : document.root.entries)
      if (++looked_at <= most_looked_at && nearest(entry.key, case_keys) == name) return;
  }
  problems.add({documents.back().name, 0, 0}, name,
               "missing, need at least one [[" + name + "]]" + others);
}

}  // namespace

CaseDraft read_case(const std::vector<Document>& documents,
                    const std::map<std::string, std::string>& overrides,
                    const std::vector<Document>& expected_file, const FileReader& files,
                    Problems& problems) {
  CaseDraft draft;
  const std::vector<NodeEntry> entries = parameter_entries(documents, problems);
  std::vector<std::string> names;
  for (const NodeEntry& entry : entries) names.push_back(entry.key);
  draft.book = FormulaBook{names};

  Reading reading{problems, draft.book, {}, nullptr, files};
  for (const Document& document : documents) {
    check_included(document, problems);
    const TableReader root{document.root, "", case_keys, reading};
    draft.title = root.text("title").value_or(draft.title);
  }
  draft.units = read_units(documents, reading);
  draft.units.parameters = parameter_units(documents);
  reading.units = draft.units;
  read_parameters(entries, overrides, draft, reading);
  reading.parameters = &draft.parameters;

  const std::vector<Item> bodies = tables_of(documents, "body", reading);
  const std::vector<Item> chains = tables_of(documents, "chain", reading);
  const std::vector<Item> studies = tables_of(documents, "study", reading);
  const std::vector<Item> nodes = tables_of(documents, "node", reading);
  const std::vector<Item> springs = tables_of(documents, "spring", reading);
  const std::vector<Item> bars = tables_of(documents, "bar", reading);
  if (nodes.empty()) require_table(documents, "body", problems, " or [[node]]");
  if (springs.empty() && bars.empty())
    require_table(documents, "chain", problems,
                  ", [[bar]] or [[spring]]: nothing holds what moves");
  require_table(documents, "study", problems);
  read_bodies(bodies, draft.mechanism, reading);
  read_nodes(nodes, draft.mechanism, reading);
  read_chains(chains, draft.mechanism, reading);
  for (const Document& document : documents)  // the case's own comes last and counts
    if (const Node* gravity = document.root.find("gravity"))
      read_gravity({gravity, "gravity"}, draft.mechanism, reading);
  read_springs(springs, draft.mechanism, reading);
  read_bars(bars, draft.mechanism, reading);
  const Index only_body = draft.mechanism.bodies.size() == 1 ? 1 : 0;
  draft.mechanism.loads = read_loads(tables_of(documents, "load", reading), draft.mechanism,
                                     only_body, draft.mechanism.numbers, reading);
  draft.studies = read_studies(studies, draft.mechanism, reading);
  const std::vector<Item> plots = tables_of(documents, "plot", reading);
  draft.plots = read_plots(plots, draft.studies, reading);
  draft.map_plots = read_map_plots(tables_of(documents, "map_plot", reading), draft.studies,
                                   draft.plots, reading);
  std::set<std::string> taken;
  for (const PlotDraft& plot : draft.plots) taken.insert(plot.spec.name);
  for (const MapPlotDraft& plot : draft.map_plots) taken.insert(plot.spec.name);
  draft.tornados =
      read_tornados(tables_of(documents, "tornado", reading), draft.studies, taken, reading);
  for (const TornadoDraft& tornado : draft.tornados) taken.insert(tornado.spec.name);
  draft.pictures =
      read_pictures(tables_of(documents, "picture", reading), draft.studies, taken, reading);
  draft.wants_report = read_report(documents, reading);
  read_expectations(expected_file, draft, reading);
  return draft;
}

}  // namespace springfold::io
