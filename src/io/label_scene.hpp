// What stands in the way of the texts of a figure, in pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "canvas.hpp"
#include "figure.hpp"

namespace springfold::io {

/// A rectangle, such as that of a text.
struct LabelBox {
  PlotPoint centre{};
  double half_width = 0, half_height = 0;

  bool holds(const PlotPoint& p, double margin) const {
    return std::abs(p.first - centre.first) <= half_width + margin &&
           std::abs(p.second - centre.second) <= half_height + margin;
  }
  bool overlaps(const LabelBox& other, double margin) const {
    return std::abs(centre.first - other.centre.first) <= half_width + other.half_width + margin &&
           std::abs(centre.second - other.centre.second) <=
               half_height + other.half_height + margin;
  }
  /// Point of the box nearest to p.
  PlotPoint nearest(const PlotPoint& p) const {
    return {std::clamp(p.first, centre.first - half_width, centre.first + half_width),
            std::clamp(p.second, centre.second - half_height, centre.second + half_height)};
  }
};

double pixels_between(const PlotPoint& a, const PlotPoint& b);

/// Everything that a label must not hide.
struct LabelScene {
  std::vector<std::vector<PlotPoint>> curves{};  ///< evenly spaced points of each curve
  std::vector<LabelBox> marks{};
  std::vector<LabelBox> labels{};
  std::vector<std::pair<PlotPoint, PlotPoint>> leaders{};  ///< lines from labels to what they name
  PlotPoint zero{};                                        ///< where the axes through zero are
  LabelBox frame{};
};

LabelScene label_scene_of(const Figure& figure, const Canvas& canvas);

bool is_in_frame(const PlotPoint& p, const Canvas& canvas);

/// A text of average letters around {0, 0}; a little too wide is better than too narrow.
LabelBox box_of(const FigureText& label, const Canvas& canvas);

/// The shortest way from the text to any of the points; infinite where there are none.
double gap_between(const LabelBox& box, const std::vector<PlotPoint>& points);

/// A place for a text that belongs to `anchor`.
struct LabelCandidate {
  LabelBox box{};
  PlotPoint anchor{};
  double badness = std::numeric_limits<double>::infinity();
};

/// How bad a text is there beside what it hides. Called only where it may still be the best.
using ExtraBadness = std::function<double(const LabelBox& box, const PlotPoint& anchor)>;

/// Tries places around the anchor, `gap` pixels between it and the text, and keeps the better one; the earlier one
/// when both are as good.
void try_around(LabelCandidate& best, const LabelScene& scene, LabelBox box,
                const PlotPoint& anchor, double gap, double extra, const ExtraBadness& more = {});

}  // namespace springfold::io
