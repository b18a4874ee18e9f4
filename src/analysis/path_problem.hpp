// A study as a curve of solutions of F(y, lambda) = 0: the adapter between statics and engine.
// Private to analysis; everything here is dimensionless.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// What lambda does. The pose t of one body, the commands and the loads are
///
///     t = t_start + lambda t_rate + N y_t,   rho = rho_start + lambda rho_rate,
///     W = W_start + lambda W_rate,
///
/// where y_t are the pose coordinates that stay free (all for load control, none for pose control).
struct PathRule {
  Index body = 1;
  Vector t_start{}, t_rate{};
  Matrix N{};  ///< d x (free pose coordinates), orthonormal columns
  Vector rho_start{}, rho_rate{};
  Vector W_start{}, W_rate{};
  /// Control mode parameter: system and load as functions of lambda; otherwise empty.
  std::function<std::pair<statics::System, Vector>(double)> family{};
  double family_step = 0x1p-8;  ///< difference step in lambda for the derivative by the parameter
  bool symmetric = true;        ///< no external moments on spatial bodies
  double length = 1;            ///< unit of lengths, for the names of switches
};

/// A PiecewiseSmoothProblem for the engine. One object serves one thread: evaluations reuse storage.
class PathProblem {
 public:
  PathProblem(statics::System system, PathRule rule);

  Index size() const { return size_; }
  bool residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                   Vector& dF_dlambda) const;
  Index switch_count() const { return static_cast<Index>(system_.switches.size()); }
  bool switches(const Vector& y, double lambda, Vector& g) const;
  bool switch_gradients(const Vector& y, double lambda, Matrix& dg_dy, Vector& dg_dlambda) const;
  bool symmetric() const { return rule_.symmetric; }
  Vector metric() const;  ///< wrenches do not enter the arc length
  /// 2 pi for joint angles without a spring (a spring counts turns) and for the angle of planar
  /// bodies; 0 for all others.
  Vector periods() const;
  std::vector<bool> angles() const;        ///< per unknown: an angle, of a joint or a planar body
  std::string switch_name(Index j) const;  ///< "spring leg.knee (acts above 0.2618)"

  /// All unknowns of the statics at a point of the path, and back.
  Vector expand(const Vector& y, double lambda) const;
  Vector reduce(const Vector& z) const;
  /// Rate of z along a direction of the path.
  Vector expand_rate(const Vector& dy, double dlambda) const;
  statics::Inputs inputs(double lambda) const;
  const statics::System& system(double lambda) const;
  const PathRule& rule() const { return rule_; }
  Index closures() const { return system_.closure_count(); }

 private:
  Vector reduce_rows(const Vector& r) const;
  std::optional<Vector> breakpoints(double lambda) const;

  statics::System system_;
  PathRule rule_;
  Index t_ = 0, d_ = 0, size_ = 0;
  mutable statics::Workspace work_{};
  mutable Vector r_{};
  mutable Matrix A_{}, dR_drho_{};
  mutable double family_lambda_ = 0;
  mutable std::optional<std::pair<statics::System, Vector>> family_{};
};

}  // namespace springfold::analysis
