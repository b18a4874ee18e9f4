#include "compared_quantity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "jump_access.hpp"
#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/analysis/design.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/system.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::Event;
using analysis::StudyResult;

constexpr std::string_view count_prefix = "count.";
constexpr std::string_view equilibrium_code = "EQ";

/// A row of a branch with the special point that is there, or one of several equilibria.
struct Point {
  const analysis::Sample* sample = nullptr;
  const Event* event = nullptr;
  const Matrix* stiffness = nullptr;
  double potential = nothing;
  const Matrix* compliance = nullptr;  ///< where there is no stiffness
  const Branch* branch = nullptr;      ///< of an event
  /// At the start: slopes on both sides of it.
  const std::vector<double>*rates_before = nullptr, *rates_after = nullptr;
};

double value_of_point(const StudyResult& result, const Point& point, const std::string& quantity) {
  if (quantity == "potential") return point.potential;
  const auto column = column_of(result, quantity);
  return column && *column < point.sample->values.size() ? point.sample->values[*column] : nothing;
}

Point point_of(const Branch& branch, const Event& event) {
  return {&branch.samples[event.row], &event,  &event.stiffness,    nothing,
          &event.compliance,          &branch, &event.rates_before, &event.rates_after};
}

bool is_index(const std::string& quantity) {
  return quantity == "index" || quantity == "index_force" || quantity == "index_pose" ||
         quantity == "index_driven";
}

/// The point as it is on one side of it: at a switching one of its two rows, and for counts of unstable
/// modes the row before or behind a special point, where they are defined.
Point on_side(Point point, Side side, const std::string& quantity) {
  if (side == Side::unsaid || point.event == nullptr || point.branch == nullptr) return point;
  const std::vector<analysis::Sample>& samples = point.branch->samples;
  const std::size_t row = point.event->row;
  if (has_two_rows(*point.branch, *point.event)) {
    if (side == Side::before || row + 1 >= samples.size()) return point;
    point.sample = &samples[row + 1];
    point.stiffness = &point.event->stiffness_after;
    point.compliance = &point.event->compliance_after;
    return point;
  }
  if (!is_index(quantity)) return point;
  if (side == Side::before && row > 0) point.sample = &samples[row - 1];
  if (side == Side::after && row + 1 < samples.size()) point.sample = &samples[row + 1];
  return point;
}

/// The row of a target of a study of commands.
const analysis::Sample* target_row(const StudyResult& result, int target) {
  const auto path = column_of(result, "path");
  if (!path || result.branches.empty()) return nullptr;
  for (const analysis::Sample& sample : result.branches.front().samples)
    if (sample.event.empty() && sample.values[*path] == target) return &sample;
  return nullptr;
}

Point point_of(const analysis::Equilibrium& e) {
  return {&e.sample, nullptr, &e.stiffness, e.potential};
}

/// "equilibria", or "equilibria.1" for those with one unstable mode.
double count_of(const analysis::EquilibriaReport& report, const StudyResult& result,
                std::string_view what) {
  const std::size_t dot = what.find('.');
  if (dot == std::string_view::npos) return static_cast<double>(report.list.size());
  const std::string wanted{what.substr(dot + 1)};
  return static_cast<double>(
      std::count_if(report.list.begin(), report.list.end(), [&](const analysis::Equilibrium& e) {
        return rounded(value_of_point(result, point_of(e), "index"), 3) == wanted;
      }));
}

double count_of(const StudyResult& result, std::string_view what) {
  if (what.starts_with("equilibria"))
    return result.equilibria ? count_of(*result.equilibria, result, what) : nothing;
  if (what == "jumps")
    return result.snap ? static_cast<double>(result.snap->jumps.size()) : nothing;
  if (what == "branches") return static_cast<double>(result.branches.size());
  const auto counts = event_counts(result);
  const auto found = counts.find(std::string{what});
  return found == counts.end() ? 0 : found->second;
}

const Event* event_in(const Branch& branch, std::size_t row) {
  for (const Event& event : branch.events)
    if (event.row == row) return &event;
  return nullptr;
}

