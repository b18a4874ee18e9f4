#include "springfold/drawing/illustration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "legend.hpp"
#include "painter.hpp"
#include "sheet.hpp"
#include "words.hpp"

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

constexpr double line_pitch = 15;  // pixels from one line of words to the next

double lines_above(const std::vector<Panel>& panels) {
  std::size_t most = 0;
  for (const Panel& panel : panels)
    most = std::max(most, panel.notes.size() + (panel.title.empty() ? 0 : 1));
  return line_pitch * static_cast<double>(most) + 6;
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
  const Room room_of_all{grid.width, grid.height, panels.size() == 1};
  const Sheet sheet = sheet_for(panels, options, room_of_all);
  Picture picture{.width = grid.width * static_cast<double>(grid.columns), .title = options.title};
  double top = edge - 4;
  add_line(options.title, 14, true, edge, picture.width - 2 * edge, top, picture);
  if (panels.size() > 1 && !options.title.empty()) top += edge;
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
  picture.height += add_legend(panels, sheet, options, picture.height, false, picture);
  return picture;
}

}  // namespace springfold::drawing
