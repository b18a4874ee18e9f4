#include "report_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "map_figure.hpp"
#include "nothing.hpp"
#include "quantity_sizes.hpp"
#include "report_lists.hpp"
#include "result_access.hpp"
#include "result_tables.hpp"
#include "smooth_line.hpp"
#include "springfold/drawing/illustration.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/io/shown_text.hpp"
#include "springfold/version.hpp"
#include "sweep_tables.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::ordered_json;
using analysis::Sample;
using analysis::StudyKind;
using analysis::StudyResult;

Json json_of(const model::Vec3<double>& v) { return {v.x(), v.y(), v.z()}; }

const char* word_of(drawing::JointShape shape) {
  switch (shape) {
    case drawing::JointShape::revolute:
      return "revolute";
    case drawing::JointShape::prismatic:
      return "prismatic";
    case drawing::JointShape::universal:
      return "universal";
    case drawing::JointShape::spherical:
      return "spherical";
    case drawing::JointShape::elastic:
      return "elastic";
    case drawing::JointShape::pin:
      return "pin";
  }
  return "";
}

const char* word_of(model::JointRole role) {
  switch (role) {
    case model::JointRole::passive:
      return "passive";
    case model::JointRole::preloaded:
      return "preloaded";
    case model::JointRole::compliant:
      return "virtual";
    case model::JointRole::actuated:
      return "actuated";
  }
  return "";
}

const char* word_of(drawing::Member member) {
  switch (member) {
    case drawing::Member::none:
      return "";
    case drawing::Member::bar:
      return "bar";
    case drawing::Member::cable:
      return "cable";
    case drawing::Member::strut:
      return "strut";
  }
  return "";
}

/// Parts and the numbers of their points: the same for all rows of a run.
Json parts_of(const drawing::Scene& scene) {
  const drawing::View view = drawing::natural_view(scene);
  Json json = {{"dimension", scene.is_planar ? 2 : 3},
               {"points", scene.points.size()},
               {"right", json_of(view.right)},
               {"up", json_of(view.up)},
               {"chains", scene.chains}};
  for (const char* list :
       {"links", "joints", "springs", "outlines", "stops", "bodies", "loads", "base", "names"})
    json[list] = Json::array();
  for (const auto& p : scene.links)
    json["links"].push_back(
        {{"from", p.from}, {"to", p.to}, {"chain", p.chain}, {"rail", p.is_rail}});
  for (const auto& p : scene.joints)
    json["joints"].push_back({{"name", p.name},
                              {"shape", word_of(p.shape)},
                              {"role", word_of(p.role)},
                              {"at", p.at},
                              {"axis", p.axis}});
  for (const auto& p : scene.springs)
    json["springs"].push_back({{"name", p.name},
                               {"line", p.is_line},
                               {"from", p.from},
                               {"at", p.at},
                               {"to", p.to},
                               {"member", word_of(p.member)}});
  for (const auto& p : scene.outlines)
    json["outlines"].push_back({{"name", p.name}, {"corners", p.corners}});
  for (const auto& p : scene.stops)
    json["stops"].push_back(
        {{"spring", p.spring}, {"at", p.at}, {"tip", p.tip}, {"slide", p.is_slide}});
  for (const auto& p : scene.bodies)
    json["bodies"].push_back({{"name", p.name}, {"origin", p.origin}, {"corners", p.corners}});
  for (const auto& p : scene.loads)
    json["loads"].push_back({{"name", p.name},
                             {"at", p.at},
                             {"moment", p.is_moment},
                             {"direction", p.is_direction},
                             {"weight", p.is_weight}});
  for (const auto& p : scene.base) json["base"].push_back({{"at", p.at}, {"towards", p.towards}});
  for (const auto& p : scene.names) json["names"].push_back({{"name", p.name}, {"at", p.at}});
  return json;
}

void add(const model::Vec3<double>& v, Index dimension, std::vector<double>& list) {
  for (Index i = 0; i < dimension; ++i) list.push_back(v[i]);
}

/// Numbers of the rows of a list, row after row.
struct RowNumbers {
  std::vector<double> values{}, points{}, springs{}, loads{};
  std::vector<double> outlines{};  ///< of each outline 1 where what is on it acts, otherwise 0
  std::vector<int> layout{};       ///< which parts each row has; -1: no posture is known
};

/// Are they the same parts, of which some may be elsewhere? A spring whose stiffness a parameter makes 0 is none.
bool are_alike(const drawing::Scene& a, const drawing::Scene& b) {
  const auto is_same = [](const drawing::SpringPart& s, const drawing::SpringPart& t) {
    return s.from == t.from && s.at == t.at && s.to == t.to && s.is_line == t.is_line;
  };
  return a.points.size() == b.points.size() && a.links.size() == b.links.size() &&
         a.joints.size() == b.joints.size() && a.stops.size() == b.stops.size() &&
         a.outlines.size() == b.outlines.size() && a.loads.size() == b.loads.size() &&
         std::equal(a.springs.begin(), a.springs.end(), b.springs.begin(), b.springs.end(),
                    is_same);
}

