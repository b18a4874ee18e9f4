// Numbers of unstable modes on both sides of a special point. Private to io.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "springfold/analysis/result.hpp"

namespace springfold::io {

/// Columns that count unstable modes.
inline constexpr std::string_view count_columns[] = {"index", "index_force", "index_driven"};

/// NaN: not defined there.
struct CountsBeside {
  double before = 0, after = 0;
  bool before_rests = false, after_rests = false;  ///< analysis::Sample::rests
};

/// A number of unstable modes for people: where springs rest no more is known of an unstable state than ">= 1".
std::string count_text(double count, bool rests);

/// Just before and just behind the point, along the branch: its two rows where a spring switches, else the points of
/// the curve on both sides of it, between which nothing else lies.
/// @param column  its name
CountsBeside counts_beside(const analysis::StudyResult& result, const analysis::Branch& branch,
                           const analysis::Event& event, std::string_view column);

}  // namespace springfold::io
