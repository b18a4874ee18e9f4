#include "study_reader.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <set>

#include "command_reader.hpp"
#include "further_curves.hpp"
#include "mark_reader.hpp"
#include "mechanism_reader.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::ControlMode;
using analysis::StartSolve;
using analysis::StudyKind;

const std::vector<std::string> study_words{
    "force_deflection", "equilibrium",    "equilibria", "control",       "map",
    "workspace",        "critical_curve", "threshold",  "sensitivity",   "critical_load",
    "design",           snap_kind,        cycle_kind,   transitions_kind};
/// Of the words above; the last three have jumps.
const std::array kinds = [] {
  using enum StudyKind;
  return std::array{
      force_deflection, equilibrium,      equilibria,       control,         map,
      workspace,        critical_curve,   threshold,        sensitivity,     critical_load,
      design,           force_deflection, force_deflection, force_deflection};
}();
const std::vector<std::string> control_words{"load", "pose", "mixed", "actuator", "parameter"};
const std::map<std::string, std::string> other_control_words{
    {"force", "load"}, {"displacement", "mixed"}, {"command", "actuator"}};
const std::vector<std::string> solve_words{"pose", "actuators", "wrench"};
const std::vector<std::string> start_solvers{"newton", "fixed_point"};
const std::vector<std::string> path_words{"arc_length", "davidenko"};
const std::string loads_example = "loads = [{ name = \"...\", on = \"...\", force = [...] }]";
const std::vector<std::string> study_keys{
    "name",       "kind",           "control",   "body",        "direction", "load",
    "loads",      "start",          "until",     "mark",        "actuators", "parameter",
    "set",        "vary",           "path",      "trace",       "branches",  "search",
    "prescribed", "critical_curve", "threshold", "sensitivity", "snap",      "critical_load",
    "cycle",      "transitions",    "design",    "extrema"};

/// Studies of commands have keys of their own.
std::vector<std::string> keys_of(const Node& study) {
  const Node* kind = study.find("kind");
  const auto word =
      kind ? std::find(study_words.begin(), study_words.end(), kind->text) : study_words.end();
  if (word == study_words.end()) return study_keys;
  const StudyKind found = kinds[static_cast<std::size_t>(word - study_words.begin())];
  return analysis::is_of_commands(found) ? command_keys(found) : study_keys;
}

void add_entries(const Node& table, const std::string& prefix, std::vector<NamedPlace>& entries) {
  for (const NodeEntry& entry : table.entries) {
    const std::string name = prefix + entry.key;
    entries.push_back({name, entry.value.place, ""});
    if (entry.value.kind == Node::Kind::table) add_entries(entry.value, name + ".", entries);
  }
}

std::vector<std::string> actuator_names(const MechanismDraft& mechanism) {
  std::vector<std::string> names;
  for (const ChainDraft& chain : mechanism.chains)
    for (const ElementDraft& element : chain.elements)
      if (const auto* joint = std::get_if<JointDraft>(&element.content))
        if (joint->role == model::JointRole::actuated)
          names.push_back(chain.name + "." + joint->name);
  return names;
}

bool grows(const std::vector<LoadDraft>& loads) {
  return std::any_of(loads.begin(), loads.end(),
                     [](const LoadDraft& load) { return load.with_lambda; });
}

class StudyReader {
 public:
  StudyReader(const Item& item, const MechanismDraft& mechanism, Reading& reading)
      : table_{*item.node, item.key, keys_of(*item.node), reading},
        mechanism_{mechanism},
        reading_{reading} {
    draft_.place = item.node->place;
    draft_.key = item.key;
    begins_on_curve_ = curve_row(*item.node).has_value();
    add_entries(*item.node, "", draft_.entries);
  }

  StudyDraft read() {
    draft_.name = table_.required_text("name", "a name").value_or("");
    const bool traces = read_kind();
    read_body();
    draft_.direction = read_vector(table_, "direction", "", "");
    draft_.prescribed = read_texts(
        table_.list("prescribed", "a list of pose coordinates such as [\"x\", \"rz\"]"), reading_);
    const std::string force = reading_.units.force, length = reading_.units.length;
    draft_.load = read_vector(table_, "load", force, force + "*" + length);
    if (!analysis::is_of_commands(draft_.kind))
      draft_.loads = read_loads(table_.tables("loads", loads_example), mechanism_,
                                body_known_ ? draft_.body : 0, draft_.numbers, reading_);
    else if (body_known_)
      draft_.commands = read_commands(draft_.kind, table_,
                                      mechanism_.bodies[static_cast<std::size_t>(draft_.body - 1)],
                                      actuator_names(mechanism_), draft_.numbers, reading_);
    refuse_what_is_not_used();
    read_control(traces);
    read_start();
    read_until();
    read_marks(table_, draft_, reading_);
    draft_.set = read_set(table_, reading_);
    draft_.vary = read_vary(table_, draft_.set, reading_);
    draft_.runs_known = draft_.vary || !(table_.has("vary") || table_.is_misspelt("vary"));
    read_trace();
    draft_.snap = read_snap(table_, draft_.numbers, reading_);
    read_branches();
    read_search();
    draft_.critical = read_critical(draft_.kind, table_, draft_.numbers, reading_);
    draft_.design = read_design(draft_.kind, table_, draft_.numbers, reading_);
    return std::move(draft_);
  }

