// What the HTML page of a run goes through row by row: branches, jumps, nodes and single states alike. Private to io.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// A row with a name.
struct PagePoint {
  std::string label{}, code{}, detail{}, sentence{};
  std::size_t row = 0;
  const analysis::Event* event = nullptr;  ///< of a branch; otherwise nullptr
};

enum class RowsForm {
  curve,   ///< neighbours belong together
  jump,    ///< a motion through states that are not at rest
  points,  ///< states beside each other
  nodes,   ///< of a map over its axes
};

/// "curve", "jump", "points", "nodes".
const char* word_of(RowsForm form);

/// Rows in their order. What they point to belongs to the result or to PageLists::own.
struct PageRows {
  std::string name{}, file{};  ///< the file of the same rows, relative to the result folder
  RowsForm form = RowsForm::curve;
  std::size_t start = 0;  ///< the row that is shown first
  std::vector<const analysis::Sample*> rows{};
  std::vector<PagePoint> points{};
};

/// Not to be copied: its rows are its own.
struct PageLists {
  PageLists() = default;
  PageLists(const PageLists&) = delete;
  PageLists(PageLists&&) = default;
  PageLists& operator=(const PageLists&) = delete;
  PageLists& operator=(PageLists&&) = delete;
  ~PageLists() = default;

  std::deque<analysis::Sample> own{};  ///< rows that no branch has
  std::vector<PageRows> lists{};
};

/// All lists of a run that have rows: its branches, the equilibria of a search, its jumps, its stable states.
/// @param files       of its branches
/// @param equilibria  file of its equilibria
PageLists page_lists_of(const PlannedRun& planned, const analysis::StudyResult& result,
                        const std::vector<std::string>& files, const std::string& equilibria,
                        const UnitLabels& units);

/// The quantities that the page's axes show first.
struct PageAxes {
  std::string x{}, y{};
};
PageAxes page_axes_of(const PlannedRun& planned, const analysis::StudyResult& result);

}  // namespace springfold::io
