// Numbers of unstable modes on both sides of a special point. Private to io.
#pragma once

#include <string_view>
#include <vector>

#include "springfold/analysis/result.hpp"

namespace springfold::io {

/// Columns that count unstable modes.
inline constexpr std::string_view count_columns[] = {"index", "index_force", "index_driven"};

/// NaN: not defined there.
struct CountsBeside {
  double before = 0, after = 0;
};

/// Just before and just behind the point, along the branch: its two rows where a spring switches, else the points of the
/// curve on both sides of it, between which nothing else lies.
/// @param column  its name
CountsBeside counts_beside(const analysis::StudyResult& result, const analysis::Branch& branch,
                           const analysis::Event& event, std::string_view column);

}  // namespace springfold::io
