#include "painter.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "glyphs.hpp"
#include "name_places.hpp"
#include "projection.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::drawing {
namespace {

using Vec = model::Vec3<double>;

constexpr double spring_width = 1.8;  // of lines [px]

double member_width(Member member) {
  return member == Member::strut ? 4.5 : member == Member::cable ? spring_width : 3;
}

std::string member_word(Member member) {
  return member == Member::strut ? "strut" : member == Member::cable ? "cable" : "bar";
}

class Painter {
 public:
  Painter(const Panel& panel, const Sheet& sheet, const Box& room, Picture& picture)
      : panel_{panel}, scene_{panel.scene}, sheet_{sheet}, room_{room}, picture_{picture} {}

  void paint() {
    paint_bodies();
    paint_base();
    paint_links();
    paint_gaps();
    for (const OutlinePart& outline : scene_.outlines) paint(outline);
    for (const SpringPart& spring : scene_.springs) paint(spring);
    for (const StopPart& stop : scene_.stops) paint(stop);
    for (const JointPart& joint : scene_.joints) paint(joint);
    paint_origins();
    for (const LoadPart& load : scene_.loads) paint(load);
    if (sheet_.has_names) paint_names();
  }

 private:
  Place place(const Vec& p) const {
    const Place seen = seen_at(sheet_, p);
    return {(room_.left + room_.right) / 2 + sheet_.scale * seen.x,
            (room_.top + room_.bottom) / 2 - sheet_.scale * seen.y};
  }
  Place place(PointId i) const { return place(scene_.points[i]); }
  /// On the screen; shorter than 1 where it points at us.
  Place seen(PointId at, const Vec& way) const {
    const Place step = seen_step(sheet_, scene_.points[at], way);
    return {step.x, -step.y};
  }

  void add(Path path) { picture_.marks.emplace_back(std::move(path)); }
  void add(const std::vector<Path>& paths, const std::string& title) {
    for (Path path : paths) {
      path.title = title;
      add(std::move(path));
    }
  }

  double share(double value) const {
    return sheet_.largest_value > 0 ? std::abs(value) / sheet_.largest_value : 0;
  }

  void paint_bodies() {
    const bool shows_stability = sheet_.colouring == Colouring::stability;
    const std::string colour = shows_stability ? stability_colour(panel_) : "#5b6b7a";
    for (const BodyPart& body : scene_.bodies) {
      std::vector<Place> corners;
      for (const PointId i : body.corners) corners.push_back(place(i));
      add({hull(std::move(corners)), true, {colour, "#dfe8f0", 2.2, {}}, "body " + body.name});
    }
  }

  void paint_base() {
    constexpr double same = 1;  // pixel
    std::vector<Place> done;
    for (const BasePart& base : scene_.base) {
      const Place at = place(base.at);
      if (std::any_of(done.begin(), done.end(), [&](Place p) { return length(p - at) < same; }))
        continue;
      done.push_back(at);
      const Place way = at - place(base.towards);
      Place away{0, 1};  // below, where nothing else is said
      if (std::abs(way.x) > std::abs(way.y)) away = {way.x > 0 ? 1.0 : -1.0, 0};
      if (std::abs(way.y) > std::abs(way.x)) away = {0, way.y > 0 ? 1.0 : -1.0};
      const double size = 2.2 * sheet_.joint;
      add(ground(at + 1.5 * sheet_.joint * away, away, size, {"#555555", "", 1, {}}), "base");
    }
  }

  void paint_links() {
    for (const LinkPart& link : scene_.links) {
      const Place from = place(link.from), to = place(link.to);
      if (length(to - from) < 0.01) continue;  // of a pixel: nothing to see
      const auto chain = static_cast<std::size_t>(link.chain);
      const double force = scene_.chain_forces[chain];
      std::string title = "chain " + scene_.chains[chain];
      if (std::isfinite(force)) title += ", carries a force of " + rounded(force);
      Ink ink{ink_colour, "", link.is_rail ? 1.2 : 3, {}};
      if (sheet_.colouring == Colouring::stability) ink.stroke = stability_colour(panel_);
      if (sheet_.colouring == Colouring::force && std::isfinite(force)) {
        ink.stroke = ramp_colour(share(force));
        ink.width += link.is_rail ? 0 : 2 * share(force);
      }
      if (link.is_rail) ink.dashes = {6, 3};
      add({{from, to}, false, ink, title});
    }
  }

