#include "smooth_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "stability_parts.hpp"

namespace springfold::io {
namespace {

/// A turn of this angle between two points is not seen as a corner.
constexpr double smallest_turn = std::numbers::pi / 120;
constexpr int most_inner_points = 24;  // of one step
/// Rows nearer than this part of the branch say nothing about its slope but rounding.
constexpr double nearest_rows = 1e-6;

PlotPoint difference(const PlotPoint& a, const PlotPoint& b, double h) {
  return {(a.first - b.first) / h, (a.second - b.second) / h};
}

PlotPoint mix(const PlotPoint& a, double u, const PlotPoint& b, double v) {
  return {u * a.first + v * b.first, u * a.second + v * b.second};
}

class Curve {
 public:
  explicit Curve(const std::vector<LineRow>& rows) : rows_{rows} {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    double low[2] = {least, least}, high[2] = {most, most};
    for (const LineRow& row : rows) {
      if (std::isfinite(row.s)) least = std::min(least, row.s), most = std::max(most, row.s);
      if (!is_finite(row.at)) continue;
      low[0] = std::min(low[0], row.at.first), high[0] = std::max(high[0], row.at.first);
      low[1] = std::min(low[1], row.at.second), high[1] = std::max(high[1], row.at.second);
    }
    near_ = nearest_rows * (most - least);
    width_ = high[0] > low[0] ? high[0] - low[0] : 1;
    height_ = high[1] > low[1] ? high[1] - low[1] : 1;
  }

  bool is_curved(std::size_t i) const {
    const LineRow &a = rows_[i], &b = rows_[i + 1];
    return is_finite(a.at) && is_finite(b.at) && a.piece == b.piece && b.s - a.s > near_;
  }

  /// So many pieces of step i that none of them turns by much.
  int pieces_of(std::size_t i) const {
    const LineRow &a = rows_[i], &b = rows_[i + 1];
    const PlotPoint p = slope(i, true), q = slope(i, false);
    const double angle = turn(p, q) + turn(difference(b.at, a.at, b.s - a.s), p);
    return 1 + std::clamp(static_cast<int>(angle / smallest_turn), 0, most_inner_points);
  }

  /// Point of step i, t from 0 to 1. @pre is_curved(i)
  PlotPoint point(std::size_t i, double t) const {
    const LineRow &a = rows_[i], &b = rows_[i + 1];
    const double h = b.s - a.s, u = 1 - t;
    const PlotPoint p = slope(i, true), q = slope(i, false);
    const PlotPoint ends = mix(a.at, u * u * (1 + 2 * t), b.at, t * t * (3 - 2 * t));
    return mix(ends, 1, mix(p, h * u * u * t, q, -h * u * t * t), 1);
  }

 private:
  /// Slope at the first or second row of step i.
  PlotPoint slope(std::size_t i, bool first) const {
    const LineRow &a = rows_[i], &b = rows_[i + 1];
    const PlotPoint chord = difference(b.at, a.at, b.s - a.s);
    if (const auto before = neighbour(i, -1)) {
      const LineRow& other = rows_[*before];
      if (first)
        return parabola(difference(a.at, other.at, a.s - other.s), a.s - other.s, chord, b.s - a.s,
                        a.is_special);
    } else if (first) {
      return at_end(i, chord, true);
    }
    if (const auto after = neighbour(i + 1, 1)) {
      const LineRow& other = rows_[*after];
      return parabola(chord, b.s - a.s, difference(other.at, b.at, other.s - b.s), other.s - b.s,
                      b.is_special);
    }
    return at_end(i, chord, false);
  }

  /// Slope in the middle of two chords of lengths g and h. The largest load stands at its limit point, not beside it.
  static PlotPoint parabola(const PlotPoint& one, double g, const PlotPoint& two, double h,
                            bool is_special) {
    PlotPoint slope = mix(one, h / (g + h), two, g / (g + h));
    if (is_special && one.first * two.first < 0) slope.first = 0;
    if (is_special && one.second * two.second < 0) slope.second = 0;
    return slope;
  }

  /// Slope at an end of the curve: of the parabola through the next two rows.
  PlotPoint at_end(std::size_t i, const PlotPoint& chord, bool first) const {
    const bool has_inner = first ? neighbour(i + 1, 1).has_value() : neighbour(i, -1).has_value();
    if (!has_inner) return chord;
    return mix(chord, 2, slope(i, !first), -1);
  }

  /// The next row of the same smooth curve that is far enough away. @param way  1 or -1
  std::optional<std::size_t> neighbour(std::size_t i, int way) const {
    for (std::size_t k = i;;) {
      if (way < 0 ? k == 0 : k + 1 >= rows_.size()) return std::nullopt;
      k = way < 0 ? k - 1 : k + 1;
      const LineRow &one = rows_[i], &other = rows_[k];
      const double gap = way * (other.s - one.s);
      if (other.piece != one.piece || !is_finite(other.at) || !(gap >= 0)) return std::nullopt;
      if (gap > near_) return k;
    }
  }

