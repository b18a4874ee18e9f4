// One random problem with closed-form answers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::known_answers {

/// A potential problem in few unknowns z: F = dV/dz, and its derivatives.
struct Base {
  Index size = 1;
  /// F (k), H = dF/dz (k x k), dF/dlambda (k), on the piece's smooth continuation; false outside
  /// the domain.
  std::function<bool(const Vector& z, double lambda, const Piece& piece, Vector& F, Matrix& H,
                     Vector& F_lambda)>
      at{};
  std::vector<double> thresholds{};  ///< switches g_i = z_1 - threshold_i; none: smooth
};

enum class AnswerKind { fold, branch_point, touch, kink, corner };

/// A special point of the curve.
struct Answer {
  AnswerKind kind = AnswerKind::fold;
  double lambda = 0;
  Vector z{};
  int multiplicity = 1;   ///< branch points: corank; kinks and corners: number of switches
  double separation = 1;  ///< distance in (z, lambda) to the next answer over size; 1: no other one
};

/// The curve ends where `inside` falls to zero.
struct Limit {
  std::string name{};
  std::function<double(const Vector& z, double lambda)> inside{};
};

struct Draw {
  std::string family{};
  Base base{};
  Vector z_start{};
  double lambda_start = 0;
  std::vector<Limit> limits{};
  double size = 1;                ///< extent of the curve in z or lambda, the larger one
  double gap = 1;                 ///< distance of the nearest other branch or arm, over size
  std::vector<Answer> answers{};  ///< on the curve through the start, within the limits
  bool blurred = false;           ///< in double precision not all answers can be told apart
  /// Decides `blurred` for a slope dlambda/dz with this error. Empty: never blurred.
  std::function<bool(double error)> blurs{};
  /// On the smooth branch of the start, also beyond branch points? Empty: there is no other one.
  std::function<bool(const Vector& z, double lambda)> on_curve{};
  /// Strictly monotone along the branch.
  std::function<double(const Vector& z, double lambda)> parameter{};
};

/// Removes answers beyond the limits, fills in separations, and lowers the gap to the smallest
/// separation of answers between which an arm or a branch comes near.
void complete(Draw& draw);

/// The branch stays between these values of lambda, or of one of the unknowns.
void limit_lambda(Draw& draw, double low, double high);
void limit_unknown(Draw& draw, Index i, double low, double high);

double smallest_separation(const Draw& draw);

}  // namespace springfold::known_answers
