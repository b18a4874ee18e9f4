// A path of targets, and the commands along it as a curve of solutions for the engine. Private to
// analysis; dimensionless.
#pragma once

#include <string>

#include "commanded.hpp"

namespace springfold::analysis {

/// Prescribed coordinates and stacked wrenches at a place of the path: at target k it is k, from 1;
/// in between a fraction.
class TargetPath {
 public:
  TargetPath(const CommandSetup& setup, const ControlPath& path);

  int count() const { return count_; }
  Vector target(double place) const { return target(place, leg_at(place)); }
  Vector load(double place) const { return load(place, leg_at(place)); }
  /// The same on one leg, from target `leg` to the next, and on its continuation; rates by place.
  Vector target(double place, int leg) const;
  Vector target_rate(double place, int leg) const;
  Vector load(double place, int leg) const;
  Vector load_rate(int leg) const;
  double way(double place) const;  ///< length of the path of the point up to here

 private:
  int leg_at(double place) const;
  double angle(double place) const;

  int count_ = 0;
  std::vector<Vector> targets_{};  ///< none on a circle
  std::vector<Vector> loads_{};    ///< one per target
  std::vector<double> ways_{};     ///< per target
  bool circle_ = false;
  Vector centre_{}, axis_1_{}, axis_2_{};  ///< of the circle, scaled by its radius
  double from_ = 0, to_ = 0;
};

/// One leg of the path, from target `leg` to the next, as F(y, lambda) = 0: y = (entries of z that
/// are not prescribed, commands), lambda grows from 0 to `length`.
class ControlProblem {
 public:
  ControlProblem(const CommandSetup& setup, const TargetPath& path, int leg);

  double length() const { return length_; }
  double place(double lambda) const { return leg_ + lambda / length_; }
  Vector reduce(const Vector& z, const Vector& rho) const;
  Vector expand(const Vector& y, double lambda) const;
  statics::Inputs inputs(const Vector& y, double lambda) const;

  Index size() const { return setup_.system.size; }
  bool residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                   Vector& dF_dlambda) const;
  Index switch_count() const { return std::ssize(setup_.system.switches); }
  bool switches(const Vector& y, double lambda, Vector& g) const;
  bool switch_gradients(const Vector& y, double lambda, Matrix& dg_dy, Vector& dg_dlambda) const;
  Vector metric() const;  ///< wrenches do not enter the arc length
  std::string switch_name(Index j) const;

 private:
  const CommandSetup& setup_;
  const TargetPath& path_;
  int leg_ = 1;
  double length_ = 1;
  std::vector<Index> unknowns_{}, held_{};
  mutable statics::Workspace work_{};
  mutable Vector r_{};
  mutable Matrix A_{}, dR_drho_{};
};

}  // namespace springfold::analysis
