#include "curve_labels.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace springfold::io {
namespace {

constexpr double leader_needed = 26;  // longest gap between point and text without a line [pixel]
constexpr double on_each_other = 3;   // lines as near as that are seen as one [pixel]
constexpr double apart_on_lines = 9;  // a dot on a line belongs to no other that is farther [pixel]
// Against hidden points and longer ways: a text that is taken for another curve's is worse than one that hides lines.
constexpr double misled = 500;
constexpr double blurred =
    8;  // points of curves are so far apart, and cells so large, in all [pixel]
constexpr double clearly_nearer = 1.5;  // so many times nearer to its own curve

/// Is each point of a near b?
bool lies_on(const std::vector<PlotPoint>& a, const std::vector<PlotPoint>& b) {
  return std::all_of(a.begin(), a.end(), [&b](const PlotPoint& at) {
    return gap_between(LabelBox{at, 0, 0}, b) < on_each_other;
  });
}

/// How far it is from anywhere in the frame to the nearest of some points, to a cell's size.
class Distances {
 public:
  explicit Distances(const LabelBox& frame)
      : left_{frame.centre.first - frame.half_width},
        bottom_{frame.centre.second - frame.half_height},
        wide_{static_cast<std::size_t>(2 * frame.half_width / cell) + 1},
        high_{static_cast<std::size_t>(2 * frame.half_height / cell) + 1},
        gaps_(wide_ * high_, std::numeric_limits<double>::infinity()) {}

  void add(const std::vector<PlotPoint>& points) {
    for (const PlotPoint& at : points) gaps_[row(at.second) * wide_ + column(at.first)] = 0;
  }

  /// Carries them from cell to cell, there and back (chamfer distances). After all points are there.
  void spread() {
    for (std::size_t k = 0; k < gaps_.size(); ++k) lower(k, k % wide_, k / wide_, -1);
    for (std::size_t k = gaps_.size(); k-- > 0;) lower(k, k % wide_, k / wide_, 1);
  }

  double at(const PlotPoint& place) const {
    return gaps_[row(place.second) * wide_ + column(place.first)];
  }

  double at(const LabelBox& box) const {
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t right = column(box.centre.first + box.half_width);
    const std::size_t top = row(box.centre.second + box.half_height);
    for (std::size_t y = row(box.centre.second - box.half_height); y <= top; ++y)
      for (std::size_t x = column(box.centre.first - box.half_width); x <= right; ++x)
        nearest = std::min(nearest, gaps_[y * wide_ + x]);
    return nearest;
  }

 private:
  static constexpr double cell = 3;  // pixel

  static std::size_t number(double along, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(along / cell, 0.0, static_cast<double>(count) - 1));
  }
  std::size_t column(double x) const { return number(x - left_, wide_); }
  std::size_t row(double y) const { return number(y - bottom_, high_); }

  /// By the neighbours that were passed before, on the way up (-1) or down (1).
  void lower(std::size_t k, std::size_t x, std::size_t y, int side) {
    const bool has_row = side < 0 ? y > 0 : y + 1 < high_;
    const std::size_t beside = side < 0 ? k - 1 : k + 1;
    const std::size_t over = side < 0 ? k - wide_ : k + wide_;
    if (side < 0 ? x > 0 : x + 1 < wide_) gaps_[k] = std::min(gaps_[k], gaps_[beside] + cell);
    if (!has_row) return;
    gaps_[k] = std::min(gaps_[k], gaps_[over] + cell);
    if (x > 0) gaps_[k] = std::min(gaps_[k], gaps_[over - 1] + std::numbers::sqrt2 * cell);
    if (x + 1 < wide_) gaps_[k] = std::min(gaps_[k], gaps_[over + 1] + std::numbers::sqrt2 * cell);
  }

  double left_, bottom_;
  std::size_t wide_, high_;
  std::vector<double> gaps_;
};

/// What a curve's label must be told apart from.
struct Neighbourhood {
  Distances to_own, to_others;

