// From a critical state to where the mechanism comes to rest, at one lambda. Private to analysis.
#pragma once

#include "springfold/analysis/snap.hpp"
#include "state_book.hpp"

namespace springfold::analysis {

/// Amplitude of the push [-].
inline constexpr double push_size = 1e-3;

/// One way to leave a critical state: a small push after which the energy is lower.
struct Departure {
  int side = 0;                  ///< sign along `along`
  Vector along{};                ///< unit direction of the moving unknowns, oriented outward
  Vector x{};                    ///< the state after the push, at rest but for the push
  double amplitude = push_size;  ///< of the push
};

struct Departures {
  std::vector<Departure> list{};
  bool is_flat =
      false;  ///< in some direction the energy does not change beyond rounding and the load's error
};

/// How well the load of a critical state is known, and which forces that makes.
struct LoadError {
  double lambda = 0;  ///< lambda may be off by so much [dimensionless]
  /// dF/dlambda by the moving unknowns at a state, on a piece; empty where it is not defined.
  std::function<Vector(const Vector& x, const Piece& piece)> rate{};
};

/// Leaves a critical state along its modes without stiffness, both ways; at a corner along the unstable
/// modes of the pieces around it. For every amplitude along the mode all other motions are brought to
/// rest; where the energy falls from there, the state is left. The sign is read where the force along
/// the mode first exceeds rounding and what the load's error makes of it, from `push_size` on.
/// @param pieces  those on both sides of the point
Departures departures(const Landscape& landscape, const Vector& critical,
                      const std::vector<Piece>& pieces, const LoadError& load = {});

/// The same departure with a smaller push: a thousandth of the straight way to where it leads, or as little more as the
/// force along the mode is above rounding.
Departure shortened(const Landscape& landscape, const Vector& critical, const Departure& departure,
                    double way);

/// Where a departure leads, and whether anything but the energy decides that.
struct Fall {
  SnapVerdict verdict = SnapVerdict::no_stable_state;
  std::optional<std::size_t> landing{};  ///< number in the book: at the end of the way down
  std::vector<std::size_t> minima{};     ///< all in the connected part of {Pi < Pi(critical)}
  std::vector<std::size_t> saddles{};    ///< in it
  bool may_run_away = false;
  bool is_lost =
      false;  ///< a way down ended at no state that is known to be stable: the verdict is open
};

/// Height of the lowest saddle from which a way down leads to a minimum; infinite where there is none.
double lowest_barrier(std::size_t minimum, const Fall& fall, StateBook& book);

/// The minimum that a motion in the part that was entered cannot leave any more: the way down from where it is ends
/// there, and what it has of energy in all is below every saddle beside. Where one minimum is all that the part holds,
/// any energy is.
std::optional<RestState> caught_by(StateBook& book, const Fall& fall, const Vector& x,
                                   double energy);

/// Do two departures begin in one part of {Pi < Pi(critical)} beside the critical state? So it is where the energy is
/// lower in all directions between theirs.
bool are_one_way(const Landscape& landscape, const Vector& critical, const Departure& a,
                 const Departure& b);

/// The same verdict, landing, minima and ways without end.
bool lead_to_the_same(const Fall& a, const Fall& b);

/// @param book  after its search
/// @param energy  Pi of the critical state
Fall fall(StateBook& book, const Departure& departure, double energy);

}  // namespace springfold::analysis
