// Stable parts of traced branches, followed while lambda moves one way. Private to analysis.
#pragma once

#include <optional>
#include <vector>

#include "quantities.hpp"
#include "springfold/analysis/result.hpp"

namespace springfold::analysis {

class StableWalk {
 public:
  StableWalk(const std::vector<QuantityDefinition>& quantities, const StudyResult& result);

  /// The special points at which stability ends when lambda goes in this direction from between the rows
  /// `row` and `row` + 1 of a branch (numbers from 1): several where a symmetric branch hands stability over to both of
  /// its sides; none where the range ends before.
  std::vector<const Event*> ends_of(int branch, std::size_t row, int direction) const;

  struct Next {
    std::size_t branch = 0, row = 0;
    int step = 1;
    bool is_start = false;
  };

  /// The branches that leave this point stably as lambda goes on, and the first of them.
  std::vector<Next> stable_branches_from(const Event& event, std::size_t from, int direction) const;
  std::optional<Next> stable_branch_from(const Event& event, std::size_t from, int direction) const;

  /// The special point behind the last stable row, or at which branches meet and lambda turns.
  const Event* first_unstable(std::size_t branch, std::size_t row, int step) const;

 private:
  const Event* event_at(std::size_t branch, std::size_t row) const;
  /// Does lambda go back behind the event?
  bool turns_at(std::size_t branch, const Event& event) const;

  const StudyResult& result_;
  std::size_t index_, lambda_;
};

}  // namespace springfold::analysis