  Neighbourhood(const LabelScene& scene, const CurveTwins& twins, std::size_t own)
      : to_own{scene.frame}, to_others{scene.frame} {
    for (std::size_t i = 0; i < scene.curves.size(); ++i)
      (twins[i] == twins[own] ? to_own : to_others).add(scene.curves[i]);
    to_own.spread();
    to_others.spread();
  }
};

/// How often the line passes another curve.
int passes_of(const Distances& to_others, const PlotPoint& from, const PlotPoint& to) {
  const double length = pixels_between(from, to);
  int passes = 0;
  bool was_near = false;
  for (double along = apart_on_lines; along < length; along += on_each_other) {
    const double t = along / length;
    const PlotPoint at{from.first + t * (to.first - from.first),
                       from.second + t * (to.second - from.second)};
    const bool is_near = to_others.at(at) < on_each_other;
    if (is_near && !was_near) ++passes;
    was_near = is_near;
  }
  return passes;
}

double ambiguity_of(const Neighbourhood& near, const LabelBox& box, const PlotPoint& anchor) {
  const double to_others = near.to_others.at(box);
  if (!needs_leader(box, anchor)) {
    const double to_own = near.to_own.at(box);
    return clearly_nearer * to_own + blurred <= to_others ? 0 : misled + to_own - to_others;
  }
  constexpr double crossed = 15;  // a curve by the line
  const double beside = near.to_others.at(anchor);
  const double unclear = beside < apart_on_lines ? misled * (1 - beside / apart_on_lines) : 0;
  const double touching = to_others < on_each_other ? crossed : 0;
  return unclear + touching + crossed * passes_of(near.to_others, anchor, box.nearest(anchor));
}

}  // namespace

CurveTwins twins_of(const LabelScene& scene) {
  CurveTwins twins(scene.curves.size());
  for (std::size_t i = 0; i < twins.size(); ++i) {
    twins[i] = i;
    for (std::size_t k = 0; k < i && twins[i] == i; ++k)
      if (twins[k] == k && lies_on(scene.curves[i], scene.curves[k]) &&
          lies_on(scene.curves[k], scene.curves[i]))
        twins[i] = k;
  }
  return twins;
}

FigureText shared_curve_label(const Figure& figure, const CurveTwins& twins, std::size_t curve) {
  if (twins[curve] != curve) return {};
  FigureText shared = figure.curves[curve].label;
  for (std::size_t i = curve + 1; i < twins.size(); ++i) {
    const FigureText& label = figure.curves[i].label;
    if (twins[i] != curve || label.text.empty() || label.text == shared.text) continue;
    shared.text += (shared.text.empty() ? "" : ", ") + label.text;
    shared.is_markup = label.is_markup;
  }
  return shared;
}

bool needs_leader(const LabelBox& box, const PlotPoint& anchor) {
  return pixels_between(anchor, box.nearest(anchor)) > leader_needed;
}

LabelCandidate place_on_curve(const LabelScene& scene, const CurveTwins& twins, const LabelBox& box,
                              std::size_t own) {
  const auto& points = scene.curves[own];
  const Neighbourhood near{scene, twins, own};
  const auto ambiguity = [&near](const LabelBox& at, const PlotPoint& anchor) {
    return ambiguity_of(near, at, anchor);
  };
  LabelCandidate best;
  constexpr std::size_t tries = 60;
  for (std::size_t i = 0; i <= tries; ++i) {
    const PlotPoint& anchor = points[i * (points.size() - 1) / tries];
    const double crowded = 30 / (1 + near.to_others.at(anchor) / 4);
    // Rather at an end than in the middle, where all other curves are farther away.
    const double to_end =
        std::min(pixels_between(points.front(), anchor), pixels_between(points.back(), anchor));
    const double inside = std::min(8.0, to_end / 30);
    for (const double gap : {10.0, 16.0, 24.0, 40.0, 70.0, 110.0, 160.0})
      try_around(best, scene, box, anchor, gap, crowded + inside + 0.5 * gap, ambiguity);
  }
  return best;
}

}  // namespace springfold::io
