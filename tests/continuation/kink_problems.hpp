// Piecewise-smooth problems with closed forms, for the special cases of kinks.
#pragma once

#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// Piece by sides: true is the side g_j > 0.
inline Piece above(std::initializer_list<bool> sides) {
  Piece piece;
  for (const bool side : sides) piece.push_back(side ? 1 : -1);
  return piece;
}

/// lambda = left(x) for x < 0 and right(x) for x > 0, with left(0) = right(0) = 0.
struct TwoGraphs {
  using Function = std::function<double(double)>;
  Function left{}, left_slope{}, right{}, right_slope{};

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    F = Vector::Constant(1, (piece[0] > 0 ? right(x[0]) : left(x[0])) - lambda);
    return true;
  }
  bool derivatives(const Vector& x, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix::Constant(1, 1, piece[0] > 0 ? right_slope(x[0]) : left_slope(x[0]));
    dF_dlambda = Vector::Constant(1, -1);
    return true;
  }
  static Index switch_count() { return 1; }
  static bool switches(const Vector& x, double, Vector& g) {
    g = x;
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Ones(1, 1);
    dg_dlambda = Vector::Zero(1);
    return true;
  }
};

/// a x + b x^2 + c x^3, as value and slope.
struct Cubic {
  double a = 0, b = 0, c = 0;
  double operator()(double x) const { return x * (a + x * (b + x * c)); }
  TwoGraphs::Function slope() const {
    return [*this](double x) { return a + x * (2 * b + 3 * c * x); };
  }
};

inline TwoGraphs two_graphs(const Cubic& left, const Cubic& right) {
  return {left, left.slope(), right, right.slope()};
}

/// A one-sided spring that acts for x_1 > 0 on the path x_1 = height + slope s + bend s^2 + twist s^3,
/// x_2 = lambda = s (below the surface; above it x_1 is two thirds of that).
struct OverSurface {
  double height = 0, slope = 0, bend = -1, twist = 0;

  double path(double s) const { return height + s * (slope + s * (bend + s * twist)); }
  static Index size() { return 2; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    F = Vector{{(piece[0] > 0 ? 1.5 : 1) * x[0] - path(lambda), x[1] - lambda}};
    return true;
  }
  bool derivatives(const Vector&, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix{{piece[0] > 0 ? 1.5 : 1, 0}, {0, 1}};
    dF_dlambda = Vector{{-(slope + lambda * (2 * bend + 3 * lambda * twist)), -1}};
    return true;
  }
  static Index switch_count() { return 1; }
  static bool switches(const Vector& x, double, Vector& g) {
    g = x.head(1);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{1, 0}};
    dg_dlambda = Vector::Zero(1);
    return true;
  }
};

/// Spring with a dead band |x_1| < gap and stiffness `below` and `above` outside it, x_2 tied to
/// x_1^2 by a second spring; or, with `cross` set, x_2 buckling where x_1 = cross:
///     V = phi(x_1) - lambda x_1 + (x_2 - x_1^2)^2 / 2,
///     V = phi(x_1) - lambda x_1 + (cross - x_1) x_2^2 / 2 + x_2^4 / 4.
struct Backlash {
  double gap = 0.3, below = 1, above = 1;
  bool buckles = false;
  double cross = 0;

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  double stiffness(const Piece& piece) const {
    return piece[1] < 0 ? below : piece[0] > 0 ? above : 0;
  }
  double force(double x, const Piece& piece) const {
    return stiffness(piece) * (piece[1] < 0 ? x + gap : x - gap);
  }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const double f = force(x[0], piece) - lambda, w = x[1] - x[0] * x[0];
    F = buckles ? Vector{{f - x[1] * x[1] / 2, (cross - x[0]) * x[1] + std::pow(x[1], 3)}}
                : Vector{{f - 2 * x[0] * w, w}};
    return true;
  }
  bool derivatives(const Vector& x, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    const double k = stiffness(piece), w = x[1] - x[0] * x[0];
    dF_dx = buckles ? Matrix{{k, -x[1]}, {-x[1], cross - x[0] + 3 * x[1] * x[1]}}
                    : Matrix{{k - 2 * w + 4 * x[0] * x[0], -2 * x[0]}, {-2 * x[0], 1}};
    dF_dlambda = Vector{{-1, 0}};
    return true;
  }
  static Index switch_count() { return 2; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = Vector{{x[0] - gap, x[0] + gap}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{1, 0}, {1, 0}};
    dg_dlambda = Vector::Zero(2);
    return true;
  }
  static std::string switch_name(Index j) { return j == 0 ? "upper end" : "lower end"; }
};