/// All special points of this code, on all branches; for "row" all rows without one; for "EQ" all
/// equilibria.
std::vector<Point> points_with(const StudyResult& result, const std::string& code) {
  std::vector<Point> points;
  for (const Branch& branch : result.branches) {
    for (const Event& event : branch.events)
      if (analysis::code_of(event.kind) == code) points.push_back(point_of(branch, event));
    for (std::size_t row = 0; code == any_row && row < branch.samples.size(); ++row)
      if (branch.samples[row].event.empty())
        points.push_back({&branch.samples[row], nullptr, nullptr});
  }
  if (code == equilibrium_code && result.equilibria)
    for (const auto& e : result.equilibria->list) points.push_back(point_of(e));
  return points;
}

/// How far a quantity runs over all rows of all branches, or over all equilibria.
double spread_of(const StudyResult& result, const std::string& quantity) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto add = [&](const Point& point) {
    const double v = value_of_point(result, point, quantity);
    low = std::fmin(low, v);
    high = std::fmax(high, v);
  };
  for (const Branch& branch : result.branches)
    for (const auto& sample : branch.samples) add({&sample});
  if (result.equilibria)
    for (const auto& e : result.equilibria->list) add(point_of(e));
  return high > low ? high - low : 1;
}

/// The one whose quantities are nearest to `near`, each difference divided by how far that quantity
/// spreads; of several that are equally near the first.
std::optional<Point> nearest_point(const StudyResult& result, const std::vector<Point>& points,
                                   const std::vector<NearValue>& near) {
  std::vector<double> distance(points.size(), 0);
  for (const NearValue& wanted : near) {
    const double spread = spread_of(result, wanted.quantity);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double v = value_of_point(result, points[i], wanted.quantity);
      const double d = std::isnan(v) ? std::numeric_limits<double>::infinity()
                                     : std::abs(v - wanted.value) / spread;
      distance[i] = std::max(distance[i], d);
    }
  }
  const auto best = std::min_element(distance.begin(), distance.end());
  if (best == distance.end() || !std::isfinite(*best)) return std::nullopt;
  return points[static_cast<std::size_t>(best - distance.begin())];
}

/// The equilibrium with this label; for "start" the one that was found from the guess.
std::optional<Point> equilibrium_at(const StudyResult& result, const std::string& at) {
  for (const auto& e : result.equilibria->list)
    if (e.label == at || (at == "start" && e.is_start)) return point_of(e);
  return std::nullopt;
}

/// A point where branches meet is taken on the first of them.
std::optional<Point> point_of(const ExpectedValue& expected, const StudyResult& result) {
  if (!expected.near.empty())
    return nearest_point(result, points_with(result, expected.at), expected.near);
  if (result.equilibria) return equilibrium_at(result, expected.at);
  if (result.branches.empty() || result.branches.front().samples.empty()) return std::nullopt;
  const Branch& first = result.branches.front();
  if (expected.at == "start") {
    Point point{&first.samples[first.start_row], event_in(first, first.start_row)};
    point.stiffness = &result.start.stiffness;
    point.compliance = &result.start.compliance;
    if (!result.start.rates_after.empty()) {
      point.rates_before = &result.start.rates_before;
      point.rates_after = &result.start.rates_after;
    } else if (point.event != nullptr) {
      point.rates_before = &point.event->rates_before;
      point.rates_after = &point.event->rates_after;
    }
    return point;
  }
  if (const auto target = target_number(expected.at)) {
    const analysis::Sample* row = target_row(result, *target);
    return row ? std::optional{Point{row}} : std::nullopt;
  }
  if (expected.at == "end") {
    const std::size_t last = first.samples.size() - 1;
    const Event* event = event_in(first, last);
    return event ? point_of(first, *event) : Point{&first.samples[last]};
  }
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == expected.at) return point_of(branch, event);
  return std::nullopt;
}

double matrix_entry(const Matrix& K, const MatrixEntry& at) {
  if (at.row >= K.rows() || at.column >= K.cols()) return nothing;
  if (!at.is_compliance) return K(at.row, at.column);
  const FullPivotLu lu(K);
  return lu.is_invertible() ? lu.inverse()(at.row, at.column) : nothing;
}

double of_junction(const StudyResult& result, const Point& point, const std::string& quantity) {
  if (!point.event) return nothing;
  for (const analysis::Junction& junction : result.junctions)
    if (!junction.label.empty() && junction.label == point.event->label)
      return quantity == "corank" ? junction.multiplicity
                                  : static_cast<double>(junction.ways.size());
  return nothing;
}

