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

/// The largest size in every column.
void take(const std::vector<double>& values, std::vector<double>& largest) {
  for (std::size_t i = 0; i < std::min(values.size(), largest.size()); ++i)
    if (std::isfinite(values[i])) largest[i] = std::max(largest[i], std::abs(values[i]));
}

}  // namespace

std::vector<double> quantity_sizes(const StudyResult& result) {
  std::vector<double> largest(result.quantities.size());
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) take(row.values, largest);
  if (result.equilibria)
    for (const analysis::Equilibrium& at : result.equilibria->list) take(at.sample.values, largest);
  UnitSizes sizes;
  for (std::size_t i = 0; i < largest.size(); ++i) {
    double& size = sizes[unit_of(result, i)];
    size = std::max(size, largest[i]);
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
  for (std::size_t i = 0; i < largest.size(); ++i)
    if (unit_of(result, i) != Unit::none) largest[i] = sizes[unit_of(result, i)];
  return largest;
}

double shown_in(const std::vector<double>& sizes, std::size_t column, double value) {
  return column < sizes.size() ? shown_against(value, sizes[column]) : value;
}

}  // namespace springfold::io
