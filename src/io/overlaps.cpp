#include "overlaps.hpp"

#include <cmath>

#include "springfold/drawing/overlaps.hpp"

namespace springfold::io {
namespace {

std::vector<drawing::RankedLine> ranked_lines(const Figure& figure, const Canvas& canvas) {
  std::vector<drawing::RankedLine> lines;
  for (std::size_t c = 0; c < figure.curves.size(); ++c)
    for (const CurvePart& part : figure.curves[c].parts) {
      drawing::RankedLine line{.curve = c, .rank = static_cast<int>(part.stability)};
      for (const PlotPoint& point : part.line) {
        const PlotPoint at = in_pixels(figure, canvas, point);
        line.places.push_back({at.first, at.second});
      }
      lines.push_back(std::move(line));
    }
  return lines;
}

/// In the units of the axes; the part's own points as they are.
Polyline on_axes(const Figure& figure, const Canvas& canvas, const CurvePart& part,
                 const drawing::Stretch& stretch) {
  Polyline line;
  for (std::size_t i = 0; i < stretch.places.size(); ++i) {
    const double number = stretch.numbers[i];
    const drawing::Place& at = stretch.places[i];
    line.push_back(number == std::floor(number) ? part.line[static_cast<std::size_t>(number)]
                                                : from_pixels(figure, canvas, {at.x, at.y}));
  }
  return line;
}

}  // namespace

DrawnLines without_overlaps(const Figure& figure, const Canvas& canvas) {
  const std::vector<drawing::SeenLine> seen =
      drawing::without_overlaps(ranked_lines(figure, canvas), canvas.width, canvas.height);
  DrawnLines lines;
  std::size_t next = 0;
  for (const FigureCurve& curve : figure.curves) {
    auto& kept = lines.curves.emplace_back();
    for (const CurvePart& part : curve.parts) {
      const drawing::SeenLine& line = seen[next++];
      if (line.is_whole) kept.push_back(part);  // with its own points
      for (const auto& stretch : line.stretches)
        kept.push_back({part.stability, on_axes(figure, canvas, part, stretch)});
      for (const auto& stretch : line.beneath)
        lines.mixed.push_back(on_axes(figure, canvas, part, stretch));
    }
  }
  return lines;
}

}  // namespace springfold::io
