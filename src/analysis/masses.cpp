#include <algorithm>
#include <cmath>

#include "equimomental.hpp"
#include "inertia.hpp"
#include "springfold/model/point.hpp"

namespace springfold::analysis {

namespace {

/// Loads along z, in place of weights: point masses that turn as a body does, and its mass once more, with a minus, at
/// its centre, where it is counted already.
void add_turning(double mass, const model::Mat3<double>& inertia, const model::Anchor& centre,
                 model::Mechanism& weighed) {
  if (inertia.isZero(0)) return;
  const auto add = [&](double part, const model::Vec3<double>& at) {
    model::Load load{.on = centre, .vector = part * model::Vec3<double>::UnitZ()};
    load.on.at += at;
    weighed.loads.push_back(std::move(load));
  };
  for (const PointOfMass& point : equimomental_points(mass, inertia)) add(point.mass, point.at);
  if (mass != 0) add(-mass, model::Vec3<double>::Zero());
}

}  // namespace

Masses::Masses(const Frozen& frozen) : frozen_{frozen} {
  // Weights of a unit of gravity are the masses; where they act, the preparation finds.
  model::Mechanism weighed = frozen.problem().layout().mechanism;
  weighed.gravity = model::Vec3<double>::UnitZ();
  weighed.loads.clear();
  for (std::size_t b = 0; b < weighed.bodies.size(); ++b) {
    const model::Body& body = weighed.bodies[b];
    add_turning(body.mass, body.inertia, {.body = static_cast<Index>(b) + 1, .at = body.centre},
                weighed);
  }
  for (std::size_t c = 0; c < weighed.chains.size(); ++c)
    for (std::size_t p = 0; p < weighed.chains[c].points.size(); ++p) {
      const model::ChainPoint& point = weighed.chains[c].points[p];
      // Places on a chain's point are told in its frame, from the point on.
      add_turning(point.mass, point.inertia, {.chain = static_cast<Index>(c), .point = p}, weighed);
    }
  system_ = statics::prepare(weighed);
  for (const statics::PointLoad& load : system_.loads)
    masses_.push_back({load.vector.z(), load.point, load.number < 0});
  for (const Mass& mass : masses_) largest_ = std::max(largest_, std::abs(mass.mass));
  const auto& moving = frozen.landscape().moving();
  const Vector zero = Vector::Zero(frozen.problem().size());
  const Vector origin = frozen.unknowns(zero);
  spread_.resize(origin.size(), static_cast<Index>(moving.size()));
  for (Index k = 0; k < spread_.cols(); ++k) {
    Vector unit = zero;
    unit[moving[static_cast<std::size_t>(k)]] = 1;
    spread_.col(k) = frozen.unknowns(unit) - origin;
  }
}

Vector Masses::variables_of(const statics::PointSlice& slice, const Vector& z) const {
  const Vector rho = frozen_.problem().inputs(0).rho;
  Vector v(slice.point.variable_count());
  for (Index k = 0; k < v.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    v[k] = (slice.z[i] >= 0 ? z[slice.z[i]] : 0.0) + (slice.rho[i] >= 0 ? rho[slice.rho[i]] : 0.0);
  }
  return v;
}

std::vector<std::array<Matrix, 3>> Masses::curvatures_at(const Vector& x) const {
  const Vector z = frozen_.unknowns(x);
  std::vector<std::array<Matrix, 3>> list;
  model::PointMotion<double> motion;
  for (const Mass& mass : masses_) {
    const statics::PointSlice& slice = system_.points[mass.point];
    const Vector v = variables_of(slice, z);
    model::evaluate_point<double>(slice.point, v, motion);
    Matrix spread = Matrix::Zero(v.size(), spread_.cols());
    for (Index k = 0; k < v.size(); ++k)
      if (const Index i = slice.z[static_cast<std::size_t>(k)]; i >= 0)
        spread.row(k) = spread_.row(i);
    std::array<Matrix, 3> second;
    second.fill(Matrix(v.size(), v.size()));
    for (Index j = 0; j < v.size(); ++j)
      for (Index k = 0; k < v.size(); ++k) {
        const model::Vec3<double> bend = model::second_displacement<double>(motion, j, k);
        for (std::size_t r = 0; r < 3; ++r) second[r](j, k) = bend[static_cast<Index>(r)];
      }
    for (Matrix& of_coordinate : second)
      of_coordinate = spread.transpose() * of_coordinate * spread;
    list.push_back(std::move(second));
  }
  return list;
}

std::vector<MassPoint> Masses::at(const Vector& x) const {
  const Vector z = frozen_.unknowns(x);
  std::vector<MassPoint> list;
  model::PointMotion<double> motion;
  for (const Mass& mass : masses_) {
    const statics::PointSlice& slice = system_.points[mass.point];
    const Vector v = variables_of(slice, z);
    model::evaluate_point<double>(slice.point, v, motion);
    Matrix jacobian = Matrix::Zero(3, spread_.cols());
    for (Index k = 0; k < v.size(); ++k)
      if (const Index i = slice.z[static_cast<std::size_t>(k)]; i >= 0)
        jacobian += motion.dp.col(k) * spread_.row(i);
    list.push_back({mass.mass / largest_, std::move(jacobian), mass.has_speed});
  }
  return list;
}

Matrix Masses::along_motions(const Ground& ground) const {
  Matrix M = Matrix::Zero(ground.motions.cols(), ground.motions.cols());
  for (const MassPoint& mass : at(ground.x)) {
    const Matrix J = mass.jacobian * ground.motions;
    M += mass.mass * J.transpose() * J;
  }
  return M;
}

}  // namespace springfold::analysis
