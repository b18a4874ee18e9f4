// Elastic links: sections of beams, the compliance of a cantilever, and the virtual joints with which
// a link's end gives way.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "springfold/model/mechanism.hpp"

namespace springfold::model {

/// Directions in which the end of a link gives way, in the order of its virtual joints: translations
/// along, then rotations about, the x, y and z axis of the link's frame. The joints follow each other
///
///     T = Tx(q1) Ty(q2) Tz(q3) Rx(q4) Ry(q5) Rz(q6),
///
/// so each rotation is about an axis that the ones before it have turned.
enum class ElasticDirection { Tx, Ty, Tz, Rx, Ry, Rz };
inline constexpr std::array<const char*, 6> elastic_direction_names{"Tx", "Ty", "Tz",
                                                                    "Rx", "Ry", "Rz"};

/// Cross-section of a beam along x. Bending about y moves the beam along z.
struct BeamSection {
  double A = 0;   ///< area [length^2]
  double Iy = 0;  ///< second moment about y: integral of z^2 [length^4]
  double Iz = 0;  ///< second moment about z: integral of y^2 [length^4]
  double J = 0;   ///< torsion constant [length^4]
  double Ay = std::numeric_limits<double>::infinity();  ///< shear area along y; infinity: no shear
  double Az = std::numeric_limits<double>::infinity();  ///< shear area along z
};

/// Circle or, with an inner diameter, tube. J = Iy + Iz.
BeamSection round_section(double diameter, double inner_diameter = 0);

/// Rectangle, `width` along y and `height` along z. J is St. Venant's series: with a >= b,
///     J = a b^3 (1/3 - (64/pi^5) (b/a) sum_{n odd} tanh(n pi a / 2b) / n^5).
/// Source: Timoshenko and Goodier, Theory of Elasticity, 3rd ed., art. 109.
BeamSection rectangular_section(double width, double height);

/// Compliance of the free end of a straight cantilever along x, rows as ElasticDirection:
///
///     | L/EA                                              |   a_y = L^3/3EIz + L/G Ay
///     |      a_y                            +L^2/2EIz     |   a_z = L^3/3EIy + L/G Az
///     |            a_z          -L^2/2EIy                 |
///     |                  L/GJ                             |
///     |            .            L/EIy                     |
///     |      .                               L/EIz        |
///
/// @param E, G  Young's and shear modulus [force/length^2]
Matrix cantilever_compliance(double length, double E, double G, const BeamSection& section);

/// Appends to the chain a rigid link of `length` along x and behind it virtual joints in these
/// directions, named "name.Tx", ..., with one coupled spring.
/// @param stiffness  symmetric, one row per direction
/// @param initial, free  one entry per direction, guess and relaxed value of the coordinates
/// @pre directions increase
void add_elastic_link(Chain& chain, const std::string& name, double length,
                      const std::vector<ElasticDirection>& directions, const Matrix& stiffness,
                      const Vector& initial, const Vector& free);

}  // namespace springfold::model
