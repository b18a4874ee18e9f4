// [[body]] and [[chain]] tables.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "mechanism_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Units of a coordinate and of what acts on it, for messages.
struct JointUnits {
  std::string coordinate{};  ///< "rad" or "m"
  std::string torque{};      ///< "N*m" or "N"
  std::string stiffness{};   ///< "N*m/rad" or "N/m"
  bool has_length = false;   ///< is it the elongation of a bar, which has a length of its own?
};
JointUnits units_of(model::JointKind kind, const UnitLabels& labels);

/// Adds the bodies, then the chains. All bodies must be read before the first chain.
void read_bodies(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);
void read_chains(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);

/// `elements` of one chain, into chain.elements and chain.points.
/// @param planar   rigid links may have two entries
/// @param coupled  joints that a coupled spring holds: they need none of their own
void read_elements(const std::vector<Item>& elements, bool planar,
                   const std::set<std::string>& coupled, NumberTable& numbers, ChainDraft& chain,
                   Reading& reading);

/// `gravity`, [[spring]] and [[load]] tables. All chains must be read before.
void read_gravity(const Item& item, MechanismDraft& draft, Reading& reading);
void read_springs(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);

/// @param body      the body on which a load acts that does not say where; 0: it must say
/// @param numbers   the table that its numbers belong to
std::vector<LoadDraft> read_loads(const std::vector<Item>& tables, const MechanismDraft& draft,
                                  Index body, NumberTable& numbers, Reading& reading);

/// `mass`: >= 0.
NumberId read_mass(const TableReader& table, NumberTable& numbers, Reading& reading);

/// `inertia` of what has a mass, about its centre: one number about z in the plane, in space three, or three rows of
/// three.
std::vector<NumberId> read_inertia(const TableReader& table, bool planar, NumberTable& numbers,
                                   Reading& reading);

/// `[[node]]`: point bodies, fixed points of the base, and chains along which nodes slide. All bodies
/// must be read before.
void read_nodes(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);

/// `[[bar]]`. All chains and springs must be read before.
void read_bars(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);

/// Has a body, node, chain, spring or bar this name? Column names begin with them: all must differ.
bool is_taken(const std::string& name, const MechanismDraft& draft);

/// A name of a body, chain or spring that is not taken yet; reports others.
std::string read_own_name(const TableReader& table, const MechanismDraft& draft, Reading& reading);

/// Three numbers, or two in the plane (z = 0).
std::vector<NumberId> read_vector3(const Item& item, bool planar, const std::string& unit,
                                   NumberTable& numbers, Reading& reading);

/// Does the body live in the plane? Also where its task space is unusable, so that one mistake does
/// not cause others.
bool is_planar(const BodyDraft& body);

/// One `{ elastic = ... }`. @param plane  the body moves in the plane: directions Tx, Ty, Rz
ElasticDraft read_elastic(const Item& item, const std::string& default_name, bool plane,
                          NumberTable& numbers, Reading& reading);

/// `coupled_springs` of a chain whose elements are read, into chain.coupled.
void read_coupled_springs(const TableReader& table, NumberTable& numbers, ChainDraft& chain,
                          Reading& reading);

/// The joints that they name, before the elements are read.
std::set<std::string> coupled_joint_names(const Node& chain);

/// `size` rows of as many numbers that make a symmetric matrix, row by row.
std::vector<NumberId> read_symmetric_matrix(const Item& item, std::size_t size,
                                            model::Definiteness definite, NumberTable& numbers,
                                            Reading& reading);

/// `[x, y, z]` or `{ at = [...], rotate = { axis = ..., angle = ... } }`.
FrameDraft read_frame(const Item& item, bool planar, NumberTable& numbers, Reading& reading);

/// "x", "-z", [1, 1, 0].
AxisDraft read_axis(const Item& item, NumberTable& numbers, Reading& reading);

/// A table with `law`; nothing if it is no table or has no usable law.
std::optional<SpringDraft> read_spring(const Item& item, model::JointKind kind,
                                       NumberTable& numbers, Reading& reading);
std::optional<SpringDraft> read_spring(const Item& item, const JointUnits& units,
                                       NumberTable& numbers, Reading& reading);

/// `[{ law = ... }, ...]`: two springs or more, one behind the other; empty: reported.
std::vector<SpringDraft> read_series_laws(const Item& list, const JointUnits& units,
                                          NumberTable& numbers, Reading& reading);

/// `series` and `initial` of a spring between points or of a shape, or of a bar. @pre table.has("series")
std::optional<SeriesDraft> read_series(const TableReader& table, const JointUnits& units,
                                       NumberTable& numbers, Reading& reading);

/// A law that counts from where the mechanism starts has no meaning in such springs: reports it.
void refuse_origin(const Item& law, const SpringDraft& spring, const std::string& what,
                   Reading& reading);
void refuse_origins(const TableReader& table, const std::optional<SeriesDraft>& series,
                    const std::string& what, Reading& reading);

/// Number of a moving body (1, 2, ...) by name; 0 for "base" if `base_allowed`. Reports others.
std::optional<Index> body_number(const std::string& name, const Item& at,
                                 const std::vector<BodyDraft>& bodies, bool base_allowed,
                                 Reading& reading);

}  // namespace springfold::io
