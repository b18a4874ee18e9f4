// A study as a curve of solutions of F(y, lambda) = 0: the adapter between statics and engine.
// Private to analysis; everything here is dimensionless.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "springfold/continuation/problem.hpp"
#include "springfold/statics/second_derivatives.hpp"
#include "springfold/statics/shapes.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// What lambda does. The pose t of one body, the commands and the loads are
///
///     t = t_start + lambda t_rate + N y_t,   rho = rho_start + lambda rho_rate,
///     W = W_start + lambda W_rate,   factors of loads = load_start + lambda load_rate,
///
/// where y_t are the pose coordinates that stay free (all for load control, none for pose control).
struct PathRule {
  Index body = 1;
  Vector t_start{}, t_rate{};
  Vector t_counted{};  ///< deflections are counted from this pose; empty: from t_start
  Matrix N{};          ///< d x (free pose coordinates), orthonormal columns
  Vector rho_start{}, rho_rate{};
  Vector W_start{}, W_rate{};
  Vector load_start{}, load_rate{};  ///< factors of the mechanism's loads
  /// Control mode parameter: system and load as functions of lambda; otherwise empty.
  std::function<std::pair<statics::System, Vector>(double)> family{};
  double family_step = 0x1p-8;  ///< difference step in lambda for the derivative by the parameter
  bool quaternions = true;  ///< for free rotations of spatial bodies, instead of rotation vectors
  bool symmetric = true;    ///< all loads have a potential
  continuation::LambdaMeasure lambda_measure{};
  double length = 1;  ///< unit of lengths, for the names of switches
};

/// The pose from which deflections are counted.
inline const Vector& start_pose_of(const PathRule& rule) {
  return rule.t_counted.size() > 0 ? rule.t_counted : rule.t_start;
}

/// Rotation of a body, followed along a path.
struct Turn {
  model::Vec3<double> phi = model::Vec3<double>::Zero();  ///< rotation vector of any length
  /// Where phi is expected, from the motion so far: near whole turns its axis is not well defined.
  model::Vec3<double> expected = model::Vec3<double>::Zero();
  Eigen::Vector4d q = Eigen::Vector4d::UnitX();
};
using Turns = std::vector<Turn>;

/// A PiecewiseSmoothProblem for the engine. One object serves one thread: evaluations reuse storage.
///
/// The unknowns y are those of z, but
///   - of the study's body the free pose coordinates only, N y_t;
///   - rotations of spatial bodies that are wholly free stand in y as quaternions q of four entries
///     instead of a rotation vector. What is evaluated is the system with its frames turned to the
///     present rotation, z with rotation vectors zero; one more equation, the gradient of
///     (|q|^2 - 1)^2 / 4, holds the length of q. So no rotation of a body is singular, the matrix
///     stays symmetric, and no negative eigenvalue is added.
class PathProblem {
 public:
  PathProblem(statics::System system, const PathRule& rule);
  /// The same with a system that others use too.
  PathProblem(std::shared_ptr<const statics::System> system, const PathRule& rule);
  /// The problem anew, in its memory, after its system has been given other numbers.
  void renew(const PathRule& rule);
  /// Deflections are counted from another pose.
  void count_from(const Vector& pose) { rule_.t_counted = pose; }