 private:
  bool read_kind() {
    draft_.kind = kinds[table_.choice("kind", study_words, 0)];
    const bool traces =
        draft_.kind == StudyKind::force_deflection || analysis::is_of_critical_points(draft_.kind);
    if (traces && !begins_on_curve_) table_.require("control", choices(control_words));
    draft_.control = std::array{
        ControlMode::load, ControlMode::pose, ControlMode::mixed, ControlMode::actuator,
        ControlMode::parameter}[table_.choice("control", control_words, 0, other_control_words)];
    const Node* control = table_.find("control");
    return traces && control &&
           std::find(control_words.begin(), control_words.end(), control->text) !=
               control_words.end();
  }

  /// Keys of curves in a study without a curve would be passed over in silence.
  void refuse_what_is_not_used() {
    const bool single = draft_.kind == StudyKind::equilibrium;
    if (!single && draft_.kind != StudyKind::equilibria) return;
    std::vector<std::string> keys{"control", "actuators", "parameter", "prescribed", "mark",
                                  "path",    "trace",     "snap",      "extrema"};
    if (single) keys.emplace_back("until");
    for (const std::string& key : keys)
      if (const Node* node = table_.find(key))
        reading_.problems.add(node->place, table_.key_of(key),
                              std::string{"has no meaning here: kind = \""} +
                                  (single ? "equilibrium" : "equilibria") +
                                  "\" follows no curve, need kind = \"force_deflection\" with it");
  }

  void read_body() {
    if (const auto name = table_.text("body")) {
      const auto number = body_number(*name, {table_.find("body"), table_.key_of("body")},
                                      mechanism_.bodies, false, reading_);
      body_known_ = number.has_value();
      draft_.body = number.value_or(1);
    } else if (!table_.has("body")) {
      body_known_ = mechanism_.bodies.size() == 1;
      if (mechanism_.bodies.size() > 1 && !begins_on_curve_)
        table_.require("body", "the name of a body: there are several");
    }
  }

  /// d numbers, translations first; empty if missing or wrong.
  std::vector<NumberId> read_vector(const TableReader& table, const std::string& name,
                                    const std::string& unit, const std::string& rotation_unit) {
    const Node* node = table.find(name);
    if (!node || !body_known_) return {};
    const BodyDraft& body = mechanism_.bodies[static_cast<std::size_t>(draft_.body - 1)];
    if (body.pose.empty()) return {};  // its task space is unusable: already reported
    const model::TaskSpace space = body.task_space;
    const auto d = static_cast<std::size_t>(model::dimension(space));
    const auto lengths = static_cast<std::size_t>(model::translations(space));
    const std::string need = "a list of " + std::to_string(d) + " numbers";
    const std::vector<Item> items = table.list(name, need);
    if (node->kind != Node::Kind::array) return {};
    if (items.size() != d) {
      reading_.problems.add(node->place, table.key_of(name),
                            "got " + described(*node) + ", need " + need + " for this task space");
      return {};
    }
    std::vector<NumberId> ids;
    for (std::size_t i = 0; i < d; ++i) {
      const Rule rule{Range::finite, i < lengths ? unit : rotation_unit};
      ids.push_back(read_number(items[i], rule, draft_.numbers, reading_));
    }
    return ids;
  }

  void read_control(bool traces) {
    if (const Node* node = table_.find("direction"); node && !draft_.direction.empty())
      draft_.numbers.require_nonzero(draft_.direction, node->place, table_.key_of("direction"),
                                     "lambda is measured along it");
    const ControlMode mode = draft_.control;
    const bool needs_direction = mode != ControlMode::actuator && mode != ControlMode::parameter;
    const bool load_grows =
        mode == ControlMode::load && (grows(mechanism_.loads) || grows(draft_.loads));
    if (traces && needs_direction && !load_grows)
      table_.require("direction", "a direction such as [1, 0]: control = \"" +
                                      table_.find("control")->text + "\" moves along it");
    read_actuators(traces);
    read_parameter(traces);
  }

