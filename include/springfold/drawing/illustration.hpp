// Scenes as a flat picture: one panel for each posture, one scale and one legend for all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/drawing/picture.hpp"
#include "springfold/drawing/scene.hpp"

namespace springfold::drawing {

/// What of the world runs to the right of the picture and what runs up. Unit vectors, perpendicular.
struct View {
  model::Vec3<double> right = model::Vec3<double>::UnitX();
  model::Vec3<double> up = model::Vec3<double>::UnitY();
  /// Distance of the eye from the middle of the mechanism, in sizes of it; 0: far away, so that parallel lines stay
  /// parallel (orthographic).
  double eye = 0;
};

/// From so far a perspective looks at the mechanism, in sizes of it: what is near looks half as large again as what is
/// far.
inline constexpr double usual_eye = 2.5;

/// Seen from far away, z up: from the direction at `azimuth` from x towards y and at `elevation` above
/// the xy plane [rad].
View view_from(double azimuth, double elevation);

/// Plan for what stays in the xy plane, otherwise from the front, a little from the right and above.
View natural_view(const Scene& scene);

enum class Colouring {
  none,
  stability,  ///< links: of the posture
  force,      ///< links: the force that their chain carries to its end; line springs: theirs
  energy,     ///< springs: what they store
};

struct Panel {
  Scene scene{};
  std::string title{};
  std::vector<std::string> notes{};      ///< lines below the title
  std::optional<int> unstable_dead{};    ///< unstable modes under dead load; nothing: not known
  std::optional<int> unstable_driven{};  ///< as the study drives the mechanism
  bool is_critical = false;  ///< a mode has just no stiffness under dead load, and none is unstable
};

struct IllustrationOptions {
  std::optional<View> view{};   ///< natural_view of the first scene if not given
  bool is_perspective = false;  ///< seen from near; what stays in a plane looks the same
  Colouring colouring = Colouring::stability;
  bool has_names = true;
  std::string title{};
  std::string force_unit{}, energy_unit{};       ///< for the legend
  double width = 720, height = 520;              ///< of a single panel [px]
  double small_width = 330, small_height = 270;  ///< of one of several [px]
};

/// Words that find no free place are left out: they stand in the titles of their marks.
/// @pre panels are not empty
Picture illustrate(const std::vector<Panel>& panels, const IllustrationOptions& options);

}  // namespace springfold::drawing