/// n bars in series pulled apart by lambda = sum x_i. All have stiffness 1 below x = 1; the first k
/// have stiffness `after` above.
struct BarChain {
  Index n = 12, k = 12;
  double after = -0.5;

  Index size() const { return n; }
  double slope(Index i, const Piece& piece) const {
    return i < k && piece[static_cast<std::size_t>(i)] > 0 ? after : 1;
  }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const auto force = [&](Index i) { return 1 + slope(i, piece) * (x[i] - 1); };
    F.resize(n);
    for (Index i = 0; i + 1 < n; ++i) F[i] = force(i) - force(i + 1);
    F[n - 1] = x.sum() - lambda;
    return true;
  }
  bool derivatives(const Vector&, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix::Zero(n, n);
    for (Index i = 0; i + 1 < n; ++i) {
      dF_dx(i, i) = slope(i, piece);
      dF_dx(i, i + 1) = -slope(i + 1, piece);
    }
    dF_dx.row(n - 1).setOnes();
    dF_dlambda = -Vector::Unit(n, n - 1);
    return true;
  }
  Index switch_count() const { return k; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = x.head(k).array() - 1;
    return true;
  }
  bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) const {
    dg_dx = Matrix::Identity(k, n);
    dg_dlambda = Vector::Zero(k);
    return true;
  }
};

/// Two buckling modes with one-sided springs that act for x_i > 0, coupled by b: on the straight
/// state x = 0 both springs rest at their thresholds.
///     F_i = (a_i - lambda) x_i + c_i max(0, x_i) + b x_j + x_i^3
struct OneSidedModes {
  Index n = 1;
  Vector a = Vector::Constant(1, 1.0), c = Vector::Constant(1, 0.5);
  double b = 0;

  Index size() const { return n; }
  static bool symmetric() { return true; }
  double stiffness(Index i, double lambda, const Piece& piece) const {
    return a[i] - lambda + (piece[static_cast<std::size_t>(i)] > 0 ? c[i] : 0);
  }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    F.resize(n);
    for (Index i = 0; i < n; ++i)
      F[i] = stiffness(i, lambda, piece) * x[i] + b * (x.sum() - x[i]) + std::pow(x[i], 3);
    return true;
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix::Constant(n, n, b);
    for (Index i = 0; i < n; ++i) dF_dx(i, i) = stiffness(i, lambda, piece) + 3 * x[i] * x[i];
    dF_dlambda = -x;
    return true;
  }
  Index switch_count() const { return n; }
  static bool switches(const Vector& x, double, Vector& g) {
    g = x;
    return true;
  }
  bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) const {
    dg_dx = Matrix::Identity(n, n);
    dg_dlambda = Vector::Zero(n);
    return true;
  }
};

/// A column on a torsion spring of stiffness 1 with play: F = [x - gap]+ - [-x - gap]+ - lambda sin x. Without a load
/// all x within the play are equilibria, x = 0 is one under every load.
struct LooseColumn {
  double gap = 0;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  static double stiffness(const Piece& piece) { return piece[0] > 0 || piece[1] < 0 ? 1 : 0; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const double free = piece[0] > 0 ? gap : -gap;
    F = Vector::Constant(1, stiffness(piece) * (x[0] - free) - lambda * std::sin(x[0]));
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                          Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, stiffness(piece) - lambda * std::cos(x[0]));
    dF_dlambda = Vector::Constant(1, -std::sin(x[0]));
    return true;
  }
  static Index switch_count() { return 2; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = Vector{{x[0] - gap, x[0] + gap}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Ones(2, 1);
    dg_dlambda = Vector::Zero(2);
    return true;
  }
  static const char* switch_name(Index j) { return j == 0 ? "right" : "left"; }
};

static_assert(PiecewiseSmoothProblem<TwoGraphs> && PiecewiseSmoothProblem<OverSurface> &&
              PiecewiseSmoothProblem<Backlash> && PiecewiseSmoothProblem<BarChain> &&
              PiecewiseSmoothProblem<OneSidedModes> && PiecewiseSmoothProblem<LooseColumn>);

}  // namespace springfold::continuation
