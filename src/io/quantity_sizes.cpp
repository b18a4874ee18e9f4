#include "quantity_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "result_access.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;
using analysis::Unit;

using UnitSizes = std::map<Unit, double>;

Unit unit_of(const StudyResult& result, std::size_t column) {
  const Unit unit = result.quantities[column].unit;
  return unit == Unit::lambda ? result.lambda_unit : unit;
}

/// Not more rows than these are asked: evenly spaced ones.
constexpr std::size_t most_rows = 2000;

/// All rows of a run one after the other.
std::vector<const std::vector<double>*> rows_of(const StudyResult& result) {
  std::vector<const std::vector<double>*> rows;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) rows.push_back(&row.values);
  if (result.equilibria)
    for (const analysis::Equilibrium& at : result.equilibria->list)
      rows.push_back(&at.sample.values);
  return rows;
}

/// The size that three quarters of the rows do not exceed, of a few rows the largest: at a singular posture stiffness
/// is as large as rounding lets it be, and says nothing of the others.
double usual_size(const std::vector<const std::vector<double>*>& rows, std::size_t column) {
  constexpr double part = 0.75;
  const std::size_t stride = (rows.size() + most_rows - 1) / most_rows;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < rows.size(); i += stride)
    if (column < rows[i]->size() && std::isfinite((*rows[i])[column]))
      sizes.push_back(std::abs((*rows[i])[column]));
  if (sizes.empty()) return 0;
  const auto last = static_cast<double>(sizes.size() - 1);
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(std::ceil(part * last));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

bool is_mechanical(Unit unit) {
  return unit == Unit::length || unit == Unit::force || unit == Unit::moment ||
         unit == Unit::energy;
}

/// Sizes of the columns that are wanted. @param counts  does a column count for one of them?
template <class Counts>
std::vector<double> sizes_of(const StudyResult& result, const Counts& counts) {
  const auto rows = rows_of(result);
  std::vector<double> usual(result.quantities.size());
  UnitSizes sizes;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    if (!counts(i)) continue;
    usual[i] = usual_size(rows, i);
    double& size = sizes[unit_of(result, i)];
    size = std::max(size, usual[i]);
  }
  const auto at_least = [&sizes](Unit unit, double size) {
    sizes[unit] = std::max(sizes[unit], size);
  };
  at_least(Unit::angle, 1);
  const double length = sizes[Unit::length];
  if (length > 0) at_least(Unit::force, sizes[Unit::moment] / length);
  const double moment = std::max(sizes[Unit::moment], sizes[Unit::force] * length);
  at_least(Unit::moment, moment);
  at_least(Unit::energy, moment);
  // Pure numbers have nothing in common: each column stands for itself.
  for (std::size_t i = 0; i < usual.size(); ++i)
    if (unit_of(result, i) != Unit::none) usual[i] = sizes[unit_of(result, i)];
  return usual;
}

}  // namespace

std::vector<double> quantity_sizes(const StudyResult& result) {
  return sizes_of(result, [](std::size_t) { return true; });
}

double quantity_size(const StudyResult& result, std::size_t column) {
  const Unit wanted = unit_of(result, column);
  const auto counts = [&](std::size_t i) {
    const Unit unit = unit_of(result, i);
    return i == column || (unit == wanted && unit != Unit::none) ||
           (is_mechanical(unit) && is_mechanical(wanted));
  };
  return sizes_of(result, counts)[column];
}

double shown_in(const std::vector<double>& sizes, std::size_t column, double value) {
  return column < sizes.size() ? shown_against(value, sizes[column]) : value;
}

}  // namespace springfold::io