  void read_actuators(bool traces) {
    const std::string need = "a table such as { \"leg.drive\" = 1 }";
    const Node* node = table_.find("actuators");
    if (traces && draft_.control == ControlMode::actuator) table_.require("actuators", need);
    if (traces && node && draft_.control != ControlMode::actuator)
      reading_.problems.add(node->place, table_.key_of("actuators"),
                            "has no meaning here, need control = \"actuator\" with it");
    const std::vector<std::string> known = actuator_names(mechanism_);
    for (const NamedItem& item : named_items(table_, "actuators", need, reading_)) {
      const auto& [name, place, key] = item.name;
      if (std::find(known.begin(), known.end(), name) == known.end())
        reading_.problems.add(place, key, "no actuator \"" + name + "\"" + suggestion(name, known));
      draft_.actuators.push_back(
          {name, read_number({item.value, key}, {}, draft_.numbers, reading_)});
    }
    if (traces && draft_.control == ControlMode::actuator && node &&
        node->kind == Node::Kind::table && node->entries.empty())
      reading_.problems.add(node->place, table_.key_of("actuators"), "got nothing, need " + need);
  }

  void read_parameter(bool traces) {
    const Node* node = table_.find("parameter");
    if (traces && draft_.control == ControlMode::parameter)
      table_.require("parameter", "the name of a parameter");
    if (traces && node && draft_.control != ControlMode::parameter)
      reading_.problems.add(node->place, table_.key_of("parameter"),
                            "has no meaning here, need control = \"parameter\" with it");
    if (const auto name = table_.text("parameter"))
      draft_.parameter = parameter_number(*name, node->place, table_.key_of("parameter"),
                                          reading_.book, reading_.problems);
  }

  void read_start() {
    const analysis::StartOptions defaults;
    std::vector<std::string> keys{"pose", "solve", "solver", "attempts", "seed", "maximum_move"};
    if (analysis::is_of_commands(draft_.kind)) keys.clear();
    keys.insert(keys.end(), history_keys().begin(), history_keys().end());
    const TableReader start = table_or_nothing("start", "a table such as { pose = [...] }", keys);
    draft_.history = read_history(start, mechanism_, reading_);
    if (analysis::is_of_commands(draft_.kind) && table_.has("start") && !start.has("from"))
      reading_.problems.add(
          table_.find("start")->place, table_.key_of("start"),
          "a study of this kind has a start only after another study, need from = "
          "\"...\", its name");
    draft_.start_pose = read_vector(start, "pose", reading_.units.length, "rad");
    draft_.start_solve = std::array{StartSolve::pose, StartSolve::actuators,
                                    StartSolve::wrench}[start.choice("solve", solve_words, 0)];
    draft_.start_solver =
        std::array{analysis::StartSolver::newton,
                   analysis::StartSolver::fixed_point}[start.choice("solver", start_solvers, 0)];
    draft_.attempts =
        start.number("attempts", {Range::small_count, ""}, draft_.numbers, defaults.attempts);
    draft_.seed = start.number("seed", {Range::whole, ""}, draft_.numbers,
                               static_cast<double>(defaults.seed));
    draft_.maximum_move = start.number("maximum_move", {Range::non_negative, ""}, draft_.numbers,
                                       defaults.maximum_move);
  }

  /// Named ranges, "[low, high]".
  std::vector<LimitDraft> read_ranges(const TableReader& table, const std::string& key,
                                      const std::string& example, Range range) {
    std::vector<LimitDraft> limits;
    const std::string more = range == Range::finite ? "" : "; inf and -inf stand for no limit";
    for (const NamedItem& item : named_items(table, key, example, reading_)) {
      const Node& value = *item.value;
      if (value.kind != Node::Kind::array || value.items.size() != 2) {
        reading_.problems.add(value.place, item.name.key,
                              "got " + described(value) + ", need [low, high]" + more);
        continue;
      }
      const std::vector<NumberId> ids =
          read_numbers(list_items({&value, item.name.key}, "[low, high]", reading_), {range, ""},
                       draft_.numbers, reading_);
      draft_.numbers.require_less(ids[0], ids[1], "low < high");
      limits.push_back({item.name, ids[0], ids[1]});
    }
    return limits;
  }

  void read_until() {
    draft_.until = read_ranges(table_, "until", "a table such as { deflection = [0, 1] }",
                               Range::maybe_infinite);
  }

  /// A table of the study; nothing where it is missing or no table.
  TableReader table_or_nothing(const std::string& name, const std::string& example,
                               const std::vector<std::string>& known) {
    static const Node nothing;
    const Node* node = table_.find(name);
    const Item item{node ? node : &nothing, table_.key_of(name)};
    return {is_table(item, example, reading_) ? *item.node : nothing, item.key, known, reading_};
  }

