// The energy at one fixed lambda, on the set on which the closures hold. Private to analysis; it knows
// no mechanisms: any symmetric problem whose F is the gradient of a Lagrangian has one.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "springfold/continuation/problem.hpp"
#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// What a landscape is made of. F(x, lambda) is the gradient of Pi(x) + mu . e(x) by all unknowns
/// x = (moving, multipliers mu); e = 0 are the closures.
struct Terrain {
  continuation::ProblemView problem;
  double lambda = 0;
  std::vector<bool> is_multiplier{};                         ///< per unknown
  std::function<double(const Vector& x)> energy{};           ///< Pi; NaN outside of the domain
  std::function<bool(const Vector&, const Vector&)> same{};  ///< the same state? Empty: by entries,
                                                             ///< modulo periods
  Matrix damping{};  ///< of the moving unknowns, positive on all motions; empty: one each
  /// So many closures depend on the others wherever all hold. Beside there, as rounding has it, they hardly do not.
  Index redundant = 0;
};

/// A state of the landscape with everything of first and second order.
struct Ground {
  Piece piece{};
  Vector gradient{};  ///< of Pi, by the moving unknowns
  Matrix closing{};   ///< of the closures, rows: derivatives by the moving unknowns
  Matrix motions{};   ///< orthonormal basis of all motions that keep the closures
  Vector slope{};     ///< gradient along the motions
  Matrix hessian{};   ///< of the Lagrangian, along the motions: k x k
  Vector x{};         ///< the state, with the multipliers that suit best
};

class Landscape {
 public:
  explicit Landscape(Terrain terrain);

  const Terrain& terrain() const { return terrain_; }
  const std::vector<Index>& moving() const { return moving_; }
  const std::vector<Index>& multipliers() const { return multipliers_; }
  const Vector& periods() const { return periods_; }

  /// Signs of the switches; zero counts as above.
  std::optional<Piece> piece_at(const Vector& x) const;
  /// All pieces that meet in a state, that of `piece_at` first: of up to 2^6 where springs rest at their thresholds.
  /// Empty outside of the domain.
  std::vector<Piece> pieces_beside(const Vector& x) const;
  double energy(const Vector& x) const { return terrain_.energy(x); }
  /// Nearest state that obeys the closures to rounding, by Newton's method of least norm.
  /// @returns false where there is none near
  bool close(Vector& x) const;
  /// @returns nothing outside of the domain
  std::optional<Ground> ground(const Vector& x) const;
  /// The same on a piece that is named, whatever the signs of the switches are.
  std::optional<Ground> ground_on(const Vector& x, const Piece& piece) const;
  /// The same on that piece of those beside the state that has the softest mode.
  std::optional<Ground> softest_ground(const Vector& x) const;
  bool same(const Vector& a, const Vector& b) const;
  /// x moved by `step` along the motions of `at`, closed again.
  std::optional<Vector> moved(const Ground& at, const Vector& step) const;
  /// Damping along the motions of `at`, k x k.
  Matrix damping(const Ground& at) const;

 private:
  bool close_gaps(Vector& x) const;

  Terrain terrain_;
  std::vector<Index> moving_{}, multipliers_{};
  Vector periods_{};
};

}  // namespace springfold::analysis
