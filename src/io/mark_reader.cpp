#include "mark_reader.hpp"

#include "text.hpp"

namespace springfold::io {
namespace {

void read_values(const TableReader& study, StudyDraft& draft, Reading& reading) {
  for (const NamedItem& item :
       named_items(study, "mark", "a table such as { deflection = [0.1] }", reading)) {
    const Item value{item.value, item.name.key};
    std::vector<Item> items{value};
    if (item.value->kind == Node::Kind::array)
      items = list_items(value, "a list of numbers", reading);
    for (const NumberId id : read_numbers(items, {}, draft.numbers, reading))
      draft.marks.push_back({item.name, id});
  }
}

void read_extrema(const TableReader& study, StudyDraft& draft, Reading& reading) {
  const Node* node = study.find("extrema");
  if (node == nullptr) return;
  for (const Item& item :
       list_items({node, study.key_of("extrema")}, "a list of quantities", reading)) {
    if (item.node->kind == Node::Kind::text)
      draft.extrema.push_back({item.node->text, item.node->place, item.key});
    else
      reading.problems.add(item.node->place, item.key,
                           "got " + described(*item.node) + ", need the name of a quantity");
  }
}

}  // namespace

void read_marks(const TableReader& study, StudyDraft& draft, Reading& reading) {
  read_values(study, draft, reading);
  read_extrema(study, draft, reading);
}

}  // namespace springfold::io
