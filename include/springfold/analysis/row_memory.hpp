// Bounds of memory: what is refused before work begins, and where a curve ends.
#pragma once

#include <cstddef>

namespace springfold::analysis {

/// The largest estimate of memory for one thing that a study asks for [byte]. A fixed number, so that
/// a case means the same on every machine.
inline constexpr double most_memory = 2e9;

/// A row of a table: its values, and the texts beside them [byte].
constexpr double bytes_of_row(std::size_t columns) {
  return 160 + 8 * static_cast<double>(columns);
}

/// The same row as text, about, while its table is written [byte].
constexpr double bytes_of_text(std::size_t columns) { return 20 * static_cast<double>(columns); }

/// A point of a curve from which a row is made: unknowns and tangent, and what is noted beside them [byte].
constexpr double bytes_of_point(std::size_t unknowns) {
  return 400 + 16 * static_cast<double>(unknowns);
}

/// Both, and the row's text [byte].
constexpr double bytes_of_traced_row(std::size_t columns, std::size_t unknowns) {
  return bytes_of_row(columns) + bytes_of_text(columns) + bytes_of_point(unknowns);
}

}  // namespace springfold::analysis