/// One scene for every set of parts that occurs.
using Layouts = std::vector<drawing::Scene>;

int layout_of(const std::optional<drawing::Scene>& scene, Layouts& layouts) {
  if (!scene) return -1;
  const auto known = std::find_if(layouts.begin(), layouts.end(), [&](const drawing::Scene& other) {
    return are_alike(*scene, other);
  });
  const auto number = static_cast<int>(known - layouts.begin());
  if (known == layouts.end()) layouts.push_back(*scene);
  return number;
}

void add_row(const StudyResult& result, const Sample& row,
             const std::optional<drawing::Scene>& scene, Layouts& layouts, RowNumbers& rows) {
  for (std::size_t i = 0; i < result.quantities.size(); ++i)
    rows.values.push_back(i < row.values.size() ? row.values[i] : nothing);
  rows.layout.push_back(layout_of(scene, layouts));
  if (!scene) return;
  for (const auto& p : scene->points) add(p, scene->is_planar ? 2 : 3, rows.points);
  for (const auto& s : scene->springs)
    rows.springs.insert(rows.springs.end(), {s.acts ? 1.0 : 0.0, s.force});
  for (const auto& load : scene->loads) add(load.vector, 3, rows.loads);
  for (const auto& outline : scene->outlines) rows.outlines.push_back(outline.acts ? 1.0 : 0.0);
}

std::vector<double> motion_at(const RowScenes& scenes, const Sample& row,
                              const std::vector<double>& rates) {
  const auto scene = scenes.scene_of(row);
  std::vector<double> motion;
  for (const auto& velocity : scenes.motion_at(row, rates))
    add(velocity, scene && scene->is_planar ? 2 : 3, motion);
  return motion;
}

/// A run and the sizes of its quantities.
struct PageRun {
  const PlannedRun& planned;
  const StudyResult& result;
  const std::vector<double>& sizes;
};

/// Which rows of a stiffness belong to translations; empty where it is not that of all bodies.
std::vector<bool> translations_in(const Matrix& stiffness, const model::Mechanism& mechanism) {
  std::vector<bool> list;
  for (const auto& body : mechanism.bodies)
    for (Index i = 0; i < body.pose.size(); ++i)
      list.push_back(i < model::translations(body.task_space));
  if (std::ssize(list) != stiffness.rows()) list.clear();
  return list;
}

/// For people: at a located point an entry is 0 where an eigenvalue of its unit would be.
Matrix shown_stiffness(const Matrix& stiffness, const PageRun& run) {
  Matrix shown = shown_matrix(stiffness);
  const auto column = column_of(run.result, "K_eig1");
  const std::vector<bool> moves = translations_in(stiffness, run.planned.mechanism);
  if (!column || moves.empty()) return shown;
  for (Index r = 0; r < shown.rows(); ++r)
    for (Index c = 0; c < shown.cols(); ++c)
      if (moves[static_cast<std::size_t>(r)] && moves[static_cast<std::size_t>(c)])
        shown(r, c) = shown_in(run.sizes, *column, shown(r, c));
  return shown;
}

Json json_of(const PagePoint& point, const PageRows& list, const RowScenes& scenes,
             const PageRun& run) {
  Json json = {{"label", point.label},
               {"code", point.code},
               {"row", point.row},
               {"detail", point.detail},
               {"sentence", point.sentence}};
  if (point.event == nullptr) return json;
  const analysis::Event& event = *point.event;
  const auto& rates = event.rates_after.empty() ? event.rates_before : event.rates_after;
  if (event.row < list.rows.size() && scenes.has_postures()) {
    json["motion"] = base64_of(motion_at(scenes, *list.rows[event.row], rates));
    for (const std::vector<double>& mode : event.modes)
      json["modes"].push_back(base64_of(motion_at(scenes, *list.rows[event.row], mode)));
  }
  if (event.stiffness.size() > 0) {
    const Matrix stiffness = shown_stiffness(event.stiffness, run);
    json["stiffness"] = Json::array();
    for (Index i = 0; i < stiffness.rows(); ++i) {
      const Vector row = stiffness.row(i);
      json["stiffness"].push_back(std::vector<double>(row.begin(), row.end()));
    }
  }
  return json;
}

/// What targets and nodes say, each text once, and its number in every row; null where they say nothing.
Json status_of(const PageRows& list) {
  std::vector<std::string> texts;
  std::vector<std::size_t> numbers;
  for (const Sample* row : list.rows) {
    const auto known = std::find(texts.begin(), texts.end(), row->status);
    numbers.push_back(static_cast<std::size_t>(known - texts.begin()));
    if (known == texts.end()) texts.push_back(row->status);
  }
  if (texts.size() == 1 && texts.front().empty()) return nullptr;
  return {{"texts", texts}, {"of", numbers}};
}

/// Rows whose counts of unstable modes mean "at least one".
std::vector<std::size_t> resting_rows(const PageRows& list) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < list.rows.size(); ++row)
    if (list.rows[row]->rests) rows.push_back(row);
  return rows;
}

