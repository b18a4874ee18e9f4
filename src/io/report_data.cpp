#include "report_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "nothing.hpp"
#include "result_access.hpp"
#include "result_tables.hpp"
#include "springfold/drawing/illustration.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/version.hpp"

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

/// Parts and the numbers of their points: the same for all rows of a run.
Json parts_of(const drawing::Scene& scene) {
  const drawing::View view = drawing::natural_view(scene);
  Json json = {{"dimension", scene.is_planar ? 2 : 3},
               {"points", scene.points.size()},
               {"right", json_of(view.right)},
               {"up", json_of(view.up)},
               {"chains", scene.chains}};
  for (const char* list :
       {"links", "joints", "springs", "stops", "bodies", "loads", "base", "names"})
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
    json["springs"].push_back(
        {{"name", p.name}, {"line", p.is_line}, {"from", p.from}, {"at", p.at}, {"to", p.to}});
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

/// Numbers of the rows of a branch, row after row.
struct RowNumbers {
  std::vector<double> values{}, points{}, springs{}, loads{};
};

void add_row(const StudyResult& result, const Sample& row,
             const std::optional<drawing::Scene>& scene, const drawing::Scene& first,
             RowNumbers& rows) {
  for (std::size_t i = 0; i < result.quantities.size(); ++i)
    rows.values.push_back(i < row.values.size() ? row.values[i] : nothing);
  const Index d = first.is_planar ? 2 : 3;
  const auto is_alike = scene && scene->points.size() == first.points.size() &&
                        scene->springs.size() == first.springs.size() &&
                        scene->loads.size() == first.loads.size();
  if (!is_alike) {
    rows.points.insert(rows.points.end(), first.points.size() * static_cast<std::size_t>(d),
                       nothing);
    rows.springs.insert(rows.springs.end(), 2 * first.springs.size(), nothing);
    rows.loads.insert(rows.loads.end(), 3 * first.loads.size(), nothing);
    return;
  }
  for (const auto& p : scene->points) add(p, d, rows.points);
  for (const auto& s : scene->springs)
    rows.springs.insert(rows.springs.end(), {s.acts ? 1.0 : 0.0, s.force});
  for (const auto& load : scene->loads) add(load.vector, 3, rows.loads);
}

std::vector<double> motion_at(const RowScenes& scenes, const Sample& row,
                              const std::vector<double>& rates) {
  const auto scene = scenes.scene_of(row);
  std::vector<double> motion;
  for (const auto& velocity : scenes.motion_at(row, rates))
    add(velocity, scene && scene->is_planar ? 2 : 3, motion);
  return motion;
}

Json json_of(const analysis::Event& event, const analysis::Branch& branch,
             const RowScenes& scenes) {
  Json json = {{"label", event.label},
               {"code", analysis::code_of(event.kind)},
               {"row", event.row},
               {"detail", event.detail},
               {"sentence", explanation_of(event.kind)}};
  const auto& rates = event.rates_after.empty() ? event.rates_before : event.rates_after;
  if (event.row < branch.samples.size() && scenes.has_postures())
    json["motion"] = base64_of(motion_at(scenes, branch.samples[event.row], rates));
  if (event.stiffness.size() > 0) {
    json["stiffness"] = Json::array();
    for (Index i = 0; i < event.stiffness.rows(); ++i) {
      const Vector row = event.stiffness.row(i);
      json["stiffness"].push_back(std::vector<double>(row.begin(), row.end()));
    }
  }
  return json;
}

/// The first row whose posture is known says what parts there are.
std::optional<drawing::Scene> first_scene(const StudyResult& result, const RowScenes& scenes) {
  if (!scenes.has_postures()) return std::nullopt;
  for (const auto& branch : result.branches)
    for (const Sample& row : branch.samples)
      if (auto scene = scenes.scene_of(row)) return scene;
  return std::nullopt;
}

Json json_of(const Case& the_case, const StudyResult& result, const PlannedRun& planned,
             const std::vector<std::string>& files) {
  Json json = {
      {"study", result.study},
      {"run", result.run},
      {"label", result.label},
      {"kind", to_string(planned.plan.kind)},
      {"control", planned.plan.kind == StudyKind::force_deflection ? to_string(planned.plan.control)
                                                                   : std::string_view{}},
      {"parameters", planned.parameters},
      {"start", result.start.found ? "" : result.start.message},
      {"doubts", result.doubts},
      {"quantities", Json::array()},
      {"branches", Json::array()}};
  for (const auto& q : result.quantities)
    json["quantities"].push_back(
        {{"name", q.name}, {"unit", unit_label(q.unit, result.lambda_unit, the_case.units)}});
  if (planned.plan.kind == StudyKind::map || planned.plan.kind == StudyKind::workspace) return json;
  const RowScenes scenes{planned, result};
  const auto first = first_scene(result, scenes);
  if (first) json["mechanism"] = parts_of(*first);
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const analysis::Branch& branch = result.branches[b];
    RowNumbers rows;
    for (const Sample& row : branch.samples)
      add_row(result, row, first ? scenes.scene_of(row) : std::nullopt,
              first ? *first : drawing::Scene{}, rows);
    Json events = Json::array();
    for (const auto& event : branch.events) events.push_back(json_of(event, branch, scenes));
    json["branches"].push_back({{"file", b < files.size() ? files[b] : ""},
                                {"rows", branch.samples.size()},
                                {"start", branch.start_row},
                                {"stops", {branch.backward.reason, branch.forward.reason}},
                                {"values", base64_of(rows.values)},
                                {"points", base64_of(rows.points)},
                                {"springs", base64_of(rows.springs)},
                                {"loads", base64_of(rows.loads)},
                                {"events", std::move(events)}});
  }
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
               {"title", the_case.title},
               {"case", the_case.file.filename().string()},
               {"hash", the_case.hash},
               {"runs", Json::array()}};
  const auto files = branch_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const PlannedRun* planned = plan_of(the_case, results[i]))
      json["runs"].push_back(json_of(the_case, results[i], *planned, files[i]));
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
