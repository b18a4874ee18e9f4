#include "compared_quantity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "result_access.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::Event;
using analysis::StudyResult;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view count_prefix = "count.";

/// A row of a branch, with the special point that is there.
struct Point {
  const Branch* branch = nullptr;
  std::size_t row = 0;
  const Event* event = nullptr;
};

double count_of(const StudyResult& result, std::string_view what) {
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

/// Of all special points of this code the one whose quantities are nearest to `near`, each
/// difference divided by how far that quantity spreads over these points.
std::optional<Point> nearest_point(const StudyResult& result, const std::string& code,
                                   const std::vector<NearValue>& near) {
  std::vector<Point> points;
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (analysis::code_of(event.kind) == code) points.push_back({&branch, event.row, &event});
  std::vector<double> distance(points.size(), 0);
  for (const NearValue& wanted : near) {
    double low = wanted.value, high = wanted.value;
    for (const Point& point : points) {
      const double v = value_at(result, *point.branch, point.row, wanted.quantity);
      low = std::fmin(low, v);
      high = std::fmax(high, v);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double v = value_at(result, *points[i].branch, points[i].row, wanted.quantity);
      const double d = std::isnan(v) ? std::numeric_limits<double>::infinity()
                                     : std::abs(v - wanted.value) / std::fmax(high - low, 1e-300);
      distance[i] = std::max(distance[i], d);
    }
  }
  const auto best = std::min_element(distance.begin(), distance.end());
  if (best == distance.end() || !std::isfinite(*best)) return std::nullopt;
  return points[static_cast<std::size_t>(best - distance.begin())];
}

/// A point where branches meet is taken on the first of them.
std::optional<Point> point_of(const ExpectedValue& expected, const StudyResult& result) {
  if (result.branches.empty() || result.branches.front().samples.empty()) return std::nullopt;
  const Branch& first = result.branches.front();
  if (expected.at == "start")
    return Point{&first, first.start_row, event_in(first, first.start_row)};
  if (expected.at == "end") {
    const std::size_t last = first.samples.size() - 1;
    return Point{&first, last, event_in(first, last)};
  }
  if (!expected.near.empty()) return nearest_point(result, expected.at, expected.near);
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == expected.at) return Point{&branch, event.row, &event};
  return std::nullopt;
}

double matrix_entry(const Matrix& K, const MatrixEntry& at) {
  if (at.row >= K.rows() || at.column >= K.cols()) return nothing;
  if (!at.is_compliance) return K(at.row, at.column);
  const Eigen::FullPivLU<Matrix> lu(K);
  return lu.isInvertible() ? lu.inverse()(at.row, at.column) : nothing;
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
  if (!point.event) return nothing;
  const auto& rates = expected.before ? point.event->rates_before : point.event->rates_after;
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
  static const std::vector<std::string> codes{"LP", "BP", "SA", "CL", "KB", "KS",
                                              "TP", "FM", "UZ", "EP", "UR"};
  return codes;
}

std::vector<std::string> general_quantities() {
  std::vector<std::string> names{"corank", "ways", "count.branches"};
  for (const std::string& code : event_codes()) names.push_back("count." + code);
  return names;
}

bool is_general_quantity(const std::string& name) {
  const auto names = general_quantities();
  return std::find(names.begin(), names.end(), name) != names.end();
}

double found_value(const ExpectedValue& expected, const StudyResult& result) {
  const std::string& quantity = expected.quantity;
  if (quantity.starts_with(count_prefix))
    return result.start.found ? count_of(result, quantity.substr(count_prefix.size())) : nothing;
  const auto point = point_of(expected, result);
  if (!point) return nothing;
  if (quantity == "corank" || quantity == "ways") return of_junction(result, *point, quantity);
  if (!expected.per.empty()) return slope(expected, result, *point);
  if (!expected.entry) return value_at(result, *point->branch, point->row, quantity);
  if (expected.at == "start") return matrix_entry(result.start.stiffness, *expected.entry);
  return point->event ? matrix_entry(point->event->stiffness, *expected.entry) : nothing;
}

}  // namespace springfold::io
