// Jumps in the summary, as JSON and as a table.
#include <algorithm>
#include <cmath>

#include "cycle_access.hpp"
#include "jump_access.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "summary_line.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {
namespace {

using Json = nlohmann::ordered_json;
using analysis::InertialMotion;
using analysis::Jump;
using analysis::SnapState;
using analysis::StudyResult;

double value_of(const StudyResult& result, const SnapState& state, std::string_view name) {
  const auto column = column_of(result, name);
  return column && *column < state.values.size() ? state.values[*column]
                                                 : std::numeric_limits<double>::quiet_NaN();
}

/// A result with the sizes of its quantities.
struct Sized {
  const StudyResult& result;
  std::vector<double> sizes{};
};

std::string lambda_text(const Sized& sized, const SnapState& state) {
  const auto column = column_of(sized.result, "lambda");
  if (!column || *column >= state.values.size()) return "nan";
  return rounded(shown_in(sized.sizes, *column, state.values[*column]), summary_digits);
}

/// "apex.x = 0, apex.y = -1.5": poses of the bodies, which come behind the study's own columns.
std::string pose_text(const Sized& sized, const SnapState& state) {
  const StudyResult& result = sized.result;
  std::string text;
  for (std::size_t i = 0; i < result.quantities.size() && i < state.values.size(); ++i) {
    const std::string& name = result.quantities[i].name;
    const std::size_t dot = name.find('.');
    const bool is_pose = dot != std::string::npos && name.find('.', dot + 1) == std::string::npos;
    static const std::vector<std::string> coordinates{"x", "y", "z", "phi", "rx", "ry", "rz"};
    if (!is_pose || std::find(coordinates.begin(), coordinates.end(), name.substr(dot + 1)) ==
                        coordinates.end())
      continue;
    text += (text.empty() ? "" : ", ") + name + " = " +
            rounded(shown_in(sized.sizes, i, state.values[i]), summary_digits);
  }
  return text;
}

std::string place_of(const SnapState& state) {
  return state.branch > 0 ? "on branch " + std::to_string(state.branch) : "outside of the branches";
}

std::string warning_text(const analysis::SnapWarning& warning) {
  constexpr double degree = 0.017453292519943295;
  const std::string angle = rounded(warning.angle / degree, summary_digits) + " degrees";
  return warning.kind == analysis::SnapWarning::Kind::dead_point
             ? "WARNING: leg " + warning.coordinate + " lands at a dead point: " + angle
             : "WARNING: leg " + warning.coordinate + " lands beyond 90 degrees: " + angle;
}

/// What the motion with masses says beside the overdamped one.
std::string inertial_lines(const Sized& sized, const InertialMotion& motion,
                           const std::string& energy) {
  if (motion.end == InertialMotion::End::no_mass)
    return summary_line("", "with masses: REFUSED, nothing with a mass moves" +
                                (motion.massless.empty() ? "" : " with " + motion.massless));
  if (motion.end == InertialMotion::End::no_end)
    return summary_line("", "with masses: not integrated to a state of rest");
  std::string text =
      motion.end == InertialMotion::End::runs_away
          ? summary_line("", "with masses it runs away")
          : summary_line("", "with masses it lands " + place_of(motion.landing) + ": " +
                                 pose_text(sized, motion.landing) + ", released " +
                                 rounded(motion.released, summary_digits) + energy);
  const bool swings_on = motion.end == InertialMotion::End::swings_on;
  constexpr int few = 4;  // of what a motion of a certain push says
  text += summary_line(
      "", "peak speed " + rounded(motion.peak_speed, few) +
              (motion.peak_force_of.empty() ? ""
                                            : ", peak force " + rounded(motion.peak_force, few) +
                                                  " (" + motion.peak_force_of + ")") +
              (swings_on ? ", swings on " + rounded(motion.followed, few)
                         : ", settled " + rounded(motion.duration, few)) +
              " after a push of " +
              (std::isnan(motion.push) ? "1e-3 radian or sizes of the mechanism"
                                       : rounded(motion.push, few) + " of the way to the landing"));
  return text;
}

std::string lines_of(const Sized& sized, const Jump& jump, const std::string& energy) {
  std::string text = summary_line(
      jump.label, "from " + jump.from + (jump.towards.empty() ? "" : ", " + jump.towards) +
                      ", lambda = " + lambda_text(sized, jump.critical) +
                      (jump.loading > 0 ? " (rising): " : " (falling): ") +
                      to_string(jump.verdict));
  if (!jump.landing.values.empty()) {
    text +=
        summary_line("", "lands " + place_of(jump.landing) + ": " + pose_text(sized, jump.landing));
    text += summary_line("", "released " + rounded(jump.released, summary_digits) + energy +
                                 ", overdamped time scale " + rounded(jump.time_scale, 4));
    if (!jump.barriers.empty() && std::isfinite(jump.barriers.front()))
      text += summary_line("", "held there by a barrier of " +
                                   rounded(jump.barriers.front(), summary_digits) + energy);
  }
  for (const SnapState& other : jump.others)
    text += summary_line(
        "", "or, with inertia or other damping: " + pose_text(sized, other) + ", released " +
                rounded(jump.critical.energy - other.energy, summary_digits) + energy);
  if (jump.may_run_away && jump.verdict == analysis::SnapVerdict::depends)
    text += summary_line("", "or it runs away");
  if (jump.inertial) text += inertial_lines(sized, *jump.inertial, energy);
  for (const std::string& name : jump.switches) text += summary_line("", "switches: " + name);
  for (const auto& warning : jump.warnings) text += summary_line("", warning_text(warning));
  if (jump.back > 0) {
    const Jump& back = sized.result.snap->jumps[static_cast<std::size_t>(jump.back - 1)];
    text += summary_line("", "leaves it again at " + back.from + ", lambda = " +
                                 lambda_text(sized, back.critical) + " (" + back.label + ")" +
                                 (std::isnan(jump.loop)
                                      ? ""
                                      : "; the loop closes, " + rounded(jump.loop, summary_digits) +
                                            energy + " lost in each"));
  }
  return text;
}

Json by_quantity(const StudyResult& result, const SnapState& state) {
  if (state.values.empty()) return nullptr;
  Json named = Json::object();
  for (std::size_t i = 0; i < std::min(state.values.size(), result.quantities.size()); ++i)
    named[result.quantities[i].name] = state.values[i];
  return {{"energy", state.energy}, {"index", state.index}, {"branch", state.branch},
          {"row", state.row},       {"piece", state.piece}, {"values", named}};
}

/// Cells of the motion with masses, in its own row.
std::string inertial_cells(const Jump& jump, const std::string& state) {
  if (!jump.inertial || state != "inertial") return ",,,,";
  const InertialMotion& motion = *jump.inertial;
  return "," + csv_number(motion.peak_speed) + "," + csv_number(motion.peak_force) + "," +
         csv_number(motion.peak_moment) + "," + csv_number(motion.duration);
}

Json list_of(const StudyResult& result, const std::vector<SnapState>& states) {
  Json list = Json::array();
  for (const SnapState& state : states) list.push_back(by_quantity(result, state));
  return list;
}

Json inertial_json(const StudyResult& result, const Jump& jump) {
  if (!jump.inertial) return nullptr;
  const InertialMotion& motion = *jump.inertial;
  return {{"end", to_string(motion.end)},
          {"massless", motion.massless},
          {"landing", by_quantity(result, motion.landing)},
          {"released", motion.released},
          {"push", motion.push},
          {"peak_speed", motion.peak_speed},
          {"peak_force", motion.peak_force},
          {"peak_force_of", motion.peak_force_of},
          {"peak_moment", motion.peak_moment},
          {"peak_moment_of", motion.peak_moment_of},
          {"duration", motion.duration},
          {"followed", motion.followed},
          {"left", motion.left},
          {"would_last", motion.would_last},
          {"dissipated", motion.dissipated}};
}

Json json_of(const StudyResult& result, const Jump& jump) {
  Json warnings = Json::array();
  for (const auto& warning : jump.warnings)
    warnings.push_back(
        {{"kind",
          warning.kind == analysis::SnapWarning::Kind::dead_point ? "dead_point" : "turned_beyond"},
         {"coordinate", warning.coordinate},
         {"angle", warning.angle}});
  return {{"label", jump.label},
          {"from", jump.from},
          {"branch", jump.branch},
          {"loading", jump.loading},
          {"side", jump.side},
          {"towards", jump.towards},
          {"verdict", to_string(jump.verdict)},
          {"released", jump.released},
          {"critical", by_quantity(result, jump.critical)},
          {"landing", by_quantity(result, jump.landing)},
          {"others", list_of(result, jump.others)},
          {"saddles", list_of(result, jump.saddles)},
          {"barriers", jump.barriers},
          {"may_run_away", jump.may_run_away},
          {"time_scale", jump.time_scale},
          {"switches", jump.switches},
          {"warnings", warnings},
          {"inertial", inertial_json(result, jump)},
          {"back", jump.back},
          {"loop", jump.loop}};
}

/// What is not followed may jump: nothing is claimed of it.
std::string no_jump_line(const StudyResult& result) {
  const bool has_begun =
      std::any_of(result.branches.begin(), result.branches.end(),
                  [](const analysis::Branch& branch) { return branch.samples.size() > 1; });
  if (!has_begun) return {};
  return summary_line("jumps", analysis::complete(result)
                                   ? "none: stability is nowhere lost to a jump"
                                   : "none on what was followed, which is not all");
}

}  // namespace

