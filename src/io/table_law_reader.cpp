// Spring laws that are tables: points in the case file or in a file of comma-separated values.
#include <algorithm>

#include "csv_points.hpp"
#include "spring_reader.hpp"

namespace springfold::io {
namespace {

constexpr std::size_t most_table_points = 10000;

const std::string need_points =
    "a list of at least two pairs [deformation, torque], deformations increasing";

void read_points(const TableReader& t, const SpringReader& reader, TableDraft& draft) {
  for (const Item& item : t.list("points", need_points)) {
    const std::string need =
        "a pair [deformation " + reader.units.coordinate + ", torque " + reader.units.torque + "]";
    const std::vector<Item> pair = list_items(item, need, reader.reading);
    if (pair.size() != 2) {
      if (item.node->kind == Node::Kind::array)
        reader.reading.problems.add(item.node->place, item.key,
                                    "got " + described(*item.node) + ", need " + need);
      continue;
    }
    draft.deformations.push_back(read_number(pair[0], {Range::finite, reader.units.coordinate},
                                             reader.numbers, reader.reading));
    draft.torques.push_back(
        read_number(pair[1], {Range::finite, reader.units.torque}, reader.numbers, reader.reading));
  }
}

void read_file(const TableReader& t, const SpringReader& reader, TableDraft& draft) {
  const auto name = t.required_text("file", "the name of a file beside the case");
  if (!name) return;
  const Node* node = t.find("file");
  const auto text = reader.reading.files
                        ? reader.reading.files(*name, node->place, t.key_of("file"))
                        : std::optional<TextFile>{};
  if (!text) return;
  for (const CsvPoint& point : read_csv_points(*text, reader.reading.problems)) {
    const auto add = [&](double value, int column, const std::string& unit) {
      const Definition definition{.constant = value,
                                  .shown = "",
                                  .place = {text->shown_name, point.line, column},
                                  .key = t.key_of("file")};
      return reader.numbers.add(definition, {Range::finite, unit});
    };
    draft.deformations.push_back(add(point.x, 1, reader.units.coordinate));
    draft.torques.push_back(add(point.y, point.column, reader.units.torque));
  }
}

/// Deformations increase, torques do not decrease unless the law may fall.
void require_order(const SpringReader& reader, const TableDraft& draft) {
  for (std::size_t i = 1; i < draft.deformations.size(); ++i)
    reader.numbers.require_less(draft.deformations[i - 1], draft.deformations[i],
                                "deformations increase");
  if (draft.falling) return;
  for (std::size_t i = 1; i < draft.torques.size(); ++i) {
    const Definition& at = reader.numbers.definition(draft.torques[i]);
    reader.numbers.require({draft.torques[i - 1], draft.torques[i]}, at.place, at.key,
                           [](const std::vector<double>& torque) -> std::string {
                             if (torque[1] >= torque[0]) return {};
                             return "the torque falls from the point before it to this one, need "
                                    "torques that rise, or falling = true for a law that may fall";
                           });
  }
}

}  // namespace

SpringDraft read_table_law(const SpringReader& reader) {
  const TableReader t = reader.table({"points", "file", "interpolation", "free", "falling"});
  TableDraft draft{.free = reader.free(t), .falling = t.truth("falling", false)};
  draft.straight = t.choice("interpolation", {"cubic", "straight"}, 0) == 1;
  const std::size_t before = reader.reading.problems.size();
  if (t.has("points") == t.has("file")) {
    reader.report(t, "points",
                  t.has("file") ? "either points or file, not both"
                                : "missing, need " + need_points + ", or file");
  } else if (t.has("points")) {
    read_points(t, reader, draft);
  } else {
    read_file(t, reader, draft);
  }
  const std::size_t count = draft.deformations.size();
  if (reader.reading.problems.size() == before && (count < 2 || count > most_table_points))
    reader.report(t, t.has("file") ? "file" : "points",
                  "got " + std::to_string(count) + (count == 1 ? " point" : " points") +
                      ", need 2 to " + std::to_string(most_table_points));
  if (count > most_table_points) draft = {};
  require_order(reader, draft);
  while (draft.deformations.size() < 2) {  // reported: one mistake must not cause others
    draft.deformations.push_back(
        reader.numbers.add(static_cast<double>(draft.deformations.size())));
    draft.torques.push_back(reader.numbers.add(0));
  }
  return draft;
}

}  // namespace springfold::io