  void paint_gaps() {
    constexpr double visible = 1e-6;  // of the size: far above what a solved state leaves
    for (const GapPart& gap : scene_.gaps) {
      const double width = (scene_.points[gap.end] - scene_.points[gap.attachment]).norm();
      if (!(width > visible * size_of(scene_))) continue;
      add({{place(gap.end), place(gap.attachment)},
           false,
           {gap_colour, "", 2, {2, 4}},
           "chain " + scene_.chains[static_cast<std::size_t>(gap.chain)] +
               " does not close: " + rounded(width) + " apart"});
    }
  }

  void paint(const SpringPart& spring) {
    Ink ink{spring.member == Member::none ? spring_colour : ink_colour, "", spring_width, {}};
    if (!spring.acts) ink = {passive_colour, "", 1.2, {3, 2}};
    std::string title = "spring " + spring.name;
    title += spring.is_one_sided ? (spring.acts ? ", acts" : ", does not act") : "";
    if (std::isfinite(spring.force)) title += ", force " + rounded(spring.force);
    if (has_colour_of_stability(scene_, spring, sheet_.colouring))
      ink.stroke = stability_colour(panel_);
    if (has_colour_of_value(spring, sheet_.colouring)) {
      const double value = sheet_.colouring == Colouring::energy ? spring.energy : spring.force;
      if (std::isfinite(value)) ink.stroke = ramp_colour(share(value));
      ink.width = 2.4;
    }
    const Place from = place(spring.from), to = place(spring.to), at = place(spring.at);
    if (spring.member != Member::none) {
      if (spring.acts) ink.width += member_width(spring.member) - spring_width;
      add({{from, to}, false, ink, member_word(spring.member) + title.substr(title.find(' '))});
      return;
    }
    if (!spring.is_line) {
      add({spiral(at, from - at, to - at, 1.3 * sheet_.joint, 2.4 * sheet_.joint), false, ink,
           title});
      return;
    }
    constexpr double shortest = 8;  // pixels: below it a coil is a blot
    if (length(to - from) > shortest)
      add({coil(from, to, std::min(1.4 * sheet_.joint, 0.3 * length(to - from))), false, ink,
           title});
    else
      picture_.marks.emplace_back(Disc{to, 1.6 * sheet_.joint, ink, title});
  }

  void paint(const OutlinePart& outline) {
    Path path{.is_closed = outline.corners.size() > 2,
              .ink = {spring_colour, "", 1.2, {5, 3}},
              .title = "spring or pressure " + outline.name,
              .is_obstacle = false,
              .is_avoided = true};
    if (!outline.acts) path.ink = {passive_colour, "", 1.2, {3, 2}};
    for (const PointId corner : outline.corners) path.places.push_back(place(corner));
    add(std::move(path));
  }

  void paint(const StopPart& stop) {
    const bool acts = scene_.springs[stop.spring].acts;
    const Ink ink{acts ? unstable_colour : passive_colour, "", 2.2, {}};
    const std::string title = "threshold of spring " + scene_.springs[stop.spring].name;
    const Place at = place(stop.at), along = direction(place(stop.tip) - at);
    const double size = 1.8 * sheet_.joint;
    if (stop.is_slide)
      add({{at - size * across(along), at + size * across(along)}, false, ink, title});
    else
      add({{at + 1.7 * size * along, at + 2.9 * size * along}, false, ink, title});
  }

