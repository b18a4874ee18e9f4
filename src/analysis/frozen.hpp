// A traced study at one fixed lambda, as a landscape. Private to analysis.
#pragma once

#include "grow_diagram.hpp"
#include "landscape.hpp"
#include "springfold/analysis/snap_settings.hpp"

namespace springfold::analysis {

/// The same bodies, spring deflections and forces: other coordinates of joints without springs,
/// like those of a universal joint turned over, make no other equilibrium.
/// @param a, b  unknowns of the statics, wrenches included
bool same_equilibrium(const statics::System& system, const Vector& a, const Vector& b);

/// Holds the problem that its landscape looks at. Unknowns are those of the statics without the pose
/// coordinates that the study prescribes; rotations stand as rotation vectors.
class Frozen {
 public:
  /// @param lambda  dimensionless
  Frozen(const PathProblem& traced, const Scales& scales, double lambda,
         const std::vector<JointDamping>& damping);
  Frozen(const Frozen&) = delete;
  Frozen& operator=(const Frozen&) = delete;

  const PathProblem& problem() const { return problem_; }
  const Landscape& landscape() const { return landscape_; }
  double lambda() const { return lambda_; }
  /// All unknowns of the statics <-> those of the landscape.
  Vector unknowns(const Vector& x) const { return problem_.expand(x, 0); }
  Vector reduced(const Vector& z) const { return problem_.reduce(z); }

 private:
  Terrain terrain(const Scales& scales, const std::vector<JointDamping>& damping) const;

  double lambda_;
  PathProblem problem_;
  Landscape landscape_;
};

/// "+apex.y": the pose coordinate that moves most, or the joint where no pose moves.
/// @param along  of the moving unknowns
std::string moves_most(const Frozen& frozen, const Vector& along);

/// All unknowns of the statics in a row of the branch table, dimensionless.
Vector unknowns_in(const std::vector<double>& values,
                   const std::vector<QuantityDefinition>& quantities, Index size);

/// Number of the column that is of this kind.
std::size_t column_of(QuantityDefinition::Kind kind,
                      const std::vector<QuantityDefinition>& quantities);

}  // namespace springfold::analysis
