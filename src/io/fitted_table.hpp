// Tables that fit a terminal.
#pragma once

#include <string>
#include <vector>

#include "text.hpp"

namespace springfold::io {

inline constexpr std::size_t table_width = 100;  // characters

/// As aligned(), in lines of at most table_width characters as far as single cells allow: columns that have no
/// room follow in further blocks, each with the first column again; a last column that is left-aligned is
/// broken at blanks.
std::string fitted(const std::vector<std::vector<std::string>>& rows,
                   const std::vector<Align>& align, std::size_t indent);

}  // namespace springfold::io
