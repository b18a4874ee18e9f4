// A mechanism whose numbers are still formulas: what a case file says, names resolved.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "numbers.hpp"
#include "spring_draft.hpp"
#include "springfold/model/elastic_link.hpp"
#include "springfold/model/mechanism.hpp"

namespace springfold::io {

/// A direction: constant, or three numbers that are made a unit vector.
struct AxisDraft {
  model::Vec3<double> fixed = model::Vec3<double>::UnitZ();
  std::vector<NumberId> entries{};  ///< empty: `fixed` holds
};

/// A constant transformation: first a shift, then a rotation about an axis.
struct FrameDraft {
  std::vector<NumberId> at{};  ///< x, y, z; empty: no shift
  AxisDraft axis{};
  std::optional<NumberId> angle{};  ///< [rad]; none: no rotation
};

struct JointDraft {
  std::string name{};
  model::JointKind kind = model::JointKind::revolute;
  AxisDraft axis{};
  model::JointRole role = model::JointRole::passive;
  std::optional<SpringDraft> spring{};
  NumberId initial = 0;
  std::optional<NumberId> command{};
};

/// The cross-section of a beam.
struct SectionDraft {
  enum class Shape { given, round, rectangular };
  Shape shape = Shape::given;
  NumberId A = 0, Iy = 0, Iz = 0, J = 0;  ///< given: those that the directions need
  std::optional<NumberId> Ay{}, Az{};     ///< shear areas; none: no shear
  NumberId diameter = 0, inner = 0;       ///< round
  NumberId width = 0, height = 0;         ///< rectangular
};

/// An elastic link: a rigid link and 6x6 virtual springs at its end, or a part of them.
struct ElasticDraft {
  enum class Kind { beam, stiffness, compliance };
  Kind kind = Kind::beam;
  std::string name{};
  std::vector<model::ElasticDirection> directions{};  ///< increasing
  NumberId length = 0;
  NumberId E = 0, G = 0;                    ///< beam
  SectionDraft section{};                   ///< beam
  NumberId segments = 0;                    ///< beam: cut into so many links
  std::vector<NumberId> matrix{};           ///< otherwise: row by row
  std::vector<NumberId> initial{}, free{};  ///< one per direction
};

/// One element of the case file. Universal and spherical joints are already two and three joints;
/// an elastic link becomes several elements of the model.
struct ElementDraft {
  std::variant<FrameDraft, JointDraft, ElasticDraft> content{};
  Place place{};
  std::string key{};
};

/// A named point of a chain, or the mass of a rigid link.
struct PointDraft {
  std::string name{};
  std::size_t elements_before = 0;
  std::vector<NumberId> at{};  ///< x, y, z; empty: none
  double factor = 1;           ///< of `at`: 1/2 for the middle of a link
  std::optional<NumberId> mass{};
  std::vector<NumberId> inertia{};  ///< none, one about z, three, or nine of a matrix
};

/// Where something acts: on a body, or on a point of a chain.
struct AnchorDraft {
  Index body = 0, chain = -1;
  std::size_t point = 0;
  std::vector<NumberId> at{};
};

/// Points of which a spring or a pressure takes one number.
struct ShapeDraft {
  model::ShapeKind kind = model::ShapeKind::path;
  std::vector<AnchorDraft> points{};
  bool closed = false;
  std::vector<std::array<std::size_t, 3>> triangles{};
  std::optional<NumberId> near{};
  bool turns = false;  ///< an angle of nodes: whole turns are counted
};

struct LoadDraft {
  std::string name{};
  AnchorDraft on{};
  model::LoadKind kind = model::LoadKind::force;
  std::vector<NumberId> vector{};  ///< x, y, z
  bool follows = false, with_lambda = false;
  ShapeDraft shape{};  ///< of a pressure
  Place place{};
  std::string key{};
};

struct LineSpringDraft {
  std::string name{};
  AnchorDraft from{}, to{};
  NumberId stiffness = 0, free = 0;
  Place place{};
  std::string key{};
};

/// Springs in series: at least two; their coordinates add up.
struct SeriesDraft {
  std::vector<SpringDraft> laws{};
  std::vector<NumberId>
      initial{};  ///< guesses of the first coordinates; the last one takes the rest
};

/// A node that is fixed in all directions: a name for a point of the base.
struct SupportDraft {
  std::string name{};
  std::vector<NumberId> at{};
  Place place{};
  std::string key{};
};

/// A straight bar between two points, whose free length may be that drawn: linear, one-sided or with
/// a law of its elongation.
struct BarDraft {
  enum class Acts { both_ways, in_tension, in_compression };
  std::string name{};
  AnchorDraft from{}, to{};
  std::optional<NumberId> stiffness{}, EA{};     ///< one of both, or `law` [force/length], [force]
  Acts acts = Acts::both_ways;                   ///< with stiffness or EA
  std::optional<SpringDraft> law{};              ///< force over elongation
  std::optional<SeriesDraft> series{};           ///< instead of `law`
  std::optional<NumberId> free{}, pretension{};  ///< one or none [length], [force]
  Place place{};
  std::string key{};
};

struct GasDraft {
  NumberId nRT = 0, initial = 0, exponent = 0;
};

struct ShapeSpringDraft {
  std::string name{};
  ShapeDraft shape{};
  std::optional<SpringDraft> law{};
  std::optional<SeriesDraft> series{};  ///< instead of `law`
  std::optional<GasDraft> gas{};
  Place place{};
  std::string key{};
};

/// A linear spring on several preloaded joints of a chain.
struct CoupledDraft {
  std::string name{};
  std::vector<std::size_t> joints{};  ///< places in ChainDraft::elements
  std::vector<NumberId> stiffness{};  ///< row by row
  std::vector<NumberId> free{};       ///< one per joint
  Place place{};
  std::string key{};
};

struct ChainDraft {
  std::string name{};
  Index from = 0, to = 1;
  FrameDraft from_at{}, to_at{};
  std::vector<ElementDraft> elements{};
  std::vector<PointDraft> points{};
  std::vector<CoupledDraft> coupled{};
  Place place{};
  std::string key{};
};

struct BodyDraft {
  std::string name{};
  model::TaskSpace task_space = model::TaskSpace::spatial;
  std::vector<NumberId> pose{};
  std::optional<NumberId> mass{};
  std::vector<NumberId> centre{};
  std::vector<NumberId> inertia{};  ///< as in PointDraft
  bool is_node = false;
  std::vector<std::string> fixed{};  ///< of a node: directions in which it is held, not all
  Place place{};
  std::string key{};
};

struct MechanismDraft {
  NumberTable numbers{};  ///< all numbers of the mechanism
  std::vector<BodyDraft> bodies{};
  std::vector<ChainDraft> chains{};
  std::vector<NumberId> gravity{};
  std::vector<LineSpringDraft> springs{};
  std::vector<SupportDraft> supports{};
  std::vector<ShapeSpringDraft> shape_springs{};
  std::vector<BarDraft>
      bars{};  ///< in the model line springs behind `springs`, or shapes behind these
  std::vector<LoadDraft> loads{};  ///< of all studies
};

/// @param numbers  values of draft.numbers, as many as these
model::Mechanism build_mechanism(const MechanismDraft& draft, const std::vector<double>& numbers);

/// For every element of the chain's model, the place of the element of the draft that it comes from.
std::vector<std::size_t> origins_of(const ChainDraft& draft, const std::vector<double>& numbers);

/// The law of the last of springs in series, and those before it, into `spring`.
/// @param length  of a bar: that of logarithmic laws which have none of their own
void put_series(const SeriesDraft& draft, const std::vector<double>& numbers, double length,
                model::ShapeSpring& spring);

/// @param numbers  values of the table that the draft's ids belong to
model::Anchor anchor_of(const AnchorDraft& draft, const std::vector<double>& numbers);

/// @param numbers  values of the table that the draft's ids belong to
std::vector<model::Load> build_loads(const std::vector<LoadDraft>& drafts,
                                     const std::vector<double>& numbers);

/// The numbers with these ids.
Vector vector_of(const std::vector<NumberId>& ids, const std::vector<double>& numbers);

/// Moments of inertia of none, one, three or nine numbers.
model::Mat3<double> inertia_of(const std::vector<NumberId>& ids,
                               const std::vector<double>& numbers);

}  // namespace springfold::io
