// What a case would take of memory, estimated before anything is built.
#pragma once

#include "case_draft.hpp"

namespace springfold::io {

/// Refuses products of counts that need more than `most_memory`: runs times joints and links,
/// segments of all elastic links, unknowns that stand in dense matrices.
/// @pre what check_numbers reports is looked at separately: numbers out of their range count as one
void check_memory(const CaseDraft& draft, Problems& problems);

/// The same for the rows that results keep: nodes of maps and targets over all runs, and rows of
/// `trace.spacing` within one step. Later ones are counted while curves are traced.
class RowCounter {
 public:
  /// @param columns  of the tables of this run
  void add(const PlannedRun& planned, std::size_t columns, const StudyDraft& study,
           Problems& problems);

 private:
  double bytes_ = 0;
};

}  // namespace springfold::io