  void read_trace() {
    draft_.path = std::array{analysis::Path::arc_length,
                             analysis::Path::davidenko}[table_.choice("path", path_words, 0)];
    const analysis::TraceSettings defaults;
    const TableReader trace = table_or_nothing("trace", "a table such as { maximum_step = 0.05 }",
                                               {"initial_step", "minimum_step", "maximum_step",
                                                "maximum_points", "spacing", "verify_arcs"});
    NumberTable& numbers = draft_.numbers;
    for (auto [name, id] : {std::pair{"initial_step", &draft_.initial_step},
                            {"minimum_step", &draft_.minimum_step},
                            {"maximum_step", &draft_.maximum_step}})
      if (trace.has(name)) *id = trace.number(name, {Range::positive, ""}, numbers, 0);
    draft_.maximum_points =
        trace.number("maximum_points", {Range::at_least_two, ""}, numbers, defaults.maximum_points);
    draft_.spacing = trace.number("spacing", {Range::non_negative, ""}, numbers, defaults.spacing);
    draft_.verify_arcs = trace.truth("verify_arcs", defaults.verify_arcs);
    if (draft_.verify_arcs && draft_.path == analysis::Path::davidenko)
      reading_.problems.add(trace.find("verify_arcs")->place, trace.key_of("verify_arcs"),
                            "got true, need path = \"arc_length\": others are not tested");
  }

  void read_branches() {
    const analysis::BranchSettings defaults;
    const TableReader branches =
        table_or_nothing("branches", "a table such as { depth = 1 }",
                         {"depth", "maximum", "search_at", "starts", "seed"});
    NumberTable& numbers = draft_.numbers;
    const auto count = [&](const std::string& name, Range range, double otherwise) {
      return branches.number(name, {range, ""}, numbers, otherwise);
    };
    draft_.depth = count("depth", Range::whole, draft_.snap.is_kind ? 1 : defaults.depth);
    require_count(draft_.depth);
    draft_.maximum_branches = count("maximum", Range::small_count, defaults.maximum);
    draft_.search_starts = count("starts", Range::small_count, defaults.starts);
    draft_.search_seed = count("seed", Range::whole, static_cast<double>(defaults.seed));
    draft_.search_at = read_numbers(branches.list("search_at", "a list of values of lambda"), {},
                                    numbers, reading_);
  }

  /// A count is converted to an integer: it must fit.
  void require_count(NumberId id) {
    const Definition& at = draft_.numbers.definition(id);
    draft_.numbers.require({id}, at.place, at.key, [](const std::vector<double>& value) {
      return value[0] <= 1e6
                 ? std::string{}
                 : "got " + shortest(value[0]) + ", need a whole number from 0 to 1000000";
    });
  }

  void read_search() {
    const analysis::SearchSettings defaults;
    const TableReader search = table_or_nothing("search", "a table such as { starts = 500 }",
                                                {"starts", "seed", "maximum", "box"});
    if (table_.has("search") && draft_.kind != StudyKind::equilibria)
      reading_.problems.add(search.place(), search.key(),
                            "goes with kind = \"equilibria\"; branches = { search_at = [...] } "
                            "searches beside curves");
    NumberTable& numbers = draft_.numbers;
    draft_.equilibria_starts =
        search.number("starts", {Range::small_count, ""}, numbers, defaults.starts);
    draft_.equilibria_seed =
        search.number("seed", {Range::whole, ""}, numbers, static_cast<double>(defaults.seed));
    draft_.equilibria_maximum =
        search.number("maximum", {Range::small_count, ""}, numbers, defaults.maximum);
    draft_.box = read_ranges(search, "box", "a table such as { tool.x = [-1, 1] }", Range::finite);
  }

  TableReader table_;
  const MechanismDraft& mechanism_;
  Reading& reading_;
  StudyDraft draft_{};
  bool body_known_ = false;
  bool begins_on_curve_ = false;  ///< what says which curve is traced is that of another study
};

}  // namespace

std::vector<StudyDraft> read_studies(const std::vector<Item>& tables,
                                     const MechanismDraft& mechanism, Reading& reading) {
  std::vector<StudyDraft> studies;
  std::set<std::string> names;
  std::deque<Node> copies;
  for (const Item& item : with_earlier_curves(tables, copies, reading.problems)) {
    StudyDraft study = StudyReader{item, mechanism, reading}.read();
    if (!study.name.empty() && !names.insert(study.name).second)
      reading.problems.add(item.node->find("name")->place, item.key + ".name",
                           "\"" + study.name +
                               "\" is already the name of another study, need "
                               "different names");
    studies.push_back(std::move(study));
  }
  connect_curves(studies);
  connect_histories(mechanism, studies, reading.problems);
  return studies;
}

}  // namespace springfold::io
