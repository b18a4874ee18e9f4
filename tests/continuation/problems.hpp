// Curves with closed forms: the engine is tested on these, never on a robot.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// One equation in one unknown, F(x, lambda) = 0.
struct ScalarProblem {
  using Function = std::function<double(double x, double lambda)>;
  Function F{}, F_x{}, F_lambda{};
  std::function<bool(double x, double lambda)> inside = [](double, double) { return true; };

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& value) const {
    if (!inside(x[0], lambda)) return false;
    value = Vector::Constant(1, F(x[0], lambda));
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    if (!inside(x[0], lambda)) return false;
    dF_dx = Matrix::Constant(1, 1, F_x(x[0], lambda));
    dF_dlambda = Vector::Constant(1, F_lambda(x[0], lambda));
    return true;
  }
};

/// x^2 + lambda^2 = 1; limit points at lambda = -1 and 1.
inline ScalarProblem circle() {
  return {[](double x, double l) { return x * x + l * l - 1; },
          [](double x, double) { return 2 * x; }, [](double, double l) { return 2 * l; }};
}

/// lambda = h(x): a branch given by its own closed form.
inline ScalarProblem graph(std::function<double(double)> h, std::function<double(double)> slope) {
  return {[h](double x, double l) { return h(x) - l; },
          [slope](double x, double) { return slope(x); }, [](double, double) { return -1.0; }};
}

/// lambda = x^3 - a x: two limit points at x = -+ sqrt(a/3) that merge in a cusp at a = 0.
inline ScalarProblem cusp(double a) {
  return graph([a](double x) { return x * (x * x - a); }, [a](double x) { return 3 * x * x - a; });
}

/// lambda = x + 2 sin 3x: limit points where cos 3x = -1/6.
inline ScalarProblem fold_ladder() {
  return graph([](double x) { return x + 2 * std::sin(3 * x); },
               [](double x) { return 1 + 6 * std::cos(3 * x); });
}

/// x (lambda - x^2) = 0.
inline ScalarProblem pitchfork() {
  return {[](double x, double l) { return x * (l - x * x); },
          [](double x, double l) { return l - 3 * x * x; }, [](double x, double) { return x; }};
}

/// x (lambda - x) = 0.
inline ScalarProblem transcritical() {
  return {[](double x, double l) { return x * (l - x); },
          [](double x, double l) { return l - 2 * x; }, [](double x, double) { return x; }};
}

/// Rigid strut on a torsion spring, stress-free at theta_0: theta - theta_0 = lambda sin theta.
/// Straight (theta_0 = 0) it buckles at lambda = 1 and follows lambda = theta / sin theta.
inline ScalarProblem strut(double theta_0 = 0) {
  return {[theta_0](double t, double l) { return t - theta_0 - l * std::sin(t); },
          [](double t, double l) { return 1 - l * std::cos(t); },
          [](double t, double) { return -std::sin(t); }};
}

/// Two modes that buckle at lambda = first and lambda = second from the straight state x = 0:
/// gradient of sum (c_i - lambda) x_i^2 / 2 + |x|^4 / 4.
struct TwoModes {
  double first = 1, second = 1;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  Matrix linear(double lambda) const {
    return Vector{{first - lambda, second - lambda}}.asDiagonal();
  }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = linear(lambda) * x + x.squaredNorm() * x;
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = linear(lambda) + x.squaredNorm() * Matrix::Identity(2, 2) + 2 * x * x.transpose();
    dF_dlambda = -x;
    return true;
  }
};

/// Spring k (x - d) that acts on one side of d only.
struct OneSided {
  double stiffness = 1, from = 0;
  int side = 1;  ///< +1: for x > from
};

/// lambda = k0 x + sum k_i s_i max(0, s_i (x - d_i)).
struct PiecewiseLine {
  double k0 = 1;
  std::vector<OneSided> springs{};

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool acts(std::size_t i, const Piece& piece) const { return piece[i] == springs[i].side; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    double force = k0 * x[0];
    for (std::size_t i = 0; i < springs.size(); ++i)
      if (acts(i, piece)) force += springs[i].stiffness * (x[0] - springs[i].from);
    F = Vector::Constant(1, force - lambda);
    return true;
  }
  bool derivatives(const Vector&, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    double slope = k0;
    for (std::size_t i = 0; i < springs.size(); ++i)
      if (acts(i, piece)) slope += springs[i].stiffness;
    dF_dx = Matrix::Constant(1, 1, slope);
    dF_dlambda = Vector::Constant(1, -1);
    return true;
  }
  Index switch_count() const { return static_cast<Index>(springs.size()); }
  bool switches(const Vector& x, double, Vector& g) const {
    g.resize(switch_count());
    for (Index j = 0; j < g.size(); ++j) g[j] = x[0] - springs[static_cast<std::size_t>(j)].from;
    return true;
  }
  bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) const {
    dg_dx = Matrix::Ones(switch_count(), 1);
    dg_dlambda = Vector::Zero(switch_count());
    return true;
  }
  static std::string switch_name(Index j) { return "stop " + std::to_string(j + 1); }
  Piece piece_at(double x) const {
    Piece piece;
    for (const OneSided& spring : springs) piece.push_back(x >= spring.from ? 1 : -1);
    return piece;
  }
};

/// Two bars in series, pulled apart by lambda = x_1 + x_2. Both have stiffness 1 up to x = limit_i
/// and `after` beyond: they carry the same force. Below 0 they soften, and only one of them will.
struct BarsInSeries {
  double after = -0.5;
  double limit_1 = 1, limit_2 = 1;

  static Index size() { return 2; }
  double limit(Index i) const { return i == 0 ? limit_1 : limit_2; }
  double slope(Index i, const Piece& piece) const {
    return piece[static_cast<std::size_t>(i)] > 0 ? after : 1;
  }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const auto force = [&](Index i) { return limit(i) + slope(i, piece) * (x[i] - limit(i)); };
    F = Vector{{force(0) - force(1), x[0] + x[1] - lambda}};
    return true;
  }
  bool derivatives(const Vector&, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix{{slope(0, piece), -slope(1, piece)}, {1, 1}};
    dF_dlambda = Vector{{0, -1}};
    return true;
  }
  static Index switch_count() { return 2; }
  bool switches(const Vector& x, double, Vector& g) const {
    g = Vector{{x[0] - limit_1, x[1] - limit_2}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Identity(2, 2);
    dg_dlambda = Vector::Zero(2);
    return true;
  }
};

static_assert(SmoothProblem<ScalarProblem> && SmoothProblem<TwoModes>);
static_assert(PiecewiseSmoothProblem<PiecewiseLine> && PiecewiseSmoothProblem<BarsInSeries>);

}  // namespace springfold::continuation
