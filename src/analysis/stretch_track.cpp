#include "stretch_track.hpp"

#include <cmath>

namespace springfold::analysis {
namespace {

/// Neighbours that are nearer than this part of the interval tell nothing but their rounding.
constexpr double nearest_neighbour = 1e-3;

std::optional<std::size_t> row_before(const StretchTrack& track, double lambda) {
  for (std::size_t r = 0; r + 1 < track.lambda.size(); ++r) {
    const double from = track.lambda[r] - lambda, to = track.lambda[r + 1] - lambda;
    if (from * to <= 0 && from < to && (track.is_stable[r] || track.is_stable[r + 1])) return r;
  }
  return std::nullopt;
}

/// The row and the next one, and those before and behind them.
std::vector<std::size_t> rows_around(const StretchTrack& track, std::size_t row) {
  const double least = nearest_neighbour * (track.s[row + 1] - track.s[row]);
  std::vector<std::size_t> rows{row, row + 1};
  if (row > 0 && track.s[row] - track.s[row - 1] > least) rows.push_back(row - 1);
  if (row + 2 < track.s.size() && track.s[row + 2] - track.s[row + 1] > least)
    rows.push_back(row + 2);
  return rows;
}

/// The polynomial through values of rows, at arc length s: Neville's scheme.
template <class Value>
Value through(const StretchTrack& track, const std::vector<std::size_t>& rows,
              const std::vector<Value>& of, double s) {
  std::vector<Value> values;
  for (const std::size_t r : rows) values.push_back(of[r]);
  for (std::size_t order = 1; order < rows.size(); ++order)
    for (std::size_t i = 0; i + order < rows.size(); ++i) {
      const double from = track.s[rows[i]], to = track.s[rows[i + order]];
      values[i] = Value(((to - s) * values[i] + (s - from) * values[i + 1]) / (to - from));
    }
  return values.front();
}

}  // namespace

Vector state_between(const StretchTrack& track, std::size_t row, double lambda) {
  double from = track.s[row], to = track.s[row + 1];
  if (!(from < to)) return track.x[row];
  const std::vector<std::size_t> rows = rows_around(track, row);
  const bool grows = track.lambda[row] < track.lambda[row + 1];
  // Lambda is that of the rows at both ends, so that it is met in between.
  constexpr int halvings = 50;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (from + to);
    const bool is_before = (through(track, rows, track.lambda, middle) < lambda) == grows;
    (is_before ? from : to) = middle;
  }
  return through(track, rows, track.x, 0.5 * (from + to));
}

std::optional<Vector> state_near(const StretchTrack& track, double lambda) {
  const auto row = row_before(track, lambda);
  if (!row) return std::nullopt;
  return state_between(track, *row, lambda);
}

}  // namespace springfold::analysis
