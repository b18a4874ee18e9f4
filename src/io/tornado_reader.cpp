// [[tornado]] tables.
#include "plot_look_reader.hpp"
#include "plot_reader.hpp"

namespace springfold::io {

std::vector<TornadoDraft> read_tornados(const std::vector<Item>& tables,
                                        const std::vector<StudyDraft>& studies,
                                        std::set<std::string> taken, Reading& reading) {
  std::vector<TornadoDraft> drafts;
  for (const Item& item : tables) {
    const TableReader table{
        *item.node, item.key,
        with_sheet_keys({"name", "title", "study", "run", "at", "quantity", "label", "markup"}),
        reading};
    TornadoDraft draft;
    TornadoSpec& spec = draft.spec;
    spec.name = table.required_text("name", "a file name without ending").value_or("");
    check_plot_name(table, spec.name, taken, reading);
    taken.insert(spec.name);
    spec.title = table.text("title").value_or("");
    spec.at = table.required_text("at", "a special point such as \"LP1\"").value_or("");
    spec.quantity = table.text("quantity").value_or(spec.quantity);
    const Node* quantity = table.find("quantity");
    draft.quantity = {spec.quantity, quantity ? quantity->place : table.place(),
                      table.key_of("quantity")};
    spec.label = table.text("label").value_or("");
    spec.markup = read_markup(table, item, reading);
    draft.look = read_sheet_look(table, spec.look, draft.numbers, reading);
    spec.study = table.required_text("study", "the name of a study").value_or("");
    if (!spec.study.empty()) {
      const Item at{table.find("study"), table.key_of("study")};
      const auto number = study_number(spec.study, at, studies, reading);
      draft.study = number;
      if (number && studies[*number].kind != analysis::StudyKind::sensitivity)
        reading.problems.add(at.node->place, at.key, "need a study of kind \"sensitivity\"");
      if (const Node* run = table.find("run"); run && number)
        spec.run = read_run({run, table.key_of("run")}, studies[*number], reading).value_or(1);
    }
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

}  // namespace springfold::io
