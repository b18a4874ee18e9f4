#include "curve_labels.hpp"

#include <algorithm>
#include <limits>

namespace springfold::io {
namespace {

constexpr double leader_needed = 26;  // longest gap between point and text without a line [pixel]
constexpr double on_each_other = 3;   // lines as near as that are seen as one [pixel]
constexpr double apart_on_lines = 9;           // a dot on a line belongs to no other that is farther [pixel]
// Against hidden points and longer ways: a text that is taken for another curve's is worse than one that hides lines.
constexpr double misled = 500;
constexpr double clearly_nearer = 1.5;  // so many times nearer to its own curve

double gap_between(const PlotPoint& at, const std::vector<PlotPoint>& points) {
  return gap_between(LabelBox{at, 0, 0}, points);
}

/// Is each point of a near b?
bool lies_on(const std::vector<PlotPoint>& a, const std::vector<PlotPoint>& b) {
  return std::all_of(a.begin(), a.end(), [&b](const PlotPoint& at) {
    return gap_between(at, b) < on_each_other;
  });
}

/// The shortest way to any curve that does not lie on this one.
template <class Shape>
double gap_to_others(const LabelScene& scene, const CurveTwins& twins, std::size_t own,
                     const Shape& shape) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < scene.curves.size(); ++other)
    if (twins[other] != twins[own])
      nearest = std::min(nearest, gap_between(shape, scene.curves[other]));
  return nearest;
}

/// Points of other curves that the line passes.
int passed_by(const LabelScene& scene, const CurveTwins& twins, std::size_t own,
              const PlotPoint& from, const PlotPoint& to) {
  const double length = pixels_between(from, to);
  int passed = 0;
  for (std::size_t other = 0; other < scene.curves.size(); ++other) {
    if (twins[other] == twins[own]) continue;
    for (double along = apart_on_lines; along < length; along += on_each_other) {
      const double t = along / length;
      const PlotPoint at{from.first + t * (to.first - from.first),
                         from.second + t * (to.second - from.second)};
      if (gap_between(at, scene.curves[other]) < on_each_other) {
        ++passed;
        break;
      }
    }
  }
  return passed;
}

/// @param near_others  from the anchor to the nearest other curve
double ambiguity_of(const LabelScene& scene, const CurveTwins& twins, std::size_t own,
                    const LabelBox& box, const PlotPoint& anchor, double near_others) {
  const double to_others = gap_to_others(scene, twins, own, box);
  if (!needs_leader(box, anchor)) {
    const double to_own = gap_between(box, scene.curves[own]);
    return clearly_nearer * to_own + on_each_other <= to_others ? 0 : misled + to_own - to_others;
  }
  constexpr double crossed = 15;  // of the line with another curve
  const double unclear = near_others < apart_on_lines ? misled * (1 - near_others / apart_on_lines) : 0;
  const double touching = to_others < on_each_other ? crossed : 0;
  return unclear + touching +
         crossed * passed_by(scene, twins, own, anchor, box.nearest(anchor));
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
  LabelCandidate best;
  constexpr std::size_t tries = 60;
  for (std::size_t i = 0; i <= tries; ++i) {
    const PlotPoint& anchor = points[i * (points.size() - 1) / tries];
    const double near_others = gap_to_others(scene, twins, own, anchor);
    const double crowded = 30 / (1 + near_others / 4);
    // Rather at an end than in the middle, where all other curves are farther away.
    const double to_end =
        std::min(pixels_between(points.front(), anchor), pixels_between(points.back(), anchor));
    const double inside = std::min(8.0, to_end / 30);
    const auto ambiguity = [&](const LabelBox& at, const PlotPoint& from) {
      return ambiguity_of(scene, twins, own, at, from, near_others);
    };
    for (const double gap : {10.0, 16.0, 24.0, 40.0, 70.0, 110.0, 160.0})
      try_around(best, scene, box, anchor, gap, crowded + inside + 0.5 * gap, ambiguity);
  }
  return best;
}

}  // namespace springfold::io
