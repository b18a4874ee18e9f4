// Columns and frames without their cables, and what a cable adds to first and second order.
#pragma once

#include <string>
#include <vector>

#include "draw.hpp"

namespace springfold::guyed {

/// A point at which a cable may be fastened.
struct Corner {
  std::string body{};
  std::string at{};  ///< in the body's frame, as a case file has it
  Vector place{};    ///< horizontal parts first, the height last
  Matrix moves{};    ///< d(horizontal parts)/dw
  /// Second derivatives of its place by w, in the order of `place`; empty ones are zero.
  std::vector<Matrix> bends{};
};

struct Bare {
  std::string family{}, text{}, loaded{}, direction{};
  int horizontals = 1;       ///< horizontal directions: 1 in the plane, 2 in space
  Matrix springs{}, load{};  ///< as of Structure
  std::vector<Sway> sways{};
  std::vector<Corner> corners{};
};

/// A column of 1 to 4 links, one of 1 to 3 links in space, or a frame of 1 to 3 storeys in the plane.
/// @param hinges_give  with torsional springs in its hinges; otherwise nothing but cables holds it
Bare random_bare(bool hinges_give, Random& random);

/// One or two platforms in space, each on three equal legs that stand above each other. A platform sways in two
/// directions and turns about the vertical; its tilt is of second order, as the legs sink unequally where it turns.
Bare random_space_frame(bool hinges_give, Random& random);

struct Attached {
  Cable cable{};
  const Corner* corner = nullptr;
  Vector reach{};  ///< of the anchor from the corner
};

/// A cable from a corner to an anchor.
/// @param reach    horizontal parts first, the height last
/// @param stretch  of its length
Attached attach(const Bare& bare, std::size_t corner, const Vector& reach, double stiffness,
                double stretch);

/// The same in a case file: as a spring between points, or as a chain with a prismatic joint (in the plane).
std::string cable_spring(const Attached& cable, std::size_t number);
std::string cable_chain(const Attached& cable, std::size_t number);

/// With all digits.
std::string number(double value);

}  // namespace springfold::guyed