Json json_of(const PageRun& run, const PageRows& list, const RowScenes& scenes, Layouts& layouts) {
  RowNumbers rows;
  for (const Sample* row : list.rows)
    add_row(run.result, *row, scenes.scene_of(*row), layouts, rows);
  Json points = Json::array();
  for (const PagePoint& point : list.points) points.push_back(json_of(point, list, scenes, run));
  const bool is_usual =
      std::all_of(rows.layout.begin(), rows.layout.end(), [](int number) { return number == 0; });
  if (std::all_of(rows.outlines.begin(), rows.outlines.end(), [](double acts) { return acts > 0; }))
    rows.outlines.clear();  // the usual thing needs no room
  return {{"name", list.name},
          {"form", word_of(list.form)},
          {"file", list.file},
          {"rows", list.rows.size()},
          {"start", list.start},
          {"values", base64_of(rows.values)},
          {"points", base64_of(rows.points)},
          {"springs", base64_of(rows.springs)},
          {"loads", base64_of(rows.loads)},
          {"outlines", base64_of(rows.outlines)},
          {"layout", is_usual ? Json(nullptr) : Json(rows.layout)},
          {"status", status_of(list)},
          {"rests", resting_rows(list)},
          {"events", std::move(points)}};
}

/// Axes of a map, and the quantity that it was asked for; null for other kinds.
Json map_of(const PlannedRun& planned) {
  const auto& map = planned.plan.map;
  if (planned.plan.kind != StudyKind::map) return nullptr;
  Json axes = Json::array();
  for (const analysis::MapAxis& axis : map.axes)
    axes.push_back(
        {{"name", axis.name}, {"from", axis.from}, {"to", axis.to}, {"points", axis.points}});
  return {{"axes", axes}, {"quantity", quantity_of(map)}};
}

Json json_of(const Case& the_case, const StudyResult& result, const PlannedRun& planned,
             const std::vector<std::string>& files, const std::string& equilibria) {
  std::string table;  // of many runs
  const std::vector<std::string> tables = sweep_files(the_case);
  for (std::size_t i = 0; i < tables.size(); ++i)
    if (the_case.sweeps[i].study == result.study) table = tables[i];
  const bool is_traced = planned.plan.kind == StudyKind::force_deflection;
  const bool is_commanded = planned.plan.kind == StudyKind::control;
  const PageAxes axes = page_axes_of(planned, result);
  Json json = {{"study", shown_in_line(result.study)},
               {"run", result.run},
               {"label", shown_in_line(result.label)},
               {"kind", to_string(planned.plan.kind)},
               {"along", is_commanded ? smooth_along(planned.plan) : "s"},
               {"control", is_traced ? to_string(planned.plan.control) : std::string_view{}},
               {"parameters", planned.parameters},
               {"varied", planned.varied},
               {"start", result.start.found ? "" : result.start.message},
               {"table", table},
               {"doubts", result.doubts},
               {"axes", {axes.x, axes.y}},
               {"map", map_of(planned)},
               {"quantities", Json::array()},
               {"branches", Json::array()}};
  const std::vector<double> sizes = quantity_sizes(result);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const analysis::Quantity& q = result.quantities[i];
    json["quantities"].push_back(
        {{"name", q.name},
         {"title", column_title(result, q.name, &planned)},
         {"unit", shown_in_line(column_unit(result, i, &planned, the_case.units))},
         {"rounding", shown_below(sizes[i])}});
  }
  const PageLists page = page_lists_of(planned, result, files, equilibria, the_case.units);
  const RowScenes scenes{planned, result};
  Layouts layouts;
  for (const PageRows& list : page.lists)
    json["branches"].push_back(json_of(PageRun{planned, result, sizes}, list, scenes, layouts));
  json["mechanisms"] = Json::array();
  for (const drawing::Scene& scene : layouts) json["mechanisms"].push_back(parts_of(scene));
  return json;
}

}  // namespace

std::string base64_of(const std::vector<double>& numbers) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  bytes.reserve(8 * numbers.size());
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<unsigned char>(bits >> (8 * i)));
  }
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[word >> (18 - 6 * k) & 0x3FU] : '=';
  }
  return text;
}

std::string report_data(const Case& the_case, const std::vector<StudyResult>& results) {
  Json json = {{"version", version},
               {"title", shown_in_line(the_case.title)},
               {"case", shown_in_line(the_case.file.filename().string())},
               {"hash", the_case.hash},
               {"units", Json::object()},
               {"runs", Json::array()}};
  for (const auto& [name, unit] : the_case.units.parameters)
    json["units"][name] = shown_in_line(unit);
  const auto files = branch_files(results);
  const auto equilibria = equilibria_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const PlannedRun* planned = plan_of(the_case, results[i]))
      json["runs"].push_back(json_of(the_case, results[i], *planned, files[i], equilibria[i]));
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain)  // "<" occurs in texts only, never in JSON itself
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text;
}

}  // namespace springfold::io
