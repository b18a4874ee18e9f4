// `pattern`: copies of a table turned about an axis.
#pragma once

#include <string>

#include "bindings.hpp"
#include "drawn_frames.hpp"
#include "problems.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

/// Keys of `pattern` beside its index.
bool is_pattern_key(std::string_view key);

/// A copy of a table.
struct PatternCopy {
  Node& table;
  std::string part{};        ///< "node", "chain", "study[1].loads", ...: what kind of table it is
  const Node& pattern;       ///< the table `pattern`
  std::string index{};       ///< its index, which `bindings` knows
  const Bindings& bindings;  ///< of this copy
  const Node& at_zero;       ///< the copy of index 0: for the names of bodies in it
  std::string key{};         ///< for messages
};

/// Turns a copy about the axis in the base: places and poses, frames with them, forces and moments without their place.
/// Numbers that stand in the frame of a body are turned so that the whole is turned as the case draws it. Where that is
/// not known, a problem is reported. Angles are index times `angle`.
/// @param parts  is told of bodies, nodes and chains that are turned
void turn_copy(const PatternCopy& copy, DrawnParts& parts, Problems& problems);

}  // namespace springfold::io
