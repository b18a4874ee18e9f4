#include "legend.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include "springfold/core/number_text.hpp"

namespace springfold::drawing {
namespace {

constexpr double line_height = 18, font_size = 11, sample = 22, margin = 14;

struct Entry {
  std::string text{};
  Ink ink{};
  bool is_disc = false;
};

class Legend {
 public:
  Legend(const std::vector<Panel>& panels, const Sheet& sheet, const IllustrationOptions& options,
         bool has_mixed)
      : panels_{panels}, sheet_{sheet} {
    add_colours(options);
    if (has_mixed)
      entries_.push_back({"with a less stable one on it", {mixed_colour, "", mixed_width, {}}});
    add_joints();
    add_springs();
    add_loads();
    const auto gap = [](const Scene& s) {
      constexpr double visible = 1e-6;  // as the painter
      return largest_gap(s) > visible;
    };
    if (any(gap)) entries_.push_back({"chain does not close", {gap_colour, "", 2, {2, 4}}});
  }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  bool any(const std::function<bool(const Scene&)>& holds) const {
    return std::any_of(panels_.begin(), panels_.end(),
                       [&](const Panel& panel) { return holds(panel.scene); });
  }

  void add_colours(const IllustrationOptions& options) {
    if (sheet_.colouring == Colouring::stability) {
      const auto add = [&](const char* colour, const char* text) {
        if (std::any_of(panels_.begin(), panels_.end(),
                        [&](const Panel& p) { return stability_colour(p) == colour; }))
          entries_.push_back({text, {colour, "", 3, {}}});
      };
      add(stable_colour, "stable under dead load");
      add(critical_colour, "critical: stability ends here");
      add(driven_colour, "held as driven, unstable under dead load");
      add(unstable_colour, "unstable");
      add(ink_colour, "stability not known");
    }
    if (sheet_.colouring != Colouring::force && sheet_.colouring != Colouring::energy) return;
    const bool is_force = sheet_.colouring == Colouring::force;
    const std::string what = is_force ? "force" : "energy of a spring";
    const std::string unit = is_force ? options.force_unit : options.energy_unit;
    for (const double part : {0.0, 0.5, 1.0})
      entries_.push_back({(part == 0 ? what + " " : "") + rounded(part * sheet_.largest_value, 3) +
                              (unit.empty() ? "" : " " + unit),
                          {ramp_colour(part), "", 4, {}}});
  }

  void add_joints() {
    const auto has = [](model::JointRole role) {
      return [role](const Scene& scene) {
        return std::any_of(scene.joints.begin(), scene.joints.end(), [&](const JointPart& joint) {
          return joint.role == role && joint.shape != JointShape::elastic;
        });
      };
    };
    if (any(has(model::JointRole::actuated)))
      entries_.push_back({"actuated joint", {ink_colour, ink_colour, 1.6, {}}, true});
    if (any(has(model::JointRole::passive)))
      entries_.push_back({"passive joint", {ink_colour, "#ffffff", 1.6, {}}, true});
    if (any(has(model::JointRole::preloaded)))
      entries_.push_back({"preloaded joint", {spring_colour, "#ffffff", 1.6, {}}, true});
    if (any(has(model::JointRole::compliant)) || any([](const Scene& scene) {
          return std::any_of(scene.joints.begin(), scene.joints.end(), [](const JointPart& joint) {
            return joint.shape == JointShape::elastic;
          });
        }))
      entries_.push_back({"virtual joint", {"#5b6b7a", "#ffffff", 1.6, {}}, true});
  }

  void add_springs() {
    const auto has_idle = [](const Scene& scene) {
      return std::any_of(scene.springs.begin(), scene.springs.end(),
                         [](const SpringPart& spring) { return !spring.acts; });
    };
    const auto has_own_colour = [this](const Scene& scene) {
      return std::any_of(scene.springs.begin(), scene.springs.end(), [&](const SpringPart& spring) {
        return spring.acts && !has_colour_of_value(spring, sheet_.colouring) &&
               !has_colour_of_stability(scene, spring, sheet_.colouring);
      });
    };
    if (any(has_own_colour)) entries_.push_back({"spring", {spring_colour, "", 1.8, {}}});
    const auto has_outline = [](const Scene& scene) { return !scene.outlines.empty(); };
    if (any(has_outline))
      entries_.push_back({"area, surface, line or plane", {spring_colour, "", 1.2, {5, 3}}});
    if (any(has_idle))
      entries_.push_back({"spring that does not act here", {passive_colour, "", 1.2, {3, 2}}});
  }

  void add_loads() {
    const auto has = [](bool is_direction) {
      return [is_direction](const Scene& scene) {
        return std::any_of(scene.loads.begin(), scene.loads.end(), [&](const LoadPart& load) {
          return load.is_direction == is_direction && load.vector.norm() > 0;
        });
      };
    };
    if (any(has(false))) entries_.push_back({"load", {load_colour, "", 2.2, {}}});
    if (any(has(true)))
      entries_.push_back({"direction of the study", {load_colour, "", 2.2, {4, 3}}});
  }

  const std::vector<Panel>& panels_;
  const Sheet& sheet_;
  std::vector<Entry> entries_;
};

}  // namespace

double add_legend(const std::vector<Panel>& panels, const Sheet& sheet,
                  const IllustrationOptions& options, double top, bool has_mixed,
                  Picture& picture) {
  double x = margin, y = top + line_height;
  const Legend legend{panels, sheet, options, has_mixed};
  for (const Entry& entry : legend.entries()) {
    Words words{.at = {0, y}, .text = entry.text, .size = font_size, .colour = "#333333"};
    const Box box = box_of(words);
    const double width = sample + 6 + box.right - box.left;
    if (x > margin && x + width > picture.width - margin) {
      x = margin;
      y += line_height;
    }
    const Place middle{x + sample / 2, y - 0.35 * font_size};
    if (entry.is_disc)
      picture.marks.emplace_back(Disc{middle, 4.5, entry.ink, ""});
    else
      picture.marks.emplace_back(Path{{{x, middle.y}, {x + sample, middle.y}}, false, entry.ink});
    words.at = {x + sample + 6, y};
    picture.marks.emplace_back(words);
    x += width + 18;
  }
  return y + margin - top;
}

}  // namespace springfold::drawing
