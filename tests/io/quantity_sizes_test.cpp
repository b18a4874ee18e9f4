#include "io/quantity_sizes.hpp"

#include <gtest/gtest.h>

namespace springfold::io {
namespace {

using analysis::Unit;

/// Stiffness of a map of eleven nodes, the last one as given, and a force without value but for rounding.
analysis::StudyResult map_with(double last) {
  analysis::StudyResult result;
  result.quantities = {
      {"stiffness", Unit::force}, {"force", Unit::force}, {"condition", Unit::none}};
  result.branches.emplace_back();
  for (int i = 0; i < 10; ++i)
    result.branches.front().samples.push_back({{4.0 + i, 1e-16, 2.0}, "", ""});
  result.branches.front().samples.push_back({{last, -2e-16, last}, "", ""});
  return result;
}

TEST(QuantitySizes, ASingularNodeMakesNothingElseZero) {
  const auto sizes = quantity_sizes(map_with(2e17));
  EXPECT_EQ(shown_in(sizes, 0, 4.0), 4.0);
  EXPECT_EQ(shown_in(sizes, 1, 1.0), 1.0);
  EXPECT_EQ(shown_in(sizes, 2, 2.0), 2.0);
  EXPECT_EQ(shown_in(sizes, 0, 2e17), 2e17);
}

TEST(QuantitySizes, WhatIsRoundingBesideTheUsualValuesOfItsUnitIsZero) {
  const auto sizes = quantity_sizes(map_with(14));
  EXPECT_EQ(shown_in(sizes, 1, -2e-16), 0.0);
}

TEST(QuantitySizes, OfAFewRowsTheLargestCounts) {
  analysis::StudyResult result = map_with(1);
  auto& rows = result.branches.front().samples;
  rows = {{{0.0, 1e-16, 1.0}, "", ""}, {{3.0, 0.0, 1.0}, "", ""}};
  EXPECT_EQ(shown_in(quantity_sizes(result), 1, 1e-16), 0.0);
}

}  // namespace
}  // namespace springfold::io
