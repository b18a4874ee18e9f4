// One scene in one panel. Private to drawing.
#pragma once

#include <string>
#include <vector>

#include "springfold/drawing/illustration.hpp"

namespace springfold::drawing {

inline constexpr const char* ink_colour = "#333333";
inline constexpr const char* passive_colour = "#8a8a8a";
inline constexpr const char* spring_colour = "#007a5e";
inline constexpr const char* load_colour = "#a3286a";
inline constexpr const char* stable_colour = "#0072b2";
inline constexpr const char* driven_colour = "#e69f00";  // held by the drive alone
inline constexpr const char* unstable_colour = "#d55e00";
inline constexpr const char* critical_colour = "#7d4bb3";
inline constexpr const char* mixed_colour =
    "#f5cba7";  // beneath a line, a less stable one lies on it
inline constexpr double mixed_width = 7;
inline constexpr const char* gap_colour = "#c00000";

/// Light to dark for t from 0 to 1, told apart in grey too.
std::string ramp_colour(double t);

/// Of the links, by stability.
std::string stability_colour(const Panel& panel);

/// Springs between two points have the colour of stability where there is no link that could: bars between nodes.
bool has_colour_of_stability(const Scene& scene, const SpringPart& spring, Colouring colouring);

/// Is it drawn in the colour of its force or energy?
bool has_colour_of_value(const SpringPart& spring, Colouring colouring);

/// What all panels share.
struct Sheet {
  View view{};
  model::Vec3<double> middle = model::Vec3<double>::Zero();  ///< comes to the middle of the panel
  Place shift{};     ///< of the panel's middle from where `middle` is seen [length]
  double eye = 0;    ///< distance of the eye from `middle` [length]; 0: far away
  double scale = 1;  ///< pixels per length
  Colouring colouring = Colouring::none;
  bool has_names = true;
  double largest_load = 0, largest_moment = 0;
  double largest_value = 0;  ///< of forces or energies that colours stand for
  double arrow = 60;         ///< length of the largest arrow [px]
  double joint = 5;          ///< radius of joints [px]
};

/// Points that are places of the mechanism, not directions.
std::vector<PointId> places_of(const Scene& scene);

/// @param room  of the panel, words stay in it
void paint(const Panel& panel, const Sheet& sheet, const Box& room, Picture& picture);

}  // namespace springfold::drawing
