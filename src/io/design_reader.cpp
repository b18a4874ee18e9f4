#include "design_draft.hpp"
#include "study_reader.hpp"

namespace springfold::io {
namespace {

using analysis::StudyKind;

const std::string design_example =
    "a table such as { parameters = { k = [1, 2] }, critical_load = { at_least = 3 } }";

class DesignReader {
 public:
  DesignReader(const TableReader& table, NumberTable& numbers, Reading& reading)
      : table_{table}, numbers_{numbers}, reading_{reading} {}

  DesignDraft read() {
    read_parameters();
    read_critical_load();
    read_no_limit_point();
    read_curve();
    read_constant();
    read_stiffness();
    static const std::vector<std::string> change_words{"norm", "sum"};
    draft_.changes = table_.choice("changes", change_words, 0) == 0 ? analysis::ChangeNorm::norm
                                                                    : analysis::ChangeNorm::sum;
    draft_.starts = table_.number("starts", {Range::small_count, ""}, numbers_,
                                  analysis::DesignSettings{}.starts);
    return std::move(draft_);
  }

 private:
  /// A table of `design`; nothing if it is missing or no table.
  std::optional<TableReader> part(const std::string& name, const std::string& need,
                                  const std::vector<std::string>& keys) {
    const Node* node = table_.find(name);
    if (node == nullptr || !is_table({node, table_.key_of(name)}, need, reading_))
      return std::nullopt;
    return TableReader{*node, table_.key_of(name), keys, reading_};
  }

  /// Two numbers; nothing if they are anything else.
  std::optional<std::pair<NumberId, NumberId>> pair_of(const Item& item, const std::string& need) {
    const Node& node = *item.node;
    if (node.kind != Node::Kind::array || node.items.size() != 2) {
      reading_.problems.add(node.place, item.key, "got " + described(node) + ", need " + need);
      return std::nullopt;
    }
    const auto ids = read_numbers(list_items(item, need, reading_), {}, numbers_, reading_);
    return std::pair{ids[0], ids[1]};
  }

  void read_parameters() {
    table_.require("parameters", "a table of bounds such as { k = [1, 2] }");
    for (const NamedItem& item :
         named_items(table_, "parameters", "a table of bounds such as { k = [1, 2] }", reading_)) {
      parameter_number(item.name.name, item.name.place, item.name.key, reading_.book,
                       reading_.problems);
      const auto bounds = pair_of({item.value, item.name.key}, "its bounds [low, high]");
      if (!bounds) continue;
      numbers_.require_less(bounds->first, bounds->second, "low < high");
      draft_.parameters.push_back({item.name.name, bounds->first, bounds->second, {}});
    }
    for (const NamedItem& item :
         named_items(table_, "scale", "a table such as { k = 0.1 }", reading_)) {
      const NumberId unit =
          read_number({item.value, item.name.key}, {Range::positive, ""}, numbers_, reading_);
      bool known = false;
      for (DesignDraft::Parameter& parameter : draft_.parameters)
        if (parameter.name == item.name.name) parameter.unit = unit, known = true;
      if (!known)
        reading_.problems.add(item.name.place, item.name.key,
                              "is none of the parameters of this design");
    }
  }

  static analysis::StabilityOf stability_of(const TableReader& table) {
    static const std::vector<std::string> index{"control", "dead_load"};
    return table.choice("index", index, 0) == 0 ? analysis::StabilityOf::control
                                                : analysis::StabilityOf::dead_load;
  }

  void read_critical_load() {
    const auto table = part("critical_load", "a table such as { at_least = 3 }",
                            {"at_least", "of", "index", "quantity"});
    if (!table) return;
    analysis::CriticalRequirement wanted{.name = "critical_load"};
    static const std::vector<std::string> of{"limit_point", "loss_of_stability"};
    wanted.unwanted = table->choice("of", of, 0) == 0 ? analysis::Unwanted::limit_point
                                                      : analysis::Unwanted::loss_of_stability;
    wanted.stability = stability_of(*table);
    wanted.quantity = table->text("quantity").value_or(wanted.quantity);
    draft_.critical.emplace_back(wanted, table->required_number("at_least", {}, numbers_));
  }

  void read_no_limit_point() {
    const auto table =
        part("no_limit_point", "a table such as { up_to = 0.5 }, or { } for none at all",
             {"up_to", "index", "quantity"});
    if (!table) return;
    analysis::CriticalRequirement wanted{.name = "no_limit_point", .quantity = "deflection"};
    wanted.stability = stability_of(*table);
    wanted.quantity = table->text("quantity").value_or(wanted.quantity);
    std::optional<NumberId> up_to;
    if (table->has("up_to"))
      up_to = table->required_number("up_to", {Range::maybe_infinite, ""}, numbers_);
    draft_.critical.emplace_back(wanted, up_to);
  }

