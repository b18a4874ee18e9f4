// Spring laws that are not straight: torque as a smooth function of the deformation u = c - free.
#pragma once

#include <complex>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "springfold/model/formula.hpp"

namespace springfold::model {

/// Deformations for which a law is written. Outside it goes on straight, with the slope at that end.
struct DeformationRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// Which part holds, wherever u is: -1 the straight one below, 0 the law itself, 1 the straight one above. None: that
  /// in which u lies.
  std::optional<int> held{};
};

/// torque = sum over i of coefficients[i] u^i.
struct PolynomialSpring {
  std::vector<double> coefficients{};  ///< the constant one first [N*m/rad^i] or [N/m^i]
  double free = 0;                     ///< coordinate with u = 0 [rad] or [length]
  DeformationRange range{};            ///< of u
  bool falling = false;                ///< may the torque fall somewhere within the range?
};

/// torque = formula(u).
struct FormulaSpring {
  Formula formula{};         ///< of u, in units of its own
  double free = 0;           ///< coordinate with u = 0 [rad] or [length]
  DeformationRange range{};  ///< of u, in the formula's unit
  bool falling = false;
  double coordinate_unit = 1;  ///< of c and free, measured in the formula's unit
  double torque_unit = 1;      ///< of the torque, measured in the formula's unit
};

/// torque = stiffness length ln(1 + u/length): with free = length that of a bar whose force grows with
/// its logarithmic strain ln(c/length). Nothing is defined where u <= -length.
struct LogarithmicSpring {
  double stiffness = 0;  ///< at u = 0 [N*m/rad] or [N/m], >= 0
  double length = 1;     ///< [rad] or [length], > 0
  double free = 0;       ///< coordinate with u = 0 [rad] or [length]
};

/// A contact: torque = force (p/depth)^exponent where the penetration p = c - from > 0, otherwise 0;
/// on the side below, torque = -force (p/depth)^exponent with p = from - c.
struct PowerSpring {
  double force = 0;     ///< at p = depth [N*m] or [N], >= 0
  double depth = 1;     ///< [rad] or [length], > 0
  double exponent = 1;  ///< >= 1
  double from = 0;      ///< coordinate of first contact [rad] or [length]
  bool below = false;   ///< does contact begin below `from`?
};

/// Cubics between nodes, straight lines beyond the first and the last one: the compiled form of tables. One piece alone
/// holds on both sides of where it begins.
struct CubicPieces {
  struct Piece {
    double at = 0;                    ///< u where it begins
    double value = 0, slope = 0;      ///< torque and its slope there
    double quadratic = 0, cubic = 0;  ///< factors of (u - at)^2 and (u - at)^3
    double energy = 0;                ///< at `at`, zero at u = 0
  };
  std::vector<Piece> pieces{};  ///< of every node, the last one straight
  double free = 0;              ///< coordinate with u = 0
};

using SpringCurve =
    std::variant<PolynomialSpring, FormulaSpring, LogarithmicSpring, PowerSpring, CubicPieces>;

/// Coordinates at which the curve bends, increasing: its torque and slope go on there, its curvature jumps. Points of
/// tables, ends of ranges.
std::vector<double> bends_of(const SpringCurve& curve);

/// The curve between two of its bends, gone on beyond both of them.
/// @param part  its number: so many bends lie below it
SpringCurve part_of(const SpringCurve& curve, std::size_t part);

/// Torque, stiffness and the stiffness's derivative at the coordinate c. A power goes on beyond its
/// first contact as an odd function. For S = double and std::complex<double>.
template <class S>
Jet<S> torque_of(const SpringCurve& curve, const S& c);

/// Energy at c, zero at u = 0 (at the first contact). Of a formula: by quadrature to rounding; with complex c to the
/// first order in its imaginary part.
template <class S>
S energy_of(const SpringCurve& curve, const S& c);

extern template Jet<double> torque_of(const SpringCurve&, const double&);
extern template Jet<std::complex<double>> torque_of(const SpringCurve&,
                                                    const std::complex<double>&);
extern template double energy_of(const SpringCurve&, const double&);
extern template std::complex<double> energy_of(const SpringCurve&, const std::complex<double>&);

}  // namespace springfold::model
