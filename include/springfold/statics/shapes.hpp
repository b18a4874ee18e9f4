// What is known of shapes and of switches in a state: values and derivatives.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// alpha of a shape [its unit] and dU/dalpha: the force with which a path or a distance pulls, the moment that closes
/// an angle; of areas and volumes minus the pressure. `own` is the coordinate of the law: alpha without what springs in
/// series take of it. `off_middle` [rad]: how far an angle with a sign, or that of a fold, is from the middle of the
/// whole turn in which it is counted; it jumps where that is half a turn.
struct ShapeState {
  double value = 0, slope = 0, own = 0, off_middle = 0;
};

/// @param shape  number among System::shapes
/// @param inputs  commands, and the factor of a pressure
ShapeState shape_state(const System& system, std::size_t shape, const Vector& z,
                       const Inputs& inputs);

/// The same with the law in its segment of the piece, continued beyond its ends: smooth where other numbers move a
/// breakpoint or the state across it, as differences do.
ShapeState shape_state(const System& system, const Piece& piece, std::size_t shape, const Vector& z,
                       const Inputs& inputs);

/// Is the spring's energy a smooth function of the points at the edge of its shape which is next to alpha: at the
/// distance 0, or in space at the angles 0 and pi? It is where it has no force there.
bool is_smooth_at_edge(const PointShape& shape, double alpha);

/// Energy of the springs in series before the law of a shape [force * length].
double series_energy(const System& system, std::size_t shape, const Vector& z);

/// Energy of all springs of shapes but those before the last one in series, each in its own segment [force * length].
double shape_energy(const System& system, const Vector& z, const Vector& rho);

/// Energy of all springs, line springs and shapes included, each in its segment of the piece, continued beyond its
/// ends.
double spring_energy(const System& system, const Piece& piece, const Vector& z, const Vector& rho);

/// Potential of all pressures.
double pressure_potential(const System& system, const Vector& z, const Inputs& inputs);

/// Are two switches breakpoints of one spring?
inline bool same_spring(const Switch& a, const Switch& b) {
  return a.spring == b.spring && a.of_shape() == b.of_shape();
}

/// What the sign of a switch is that of: a joint's coordinate, or alpha, minus the breakpoint.
/// @param number  of the switch
double switch_value(const System& system, std::size_t number, const Vector& z, const Vector& rho);

/// The same of all switches from number `first` on. The place of a spring is found once for all its breakpoints.
/// @param values  one for every switch; those before `first` are left as they are
void put_switch_values(const System& system, std::size_t first, const Vector& z, const Vector& rho,
                       Vector& values);

/// Storage of switch_gradient(): by z, by rho.
struct SwitchGradient {
  Vector z{}, rho{};
  Workspace work{};
};
/// The derivatives of switch_value(). @returns false when they are not finite
bool switch_gradient(const System& system, std::size_t number, const Vector& z, const Vector& rho,
                     SwitchGradient& out);

}  // namespace springfold::statics
