// summary.json: what was found, run by run. Layout: docs/results.md.
#include <nlohmann/json.hpp>

#include "comparison_text.hpp"
#include "counts_beside.hpp"
#include "design_summary.hpp"
#include "json_text.hpp"
#include "jump_access.hpp"
#include "result_access.hpp"
#include "result_tables.hpp"
#include "springfold/io/results.hpp"
#include "sweep_points.hpp"
#include "sweep_tables.hpp"

namespace springfold::io {

namespace {

using Json = nlohmann::ordered_json;
using analysis::StudyResult;

/// Rows of the matrix; null for an empty one.
Json json_of(const Matrix& matrix) {
  if (matrix.size() == 0) return nullptr;
  Json rows = Json::array();
  for (Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json json_of(const analysis::Stop& stop) {
  return {{"reason", stop.reason}, {"complete", stop.complete}};
}

/// {"s": ..., "lambda": ..., ...}; null without values.
Json by_quantity(const StudyResult& result, const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  Json named = Json::object();
  for (std::size_t i = 0; i < std::min(values.size(), result.quantities.size()); ++i)
    named[result.quantities[i].name] = values[i];
  return named;
}

Json json_of(const StudyResult& result, const analysis::Branch& branch,
             const analysis::Event& event) {
  Json json = {{"label", event.label},
               {"code", analysis::code_of(event.kind)},
               {"detail", event.detail},
               {"row", event.row}};
  const bool exists = event.row < branch.samples.size();
  json["values"] = exists ? by_quantity(result, branch.samples[event.row].values) : Json{};
  Json before = Json::object(), after = Json::object();
  for (const std::string_view name : count_columns) {
    if (!column_of(result, name)) continue;
    const CountsBeside counts = counts_beside(result, branch, event, name);
    before[std::string(name)] = counts.before;
    after[std::string(name)] = counts.after;
  }
  json["counts_before"] = std::move(before);
  json["counts_after"] = std::move(after);
  json["rates_before"] = by_quantity(result, event.rates_before);
  json["rates_after"] = by_quantity(result, event.rates_after);
  for (const auto& mode : event.modes) json["modes"].push_back(by_quantity(result, mode));
  json["stiffness"] = json_of(event.stiffness);
  json["compliance"] = json_of(event.compliance);
  if (event.stiffness_after.size() > 0) json["stiffness_after"] = json_of(event.stiffness_after);
  if (event.compliance_after.size() > 0) json["compliance_after"] = json_of(event.compliance_after);
  return json;
}

Json counts_of_pieces(const analysis::RestingRows& rows) {
  using Stable = analysis::RestingRows::Stable;
  const char* stable = rows.stable == Stable::yes  ? "yes"
                       : rows.stable == Stable::no ? "no"
                                                   : "undecided";
  return {{"stable", stable}, {"fewest_unstable", rows.fewest}, {"most_unstable", rows.most}};
}

Json json_of(const analysis::VerifiedArcs& arcs) {
  Json sampled = Json::array();
  for (const auto& stretch : arcs.sampled) sampled.push_back({stretch.s_begin, stretch.s_end});
  return {{"length", arcs.length},
          {"verified", arcs.verified},
          {"share", arcs.share()},
          {"sampled", std::move(sampled)}};
}

Json json_of(const StudyResult& result, const analysis::Branch& branch, const std::string& file) {
  Json json = {{"file", file},
               {"points", branch.samples.size()},
               {"start_row", branch.start_row},
               {"refused_steps", branch.log.size()},
               {"depth", branch.depth},
               {"origin", branch.origin},
               {"origin_branch", branch.origin_branch},
               {"start", branch.start},
               {"backward", json_of(branch.backward)},
               {"forward", json_of(branch.forward)}};
  json["arcs"] = branch.arcs ? json_of(*branch.arcs) : Json{};
  json["resting"] = Json::array();
  for (const analysis::RestingRows& rows : branch.resting) {
    Json stretch = {{"first_row", rows.first}, {"last_row", rows.last}};
    stretch.update(counts_of_pieces(rows));
    json["resting"].push_back(std::move(stretch));
  }
  json["events"] = Json::array();
  for (const auto& event : branch.events) json["events"].push_back(json_of(result, branch, event));
  return json;
}

Json json_of(const analysis::Junction& junction) {
  return {{"label", junction.label},   {"code", analysis::code_of(junction.kind)},
          {"branch", junction.branch}, {"multiplicity", junction.multiplicity},
          {"ways", junction.ways},     {"complete", junction.complete},
          {"why", junction.why}};
}

Json json_of(const analysis::Search& search) {
  return {{"lambda", search.lambda},
          {"starts", search.starts},
          {"found", search.found},
          {"traced", search.traced},
          {"out_of_range", search.out_of_range},
          {"limit_reached", search.limit_reached}};
}

template <class T>
Json json_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(json_of(item));
  return list;
}

/// null for studies of another kind.
Json equilibria_json(const StudyResult& result, const std::string& file) {
  if (!result.equilibria) return nullptr;
  const analysis::EquilibriaReport& report = *result.equilibria;
  Json list = Json::array();
  for (const auto& e : report.list)
    list.push_back({{"label", e.label},
                    {"start", e.is_start},
                    {"potential", e.potential},
                    {"note", e.note},
                    {"resting", e.resting ? counts_of_pieces(*e.resting) : Json()},
                    {"values", by_quantity(result, e.sample.values)},
                    {"stiffness", json_of(e.stiffness)}});
  return {{"file", file},
          {"at_least", report.list.size()},
          {"starts", report.starts},
          {"out_of_range", report.out_of_range},
          {"locked", report.locked},
          {"limit_reached", report.limit_reached},
          {"morse",
           {{"applies", report.morse.applies},
            {"expected", report.morse.applies ? Json(report.morse.expected) : Json()},
            {"found", report.morse.applies ? Json(report.morse.found) : Json()},
            {"why", report.morse.why}}},
          {"list", list}};
}

/// null for studies of another kind.
Json threshold_json(const StudyResult& result) {
  if (!result.threshold) return nullptr;
  const analysis::ThresholdReport& report = *result.threshold;
  return {{"found", report.found},
          {"value", report.found ? Json(report.value) : Json()},
          {"decides", report.decides},
          {"verified", report.verified},
          {"message", report.message}};
}

/// Chain stiffnesses by the chains' names.
Json chain_stiffnesses(const std::vector<Matrix>& matrices, const PlannedRun* planned) {
  Json json = Json::object();
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const bool has_name = planned != nullptr && i < planned->mechanism.chains.size();
    const auto name = has_name ? planned->mechanism.chains[i].name : std::to_string(i + 1);
    json[name] = json_of(matrices[i]);
  }
  return json;
}

Json json_of(const analysis::RedundantClosures& redundant) {
  return {{"count", redundant.count},
          {"of", redundant.of},
          {"chains", redundant.chains},
          {"smallest_kept", redundant.smallest_kept},
          {"largest_dropped", redundant.largest_dropped}};
}

Json json_of(const StudyResult& result, const PlannedRun* planned) {
  const analysis::StartReport& start = result.start;
  Json sides = Json::array();
  for (const auto& side : start.sides)
    sides.push_back({{"piece", side.piece},
                     {"stiffness", json_of(side.stiffness)},
                     {"compliance", json_of(side.compliance)}});
  Json ways = Json::array();
  for (const auto& way : start.ways)
    ways.push_back({{"branch", way.branch}, {"rates", by_quantity(result, way.rates)}});
  Json tangent = Json::array();
  for (const auto& [real, imaginary] : start.tangent)
    tangent.push_back({{"real", real}, {"imaginary", imaginary}});
  return {{"found", start.found},
          {"method", start.method},
          {"message", start.message},
          {"attempts", start.attempts},
          {"iterations", start.iterations},
          {"chain_iterations", start.chain_iterations},
          {"residual", start.residual},
          {"guess_residual", start.guess_residual},
          {"moved", start.moved},
          {"moved_most", start.moved_most},
          {"situation", start.situation},
          {"sides", sides},
          {"where", start.where},
          {"advice", start.advice},
          {"outside", start.outside},
          {"free_motions", start.free_motions},
          {"rates_before", by_quantity(result, start.rates_before)},
          {"rates_after", by_quantity(result, start.rates_after)},
          {"ways", ways},
          {"tangent_eigenvalues", tangent},
          {"zero_modes", start.zero_modes},
          {"redundant_closures", json_of(start.redundant)},
          {"stiffness", json_of(start.stiffness)},
          {"compliance", json_of(start.compliance)},
          {"chain_stiffnesses", chain_stiffnesses(start.chain_stiffnesses, planned)}};
}

Json json_of(const StudyResult& result, const PlannedRun* planned, const UnitLabels& units,
             const std::vector<std::string>& files, const std::string& equilibria_file) {
  Json json = {{"study", result.study}, {"run", result.run}, {"label", result.label}};
  json["complete"] = analysis::complete(result);
  json["parameters"] = planned != nullptr ? Json(planned->parameters) : Json::object();
  json["quantities"] = Json::array();
  for (const auto& quantity : result.quantities) {
    const auto unit = unit_label(quantity.unit, result.lambda_unit, units);
    json["quantities"].push_back({{"name", quantity.name}, {"unit", unit}});
  }
  json["conservative"] = result.non_conservative.empty();
  json["non_conservative"] = result.non_conservative;
  json["start"] = json_of(result, planned);
  json["event_counts"] = Json(event_counts(result));
  json["branches"] = Json::array();
  for (std::size_t b = 0; b < result.branches.size(); ++b)
    json["branches"].push_back(json_of(result, result.branches[b], files[b]));
  json["junctions"] = json_of(result.junctions);
  json["searches"] = json_of(result.searches);
  json["equilibria"] = equilibria_json(result, equilibria_file);
  json["threshold"] = threshold_json(result);
  if (result.design) json["design"] = design_json(*result.design);
  if (result.snap) json["snap"] = jumps_json(result);
  json["ways_not_followed"] = analysis::ways_not_followed(result);
  json["doubts"] = result.doubts;
  return json;
}

Json missing_runs(const Case& the_case, const std::vector<StudyResult>& results) {
  Json missing = Json::array();
  for (const auto& planned : the_case.runs)
    if (result_of(results, planned.study, planned.run) == nullptr)
      missing.push_back({{"study", planned.study}, {"run", planned.run}});
  return missing;
}

/// Tables with one row per run.
Json sweeps_json(const Case& the_case, const std::vector<StudyResult>& results) {
  Json list = Json::array();
  const auto files = sweep_files(the_case);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const SweepTable& sweep = the_case.sweeps[i];
    const SweepCounts counts = counts_of(the_case, sweep, results);
    list.push_back({{"study", sweep.study},
                    {"file", files[i]},
                    {"parameters", sweep.parameters},
                    {"columns", sweep.columns},
                    {"runs", counts.planned},
                    {"done", counts.done},
                    {"complete", counts.complete}});
  }
  return list;
}

/// Special points over the parameters: every point of every run with all columns.
Json sweep_points_json(const std::vector<SweepPoints>& sweeps,
                       const std::vector<std::string>& files) {
  Json list = Json::array();
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    Json runs = Json::array();
    for (const SweepPoints::Run& run : sweeps[i].runs) {
      Json json = {{"run", run.planned->run}, {"parameters", Json::object()}};
      for (const std::string& name : sweeps[i].parameters)
        json["parameters"][name] = varied_value(run.planned, name);
      json["points"] = Json::object();
      for (std::size_t p = 0; p < sweeps[i].labels.size(); ++p)
        if (const auto& place = run.places[p])
          json["points"][sweeps[i].labels[p]] =
              by_quantity(*run.result, place->branch->samples[place->row].values);
      runs.push_back(std::move(json));
    }
    list.push_back({{"study", sweeps[i].study},
                    {"file", files[i]},
                    {"parameters", sweeps[i].parameters},
                    {"labels", sweeps[i].labels},
                    {"runs", std::move(runs)}});
  }
  return list;
}

}  // namespace

