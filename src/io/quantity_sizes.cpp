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

void take(const StudyResult& result, const std::vector<double>& values, UnitSizes& sizes) {
  for (std::size_t i = 0; i < std::min(values.size(), result.quantities.size()); ++i) {
    const Unit unit = result.quantities[i].unit;
    double& size = sizes[unit == Unit::lambda ? result.lambda_unit : unit];
    if (std::isfinite(values[i])) size = std::max(size, std::abs(values[i]));
  }
}

}  // namespace

std::vector<double> quantity_sizes(const StudyResult& result) {
  UnitSizes sizes;
  for (const analysis::Branch& branch : result.branches)
    for (const analysis::Sample& row : branch.samples) take(result, row.values, sizes);
  if (result.equilibria)
    for (const analysis::Equilibrium& at : result.equilibria->list)
      take(result, at.sample.values, sizes);
  const auto at_least = [&sizes](Unit unit, double size) {
    sizes[unit] = std::max(sizes[unit], size);
  };
  at_least(Unit::angle, 1);
  const double length = sizes[Unit::length];
  if (length > 0) at_least(Unit::force, sizes[Unit::moment] / length);
  const double moment = std::max(sizes[Unit::moment], sizes[Unit::force] * length);
  at_least(Unit::moment, moment);
  at_least(Unit::energy, moment);
  std::vector<double> list;
  for (const analysis::Quantity& q : result.quantities) {
    const Unit unit = q.unit == Unit::lambda ? result.lambda_unit : q.unit;
    // Pure numbers have nothing in common.
    list.push_back(unit == Unit::none ? 0 : sizes[unit]);
  }
  return list;
}

double shown_in(const std::vector<double>& sizes, std::size_t column, double value) {
  return column < sizes.size() ? shown_against(value, sizes[column]) : value;
}

}  // namespace springfold::io
