#include "point_terms.hpp"

#include <cassert>

#include "shape_terms.hpp"
#include "turn_moment.hpp"

namespace springfold::statics {
namespace {

using model::LoadKind;
using model::PointMotion;
using model::Vec3;

/// The load in world axes.
Vec3<double> vector_of(const PointLoad& load, const PointMotion<double>& at,
                       const Vector& factors) {
  const double factor = load.number < 0 || factors.size() == 0 ? 1 : factors[load.number];
  const Vec3<double> vector = factor * load.vector;
  return load.follows ? Vec3<double>(at.pose.R * vector) : vector;
}

/// d(generalised force j)/d(variable k).
double force_rate(const PointLoad& load, const PointMotion<double>& at, const Vec3<double>& vector,
                  Index j, Index k) {
  const bool force = load.kind == LoadKind::force;
  double rate = vector.dot(force ? second_displacement(at, j, k) : spin_rate(at, j, k));
  if (load.follows)
    rate += model::cross<double>(at.spin.col(k), vector).dot((force ? at.dp : at.spin).col(j));
  return rate;
}

/// A moment with a potential, at a body that turns about one direction only or on a chain from it: the potential of
/// turn_moment.hpp, with the angles of the chain's joints added to that of the body.
void add_moment_about_one_axis(const System& system, const PointLoad& load, const PointSlice& slice,
                               const PointMotion<double>& at, const Vec3<double>& vector,
                               Vector& residual, Matrix* A) {
  const BodyTurn& turn = *system.body_slices[static_cast<std::size_t>(slice.body - 1)].turn;
  const TurnMoment m = turn_moment(turn, at.body.pose.R * turn.reference, vector, load.follows);
  const Index first = at.rotation, joints = slice.point.first_joint();
  for (Index j = first; j < joints; ++j) {
    const Index row = slice.z[static_cast<std::size_t>(j)];
    residual[row] -= at.spin.col(j).dot(m.vector);
    for (Index k = first; A != nullptr && k < joints; ++k)
      (*A)(row, slice.z[static_cast<std::size_t>(k)]) -=
          m.vector.dot(spin_rate(at, j, k)) + at.spin.col(j).dot(m.rate * at.spin.col(k));
  }
  const Vector along = directions_of_joints(turn, slice.point).transpose() * vector;
  for (Index j = 0; j < along.size(); ++j)
    if (const Index row = slice.z[static_cast<std::size_t>(joints + j)]; row >= 0)
      residual[row] -= along[j];
}

void add_load(const System& system, const PointLoad& load, Workspace::Point& point,
              const Vector& factors, Vector& residual, Matrix* A, Matrix* dR_drho) {
  const PointSlice& slice = system.points[load.point];
  const PointMotion<double>& at = point.at;
  const Vec3<double> vector = vector_of(load, at, factors);
  if (load.about_one_axis)
    return add_moment_about_one_axis(system, load, slice, at, vector, residual, A);
  Vector& Q = point.forces;  // generalised, one per variable of the point
  Q.noalias() = (load.kind == LoadKind::force ? at.dp : at.spin).transpose() * vector;
  for (Index j = 0; j < Q.size(); ++j) {
    const Index row = slice.z[static_cast<std::size_t>(j)];
    if (row < 0) continue;
    residual[row] -= Q[j];
    for (Index k = 0; A != nullptr && k < Q.size(); ++k)
      add_derivative(slice, j, slice, k, -force_rate(load, at, vector, j, k), *A, dR_drho);
  }
}

/// Line spring with the vector d = p_to - p_from of length l, tension T = k (l - l0):
///
///     dU/dv_j = f . dd_j,  f = (T/l) d;      d2U = dd_j^T [ (T/l) I + (k - T/l) d d^T/l^2 ] dd_k
///                                                  + f . d2d_jk
///
/// With l0 = 0, T/l = k and nothing is divided by l.
class SpringTerm {
 public:
  SpringTerm(const System& system, const PointSpring& spring, const PointMotion<double>& from,
             const PointMotion<double>& to)
      : slices_{&system.points[spring.from], &system.points[spring.to]}, at_{&from, &to} {
    const Vec3<double> d = to.pose.p - from.pose.p;
    const double l = d.norm();
    const double per_length =
        spring.free == 0 ? spring.stiffness : spring.stiffness * (1 - spring.free / l);
    force_ = per_length * d;
    stiffness_ = per_length * model::Mat3<double>::Identity();
    if (spring.free != 0)
      stiffness_ += (spring.stiffness - per_length) * (d / l) * (d / l).transpose();
  }