  void read_curve() {
    const auto table =
        part("curve", "a table such as { points = [[0.1, 2], [0.2, 3]], tolerance = 0.1 }",
             {"points", "tolerance", "x", "y"});
    if (!table) return;
    analysis::CurveRequirement& curve = draft_.curve.emplace();
    curve.x = table->text("x").value_or(curve.x);
    curve.y = table->text("y").value_or(curve.y);
    table->require("points", "a list of points such as [[0.1, 2], [0.2, 3]]");
    for (const Item& item : table->list("points", "a list of points such as [[0.1, 2], [0.2, 3]]"))
      if (const auto point = pair_of(item, "a point [x, y]")) draft_.points.push_back(*point);
    draft_.tolerance = table->required_number("tolerance", {Range::positive, ""}, numbers_);
  }

  void read_constant() {
    const auto table = part("constant", "a table such as { from = 0.1, to = 0.3, within = 0.02 }",
                            {"quantity", "along", "from", "to", "within", "mean_at_least"});
    if (!table) return;
    analysis::ConstantRequirement& constant = draft_.constant.emplace();
    constant.quantity = table->text("quantity").value_or(constant.quantity);
    constant.along = table->text("along").value_or(constant.along);
    draft_.from = table->required_number("from", {}, numbers_);
    draft_.to = table->required_number("to", {}, numbers_);
    numbers_.require_less(draft_.from, draft_.to, "from < to");
    draft_.within = table->required_number("within", {Range::positive, ""}, numbers_);
    if (table->has("mean_at_least"))
      draft_.mean_at_least = table->required_number("mean_at_least", {}, numbers_);
  }

  void read_stiffness() {
    const std::string need = "stiffness = [{ at_least = 2 }]";
    for (const Item& item : table_.tables("stiffness", need)) {
      const TableReader table{
          *item.node, item.key, {"at", "pose", "quantity", "at_least"}, reading_};
      DesignDraft::Stiffness one;
      one.quantity = table.text("quantity").value_or(analysis::StiffnessRequirement{}.quantity);
      one.at_least = table.required_number("at_least", {}, numbers_);
      const auto places =
          named_items(table, "at", "a table such as { deflection = 0.1 }", reading_);
      if (places.size() > 1)
        reading_.problems.add(table.find("at")->place, table.key_of("at"),
                              "got several quantities, need one");
      for (const NamedItem& place : places)
        one.at = {place.name.name,
                  read_number({place.value, place.name.key}, {}, numbers_, reading_)};
      one.pose = read_numbers(table.list("pose", "a list of numbers"), {}, numbers_, reading_);
      draft_.stiffness.push_back(std::move(one));
    }
  }

  const TableReader& table_;
  NumberTable& numbers_;
  Reading& reading_;
  DesignDraft draft_{};
};

}  // namespace

DesignDraft read_design(StudyKind kind, const TableReader& study, NumberTable& numbers,
                        Reading& reading) {
  if (kind != StudyKind::design) return {};
  const Node* node = study.require("design", design_example);
  if (node == nullptr || !is_table({node, study.key_of("design")}, design_example, reading))
    return {};
  const TableReader table{*node,
                          study.key_of("design"),
                          {"parameters", "scale", "critical_load", "no_limit_point", "curve",
                           "constant", "stiffness", "changes", "starts"},
                          reading};
  return DesignReader{table, numbers, reading}.read();
}

void build_design(const DesignDraft& draft, const std::vector<double>& numbers,
                  analysis::DesignSettings& settings) {
  for (const DesignDraft::Parameter& one : draft.parameters)
    settings.parameters.push_back(
        {one.name, numbers[one.low], numbers[one.high], one.unit ? numbers[*one.unit] : 0});
  for (const auto& [requirement, at_least] : draft.critical) {
    settings.critical.push_back(requirement);
    if (at_least) settings.critical.back().at_least = numbers[*at_least];
  }
  settings.curve = draft.curve;
  if (settings.curve) {
    for (const auto& [x, y] : draft.points)
      settings.curve->points.emplace_back(numbers[x], numbers[y]);
    settings.curve->tolerance = numbers[draft.tolerance];
  }
  settings.constant = draft.constant;
  if (settings.constant) {
    settings.constant->from = numbers[draft.from];
    settings.constant->to = numbers[draft.to];
    settings.constant->within = numbers[draft.within];
    if (draft.mean_at_least) settings.constant->mean_at_least = numbers[*draft.mean_at_least];
  }
  for (const DesignDraft::Stiffness& one : draft.stiffness) {
    analysis::StiffnessRequirement wanted{.quantity = one.quantity,
                                          .at_least = numbers[one.at_least]};
    if (one.at) wanted.at = {one.at->first, numbers[one.at->second]};
    wanted.pose = vector_of(one.pose, numbers);
    settings.stiffness.push_back(std::move(wanted));
  }
  settings.changes = draft.changes;
  if (!settings.parameters.empty()) settings.starts = static_cast<int>(numbers[draft.starts]);
}

}  // namespace springfold::io
