#include "counts_beside.hpp"

#include <cmath>

#include "result_access.hpp"
#include "summary_line.hpp"
#include "text.hpp"

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
  const auto rests = [&](std::size_t row) {
    return row < branch.samples.size() && branch.samples[row].rests;
  };
  return {value_at(result, branch, first, column), value_at(result, branch, second, column),
          rests(first), rests(second)};
}

std::string count_text(double count, bool rests) {
  if (std::isnan(count)) return {};
  return rests && count >= 1 ? ">= 1" : rounded(count, summary_digits);
}

}  // namespace springfold::io
