#include "counts_beside.hpp"

#include "result_access.hpp"

namespace springfold::io {

CountsBeside counts_beside(const analysis::StudyResult& result, const analysis::Branch& branch,
                           const analysis::Event& event, std::string_view column) {
  using analysis::EventKind;
  const bool is_ordinary =
      event.kind == EventKind::user_value || event.kind == EventKind::end_of_range;
  const bool has_neighbours = event.row > 0 && event.row + 1 < branch.samples.size();
  std::size_t first = event.row, second = event.row;
  if (has_two_rows(branch, event))
    second = event.row + 1;
  else if (!is_ordinary && has_neighbours)
    first = event.row - 1, second = event.row + 1;
  return {value_at(result, branch, first, column), value_at(result, branch, second, column)};
}

}  // namespace springfold::io
