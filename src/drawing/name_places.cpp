#include "name_places.hpp"

#include <algorithm>

namespace springfold::drawing {
namespace {

bool is_within(const Box& inner, const Box& outer) {
  return inner.left >= outer.left && inner.right <= outer.right && inner.top >= outer.top &&
         inner.bottom <= outer.bottom;
}

/// With room for half of the line's width and a little air.
Box widened(const Box& box, const Ink& ink) {
  constexpr double air = 1.5;
  const double by = ink.width / 2 + air;
  return {box.left - by, box.top - by, box.right + by, box.bottom + by};
}

bool is_free(const Box& box, const Picture& picture, bool keeps_off_all) {
  for (const Mark& mark : picture.marks) {
    if (const auto* words = std::get_if<Words>(&mark)) {
      if (overlap(box, box_of(*words))) return false;
    } else if (const auto* disc = std::get_if<Disc>(&mark)) {
      const Place c = disc->centre;
      const double r = disc->radius;
      if (overlap(box, {c.x - r, c.y - r, c.x + r, c.y + r})) return false;
    } else if (const auto& path = std::get<Path>(mark);
               path.is_obstacle || (keeps_off_all && path.is_avoided)) {
      const Box wide = widened(box, path.ink);
      for (std::size_t i = 0; i + 1 < path.places.size(); ++i)
        if (crosses(path.places[i], path.places[i + 1], wide)) return false;
      if (path.is_closed && !path.places.empty() &&
          crosses(path.places.back(), path.places.front(), wide))
        return false;
    }
  }
  return true;
}

}  // namespace

void place_names(const std::vector<WantedName>& names, const Box& room, Picture& picture) {
  struct Side {
    double x, y;
    Anchor anchor;
  };
  // Where one looks first: right above, then around.
  constexpr Side sides[] = {{0.7, -0.7, Anchor::start}, {0.7, 0.7, Anchor::start},
                            {-0.7, -0.7, Anchor::end},  {-0.7, 0.7, Anchor::end},
                            {1, 0, Anchor::start},      {-1, 0, Anchor::end},
                            {0, -1, Anchor::middle},    {0, 1, Anchor::middle}};
  for (const WantedName& name : names) {
    if (name.words.text.empty()) continue;
    bool is_placed = false;
    const auto try_sides = [&](double away, bool keeps_off_all) {
      for (const Side& side : sides) {
        Words words = name.words;
        words.anchor = side.anchor;
        // The base line: half of a letter's height below the middle of the words.
        words.at = {name.at.x + side.x * away,
                    name.at.y + side.y * (away + 0.25 * words.size) + 0.3 * words.size};
        const Box box = box_of(words);
        if (!is_within(box, room) || !is_free(box, picture, keeps_off_all)) continue;
        picture.marks.push_back(words);
        is_placed = true;
        return;
      }
    };
    for (const bool keeps_off_all : {true, false})
      for (double away = name.distance + 4; away < name.distance + 34 && !is_placed; away += 6)
        try_sides(away, keeps_off_all);
  }
}

}  // namespace springfold::drawing
