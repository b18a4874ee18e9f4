#include "sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "projection.hpp"

namespace springfold::drawing {
namespace {

using Vec = model::Vec3<double>;

/// The box around all panels as they are seen, in lengths.
struct Seen {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  double low = left, high = -left;
};

Seen seen_of(const std::vector<Panel>& panels, const Sheet& sheet) {
  Seen seen;
  for (const Panel& panel : panels)
    for (const PointId i : places_of(panel.scene)) {
      const Place at = seen_at(sheet, panel.scene.points[i]);
      seen.left = std::min(seen.left, at.x);
      seen.right = std::max(seen.right, at.x);
      seen.low = std::min(seen.low, at.y);
      seen.high = std::max(seen.high, at.y);
    }
  return seen;
}

/// The eye looks at the middle of the box around all panels in space.
void place_eye(const std::vector<Panel>& panels, Sheet& sheet) {
  if (!(sheet.view.eye > 0)) return;
  constexpr double beyond = std::numeric_limits<double>::infinity();
  Vec low = Vec::Constant(beyond), high = Vec::Constant(-beyond);
  for (const Panel& panel : panels)
    for (const PointId i : places_of(panel.scene)) {
      low = low.cwiseMin(panel.scene.points[i]);
      high = high.cwiseMax(panel.scene.points[i]);
    }
  if (!low.allFinite() || !high.allFinite()) return;
  sheet.middle = 0.5 * (low + high);
  sheet.eye = sheet.view.eye * (high - low).norm();
}

/// Colours and arrows are measured by the largest of all panels.
void measure(const std::vector<Panel>& panels, Sheet& sheet) {
  const auto take = [](double value, double& largest) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  };
  for (const Panel& panel : panels) {
    for (const LoadPart& load : panel.scene.loads)
      if (!load.is_direction)
        take(load.vector.norm(), load.is_moment ? sheet.largest_moment : sheet.largest_load);
    if (sheet.colouring == Colouring::energy)
      for (const SpringPart& spring : panel.scene.springs) take(spring.energy, sheet.largest_value);
    if (sheet.colouring != Colouring::force) continue;
    for (const double force : panel.scene.chain_forces) take(force, sheet.largest_value);
    for (const SpringPart& spring : panel.scene.springs)
      if (spring.is_line) take(spring.force, sheet.largest_value);
  }
}

/// Middle half of the links' lengths on the screen decides how large joints are.
double joint_radius(const Panel& panel, const Sheet& sheet) {
  constexpr double smallest = 2.2, largest = 5.5, part = 0.2;
  std::vector<double> lengths;
  for (const LinkPart& link : panel.scene.links) {
    const Vec way = panel.scene.points[link.to] - panel.scene.points[link.from];
    const double pixels =
        sheet.scale * std::hypot(sheet.view.right.dot(way), sheet.view.up.dot(way));
    if (pixels > 1) lengths.push_back(pixels);
  }
  if (lengths.empty()) return largest;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::clamp(part * *middle, smallest, largest);
}

}  // namespace

Sheet sheet_for(const std::vector<Panel>& panels, const IllustrationOptions& options,
                const Room& room) {
  Sheet sheet{.view = options.view ? *options.view : natural_view(panels.front().scene),
              .colouring = options.colouring,
              .has_names = options.has_names,
              .arrow = room.is_large ? 64.0 : 36.0};
  if (options.is_perspective && !(sheet.view.eye > 0)) sheet.view.eye = usual_eye;
  place_eye(panels, sheet);
  measure(panels, sheet);
  const double border = sheet.arrow + 16;
  const Seen seen = seen_of(panels, sheet);
  const double wide = seen.right - seen.left, tall = seen.high - seen.low;
  const double across =
      std::max(wide / (room.width - 2 * border), tall / (room.height - 2 * border));
  sheet.scale = across > 0 ? 1 / across : 1;
  if (sheet.eye > 0)
    sheet.shift = {0.5 * (seen.left + seen.right), 0.5 * (seen.low + seen.high)};
  else
    sheet.middle = 0.5 * (seen.left + seen.right) * sheet.view.right +
                   0.5 * (seen.low + seen.high) * sheet.view.up;
  sheet.joint = joint_radius(panels.front(), sheet);
  if (!room.is_large) sheet.joint = std::min(sheet.joint, 4.0);
  return sheet;
}

}  // namespace springfold::drawing