std::string jump_lines(const StudyResult& result, const UnitLabels& units) {
  if (!result.snap) return "";
  const analysis::SnapReport& report = *result.snap;
  const std::string energy = " " + unit_label(analysis::Unit::energy, result.lambda_unit, units);
  std::string text;
  if (report.jumps.empty() && report.refusals.empty()) text += no_jump_line(result);
  const Sized sized{result, report.jumps.empty() ? std::vector<double>{} : quantity_sizes(result)};
  for (const Jump& jump : report.jumps) text += lines_of(sized, jump, energy);
  for (const auto& handover : report.handovers)
    text +=
        summary_line(handover.at, "no jump: branch " + std::to_string(handover.branch) +
                                      " hands over to branch " + std::to_string(handover.next) +
                                      (handover.towards.empty() ? "" : ", " + handover.towards));
  const bool claims_one = std::any_of(report.jumps.begin(), report.jumps.end(), [](const Jump& j) {
    return j.verdict == analysis::SnapVerdict::unambiguous;
  });
  if (claims_one && !report.transitions)
    text +=
        summary_line("jumps",
                     "checked: landings are stable, and the energy falls on the whole way there; "
                     "\"unambiguous\" rests on a search: no other state was found below the "
                     "critical energy");
  return text + cycle_lines(result, units) + transition_lines(result, units);
}

