#include "mechanism_draft.hpp"

#include "bar_draft.hpp"
#include "counted_turns.hpp"
#include "moved_numbers.hpp"
#include "springfold/core/overloaded.hpp"

namespace springfold::io {
namespace {

using Numbers = std::vector<double>;

model::Vec3<double> direction_of(const AxisDraft& axis, const Numbers& numbers) {
  if (axis.entries.empty()) return axis.fixed;
  const model::Vec3<double> v{numbers[axis.entries[0]], numbers[axis.entries[1]],
                              numbers[axis.entries[2]]};
  return v / v.norm();
}

model::Pose<double> pose_of(const FrameDraft& frame, const Numbers& numbers) {
  model::Pose<double> pose;
  for (std::size_t i = 0; i < frame.at.size(); ++i)
    pose.p[static_cast<Index>(i)] = numbers[frame.at[i]];
  if (frame.angle)
    pose.R =
        model::rotation_about<double>(direction_of(frame.axis, numbers), numbers[*frame.angle]);
  return pose;
}

model::BeamSection section_of(const SectionDraft& s, const Numbers& n) {
  model::BeamSection section;
  switch (s.shape) {
    case SectionDraft::Shape::given:
      section = {.A = n[s.A], .Iy = n[s.Iy], .Iz = n[s.Iz], .J = n[s.J]};
      break;
    case SectionDraft::Shape::round:
      section = model::round_section(n[s.diameter], n[s.inner]);
      break;
    case SectionDraft::Shape::rectangular:
      section = model::rectangular_section(n[s.width], n[s.height]);
      break;
  }
  if (s.Ay) section.Ay = n[*s.Ay];
  if (s.Az) section.Az = n[*s.Az];
  return section;
}

/// Stiffness of an elastic link's end, or of one of its segments, in its directions.
Matrix stiffness_of(const ElasticDraft& draft, double length, const Numbers& n) {
  const auto m = static_cast<Index>(draft.directions.size());
  Matrix matrix(m, m);
  if (draft.kind == ElasticDraft::Kind::beam) {
    const Matrix C =
        model::cantilever_compliance(length, n[draft.E], n[draft.G], section_of(draft.section, n));
    std::vector<Index> rows;
    for (const model::ElasticDirection d : draft.directions) rows.push_back(static_cast<Index>(d));
    return model::inverse_of(C(rows, rows));
  }
  for (Index i = 0; i < m * m; ++i)
    matrix(i / m, i % m) = n[draft.matrix[static_cast<std::size_t>(i)]];
  return draft.kind == ElasticDraft::Kind::compliance ? model::inverse_of(matrix)
                                                      : Matrix(0.5 * (matrix + matrix.transpose()));
}

void add_elastic(const ElasticDraft& draft, const Numbers& n, model::Chain& chain) {
  const auto segments = static_cast<int>(n[draft.segments]);
  const double length = n[draft.length] / segments;
  const Matrix stiffness = stiffness_of(draft, length, n);
  for (int i = 1; i <= segments; ++i)
    add_elastic_link(chain, segments == 1 ? draft.name : draft.name + "." + std::to_string(i),
                     length, draft.directions, stiffness, vector_of(draft.initial, n),
                     vector_of(draft.free, n));
}

model::Joint joint_of(const JointDraft& from, const Numbers& numbers) {
  model::Joint joint{.name = from.name, .kind = from.kind, .role = from.role};
  joint.axis = direction_of(from.axis, numbers);
  if (from.spring) joint.spring = law_of(*from.spring, numbers);
  if (from.spring)
    joint.spring_from_start =
        std::visit([](const auto& spring) { return spring.from_start; }, *from.spring);
  joint.initial = numbers[from.initial];
  if (from.command) joint.command = numbers[*from.command];
  return joint;
}

void add_element(const ElementDraft& draft, const Numbers& numbers, model::Chain& chain) {
  std::visit(Overloaded{[&](const FrameDraft& frame) {
                          chain.elements.push_back(model::RigidLink{pose_of(frame, numbers)});
                        },
                        [&](const JointDraft& joint) {
                          chain.elements.push_back(joint_of(joint, numbers));
                        },
                        [&](const ElasticDraft& link) { add_elastic(link, numbers, chain); }},
             draft.content);
}

/// None, two or three numbers.
model::Vec3<double> vec3_of(const std::vector<NumberId>& ids, const Numbers& numbers) {
  model::Vec3<double> v = model::Vec3<double>::Zero();
  for (std::size_t i = 0; i < ids.size(); ++i) v[static_cast<Index>(i)] = numbers[ids[i]];
  return v;
}

/// @param first  of the model's elements, per element of the draft
model::CoupledSpring coupled_of(const CoupledDraft& draft, const std::vector<std::size_t>& first,
                                const Numbers& numbers) {
  model::CoupledSpring spring{.name = draft.name};
  for (const std::size_t joint : draft.joints) spring.elements.push_back(first[joint]);
  put_numbers(draft, numbers, spring);
  return spring;
}

model::Shape shape_of(const ShapeDraft& draft, const Numbers& numbers) {
  model::Shape shape{.kind = draft.kind, .closed = draft.closed, .triangles = draft.triangles};
  for (const AnchorDraft& point : draft.points) shape.points.push_back(anchor_of(point, numbers));
  if (draft.near) shape.near = numbers[*draft.near];
  return shape;
}

model::ShapeSpring shape_spring_of(const ShapeSpringDraft& draft, const Numbers& numbers) {
  model::ShapeSpring spring{.name = draft.name, .shape = shape_of(draft.shape, numbers)};
  if (draft.law) spring.law = law_of(*draft.law, numbers);
  if (draft.series) put_series(*draft.series, numbers, 1, spring);
  if (draft.gas)
    spring.gas = {numbers[draft.gas->nRT], numbers[draft.gas->initial],
                  numbers[draft.gas->exponent]};
  return spring;
}

model::ChainPoint point_of(const PointDraft& draft, std::size_t elements_before,
                           const Numbers& numbers) {
  return {.name = draft.name,
          .elements_before = elements_before,
          .at = draft.factor * vec3_of(draft.at, numbers),
          .mass = draft.mass ? numbers[*draft.mass] : 0,
          .inertia = inertia_of(draft.inertia, numbers)};
}

}  // namespace

model::Mat3<double> inertia_of(const std::vector<NumberId>& ids, const Numbers& numbers) {
  model::Mat3<double> I = model::Mat3<double>::Zero();
  // One number is that of a plate: what it has about x and y matters to nothing in the plane.
  if (ids.size() == 1)
    I.diagonal() << numbers[ids[0]] / 2, numbers[ids[0]] / 2, numbers[ids[0]];
  else if (ids.size() == 3)
    I.diagonal() = vec3_of(ids, numbers);
  else
    for (std::size_t i = 0; i < ids.size(); ++i)
      I(static_cast<Index>(i / 3), static_cast<Index>(i % 3)) = numbers[ids[i]];
  return I;
}

void put_series(const SeriesDraft& draft, const Numbers& numbers, double length,
                model::ShapeSpring& spring) {
  for (std::size_t i = 0; i < draft.laws.size(); ++i) {
    model::SpringLaw law = law_of(draft.laws[i], numbers, length);
    if (i + 1 == draft.laws.size()) {
      spring.law = std::move(law);
      return;
    }
    spring.before.push_back({.law = std::move(law)});
    if (i < draft.initial.size()) spring.before.back().initial = numbers[draft.initial[i]];
  }
}

model::Anchor anchor_of(const AnchorDraft& draft, const Numbers& numbers) {
  return {.body = draft.body,
          .chain = draft.chain,
          .point = draft.point,
          .at = vec3_of(draft.at, numbers)};
}

std::vector<std::size_t> origins_of(const ChainDraft& draft, const std::vector<double>& numbers) {
  model::Chain chain;
  std::vector<std::size_t> origins;
  for (std::size_t i = 0; i < draft.elements.size(); ++i) {
    add_element(draft.elements[i], numbers, chain);
    origins.resize(chain.elements.size(), i);
  }
  return origins;
}

void put_numbers(const CoupledDraft& draft, const Numbers& numbers, model::CoupledSpring& spring) {
  const auto m = static_cast<Index>(draft.joints.size());
  Matrix matrix(m, m);
  for (Index i = 0; i < m * m; ++i)
    matrix(i / m, i % m) = numbers[draft.stiffness[static_cast<std::size_t>(i)]];
  spring.stiffness = 0.5 * (matrix + matrix.transpose());
  spring.free = vector_of(draft.free, numbers);
}

model::Vec3<double> load_vector_of(const LoadDraft& draft, const Numbers& numbers) {
  return vec3_of(draft.vector, numbers);
}

std::vector<model::Load> build_loads(const std::vector<LoadDraft>& drafts, const Numbers& numbers) {
  std::vector<model::Load> loads;
  for (const LoadDraft& draft : drafts)
    loads.push_back({.name = draft.name,
                     .on = anchor_of(draft.on, numbers),
                     .kind = draft.kind,
                     .follows = draft.follows,
                     .with_lambda = draft.with_lambda,
                     .vector = load_vector_of(draft, numbers),
                     .shape = shape_of(draft.shape, numbers)});
  return loads;
}

Vector vector_of(const std::vector<NumberId>& ids, const std::vector<double>& numbers) {
  Vector v(static_cast<Index>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i) v[static_cast<Index>(i)] = numbers[ids[i]];
  return v;
}

model::Mechanism build_mechanism(const MechanismDraft& draft, const std::vector<double>& numbers) {
  model::Mechanism mechanism;
  mechanism.bodies.reserve(draft.bodies.size());
  mechanism.chains.reserve(draft.chains.size());
  for (const BodyDraft& body : draft.bodies)
    mechanism.bodies.push_back({.name = body.name,
                                .task_space = body.task_space,
                                .pose = vector_of(body.pose, numbers),
                                .mass = body.mass ? numbers[*body.mass] : 0,
                                .centre = vec3_of(body.centre, numbers),
                                .inertia = inertia_of(body.inertia, numbers)});
  for (const ChainDraft& from : draft.chains) {
    model::Chain chain{.name = from.name, .from = from.from, .to = from.to};
    chain.from_attachment = pose_of(from.from_at, numbers);
    chain.to_attachment = pose_of(from.to_at, numbers);
    chain.elements.reserve(from.elements.size());
    std::vector<std::size_t> first;  // of the model's elements, per element of the draft
    for (const ElementDraft& element : from.elements) {
      first.push_back(chain.elements.size());
      add_element(element, numbers, chain);
    }
    first.push_back(chain.elements.size());
    for (const CoupledDraft& spring : from.coupled)
      chain.coupled_springs.push_back(coupled_of(spring, first, numbers));
    for (const PointDraft& point : from.points)
      chain.points.push_back(point_of(point, first[point.elements_before], numbers));
    mechanism.chains.push_back(std::move(chain));
  }
  mechanism.gravity = vec3_of(draft.gravity, numbers);
  mechanism.loads = build_loads(draft.loads, numbers);
  for (const LineSpringDraft& spring : draft.springs)
    mechanism.line_springs.push_back({.name = spring.name,
                                      .from = anchor_of(spring.from, numbers),
                                      .to = anchor_of(spring.to, numbers),
                                      .stiffness = numbers[spring.stiffness],
                                      .free = numbers[spring.free]});
  for (const ShapeSpringDraft& spring : draft.shape_springs)
    mechanism.shape_springs.push_back(shape_spring_of(spring, numbers));
  add_bars(draft, numbers, mechanism);
  add_ray_chains(draft, mechanism);
  return mechanism;
}

}  // namespace springfold::io
