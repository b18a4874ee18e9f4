// The engine alone, on the unit circle: back from outside onto the circle along the diagonal.
#include <cmath>
#include <springfold/continuation/newton.hpp>

using springfold::Matrix, springfold::Vector;

struct Circle {
  static springfold::Index size() { return 1; }
  static bool residual(const Vector& x, double lambda, Vector& F) {
    F = Vector::Constant(1, x[0] * x[0] + lambda * lambda - 1);
    return true;
  }
  static bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, 2 * x[0]);
    dF_dlambda = Vector::Constant(1, 2 * lambda);
    return true;
  }
};

int main() {
  namespace continuation = springfold::continuation;
  const Vector one = Vector::Ones(1);
  const auto result = continuation::correct(Circle{}, one, one, 1, {}, {one, -1}, {});
  const bool right = converged(result) && std::abs(result.lambda - std::sqrt(0.5)) < 1e-9;
  return right ? 0 : 1;
}
