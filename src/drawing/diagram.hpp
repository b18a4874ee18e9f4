// The curve beside a moving mechanism. Private to drawing.
#pragma once

#include "springfold/drawing/movie.hpp"
#include "springfold/drawing/overlaps.hpp"

namespace springfold::drawing {

/// From values to pixels.
class DiagramAxes {
 public:
  DiagramAxes(const Diagram& diagram, const Box& frame);
  Place place(const DiagramPoint& point) const;

  /// Frame, ticks, names, curve and labels of special points. Dashes that lie on a line are not drawn again.
  /// @returns whether a line lies on a more stable one somewhere: that is drawn on a pale band
  bool paint(Picture& picture) const;

 private:
  void paint_ticks(Picture& picture) const;
  bool paint_curve(Picture& picture) const;
  void paint_points(Picture& picture) const;
  std::vector<Path> curve() const;

  const Diagram& diagram_;
  Box frame_{};
  double left_ = 0, right_ = 1, low_ = 0, high_ = 1;  ///< values at the frame's edges
};

/// Both values are finite.
bool is_known(const DiagramPoint& point);

}  // namespace springfold::drawing
