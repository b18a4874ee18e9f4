// Rows of springs that switch, stiff and soft ones side by side, many of them at rest where the path begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "switching_row.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

RowSpring linear_spring(int from, int to, double k) {
  return {from, to, {}, {k}, "law = \"linear\", stiffness = " + number(k)};
}

RowSpring spring_above(int from, int to, double k, double at) {
  return {from,
          to,
          {at},
          {0, k},
          "law = \"one_sided\", stiffness = " + number(k) + ", from = " + number(at)};
}

RowSpring spring_below(int from, int to, double k, double at) {
  RowSpring s = spring_above(from, to, k, at);
  s.law += ", side = \"below\"";
  s.stiffness = {k, 0};
  return s;
}

RowSpring gap_spring(int from, int to, double k, double low, double high) {
  return {from,
          to,
          {low, high},
          {k, 0, k},
          "law = \"gap\", stiffness = " + number(k) + ", low = " + number(low) +
              ", high = " + number(high)};
}

RowSpring stopped_spring(int from, int to, double k, double stop, double low, double high) {
  const Real both = static_cast<Real>(k) + static_cast<Real>(stop);
  return {from,
          to,
          {low, high},
          {both, k, both},
          "law = \"stops\", stiffness = " + number(k) + ", stop_stiffness = " + number(stop) +
              ", low = " + number(low) + ", high = " + number(high)};
}

/// Stiffnesses of five sizes from 10^-exponent to 10^exponent.
Row drawn_row(unsigned seed, double exponent) {
  std::mt19937 generator(seed);
  const auto below = [&generator](int n) {
    return static_cast<int>(generator() % static_cast<unsigned>(n));
  };
  const auto stiffness = [&] {
    const double digits = (10 + below(90)) / 10.0;
    return digits * std::pow(10.0, std::round(exponent * (below(5) - 2) / 2));
  };
  Row row{.bodies = 1 + below(4), .unit = below(3) == 0 ? 1000.0 : 1.0};
  const auto switching = [&](int from, int to) {
    const double thresholds[] = {0, 0, 0, 0.01, 0.1, 1e-6};
    const double at = thresholds[below(6)] * row.unit, k = stiffness();
    switch (below(5)) {
      case 0:
        return linear_spring(from, to, k);
      case 1:
        return spring_above(from, to, k, at);
      case 2:
        return spring_below(from, to, k, -at);
      case 3:
        return gap_spring(from, to, k, below(2) == 0 ? 0 : -0.05 * row.unit, 0.1 * row.unit);
      default:
        return stopped_spring(from, to, k, stiffness(), -at, at + 0.02 * row.unit);
    }
  };
  for (int i = 0; i < row.bodies; ++i) row.springs.push_back(linear_spring(i - 1, i, stiffness()));
  for (int i = 0; i < row.bodies; ++i)
    for (int more = below(4); more > 0; --more) row.springs.push_back(switching(-1, i));
  if (row.bodies > 2 && below(2) == 0) row.springs.push_back(switching(0, 2));
  return row;
}

/// Names of the springs in an event's sentence.
std::set<std::string> springs_in(const std::string& text) {
  std::set<std::string> names;
  const std::string word = "spring ";
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const auto begin = at + word.size();
    names.insert(text.substr(begin, text.find(' ', begin) - begin));
  }
  return names;
}

std::set<std::string> without(std::set<std::string> names, const std::set<std::string>& some) {
  for (const std::string& name : some) names.erase(name);
  return names;
}

/// All switchings of both sides in the order of the load, as the straight pieces have them.
std::vector<Switching> true_switchings(const Row& row, double most_load,
                                       std::set<std::string>& idle) {
  const Real most = 0.6L * static_cast<Real>(row.unit);
  const RowPath up = row_path(row, 1, most_load, most), down = row_path(row, -1, most_load, most);
  idle = idle_springs(row, up.first, 1);
  for (const std::string& name : idle_springs(row, down.first, -1)) idle.insert(name);
  std::vector<Switching> all(down.switchings.rbegin(), down.switchings.rend());
  Switching start{0, 0, {}, std::vector<Real>(static_cast<std::size_t>(row.bodies), 0)};
  for (std::size_t k = 0; k < row.springs.size(); ++k)
    if (up.first[k] != down.first[k]) start.names.insert(spring_name(k));
  all.push_back(start);
  all.insert(all.end(), up.switchings.begin(), up.switchings.end());
  for (Switching& one : all) one.names = without(one.names, idle);
  std::erase_if(all, [](const Switching& one) { return one.names.empty(); });
  return all;
}

/// Thresholds nearer than this may be told as one.
bool are_apart(const Row& row, double most_load) {
  std::set<std::string> idle;
  const std::vector<Switching> all = true_switchings(row, most_load, idle);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    Real most = 0;
    for (std::size_t k = 0; k < all[i].x.size(); ++k)
      most = std::max(most, std::abs(all[i + 1].x[k] - all[i].x[k]));
    if (most < Real{1e-8} * static_cast<Real>(row.unit)) return false;
  }
  return true;
}

void expect_true_switchings(const Row& row, double most_load, int depth = 0) {
  const StudyResult result = run(row_text(row, most_load, depth)).of("p");
  EXPECT_TRUE(complete(result));
  EXPECT_EQ(result.branches.size(), 1u);
  std::set<std::string> idle;
  const std::vector<Switching> expected = true_switchings(row, most_load, idle);
  std::vector<const analysis::Event*> told;
  for (const auto& event : result.branches.at(0).events) {
    EXPECT_TRUE(event.kind == EventKind::switching || event.kind == EventKind::end_of_range)
        << event.label << " " << event.detail;
    if (event.kind == EventKind::switching && !without(springs_in(event.detail), idle).empty())
      told.push_back(&event);
  }
  ASSERT_EQ(told.size(), expected.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(without(springs_in(told[i]->detail), idle), expected[i].names) << told[i]->detail;
    EXPECT_NEAR(value(result, told[i]->row, "deflection"), static_cast<double>(expected[i].last),
                1e-9 * row.unit);
  }
}