  Index size() const { return size_; }
  bool residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const;
  bool derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                   Vector& dF_dlambda) const;
  bool equations(const Vector& y, double lambda, const Piece& piece, Vector& F, Matrix& dF_dy,
                 Vector& dF_dlambda) const;
  /// Exact second derivatives, as ProblemView has them; false where the statics doesn't know them, or rotations are
  /// free.
  bool second_along(const Vector& y, double lambda, const Piece& piece, const Vector& w,
                    const Vector& V, Vector& value) const;
  /// Chains so long that their matrices are better not formed, or many members?
  bool structured() const { return stages_.has_value(); }
  bool structured_derivatives(const Vector& y, double lambda, const Piece& piece,
                              StructuredMatrix& dF_dy, Vector& dF_dlambda) const;
  Index switch_count() const { return static_cast<Index>(system_.switches.size()); }
  bool switches(const Vector& y, double lambda, Vector& g) const;
  bool switch_gradients(const Vector& y, double lambda, Matrix& dg_dy, Vector& dg_dlambda) const;
  bool symmetric() const { return rule_.symmetric; }
  Vector metric() const;  ///< wrenches do not enter the arc length
  /// 2 pi for joint angles without a spring (a spring counts turns) and for the angle of planar
  /// bodies; 0 for all others.
  Vector periods() const;
  std::vector<bool> angles() const;  ///< per unknown: an angle, of a joint or a planar body
  continuation::LambdaMeasure lambda_measure() const { return rule_.lambda_measure; }
  std::string switch_name(Index j) const;  ///< "spring leg.knee (acts above 0.2618)"

  std::vector<Index> double_covers() const;  ///< quaternions: first entries in y

  /// Free rotations: those that go on from `before`, a point nearby, with whole turns counted;
  /// without it those of the quaternions, shorter than a whole turn.
  Turns turns(const Vector& y, const Turns* before = nullptr) const;
  /// All unknowns of the statics at a point of the path, and back. @param turns  of this point
  Vector expand(const Vector& y, double lambda, const Turns* turns = nullptr) const;
  Vector reduce(const Vector& z) const;
  /// expand() and inputs() into memory that is there.
  void put_expanded(const Vector& y, double lambda, const Turns* turns, Vector& z) const;
  void put_inputs(double lambda, statics::Inputs& in) const;
  /// The same point as it is evaluated: by `turned(y, lambda)`, with free rotations at zero.
  Vector local(const Vector& y, double lambda) const;
  const statics::System& turned(const Vector& y, double lambda) const;
  /// The same with the frames of all spatial bodies turned, also of those whose rotation is
  /// prescribed: derivatives by rotation vectors are then derivatives by twists in world axes.
  const statics::System& turned_to_pose(const Vector& y, double lambda, Vector& z) const;
  /// Rate of `local` along a direction of the path: free rotations turn about world axes.
  Vector local_rate(const Vector& y, const Vector& dy, double dlambda) const;
  /// Rate of `expand` with these turns.
  Vector expand_rate(const Vector& y, const Vector& dy, double dlambda, const Turns* turns) const;
  /// A body whose rotation vector stands at z[first] ... z[first + 2] and in y as a quaternion.
  struct FreeRotation {
    Index z = 0;  ///< of the rotation vector
    Index v = 0;  ///< where it would stand among the unknowns if it were one
    Index y = 0;  ///< of the quaternion
    std::size_t body = 0;
  };
  const std::vector<FreeRotation>& free_rotations() const { return rotations_; }
  statics::Inputs inputs(double lambda) const;
  const statics::System& system(double lambda) const;
  const statics::System& layout() const { return system_; }  ///< who stands where, at the start
  const PathRule& rule() const { return rule_; }
  Index closures() const { return system_.closure_count(); }
  /// The matrix of the statics as equations() had it there, if that is one of the last places where it was asked and
  /// some coordinates of the pose are given; nullptr otherwise. Valid until the next call.
  const Matrix* known_matrix(const Vector& y, double lambda, const Piece& piece) const;
  /// Are the unknowns of the path those of the statics, and its equations?
  bool is_whole() const { return is_whole_ && rotations_.empty(); }

 private:
  void find_free_rotations();
  void find_stages();
  void put_basis(const Vector& y) const;
  void put_local(const Vector& y, double lambda, Vector& z) const;
  void add_motion(const Vector& v, Vector& z) const;
  bool put_rate(const Vector& y, double lambda, const Piece& piece, const statics::System& present,
                const Matrix* A, Vector& rate) const;
  void put_quaternions(const Vector& y, const Matrix& plain, Matrix& result) const;
  void put_quaternions(const Vector& y, const Vector& plain, Vector& result) const;
  void reduce_rows(const Vector& r, Vector& reduced) const;
  void reduce_residual(const Vector& y, Vector& F) const;
  void reduce_matrix(const Matrix& A, Matrix& reduced) const;
  void spread(const Vector& v, Vector& y) const;
  void gather(const Vector& y, Vector& v) const;
  bool has_rotations(const Vector& y) const;
  const std::vector<model::Mat3<double>>& frames(const Vector& y) const;
  std::optional<Vector> breakpoints(double lambda) const;
  std::optional<Vector> switches_at(const Vector& y, double lambda) const;
  bool put_shape_switches(const Vector& y, double lambda, Index first, Vector& g) const;
  bool put_shape_gradients(const Vector& y, double lambda, Index first, Matrix& dg_dy,
                           Vector& dg_dlambda) const;
  std::string shape_switch_name(const statics::Switch& s, Index j) const;

  std::shared_ptr<const statics::System> kept_;
  const statics::System& system_;  ///< *kept_
  PathRule rule_;
  Index t_ = 0, d_ = 0, size_ = 0;  ///< size_: of y
  Index plain_size_ = 0;            ///< of v, the unknowns with rotation vectors
  bool is_whole_ = false;           ///< N = 1: all pose coordinates are free
  bool knows_second_ = false;       ///< the statics has second derivatives of the equations
  bool moves_pose_ = false, moves_commands_ = false, moves_wrench_ = false, moves_loads_ = false;
  std::vector<FreeRotation> rotations_{};
  std::vector<Index> place_{};  ///< of the entries of v in y; -1 for free rotations
  mutable statics::System turned_{};
  mutable statics::Workspace work_{}, load_work_{};
  mutable statics::Inputs inputs_{};
  mutable statics::StateDirection along_{}, second_{};
  mutable Vector z_{}, v_{}, r_{}, rate_{}, F_{}, dz_{};
  Vector none_{};  ///< where commands do not move
  struct KnownMatrix {
    Vector y{};
    double lambda = std::numeric_limits<double>::quiet_NaN();
    Piece piece{};
    Matrix A{};
  };
  mutable std::array<KnownMatrix, 4> known_{};  ///< of a step's end and middle, and on the way
  mutable std::size_t newest_ = 0;              ///< of these
  mutable Matrix dR_drho_{}, plain_{}, columns_{};
  mutable std::vector<model::Mat3<double>> frames_{};
  mutable statics::SwitchGradient switch_gradient_{};
  mutable std::optional<statics::StageJacobians> stages_{};  ///< of long chains
  mutable Matrix basis_{}, added_{};
  mutable double family_lambda_ = 0;
  mutable std::optional<std::pair<statics::System, Vector>> family_{};
};

}  // namespace springfold::analysis
