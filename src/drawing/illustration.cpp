#include "springfold/drawing/illustration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "legend.hpp"
#include "painter.hpp"

namespace springfold::drawing {
namespace {

using Vec = model::Vec3<double>;

struct Grid {
  std::size_t columns = 1, rows = 1;
  double width = 0, height = 0;  ///< of one panel
};

Grid grid_for(std::size_t count, const IllustrationOptions& options) {
  if (count == 1) return {1, 1, options.width, options.height};
  constexpr std::size_t most_columns = 4;
  const auto columns = std::min(
      most_columns, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count)))));
  return {columns, (count + columns - 1) / columns, options.small_width, options.small_height};
}

/// The box around all panels as they are seen, in lengths.
struct Seen {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  double low = left, high = -left;
};

Seen seen_of(const std::vector<Panel>& panels, const View& view) {
  Seen seen;
  for (const Panel& panel : panels)
    for (const PointId i : places_of(panel.scene)) {
      const Vec& p = panel.scene.points[i];
      seen.left = std::min(seen.left, view.right.dot(p));
      seen.right = std::max(seen.right, view.right.dot(p));
      seen.low = std::min(seen.low, view.up.dot(p));
      seen.high = std::max(seen.high, view.up.dot(p));
    }
  return seen;
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

constexpr double line = 15;  // pixels from one line of words to the next

Sheet sheet_for(const std::vector<Panel>& panels, const IllustrationOptions& options, double width,
                double height) {
  Sheet sheet{.view = options.view ? *options.view : natural_view(panels.front().scene),
              .colouring = options.colouring,
              .has_names = options.has_names,
              .arrow = panels.size() == 1 ? 64.0 : 36.0};
  measure(panels, sheet);
  const double margin = sheet.arrow + 16;
  const Seen seen = seen_of(panels, sheet.view);
  const double wide = seen.right - seen.left, tall = seen.high - seen.low;
  const double across = std::max(wide / (width - 2 * margin), tall / (height - 2 * margin));
  sheet.scale = across > 0 ? 1 / across : 1;
  sheet.middle = 0.5 * (seen.left + seen.right) * sheet.view.right +
                 0.5 * (seen.low + seen.high) * sheet.view.up;
  sheet.joint = joint_radius(panels.front(), sheet);
  if (panels.size() > 1) sheet.joint = std::min(sheet.joint, 4.0);
  return sheet;
}

/// As many whole characters as fit, with an ellipsis for the rest.
std::string fitting(const std::string& text, double font, double width) {
  const auto fits = [&](const std::string& t) {
    const Box box = box_of({.text = t, .size = font});
    return box.right - box.left <= width;
  };
  if (fits(text)) return text;
  std::string shorter = text;
  while (!shorter.empty() && !fits(shorter + "…")) {
    while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xC0U) == 0x80)
      shorter.pop_back();
    if (!shorter.empty()) shorter.pop_back();
  }
  return shorter + "…";
}

void add_line(const std::string& text, double font, bool is_bold, double x, double width, double& y,
              Picture& picture) {
  if (text.empty()) return;
  y += font + 4;
  picture.marks.emplace_back(
      Words{.at = {x, y}, .text = fitting(text, font, width), .size = font, .is_bold = is_bold});
}

double lines_above(const std::vector<Panel>& panels) {
  std::size_t most = 0;
  for (const Panel& panel : panels)
    most = std::max(most, panel.notes.size() + (panel.title.empty() ? 0 : 1));
  return line * static_cast<double>(most) + 6;
}

}  // namespace

View view_from(double azimuth, double elevation) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  return {Vec(-sa, ca, 0), Vec(-se * ca, -se * sa, ce)};
}

View natural_view(const Scene& scene) {
  if (scene.is_planar) return {};
  constexpr double degree = std::numbers::pi / 180;
  return view_from(-62 * degree, 22 * degree);
}

Picture illustrate(const std::vector<Panel>& panels, const IllustrationOptions& options) {
  assert(!panels.empty());
  constexpr double edge = 10;
  const Grid grid = grid_for(panels.size(), options);
  const double above = lines_above(panels);
  const Sheet sheet = sheet_for(panels, options, grid.width, grid.height);
  Picture picture{.width = grid.width * static_cast<double>(grid.columns), .title = options.title};
  double top = edge - 4;
  add_line(options.title, 14, true, edge, picture.width - 2 * edge, top, picture);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double left = grid.width * static_cast<double>(i % grid.columns);
    double y = top + (above + grid.height) * static_cast<double>(i / grid.columns);
    const Box room{left + 4, y + above, left + grid.width - 4, y + above + grid.height};
    const double width = grid.width - 2 * edge;
    add_line(panels[i].title, 12, panels.size() > 1, left + edge, width, y, picture);
    for (const std::string& note : panels[i].notes)
      add_line(note, 11, false, left + edge, width, y, picture);
    paint(panels[i], sheet, room, picture);
  }
  picture.height = top + (above + grid.height) * static_cast<double>(grid.rows);
  picture.height += add_legend(panels, sheet, options, picture.height, picture);
  return picture;
}

}  // namespace springfold::drawing