TEST(SwitchingRows, SwitchWhereTheirStraightPiecesMeet) {
  for (const double exponent : {1.0, 2.0, 3.0, 4.0, 5.0})
    for (unsigned seed = 1; seed <= 25; ++seed) {
      SCOPED_TRACE(number(exponent) + ", draw " + std::to_string(seed));
      const Row row = drawn_row(seed + 1000 * static_cast<unsigned>(exponent), exponent);
      const double most_load = row.unit * std::pow(10.0, seed % 5 - 2.0);
      if (are_apart(row, most_load)) expect_true_switchings(row, most_load, seed % 3 == 0);
    }
}

TEST(SwitchingRows, ThatRestAcrossAStiffMemberHaveBothHalvesOfTheirPath) {
  expect_true_switchings({3,
                          1,
                          {linear_spring(-1, 0, 1e4), linear_spring(0, 1, 1e8),
                           gap_spring(-1, 1, 1, 0, 0.1), linear_spring(1, 2, 1e-4)}},
                         6e-5);
}

TEST(SwitchingRows, ThatOnlySoftSpringsHoldHaveOneCurveThroughTheirStart) {
  // Beside their stiff springs these leave a share of 1e-12 to 1e-10, which nothing near the start makes zero.
  const Row stiff_between{
      4,
      1,
      {linear_spring(-1, 0, 5.5e-5), linear_spring(0, 1, 4.4e5), linear_spring(1, 2, 980),
       linear_spring(2, 3, 9.8e-5), spring_above(-1, 3, 980, 0)}},
      soft_between{
          4,
          1000,
          {linear_spring(-1, 0, 3.6e-7), linear_spring(0, 1, 8.2), linear_spring(1, 2, 4.5e-7),
           linear_spring(2, 3, 9e4), spring_below(-1, 3, 1.1e-4, 0)}};
  for (const Row& row : {stiff_between, soft_between})
    for (const int depth : {0, 1}) expect_true_switchings(row, 0.1 * row.unit, depth);
}

TEST(SwitchingRows, ASpringThatHasHardlyLeftItsThresholdTakesNoPartInTheNextSwitching) {
  const Row row{4,
                1000,
                {linear_spring(-1, 0, 1e-3), linear_spring(0, 1, 1e-3), linear_spring(1, 2, 1),
                 linear_spring(2, 3, 0.06), spring_below(-1, 0, 1e3, 0), linear_spring(-1, 2, 1e3),
                 gap_spring(-1, 3, 1, -50, 100)}};
  for (const int depth : {0, 1}) expect_true_switchings(row, 20, depth);
}

TEST(SwitchingRows, TwoThresholdsThatAreNearlyReachedAtOnceAreToldOneAfterTheOther) {
  // 5e-10 apart along the path.
  const Row row{
      3,
      1,
      {linear_spring(-1, 0, 1.6), linear_spring(0, 1, 1.8), linear_spring(1, 2, 1800),
       spring_below(-1, 1, 1500, -1e-6), linear_spring(-1, 1, 0.057), spring_below(-1, 2, 31, 0),
       stopped_spring(-1, 2, 0.037, 1.2, -1e-6, 0.020001), spring_above(-1, 2, 850, 0)}};
  expect_true_switchings(row, 100, 1);
}

TEST(SwitchingRows, ThresholdsThatLieInDifferentRowsAreToldOneAfterTheOtherHoweverNear) {
  // Behind the first one, which is stiff, the load grows by much before the next one, 3e-10 farther.
  for (const double apart : {3e-10, 1e-9, 2e-9})
    for (const double stiff : {1.0, 1e3, 1e5}) {
      SCOPED_TRACE(number(apart) + ", " + number(stiff));
      expect_true_switchings({1,
                              1,
                              {linear_spring(-1, 0, 1), spring_above(-1, 0, stiff, 0.1),
                               spring_above(-1, 0, 3, 0.1 + apart)}},
                             1);
      expect_true_switchings({2,
                              1,
                              {linear_spring(-1, 0, 1), linear_spring(0, 1, 20),
                               spring_below(-1, 0, stiff, -0.1 - apart),
                               spring_below(-1, 0, 3, -0.1), spring_above(-1, 1, 2, 0.2)}},
                             1, 1);
    }
}

TEST(SwitchingRows, SwitchAtTheStartThoughTheNextThresholdIsPassedAtOnce) {
  expect_true_switchings(
      {1, 1, {linear_spring(-1, 0, 1), spring_above(-1, 0, 2, 0), spring_above(-1, 0, 3, 7e-10)}},
      1);
}

TEST(SwitchingRows, NameASpringOnceWhereBothEndsOfItsGapArePassed) {
  const Row row{
      1, 1, {linear_spring(-1, 0, 1), gap_spring(-1, 0, 3, 0, 1e-12), spring_above(-1, 0, 2, 0)}};
  const StudyResult result = run(row_text(row, 1)).of("p");
  int named = 0;
  for (const auto& event : result.branches.at(0).events)
    for (auto at = event.detail.find("spring b1"); at != std::string::npos;
         at = event.detail.find("spring b1", at + 1))
      ++named;
  EXPECT_EQ(named, 1);
}

}  // namespace
}  // namespace springfold::io
