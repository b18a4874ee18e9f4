// A rigid strut on a torsion spring, pushed along its axis: the smallest structure that buckles.
// Beyond the angle gamma the spring has only half its stiffness.
#include <cmath>
#include <cstdio>
#include <springfold/continuation/trace.hpp>

namespace continuation = springfold::continuation;
using springfold::Index, springfold::Matrix, springfold::Piece, springfold::Vector;

/// F = theta - [theta - gamma]^+ / 2 - lambda sin(theta), lambda = force * length / stiffness.
struct Strut {
  static constexpr double gamma = 0.5;
  static Index size() { return 1; }
  static bool symmetric() { return true; }  // so branch points are looked for
  static bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) {
    const double torque = piece[0] > 0 ? gamma + 0.5 * (x[0] - gamma) : x[0];
    F = Vector::Constant(1, torque - lambda * std::sin(x[0]));
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                          Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, (piece[0] > 0 ? 0.5 : 1) - lambda * std::cos(x[0]));
    dF_dlambda = Vector::Constant(1, -std::sin(x[0]));
    return true;
  }
  static Index switch_count() { return 1; }
  static bool switches(const Vector& x, double, Vector& g) {
    g = Vector::Constant(1, x[0] - gamma);
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix::Ones(1, 1);
    dg_dlambda = Vector::Zero(1);
    return true;
  }
  static const char* switch_name(Index) { return "spring softens"; }
};

/// Traces from (theta, lambda), with lambda growing first, until lambda is 1.5.
void follow(double theta, double lambda) {
  const Strut strut;
  const Vector x = Vector::Constant(1, theta);
  const continuation::Event enough{
      .name = "lambda = 1.5",
      .value = [](const continuation::CurvePoint& p) { return p.lambda - 1.5; },
      .action = continuation::EventAction::stop};
  for (const auto& ray : continuation::rays_from(strut, x, lambda, {-1}, {}).rays) {
    if (ray.tangent.dlambda < 0) continue;  // the way back
    const auto curve = continuation::trace(strut, x, lambda, ray, {enough}, {});
    std::printf("from theta = %.1f: %s\n", theta, curve.stop_detail.c_str());
    for (const auto& hit : curve.hits)
      std::printf("  %s%s: theta = %.9f, lambda = %.9f\n", hit.name.c_str(),
                  hit.kind == continuation::HitKind::corner ? " (corner)" : "", hit.point.x[0],
                  hit.point.lambda);
  }
}

int main() {
  follow(0, 0);                      // straight: branch point at lambda = 1
  follow(0.2, 0.2 / std::sin(0.2));  // buckled: lambda = theta / sin(theta)
}