double slope(const ExpectedValue& expected, const StudyResult& result, const Point& point) {
  const auto* side = expected.side == Side::before ? point.rates_before : point.rates_after;
  if (side == nullptr) return nothing;
  const auto& rates = *side;
  const auto of = column_of(result, expected.quantity), per = column_of(result, expected.per);
  if (!of || !per || *of >= rates.size() || *per >= rates.size()) return nothing;
  return rates[*of] / rates[*per];
}

}  // namespace

std::vector<MatrixEntryName> matrix_entries(const model::Mechanism& mechanism) {
  const statics::System system = statics::prepare(mechanism);
  std::vector<std::string> coordinates;
  for (Index i = system.first_pose; i < system.size; ++i) {
    const std::string& name = system.coordinate_names[static_cast<std::size_t>(i)];
    const bool is_only = mechanism.bodies.size() == 1;
    coordinates.push_back(is_only ? name.substr(name.find('.') + 1) : name);
  }
  std::vector<MatrixEntryName> names;
  for (const bool is_compliance : {false, true})
    for (std::size_t r = 0; r < coordinates.size(); ++r)
      for (std::size_t c = 0; c < coordinates.size(); ++c)
        names.push_back({(is_compliance ? "C." : "K.") + coordinates[r] + "." + coordinates[c],
                         {is_compliance, static_cast<Index>(r), static_cast<Index>(c)}});
  return names;
}

const std::vector<std::string>& event_codes() {
  static const std::vector<std::string> codes{
      "LP", "BP", "SA", "CL", "KB", "KS", "TP", "FM", "UZ", "EP", "SC", "UR", "EQ", "CP",
      "IC", "CX", "HT", "BB", "C2", "FA", "CR", "TA", "AA", "SB", "PT", "EX", "TH", "JP"};
  return codes;
}

bool is_event_code(const std::string& text) {
  const auto& codes = event_codes();
  return std::find(codes.begin(), codes.end(), text) != codes.end();
}

bool is_event_label(const std::string& text) {
  if (text.size() < 3 || text[2] == '0') return false;
  const bool digits =
      std::all_of(text.begin() + 2, text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && is_event_code(text.substr(0, 2));
}

std::vector<std::string> general_quantities() {
  std::vector<std::string> names{"corank",         "ways",        "potential",
                                 "count.branches", "count.jumps", "count.equilibria"};
  for (const std::string& code : event_codes())
    if (code != equilibrium_code) names.push_back("count." + code);
  return names;
}

bool is_general_quantity(const std::string& name) {
  const auto names = general_quantities();
  const std::string by_index = "count.equilibria.";
  if (name.starts_with(by_index) && name.size() > by_index.size() &&
      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(by_index.size()), name.end(),
                  [](char c) { return c >= '0' && c <= '9'; }))
    return true;
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::optional<int> target_number(const std::string& at) {
  const std::string word = "target ";
  if (!at.starts_with(word) || at.size() == word.size() || at.size() > word.size() + 7)
    return std::nullopt;
  const bool digits = std::all_of(at.begin() + static_cast<std::ptrdiff_t>(word.size()), at.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || at[word.size()] == '0') return std::nullopt;
  return std::stoi(at.substr(word.size()));
}

double found_value(const ExpectedValue& expected, const StudyResult& result) {
  const std::string& quantity = expected.quantity;
  if (is_jump_place(expected.at)) return jump_value(expected, result);
  if (quantity.starts_with(count_prefix))
    return result.start.found ? count_of(result, quantity.substr(count_prefix.size())) : nothing;
  if (result.design)
    if (const auto value = analysis::design_value(*result.design, quantity)) return *value;
  if (result.threshold)
    for (const analysis::ThresholdQuantity& one : analysis::threshold_quantities)
      if (quantity == one.name) return one.value(*result.threshold);
  const auto found = point_of(expected, result);
  if (!found) return nothing;
  const std::optional<Point> point = on_side(*found, expected.side, quantity);
  if (quantity == "corank" || quantity == "ways") return of_junction(result, *point, quantity);
  if (!expected.per.empty()) return slope(expected, result, *point);
  if (!expected.entry) return value_of_point(result, *point, quantity);
  const MatrixEntry& entry = *expected.entry;
  if (entry.is_compliance && point->compliance && point->compliance->size() > 0)
    return (*point->compliance)(entry.row, entry.column);
  return point->stiffness ? matrix_entry(*point->stiffness, entry) : nothing;
}

}  // namespace springfold::io
