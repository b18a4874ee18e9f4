// `critical_curve = { of = "STUDY/ROW" }`: a critical curve that begins at a row of another one.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "table_reader.hpp"

namespace springfold::io {

/// A row of the table of another study.
struct CurveRow {
  std::string study{}, label{};
};

/// Nothing where `of` names a point of the study's own path.
std::optional<CurveRow> curve_row(const std::string& of);

/// The row that a [[study]] table asks for; nothing: none.
std::optional<CurveRow> curve_row(const Node& study);

/// The studies, those that begin at a row of another one with what they take over: all that says which curve is
/// traced. Reports unknown studies, other kinds, circles, and keys that differ.
/// @param copies  keeps the tables that were made
std::vector<Item> with_earlier_curves(const std::vector<Item>& studies, std::deque<Node>& copies,
                                      Problems& problems);

}  // namespace springfold::io
