// Two buckling modes x and y with the same critical load: at lambda = 1 all branches meet in one
// point of corank 2. V = (1 - lambda) (x^2 + y^2) / 2 + (x^4 + 6 x^2 y^2 + y^4) / 4.
#include <cmath>
#include <cstdio>
#include <springfold/continuation/diagram.hpp>

namespace continuation = springfold::continuation;
using springfold::Index, springfold::Matrix, springfold::Vector;

/// F = dV/d(x, y).
struct TwoModes {
  static Index size() { return 2; }
  static bool symmetric() { return true; }  // dF/dx is symmetric: its inertia is counted
  static bool residual(const Vector& u, double lambda, Vector& F) {
    const double x = u[0], y = u[1];
    F = (1 - lambda) * u + Vector{{x * (x * x + 3 * y * y), y * (y * y + 3 * x * x)}};
    return true;
  }
  static bool derivatives(const Vector& u, double lambda, Matrix& dF_dx, Vector& dF_dlambda) {
    const double x = u[0], y = u[1], same = 1 - lambda + 3 * (x * x + y * y);
    dF_dx = Matrix{{same, 6 * x * y}, {6 * x * y, same}};
    dF_dlambda = -u;
    return true;
  }
};

continuation::Event stop_at(double lambda) {
  return {.name = "end of the range",
          .value = [lambda](const continuation::CurvePoint& p) { return p.lambda - lambda; },
          .action = continuation::EventAction::stop};
}

int main() {
  const TwoModes modes;
  const auto diagram = continuation::trace_diagram(modes, {{.x = Vector::Zero(2), .lambda = 0.5}},
                                                   {stop_at(0.1), stop_at(2)}, {});
  for (const auto& junction : diagram.junctions)
    std::printf("lambda = %.9f: corank %d, %zu ways\n", junction.point.lambda,
                junction.multiplicity, junction.ways.size());
  for (const double x : {0.0, 0.5, 1.0})  // branches by the place where they end
    for (const double y : {0.0, 0.5, 1.0})
      for (const auto& branch : diagram.branches) {
        const auto& end = branch.curve.hits.back().point;
        if (std::abs(std::abs(end.x[0]) - x) > 1e-9 || std::abs(std::abs(end.x[1]) - y) > 1e-9)
          continue;
        std::printf("branch to |x| = %.1f, |y| = %.1f, lambda = %.1f: %td negative\n", x, y,
                    end.lambda, end.negative.value_or(-1));
      }
  for (const auto& doubt : diagram.doubts) std::printf("%s\n", doubt.c_str());
}