  void add(Vector& residual, Matrix* A, Matrix* dR_drho) const {
    for (const int a : {0, 1})
      for (Index j = 0; j < at_[a]->dp.cols(); ++j) {
        const Index row = slices_[a]->z[static_cast<std::size_t>(j)];
        if (row < 0) continue;
        residual[row] += sign(a) * force_.dot(at_[a]->dp.col(j));
        if (A != nullptr) add_row(a, j, *A, dR_drho);
      }
  }

 private:
  static double sign(int end) { return end == 0 ? -1 : 1; }

  void add_row(int a, Index j, Matrix& A, Matrix* dR_drho) const {
    const Vec3<double> row = sign(a) * (stiffness_ * at_[a]->dp.col(j));
    for (const int b : {0, 1})
      for (Index k = 0; k < at_[b]->dp.cols(); ++k) {
        double value = sign(b) * row.dot(at_[b]->dp.col(k));
        if (a == b) value += sign(a) * force_.dot(second_displacement(*at_[a], j, k));
        add_derivative(*slices_[a], j, *slices_[b], k, value, A, dR_drho);
      }
  }

  const PointSlice* slices_[2];
  const PointMotion<double>* at_[2];
  Vec3<double> force_{};
  model::Mat3<double> stiffness_{};
};

/// Marks the points that a load or a line spring is at: one look at each of them, whatever their number.
void mark_used(const System& system, std::vector<Workspace::Point>& points) {
  for (Workspace::Point& point : points) point.is_used = false;
  for (const PointLoad& load : system.loads) points[load.point].is_used = true;
  for (const PointSpring& spring : system.line_springs)
    points[spring.from].is_used = points[spring.to].is_used = true;
}

}  // namespace

void evaluate_point(const System& system, std::size_t point, const Vector& z, const Vector& rho,
                    Workspace::Point& out) {
  const PointSlice& slice = system.points[point];
  Vector& v = out.variables;
  v.resize(slice.point.variable_count());
  for (Index k = 0; k < v.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    v[k] = (slice.z[i] >= 0 ? z[slice.z[i]] : 0.0) + (slice.rho[i] >= 0 ? rho[slice.rho[i]] : 0.0);
  }
  model::evaluate_point<double>(slice.point, v, out.at);
}

void add_derivative(const PointSlice& row, Index j, const PointSlice& column, Index k, double value,
                    Matrix& A, Matrix* dR_drho) {
  const Index r = row.z[static_cast<std::size_t>(j)];
  const auto c = static_cast<std::size_t>(k);
  if (r < 0) return;
  if (column.z[c] >= 0) A(r, column.z[c]) += value;
  if (dR_drho != nullptr && column.rho[c] >= 0) (*dR_drho)(r, column.rho[c]) += value;
}

void add_point_terms(const System& system, const Vector& z, const Inputs& inputs, Workspace& work,
                     Vector& residual, Matrix* A, Matrix* dR_drho) {
  if (system.loads.empty() && system.line_springs.empty()) return;
  work.points.resize(system.points.size());
  mark_used(system, work.points);
  for (std::size_t i = 0; i < system.points.size(); ++i)
    if (work.points[i].is_used) evaluate_point(system, i, z, inputs.rho, work.points[i]);
  for (const PointLoad& load : system.loads)
    add_load(system, load, work.points[load.point], inputs.loads, residual, A, dR_drho);
  for (const PointSpring& spring : system.line_springs)
    SpringTerm(system, spring, work.points[spring.from].at, work.points[spring.to].at)
        .add(residual, A, dR_drho);
}

void put_load_rate(const System& system, const Vector& z, const Vector& rho, const Vector& rates,
                   Workspace& work, Vector& rate) {
  assert(rates.size() == static_cast<Index>(system.mechanism.loads.size()));
  rate.setZero(system.size);
  work.points.resize(system.points.size());
  for (const PointLoad& load : system.loads) {
    if (load.number < 0 || rates[load.number] == 0) continue;
    evaluate_point(system, load.point, z, rho, work.points[load.point]);
    add_load(system, load, work.points[load.point], rates, rate, nullptr, nullptr);
  }
  add_pressure_rate(system, z, rho, rates, work, rate);
}

Vector load_rate(const System& system, const Vector& z, const Vector& rho, const Vector& rates) {
  Workspace work;
  Vector rate;
  put_load_rate(system, z, rho, rates, work, rate);
  return rate;
}

Vec3<double> position_of(const System& system, std::size_t point, const Vector& z,
                         const Vector& rho) {
  Workspace::Point p;
  evaluate_point(system, point, z, rho, p);
  return p.at.pose.p;
}

LineSpringState line_spring_state(const System& system, std::size_t spring, const Vector& z,
                                  const Vector& rho) {
  const PointSpring& s = system.line_springs[spring];
  const double length =
      (position_of(system, s.to, z, rho) - position_of(system, s.from, z, rho)).norm();
  return {length, s.stiffness * (length - s.free)};
}

namespace {

/// Of the springs that do not switch.
double energy_of_linear_springs(const System& system, const Vector& z, const Vector& rho) {
  double energy = 0;
  for (const CoordinateGroup& group : system.coupled) {
    const Vector q = z(group.coordinates) - group.free;
    energy += 0.5 * q.dot(group.stiffness * q);
  }
  for (std::size_t i = 0; i < system.line_springs.size(); ++i) {
    const PointSpring& spring = system.line_springs[i];
    const double stretch = line_spring_state(system, i, z, rho).length - spring.free;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

/// Of a moment with a potential, which turns about axes of one direction, each by its own variable.
double work_of_moment(const System& system, const PointLoad& load, const Workspace::Point& point,
                      const Vec3<double>& vector, const Vector& z, const Vector& rho) {
  const PointSlice& slice = system.points[load.point];
  if (!load.about_one_axis) return (point.at.spin.transpose() * vector).dot(point.variables);
  const BodyTurn& turn = *system.body_slices[static_cast<std::size_t>(slice.body - 1)].turn;
  const Vector along = directions_of_joints(turn, slice.point).transpose() * vector;
  return vector.dot(turn.axis) * angle_of(turn, z, rho) +
         along.dot(point.variables.tail(along.size()));
}

}  // namespace

double spring_energy(const System& system, const Vector& z, const Vector& rho) {
  double energy = energy_of_linear_springs(system, z, rho);
  for (const CoordinateSpring& spring : system.springs) {
    const double c = z[spring.coordinate];
    energy += spring.law.energy(spring.law.segment_at(c), c);
  }
  if (!system.shapes.empty()) energy += shape_energy(system, z, rho);
  return energy;
}

double spring_energy(const System& system, const Piece& piece, const Vector& z, const Vector& rho) {
  double energy = energy_of_linear_springs(system, z, rho);
  for (const CoordinateSpring& spring : system.springs)
    energy += spring.law.energy(segment_of(spring, piece), z[spring.coordinate]);
  if (!system.shapes.empty()) energy += shape_energy(system, piece, z, rho);
  return energy;
}

double spring_energy(const System& system, const Vector& z) {
  return spring_energy(system, z, system.commands);
}

double load_potential(const System& system, const Vector& z, const Inputs& inputs) {
  double potential = 0;
  Workspace::Point point;
  for (const PointLoad& load : system.loads) {
    evaluate_point(system, load.point, z, inputs.rho, point);
    const Vec3<double> vector = vector_of(load, point.at, inputs.loads);
    if (load.kind == LoadKind::force)
      potential -= vector.dot(point.at.pose.p);
    else
      potential -= work_of_moment(system, load, point, vector, z, inputs.rho);
  }
  for (const BodySlice& body : system.body_slices) {
    const auto W = inputs.W.segment(body.W, body.count);
    if (body.turn)
      potential -= W.head(3).dot(z.segment(body.t, 3)) +
                   W.tail(3).dot(body.turn->axis) * angle_of(*body.turn, z, inputs.rho);
    else
      potential -= W.dot(z.segment(body.t, body.count));
  }
  if (!system.shapes.empty()) potential += pressure_potential(system, z, inputs);
  return potential;
}

}  // namespace springfold::statics