Json jumps_json(const StudyResult& result) {
  if (!result.snap) return nullptr;
  Json jumps = Json::array(), handovers = Json::array();
  for (const Jump& jump : result.snap->jumps) jumps.push_back(json_of(result, jump));
  for (const auto& handover : result.snap->handovers)
    handovers.push_back({{"at", handover.at},
                         {"branch", handover.branch},
                         {"next", handover.next},
                         {"towards", handover.towards}});
  return {{"jumps", jumps},
          {"handovers", handovers},
          {"cycle", cycle_json(result)},
          {"transitions", transitions_json(result)},
          {"landing_branches", result.snap->landing_branches},
          {"refusals", result.snap->refusals}};
}

std::string jumps_csv(const std::vector<StudyResult>& results) {
  const std::vector<std::string> names =
      columns_where(results, [](const StudyResult& result) { return result.snap != nullptr; });
  std::string csv =
      "study,run,label,jump,from,branch,loading,side,towards,verdict,state,to_branch,potential,"
      "released,time_scale,back,loop,peak_speed,peak_force,peak_moment,duration";
  for (const auto& name : names) csv += "," + csv_text(name);
  csv += "\n";
  for (const auto& result : results) {
    if (!result.snap) continue;
    for (const Jump& jump : result.snap->jumps) {
      const auto add = [&](const std::string& what, const SnapState& state) {
        csv += csv_text(result.study) + "," + std::to_string(result.run) + "," +
               csv_text(result.label) + "," + jump.label + "," + csv_text(jump.from) + "," +
               std::to_string(jump.branch) + "," + std::to_string(jump.loading) + "," +
               std::to_string(jump.side) + "," + csv_text(jump.towards) + "," +
               csv_text(to_string(jump.verdict)) + "," + what + "," + std::to_string(state.branch) +
               "," + csv_number(state.energy) + "," +
               csv_number(jump.critical.energy - state.energy) + "," + csv_number(jump.time_scale) +
               "," + (jump.back > 0 ? "J" + std::to_string(jump.back) : "") + "," +
               csv_number(jump.loop) + inertial_cells(jump, what);
        for (const auto& name : names) csv += "," + csv_number(value_of(result, state, name));
        csv += "\n";
      };
      add("critical", jump.critical);
      if (!jump.landing.values.empty()) add("landing", jump.landing);
      for (const SnapState& other : jump.others) add("other", other);
      if (jump.inertial && !jump.inertial->landing.values.empty())
        add("inertial", jump.inertial->landing);
      for (const SnapState& saddle : jump.saddles) add("saddle", saddle);
    }
  }
  return csv;
}

}  // namespace springfold::io
