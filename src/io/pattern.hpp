// `pattern`: copies of a table turned about an axis.
#pragma once

#include <string>

#include "bindings.hpp"
#include "problems.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

/// Keys of `pattern` beside its index.
bool is_pattern_key(std::string_view key);

/// Turns a copy, in the frames in which its numbers stand: places and poses about the axis through `about`,
/// frames with them, forces and moments without them. Angles are index times `angle`.
/// @param part      "node", "chain", "study[1].loads", ...: what kind of table it is
/// @param pattern   the table `pattern`; its index is `index`, which `bindings` knows
/// @param key       of the copy, for messages
void turn_copy(Node& copy, const std::string& part, const Node& pattern, const std::string& index,
               const Bindings& bindings, const std::string& key, Problems& problems);

}  // namespace springfold::io