std::string summary_json(const Case& the_case, const std::vector<StudyResult>& results) {
  Json summary = {{"schema_version", 1}};
  summary["case"] = {
      {"file", the_case.file.filename().string()},
      {"title", the_case.title},
      {"hash", the_case.hash},
      {"units", {{"length", the_case.units.length}, {"force", the_case.units.force}}}};
  summary["complete"] = all_complete(the_case, results);
  summary["missing_runs"] = missing_runs(the_case, results);
  summary["runs"] = Json::array();
  const auto files = branch_files(results);
  const auto equilibria = equilibria_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (!results[i].row)
      summary["runs"].push_back(json_of(results[i], plan_of(the_case, results[i]), the_case.units,
                                        files[i], equilibria[i]));
  if (!the_case.sweeps.empty()) summary["sweeps"] = sweeps_json(the_case, results);
  const std::vector<SweepPoints> sweeps = sweep_points_of(the_case, results);
  if (!sweeps.empty())
    summary["sweep_points"] = sweep_points_json(sweeps, sweep_points_files(the_case, sweeps));
  summary["comparisons"] = Json::array();
  for (const auto& comparison : compare(the_case.expected, results))
    summary["comparisons"].push_back(comparison_json(comparison));
  return json_text(summary);
}

}  // namespace springfold::io
