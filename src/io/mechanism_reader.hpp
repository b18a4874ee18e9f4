// [[body]] and [[chain]] tables.
#pragma once

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
};
JointUnits units_of(model::JointKind kind, const UnitLabels& labels);

/// Adds the bodies, then the chains. All bodies must be read before the first chain.
void read_bodies(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);
void read_chains(const std::vector<Item>& tables, MechanismDraft& draft, Reading& reading);

/// `elements` of one chain. @param planar  rigid links may have two entries
std::vector<ElementDraft> read_elements(const std::vector<Item>& elements, bool planar,
                                        NumberTable& numbers, Reading& reading);

/// One `{ elastic = ... }`. @param plane  the body moves in the plane: directions Tx, Ty, Rz
ElasticDraft read_elastic(const Item& item, const std::string& default_name, bool plane,
                          NumberTable& numbers, Reading& reading);

/// `[x, y, z]` or `{ at = [...], rotate = { axis = ..., angle = ... } }`.
FrameDraft read_frame(const Item& item, bool planar, NumberTable& numbers, Reading& reading);

/// "x", "-z", [1, 1, 0].
AxisDraft read_axis(const Item& item, NumberTable& numbers, Reading& reading);

/// A table with `law`; nothing if it is no table or has no usable law.
std::optional<SpringDraft> read_spring(const Item& item, model::JointKind kind,
                                       NumberTable& numbers, Reading& reading);

/// Number of a moving body (1, 2, ...) by name; 0 for "base" if `base_allowed`. Reports others.
std::optional<Index> body_number(const std::string& name, const Item& at,
                                 const std::vector<BodyDraft>& bodies, bool base_allowed,
                                 Reading& reading);

}  // namespace springfold::io
