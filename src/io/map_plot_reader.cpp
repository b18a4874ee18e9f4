#include <algorithm>

#include "plot_look_reader.hpp"
#include "plot_reader.hpp"

namespace springfold::io {
namespace {

class MapPlotReader {
 public:
  MapPlotReader(const Item& item, const std::vector<StudyDraft>& studies, Reading& reading)
      : table_{*item.node, item.key,
               with_sheet_keys({"name", "title", "quantity", "label", "x_label", "y_label",
                                "factor", "x_factor", "y_factor", "levels", "range", "activation",
                                "markup", "panels"}),
               reading},
        item_{item},
        studies_{studies},
        reading_{reading} {}

  MapPlotDraft read(const std::set<std::string>& taken) {
    MapPlotSpec& spec = draft_.spec;
    spec.name = table_.required_text("name", "a file name without ending").value_or("");
    check_plot_name(table_, spec.name, taken, reading_);
    spec.title = table_.text("title").value_or("");
    spec.quantity =
        table_.required_text("quantity", "a quantity such as \"K_trans_min\"").value_or("");
    if (const Node* node = table_.find("quantity"))
      draft_.quantity = {spec.quantity, node->place, table_.key_of("quantity")};
    spec.label = table_.text("label").value_or("");
    spec.x_label = table_.text("x_label").value_or("");
    spec.y_label = table_.text("y_label").value_or("");
    draft_.factor = table_.number("factor", {}, draft_.numbers, 1);
    draft_.x_factor = table_.number("x_factor", {}, draft_.numbers, 1);
    draft_.y_factor = table_.number("y_factor", {}, draft_.numbers, 1);
    draft_.levels =
        read_numbers(table_.list("levels", "a list of values"), {}, draft_.numbers, reading_);
    read_range();
    spec.activation = table_.truth("activation", spec.activation);
    spec.markup = read_markup(table_, item_, reading_);
    draft_.look = read_sheet_look(table_, spec.look, draft_.numbers, reading_);
    read_panels();
    return std::move(draft_);
  }

 private:
  void read_range() {
    const Node* node = table_.find("range");
    if (!node) return;
    const auto items = table_.list("range", "[low, high]");
    if (items.size() != 2) {
      if (node->kind == Node::Kind::array)
        reading_.problems.add(node->place, table_.key_of("range"),
                              "got " + described(*node) + ", need [low, high]");
      return;
    }
    draft_.range = read_numbers(items, {}, draft_.numbers, reading_);
    draft_.numbers.require_less(draft_.range[0], draft_.range[1], "low < high");
  }

  void read_panels() {
    const Node* panels = table_.require("panels", "a list such as [{ study = \"...\" }]");
    for (const Item& item : table_.tables("panels", "panels = [{ study = \"...\" }]"))
      read_panel(item);
    if (panels && panels->kind == Node::Kind::array && panels->items.empty())
      reading_.problems.add(panels->place, table_.key_of("panels"),
                            "got an empty list, need at least one panel");
  }

  void read_panel(const Item& item) {
    const TableReader table{*item.node, item.key, {"study", "run", "title", "slice"}, reading_};
    MapPanelSpec panel;
    panel.title = table.text("title").value_or("");
    panel.study = table.required_text("study", "the name of a map").value_or("");
    if (panel.study.empty()) return;
    const Item at{table.find("study"), table.key_of("study")};
    const auto number = study_number(panel.study, at, studies_, reading_);
    if (!number) return;
    const StudyDraft& study = studies_[*number];
    if (study.kind != analysis::StudyKind::map || study.commands.axes.size() < 2) {
      reading_.problems.add(at.node->place, at.key,
                            "need a study of kind \"map\" with at least two axes");
      return;
    }
    if (const Node* run = table.find("run"))
      panel.run = read_run({run, table.key_of("run")}, study, reading_).value_or(1);
    if (const Node* slice = table.find("slice")) {
      const double value = slice->number;
      const bool whole = slice->kind == Node::Kind::number && value >= 1 && value <= 1e6 &&
                         value == static_cast<int>(value);
      if (!whole || study.commands.axes.size() < 3)
        reading_.problems.add(
            slice->place, table.key_of("slice"),
            "got " + described(*slice) + ", need the number of a value of the third axis, from 1");
      else
        panel.slice = static_cast<int>(value);
    }
    draft_.spec.panels.push_back(std::move(panel));
  }

  TableReader table_;
  const Item& item_;
  const std::vector<StudyDraft>& studies_;
  Reading& reading_;
  MapPlotDraft draft_{};
};

}  // namespace

std::vector<MapPlotDraft> read_map_plots(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies,
                                         const std::vector<PlotDraft>& plots, Reading& reading) {
  std::set<std::string> taken;
  for (const PlotDraft& plot : plots) taken.insert(plot.spec.name);
  std::vector<MapPlotDraft> drafts;
  for (const Item& item : tables) {
    drafts.push_back(MapPlotReader{item, studies, reading}.read(taken));
    taken.insert(drafts.back().spec.name);
  }
  return drafts;
}

}  // namespace springfold::io
