// What colours say: stability, forces, energies.
#include <algorithm>
#include <cmath>

#include "painter.hpp"

namespace springfold::drawing {

std::string ramp_colour(double t) {
  constexpr double light[] = {158, 188, 218}, dark[] = {63, 0, 75};
  const double part = std::clamp(t, 0.0, 1.0);
  std::string text = "#";
  for (int i = 0; i < 3; ++i) {
    const auto value = static_cast<unsigned>(std::lround(light[i] + part * (dark[i] - light[i])));
    text += "0123456789abcdef"[value / 16];
    text += "0123456789abcdef"[value % 16];
  }
  return text;
}

std::string stability_colour(const Panel& panel) {
  if (panel.unstable_driven && *panel.unstable_driven > 0) return unstable_colour;
  if (panel.is_critical) return critical_colour;
  if (!panel.unstable_dead) return ink_colour;
  if (*panel.unstable_dead == 0) return stable_colour;
  return panel.unstable_driven ? driven_colour : unstable_colour;
}

bool has_colour_of_stability(const Scene& scene, const SpringPart& spring, Colouring colouring) {
  const bool no_link = std::all_of(scene.links.begin(), scene.links.end(),
                                   [](const LinkPart& link) { return link.is_rail; });
  return colouring == Colouring::stability && spring.is_line && spring.acts &&
         (no_link || spring.member != Member::none);
}

bool has_colour_of_value(const SpringPart& spring, Colouring colouring) {
  return spring.acts &&
         (colouring == Colouring::energy || (colouring == Colouring::force && spring.is_line));
}

}  // namespace springfold::drawing
