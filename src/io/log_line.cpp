#include "log_line.hpp"

#include <cmath>

#include "stability_parts.hpp"

namespace springfold::io {
namespace {

constexpr double not_seen = 3e-5;  // of an axis: a thirtieth of a pixel, so that no corner is seen
constexpr double longest_step = 0.5;  // in decades
constexpr int most_halvings = 40;     // halvings

struct Shown {
  double t = 0;
  PlotPoint at{};    ///< as plotted
  PlotPoint part{};  ///< along the axes, in parts of them; not finite where there is no place
};

class Refinement {
 public:
  Refinement(const PieceOfCurve& curve, const AxisScales& scales, Polyline& points)
      : curve_{curve}, scales_{scales}, points_{points} {}

  Shown shown(double t) const {
    const PlotPoint at = curve_(t);
    return {t,
            at,
            {along(at.first, scales_.x_log, scales_.width),
             along(at.second, scales_.y_log, scales_.height)}};
  }

  void halve(const Shown& a, const Shown& b, int depth) {
    const Shown middle = shown((a.t + b.t) / 2);
    if (depth == 0 || is_straight(a, middle, b)) return;
    halve(a, middle, depth - 1);
    points_.push_back(middle.at);
    halve(middle, b, depth - 1);
  }

 private:
  static double along(double value, bool is_log, double size) {
    if (!is_log) return value / size;
    return value > 0 ? std::log10(value) / size : std::nan("");
  }

  bool is_straight(const Shown& a, const Shown& middle, const Shown& b) const {
    const bool from = is_finite(a.part), to = is_finite(b.part);
    if (!from && !to) return !is_finite(middle.part);
    if (from != to) return is_below(from ? a.at : b.at);
    if (!is_finite(middle.part)) return false;
    const double x = b.part.first - a.part.first, y = b.part.second - a.part.second;
    if (scales_.x_log && std::abs(x) * scales_.width > longest_step) return false;
    if (scales_.y_log && std::abs(y) * scales_.height > longest_step) return false;
    // An S lies on its chord in the middle, and nowhere else.
    const double t = middle.t, quarter = (b.t - a.t) / 4;
    return lies_on(a, b, middle) && lies_on(a, b, shown(t - quarter)) &&
           lies_on(a, b, shown(t + quarter));
  }

  static bool lies_on(const Shown& a, const Shown& b, const Shown& point) {
    const double x = b.part.first - a.part.first, y = b.part.second - a.part.second;
    const double u = point.part.first - a.part.first, v = point.part.second - a.part.second;
    const double length = std::hypot(x, y);
    return length < not_seen || std::abs(x * v - y * u) < not_seen * length;
  }

  /// Is the end that has a place below all that is looked for?
  bool is_below(const PlotPoint& at) const {
    return (scales_.x_log && at.first < scales_.least.first) ||
           (scales_.y_log && at.second < scales_.least.second);
  }

  const PieceOfCurve& curve_;
  const AxisScales& scales_;
  Polyline& points_;
};

}  // namespace

void add_points_between(const PieceOfCurve& curve, double from, double to, const AxisScales& scales,
                        Polyline& points) {
  if (!scales.any_log()) return;
  Refinement refinement{curve, scales, points};
  refinement.halve(refinement.shown(from), refinement.shown(to), most_halvings);
}

}  // namespace springfold::io