  void paint(const JointPart& joint) {
    const bool is_actuated = joint.role == model::JointRole::actuated;
    Ink ink{ink_colour, is_actuated ? ink_colour : "#ffffff", 1.6, {}};
    if (joint.role == model::JointRole::preloaded) ink.stroke = spring_colour;
    if (joint.role == model::JointRole::compliant) ink.stroke = "#5b6b7a";
    const double r = sheet_.joint;
    const Place at = place(joint.at);
    const std::string title = joint.name.empty() ? "free to turn" : joint.name;
    switch (joint.shape) {
      case JointShape::prismatic: {
        const Place along = direction(place(joint.axis) - at);
        add_box(at, 1.6 * r * along, 1.0 * r * across(along), ink, title);
        return;
      }
      case JointShape::elastic:
        add_box(at, {0.8 * r, 0.8 * r}, {0.8 * r, -0.8 * r}, ink, title);
        return;
      case JointShape::universal:
        picture_.marks.emplace_back(Disc{at, 1.2 * r, ink, title});
        ink.width = 1;
        add({{at - Place{r, 0}, at + Place{r, 0}}, false, ink, title});
        add({{at - Place{0, r}, at + Place{0, r}}, false, ink, title});
        return;
      case JointShape::spherical:
        picture_.marks.emplace_back(Disc{at, 1.4 * r, ink, title});
        picture_.marks.emplace_back(Disc{at, 0.6 * r, {"", ink.stroke, 0, {}}, title});
        return;
      case JointShape::revolute:
        picture_.marks.emplace_back(Disc{at, r, ink, title});
        return;
      case JointShape::pin:
        picture_.marks.emplace_back(Disc{at, 0.8 * r, ink, title});
        return;
    }
  }

  void add_box(Place at, Place a, Place b, const Ink& ink, const std::string& title) {
    add({{at - a - b, at + a - b, at + a + b, at - a + b}, true, ink, title});
  }

  void paint_origins() {
    for (const BodyPart& body : scene_.bodies)
      picture_.marks.emplace_back(
          Disc{place(body.origin), 0.4 * sheet_.joint, {"", ink_colour, 0, {}}, body.name});
  }

  void paint(const LoadPart& load) {
    const double largest = load.is_moment ? sheet_.largest_moment : sheet_.largest_load;
    const double size = load.vector.norm();
    if (!(size > 0) || (load.is_direction ? is_covered(load) : !(largest > 0))) return;
    const Place at = place(load.at);
    Ink ink{load_colour, "", load.is_weight ? 1.2 : 2.2, {}};
    std::string title = load.is_direction ? "direction in which the study drives"
                        : load.is_weight  ? "weight"
                        : load.is_moment  ? "moment"
                                          : "force";
    if (!load.name.empty()) title += " " + load.name;
    if (!load.is_direction) title += ": " + rounded(size);
    if (load.is_direction) ink.dashes = {4, 3};
    if (load.is_moment) {
      const double sign = towards_eye(sheet_, scene_.points[load.at]).dot(load.vector) < 0 ? -1 : 1;
      add(turning_arrow(at, 3.4 * sheet_.joint, sign, ink), title);
      return;
    }
    constexpr double least = 0.35;  // of the longest arrow, so that heads fit
    const double part = load.is_direction ? 0.7 : least + (1 - least) * size / largest;
    const Place way = sheet_.arrow * part * seen(load.at, load.vector / size);
    constexpr double end_on = 12;  // pixels: shorter ones point at us or away
    if (length(way) < end_on) {
      picture_.marks.emplace_back(Disc{at, 2.2 * sheet_.joint, ink, title});
      return;
    }
    const Place begin = at + 1.5 * sheet_.joint * direction(way);
    add(arrow(begin, begin + way, ink), title);
  }

  /// A force along the direction is drawn there already.
  bool is_covered(const LoadPart& direction) const {
    return std::any_of(scene_.loads.begin(), scene_.loads.end(), [&](const LoadPart& load) {
      constexpr double same_direction = 0.99;  // cosine: arrows that cannot be told apart
      const double sizes = load.vector.norm() * direction.vector.norm();
      return !load.is_direction && load.at == direction.at && sizes > 0 &&
             load.is_moment == direction.is_moment &&
             std::abs(load.vector.dot(direction.vector)) > same_direction * sizes;
    });
  }

