#include "springfold/drawing/movie.hpp"

#include <algorithm>
#include <cassert>

#include "diagram.hpp"
#include "legend.hpp"
#include "sheet.hpp"
#include "words.hpp"

namespace springfold::drawing {
namespace {

constexpr double edge = 10, film_width = 860,
                 film_height = 360;    // of mechanism and diagram together [px]
constexpr double diagram_begin = 430;  // where the diagram begins
constexpr double head = 48;            // lines of title and heading
constexpr double notes = 62;           // lines above the mechanism

Box diagram_frame() {
  return {diagram_begin + 62, head + 30, film_width - 20, head + notes + film_height - 46};
}

/// There and back. At both ends it rests as long as in so many slots.
std::vector<std::size_t> to_and_fro(const std::vector<std::size_t>& order) {
  constexpr std::size_t rest = 8;
  std::vector<std::size_t> loop(rest, order.front());
  loop.insert(loop.end(), order.begin(), order.end());
  loop.insert(loop.end(), rest, order.back());
  loop.insert(loop.end(), order.rbegin(), order.rend());
  return loop;
}

std::vector<Mark> marks_of(const Frame& frame, const Sheet& sheet, Place dot, bool has_dot) {
  Picture picture{.width = film_width, .height = head + notes + film_height};
  double y = head;
  add_line(frame.panel.title, 12, true, edge, diagram_begin - 2 * edge, y, picture);
  for (const std::string& note : frame.panel.notes)
    add_line(note, 11, false, edge, diagram_begin - 2 * edge, y, picture);
  paint(frame.panel, sheet, {4, head + notes, diagram_begin - 4, head + notes + film_height},
        picture);
  for (Mark& mark : picture.marks) {  // nobody points at what moves
    if (auto* path = std::get_if<Path>(&mark)) path->title.clear();
    if (auto* disc = std::get_if<Disc>(&mark)) disc->title.clear();
  }
  if (has_dot) picture.marks.emplace_back(Disc{dot, 5.5, {"#ffffff", load_colour, 1.5, {}}});
  return std::move(picture.marks);
}

/// The legend explains what occurs on the curve too: a panel more for each stability that no frame has.
void add_states_of(const Diagram& diagram, std::vector<Panel>& panels) {
  for (const DiagramPoint& point : diagram.points) {
    const auto is_same = [&](const Panel& panel) {
      return panel.unstable_dead == point.unstable_dead &&
             panel.unstable_driven == point.unstable_driven;
    };
    if (std::any_of(panels.begin(), panels.end(), is_same)) continue;
    Panel panel = panels.front();
    panel.unstable_dead = point.unstable_dead;
    panel.unstable_driven = point.unstable_driven;
    panels.push_back(std::move(panel));
  }
}

}  // namespace

Place place_in_movie(const Film& film, const DiagramPoint& point) {
  return DiagramAxes{film.diagram, diagram_frame()}.place(point);
}

Movie animate(const Film& film, const IllustrationOptions& options) {
  assert(!film.frames.empty() && !film.order.empty());
  std::vector<Panel> panels;
  for (const Frame& frame : film.frames) panels.push_back(frame.panel);
  Sheet sheet = sheet_for(panels, options, {diagram_begin, film_height, true});
  // Names would jump from frame to frame to where there is room.
  sheet.has_names = false;
  Movie movie{.still = {.width = film_width, .title = options.title},
              .order = to_and_fro(film.order)};
  double y = edge - 4;
  add_line(options.title, 14, true, edge, film_width - 2 * edge, y, movie.still);
  add_line(film.heading, 12, false, edge, film_width - 2 * edge, y, movie.still);
  const DiagramAxes axes{film.diagram, diagram_frame()};
  const bool is_mixed = axes.paint(movie.still);
  add_states_of(film.diagram, panels);
  const double bottom = head + notes + film_height;
  movie.still.height = bottom + add_legend(panels, sheet, options, bottom, is_mixed, movie.still);
  for (const Frame& frame : film.frames) {
    const DiagramPoint& point = film.diagram.points[frame.point];
    movie.frames.push_back(marks_of(frame, sheet, axes.place(point), is_known(point)));
  }
  return movie;
}

}  // namespace springfold::drawing
