// Shapes of points: what springs and pressures act on.
#pragma once

#include <string>
#include <vector>

#include "mechanism_reader.hpp"

namespace springfold::io {

/// `shape`, `of` and what belongs to them. @param words  shapes that are allowed here
ShapeDraft read_shape(const TableReader& table, const std::vector<std::string>& words,
                      const MechanismDraft& draft, NumberTable& numbers, Reading& reading);

/// Units of alpha and of an energy per alpha.
JointUnits units_of(model::ShapeKind kind, const UnitLabels& labels);

}  // namespace springfold::io
