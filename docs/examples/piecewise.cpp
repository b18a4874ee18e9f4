// A rigid strut on a torsion spring that just touches an elastic stop on its right: straight, it is
// on the switching surface for every load, and each side buckles at its own.
#include <cmath>
#include <cstdio>
#include <springfold/continuation/diagram.hpp>

namespace continuation = springfold::continuation;
using springfold::Index, springfold::Matrix, springfold::Piece, springfold::Vector;

/// F = theta + [theta]^+ / 2 - lambda sin(theta), lambda = force * length / stiffness.
struct LeaningStrut {
  static double stiffness(const Piece& piece) { return piece[0] > 0 ? 1.5 : 1; }

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  static bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) {
    F = Vector::Constant(1, stiffness(piece) * x[0] - lambda * std::sin(x[0]));
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                          Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, stiffness(piece) - lambda * std::cos(x[0]));
    dF_dlambda = Vector::Constant(1, -std::sin(x[0]));
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
  static const char* switch_name(Index) { return "stop"; }
};

continuation::Event stop_at(double lambda) {
  return {.name = "end of the range",
          .value = [lambda](const continuation::CurvePoint& p) { return p.lambda - lambda; },
          .action = continuation::EventAction::stop};
}

int main() {
  const LeaningStrut strut;
  const auto diagram = continuation::trace_diagram(
      strut, {{.x = Vector::Zero(1), .lambda = 0.5, .piece = {-1}}}, {stop_at(0.1), stop_at(2)}, {});
  for (const auto& junction : diagram.junctions)
    std::printf("lambda = %.9f: %zu ways\n", junction.point.lambda, junction.ways.size());
  for (const auto& branch : diagram.branches) {
    const auto& end = branch.curve.hits.back().point;
    std::printf("branch to theta = %.9f, lambda = %.1f, %s\n", end.x[0], end.lambda,
                end.piece[0] > 0 ? "on the stop" : "free");
  }
  for (const auto& doubt : diagram.doubts) std::printf("%s\n", doubt.c_str());
}