  /// Angle between two slopes as the figure shows them, about.
  double turn(const PlotPoint& a, const PlotPoint& b) const {
    const double ax = a.first / width_, ay = a.second / height_;
    const double bx = b.first / width_, by = b.second / height_;
    return std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by));
  }

  const std::vector<LineRow>& rows_;
  double near_ = 0, width_ = 1, height_ = 1;
};

/// The rows as logarithmic axes show them; not finite where there is no place.
std::vector<LineRow> decades_of(std::vector<LineRow> rows, const AxisScales& scales) {
  const auto decade = [](double value) { return value > 0 ? std::log10(value) : std::nan(""); };
  for (LineRow& row : rows) {
    if (scales.x_log) row.at.first = decade(row.at.first);
    if (scales.y_log) row.at.second = decade(row.at.second);
  }
  return rows;
}

PlotPoint from_decades(PlotPoint at, const AxisScales& scales) {
  if (scales.x_log) at.first = std::pow(10, at.first);
  if (scales.y_log) at.second = std::pow(10, at.second);
  return at;
}

/// Is the curve smooth in decades here, as power laws are on two logarithmic axes? Near zero it is smooth in the
/// values, and its logarithm is not; over one logarithmic axis what is straight in the values would become wavy.
bool is_gentle(const std::vector<LineRow>& rows, std::size_t step, const AxisScales& scales) {
  constexpr double most = 0.5;  // decades from row to row
  if (!scales.x_log || !scales.y_log) return false;
  const std::size_t first = step > 0 ? step - 1 : 0, last = std::min(step + 1, rows.size() - 2);
  for (std::size_t i = first; i <= last; ++i) {
    const PlotPoint &a = rows[i].at, &b = rows[i + 1].at;
    if (!(std::abs(b.first - a.first) < most) || !(std::abs(b.second - a.second) < most))
      return false;
  }
  return true;
}

/// Does the path turn, or its load change its rate, at a target? One in even steps along a straight line does not.
bool has_corners(const analysis::ControlPath& path) {
  if (path.loads.size() > 2) return true;
  if (path.circle || path.targets.empty()) return false;
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const Vector &from = path.targets.front(), &to = path.targets.back();
  const double size = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  const auto last = static_cast<double>(path.targets.size() - 1);
  for (std::size_t i = 0; i < path.targets.size(); ++i) {
    const Vector even = from + static_cast<double>(i) / last * (to - from);
    if (!((path.targets[i] - even).cwiseAbs().maxCoeff() <= rounding * size)) return true;
  }
  return false;
}

}  // namespace

std::string smooth_along(const analysis::Study& study) {
  if (study.kind == analysis::StudyKind::control) return has_corners(study.targets) ? "" : "path";
  const bool is_traced = study.kind == analysis::StudyKind::force_deflection ||
                         analysis::is_of_critical_points(study.kind);
  return is_traced && study.path == analysis::Path::arc_length ? "s" : "";
}

AxisScales scales_of(const std::vector<LineRow>& rows, bool x_log, bool y_log) {
  AxisScales scales{.x_log = x_log, .y_log = y_log};
  const auto measure = [&rows](bool is_log, auto value_of, double& size, double& least) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const LineRow& row : rows) {
      const double value = value_of(row);
      if (!std::isfinite(value) || (is_log && !(value > 0))) continue;
      low = std::min(low, value), high = std::max(high, value);
    }
    if (!(low < high)) return;
    size = is_log ? std::log10(high / low) : high - low;
    constexpr double further = 1e-3;  // curves leave the frame, which ends a little below the least
    if (is_log) least = further * low;
  };
  measure(
      x_log, [](const LineRow& row) { return row.at.first; }, scales.width, scales.least.first);
  measure(
      y_log, [](const LineRow& row) { return row.at.second; }, scales.height, scales.least.second);
  return scales;
}

std::vector<Polyline> points_between(const std::vector<LineRow>& rows, const AxisScales& scales) {
  std::vector<Polyline> all;
  const std::vector<LineRow> in_decades = decades_of(rows, scales);
  const Curve plain{rows}, shown{in_decades};
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const bool in_logs = is_gentle(in_decades, i, scales) && shown.is_curved(i);
    const Curve& curve = in_logs ? shown : plain;
    const bool is_curved = curve.is_curved(i);
    const LineRow &a = rows[i], &b = rows[i + 1];
    const auto at = [&](double t) {
      if (!is_curved) return mix(a.at, 1 - t, b.at, t);
      return in_logs ? from_decades(curve.point(i, t), scales) : curve.point(i, t);
    };
    Polyline points;
    const int pieces = is_curved ? curve.pieces_of(i) : 1;
    for (int k = 0; k < pieces && is_finite(a.at) && is_finite(b.at); ++k) {
      const double from = static_cast<double>(k) / pieces;
      if (k > 0) points.push_back(at(from));
      add_points_between(at, from, static_cast<double>(k + 1) / pieces, scales, points);
    }
    all.push_back(std::move(points));
  }
  return all;
}

}  // namespace springfold::io