  void want(PointId at, const std::string& text, bool is_bold, const char* colour) {
    names_.push_back(
        {place(at),
         {.text = text, .size = is_bold ? 12.0 : 11.0, .colour = colour, .is_bold = is_bold},
         1.6 * sheet_.joint});
  }

  /// Bodies first, then what is named in the case; joints only where they are few.
  void paint_names() {
    constexpr std::size_t few = 14;
    for (const BodyPart& body : scene_.bodies) want(body.origin, body.name, true, "#222222");
    for (const LoadPart& load : scene_.loads)
      if (load.vector.norm() > 0) want(load.at, load.name, false, load_colour);
    for (const NamedPoint& point : scene_.names) want(point.at, point.name, false, "#444444");
    for (std::size_t c = 0; c < scene_.chains.size(); ++c) want_chain(c);
    for (const SpringPart& spring : scene_.springs)
      if (spring.is_line && spring.name.find('.') == std::string::npos && !is_outline(spring.name))
        names_.push_back({0.5 * (place(spring.from) + place(spring.to)),
                          {.text = spring.name, .size = 11, .colour = spring_colour},
                          1.6 * sheet_.joint});
    for (std::size_t i = 0; i < scene_.outlines.size(); ++i)
      if (i == 0 || scene_.outlines[i].name != scene_.outlines[i - 1].name)
        want_outline(scene_.outlines[i]);
    if (scene_.joints.size() <= few)
      for (const JointPart& joint : scene_.joints)
        want(joint.at, joint.name.substr(joint.name.find('.') + 1), false, "#555555");
    place_names(names_, room_, picture_);
  }

  /// The name stands at the outline then.
  bool is_outline(const std::string& name) const {
    return std::any_of(scene_.outlines.begin(), scene_.outlines.end(),
                       [&](const OutlinePart& outline) { return outline.name == name; });
  }

  /// At the middle of its longest side.
  void want_outline(const OutlinePart& outline) {
    const std::size_t count = outline.corners.size();
    double longest = -1;
    Place middle;
    for (std::size_t i = 0; i < (count > 2 ? count : count - 1); ++i) {
      const Place a = place(outline.corners[i]), b = place(outline.corners[(i + 1) % count]);
      if (length(b - a) <= longest) continue;
      longest = length(b - a);
      middle = 0.5 * (a + b);
    }
    names_.push_back({middle, {.text = outline.name, .size = 11, .colour = spring_colour}, 3});
  }

  /// At the middle of the chain's longest link.
  void want_chain(std::size_t chain) {
    double longest = -1;
    Place middle;
    for (const LinkPart& link : scene_.links) {
      const Place from = place(link.from), to = place(link.to);
      if (static_cast<std::size_t>(link.chain) != chain || length(to - from) <= longest) continue;
      longest = length(to - from);
      middle = 0.5 * (from + to);
    }
    if (longest < 0) return;
    names_.push_back({middle, {.text = scene_.chains[chain], .size = 11, .colour = "#444444"}, 3});
  }

  const Panel& panel_;
  const Scene& scene_;
  const Sheet& sheet_;
  const Box& room_;
  Picture& picture_;
  std::vector<WantedName> names_;
};

}  // namespace

std::vector<PointId> places_of(const Scene& scene) {
  std::vector<PointId> places;
  for (const LinkPart& link : scene.links) places.insert(places.end(), {link.from, link.to});
  for (const BodyPart& body : scene.bodies)
    places.insert(places.end(), body.corners.begin(), body.corners.end());
  for (const SpringPart& spring : scene.springs)
    places.insert(places.end(), {spring.from, spring.to});
  for (const OutlinePart& outline : scene.outlines)
    places.insert(places.end(), outline.corners.begin(), outline.corners.end());
  for (const GapPart& gap : scene.gaps) places.insert(places.end(), {gap.end, gap.attachment});
  for (const LoadPart& load : scene.loads) places.push_back(load.at);
  for (const BasePart& base : scene.base) places.push_back(base.at);
  return places;
}

void paint(const Panel& panel, const Sheet& sheet, const Box& room, Picture& picture) {
  Painter{panel, sheet, room, picture}.paint();
}

}  // namespace springfold::drawing
