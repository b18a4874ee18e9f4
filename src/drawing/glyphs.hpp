// Shapes of the parts in pixels. Private to drawing.
#pragma once

#include <vector>

#include "springfold/drawing/picture.hpp"

namespace springfold::drawing {

Place operator+(Place a, Place b);
Place operator-(Place a, Place b);
Place operator*(double s, Place a);
double length(Place a);
/// Unit vector; to the right where `a` has no length.
Place direction(Place a);
/// Turned by a quarter.
Place across(Place a);

/// A zigzag with straight ends. @pre length(to - from) > 0
std::vector<Place> coil(Place from, Place to, double half_width);

/// A spiral about `centre` from the direction `begin` to `end` and one turn more, counterclockwise as
/// seen on the screen if the angle between them is positive.
std::vector<Place> spiral(Place centre, Place begin, Place end, double inner, double outer);

/// Shaft and head of an arrow.
std::vector<Path> arrow(Place from, Place to, const Ink& ink);

/// An arc of three quarters with a head. @param sign  1: counterclockwise on the screen
std::vector<Path> turning_arrow(Place centre, double radius, double sign, const Ink& ink);

/// Ground behind `at`: a line and hatches on the side of `away`, which is one of the four directions.
std::vector<Path> ground(Place at, Place away, double size, const Ink& ink);

/// Corners of the convex hull, in order around it (Andrew's monotone chain).
std::vector<Place> hull(std::vector<Place> places);

}  // namespace springfold::drawing
