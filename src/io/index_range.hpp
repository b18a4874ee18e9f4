// Indices of repetitions and patterns.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "problems.hpp"
#include "toml_reader.hpp"

namespace springfold::io {

struct IndexRange {
  std::string name{};
  long first = 0, last = 0, step = 1;

  std::size_t count() const { return static_cast<std::size_t>((last - first) / step + 1); }
};

/// Indices are at most as large.
constexpr double largest_index = 1e6;

/// Indices of `repeat` or `pattern` of a table, none where it has neither; nothing if they are unusable, which is
/// reported. @param parameters  names that no index may have @param outer  indices around it; may be null
std::optional<std::vector<IndexRange>> ranges_of(const Node& item, const std::string& key,
                                                 const std::set<std::string>& parameters,
                                                 const Bindings* outer, Problems& problems);

/// The index of a pattern; "" if it has none.
std::string index_of(const Node& pattern);

}  // namespace springfold::io
