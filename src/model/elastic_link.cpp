#include "springfold/model/elastic_link.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace springfold::model {

using std::numbers::pi;

BeamSection round_section(double diameter, double inner_diameter) {
  const double D2 = diameter * diameter, d2 = inner_diameter * inner_diameter;
  const double I = pi / 64 * (D2 - d2) * (D2 + d2);
  return {.A = pi / 4 * (D2 - d2), .Iy = I, .Iz = I, .J = 2 * I};
}

BeamSection rectangular_section(double width, double height) {
  const double a = std::max(width, height), b = std::min(width, height);
  double sum = 0;
  for (int n = 199; n > 0; n -= 2) sum += std::tanh(n * pi * a / (2 * b)) / std::pow(n, 5);
  sum += 1 / (8 * std::pow(200.0, 4));  // n > 199: tanh is 1, half the integral of n^-5 from 200
  const double J = a * b * b * b * (1.0 / 3 - 64 / std::pow(pi, 5) * (b / a) * sum);
  return {.A = width * height,
          .Iy = width * height * height * height / 12,
          .Iz = height * width * width * width / 12,
          .J = J};
}

Matrix cantilever_compliance(double L, double E, double G, const BeamSection& s) {
  Matrix C = Matrix::Zero(6, 6);
  const double by = 1 / (E * s.Iy), bz = 1 / (E * s.Iz);
  const auto shear = [&](double area) { return std::isinf(area) ? 0.0 : L / (G * area); };
  C(0, 0) = L / (E * s.A);
  C(1, 1) = L * L * L / 3 * bz + shear(s.Ay);
  C(2, 2) = L * L * L / 3 * by + shear(s.Az);
  C(3, 3) = L / (G * s.J);
  C(4, 4) = L * by;
  C(5, 5) = L * bz;
  C(1, 5) = C(5, 1) = L * L / 2 * bz;
  C(2, 4) = C(4, 2) = -L * L / 2 * by;
  return C;
}

void add_elastic_link(Chain& chain, const std::string& name, double length,
                      const std::vector<ElasticDirection>& directions, const Matrix& stiffness,
                      const Vector& initial, const Vector& free) {
  assert(stiffness.rows() == static_cast<Index>(directions.size()));
  assert(initial.size() == stiffness.rows() && free.size() == stiffness.rows());
  if (length != 0) chain.elements.push_back(RigidLink{{.p = {length, 0, 0}}});
  CoupledSpring spring{.name = name, .stiffness = stiffness, .free = free};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto d = static_cast<Index>(directions[i]);
    spring.elements.push_back(chain.elements.size());
    chain.elements.push_back(
        Joint{.name = name + "." + elastic_direction_names[static_cast<std::size_t>(d)],
              .kind = d < 3 ? JointKind::prismatic : JointKind::revolute,
              .axis = Vec3<double>::Unit(d % 3),
              .role = JointRole::compliant,
              .initial = initial[static_cast<Index>(i)]});
  }
  chain.coupled_springs.push_back(std::move(spring));
}

}  // namespace springfold::model
