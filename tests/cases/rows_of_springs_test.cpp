// Rows of springs, each as stiff as it likes: spring i is stretched by load / k_i, whatever the others are, and node i
// moves by the sum of what lies before it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::ElementsAre;
using Stiffnesses = std::vector<double>;

std::string node_of_row(std::size_t i) { return "n" + std::to_string(i); }

/// Nodes n1, n2, ... at x = 1, 2, ..., the last one loaded.
std::string row_of_springs(const Stiffnesses& row, double load, const std::string& study) {
  std::string text = "[[node]]\nname = \"n0\"\nat = [0, 0]\nfixed = true\n";
  for (std::size_t i = 1; i <= row.size(); ++i)
    text += "[[node]]\nname = \"" + node_of_row(i) + "\"\nat = [" + std::to_string(i) +
            ", 0]\nfixed = [\"y\"]\n[[bar]]\nname = \"b" + std::to_string(i) + "\"\nfrom = \"" +
            node_of_row(i - 1) + "\"\nto = \"" + node_of_row(i) +
            "\"\nstiffness = " + number(row[i - 1]) + "\n";
  return text + "[[study]]\nname = \"row\"\nbody = \"" + node_of_row(row.size()) + "\"\nload = [" +
         number(load) + ", 0]\n" + study;
}

/// @param at  value of a quantity
template <class At>
void expect_stretched(const Stiffnesses& row, double load, const At& at) {
  double moved = 0;
  for (std::size_t i = 1; i <= row.size(); ++i) {
    moved += load / row[i - 1];
    const double place = static_cast<double>(i);
    EXPECT_NEAR(at(node_of_row(i) + ".x") - place, moved,
                1e-8 * std::abs(moved) + 1e-15 * static_cast<double>(row.size() + 1))
        << "node " << i << ", load " << load << ", springs " << testing::PrintToString(row);
  }
}

const Stiffnesses rows_of_springs[] = {
    {1e8, 1e-2}, {1e8, 1e-4}, {1e8, 1e-6},       {1e8, 1e-8},          {1e4, 1e-6},
    {1e-2, 1e8}, {1e-6, 1e7}, {1e8, 1e-8, 1e-3}, {3e-4, 1e8, 2e-6, 5}, {1e-8, 1e-4, 1e7, 0.04}};

double softest_of(const Stiffnesses& row) { return *std::min_element(row.begin(), row.end()); }

TEST(RowsOfSprings, StretchByTheirLoadsHoweverStiffTheOthersAre) {
  for (const Stiffnesses& row : rows_of_springs)
    for (const double stretch : {1e-17, 1e-14, 1e-12, -1e-9, 1e-6, 1e-4, -1e-2, 0.3}) {
      const double load = stretch * softest_of(row);
      const StudyResult result =
          run(row_of_springs(row, load, "kind = \"equilibrium\"\n")).of("row");
      ASSERT_TRUE(result.start.found);
      expect_stretched(row, load, [&](const std::string& q) { return value(result, 0, q); });
    }
}

TEST(RowsOfSprings, StretchByTheirLoadsInSearchesForAllEquilibria) {
  for (const Stiffnesses& row : rows_of_springs)
    for (const double stretch : {1e-12, 1e-6, -1e-2}) {
      const double load = stretch * softest_of(row);
      const StudyResult result =
          run(row_of_springs(row, load, "kind = \"equilibria\"\nsearch = { starts = 1 }\n"))
              .of("row");
      ASSERT_TRUE(result.equilibria);
      ASSERT_EQ(result.equilibria->list.size(), 1u);
      expect_stretched(row, load, [&](const std::string& q) {
        return result.equilibria->list[0].sample.values[column(result, q)];
      });
    }
}

TEST(RowsOfSprings, StretchByTheirLoadsWherePathsBegin) {
  for (const Stiffnesses& row : rows_of_springs)
    for (const double stretch : {1e-12, 1e-6, 1e-2}) {
      const double load = stretch * softest_of(row);
      const StudyResult result =
          run(row_of_springs(row, load,
                             "control = \"load\"\ndirection = [1, 0]\nuntil = { lambda = [0, " +
                                 number(load) + "] }\n"))
              .of("row");
      ASSERT_TRUE(result.start.found);
      expect_stretched(row, load, [&](const std::string& q) { return value(result, 0, q); });
    }
}

TEST(RowsOfSprings, StretchByTheirLoadsWhereThereAreMany) {
  Stiffnesses row(60, 1.0);
  row[7] = 1e7;
  row[20] = 2e-5;
  row[21] = 3e6;
  row[59] = 40;
  for (const double stretch : {1e-11, 1e-6, 1e-2}) {
    const double load = stretch * softest_of(row);
    const StudyResult result = run(row_of_springs(row, load, "kind = \"equilibrium\"\n")).of("row");
    ASSERT_TRUE(result.start.found);
    expect_stretched(row, load, [&](const std::string& q) { return value(result, 0, q); });
  }
}

/// Each spring may be turned over, its second node on the other side of the first, and is stretched by as much.
TEST(RowsOfSprings, TurnedOverAreFoundHoweverStiffTheyAre) {
  for (const double stiff : {1e5, 1e7, 1e9}) {
    const Stiffnesses row{stiff, 1e-3};
    constexpr double load = 1e-5;
    const StudyResult result =
        run(row_of_springs(row, load, "kind = \"equilibria\"\nsearch = { starts = 60 }\n"))
            .of("row");
    ASSERT_TRUE(result.equilibria);
    EXPECT_GE(result.equilibria->list.size(), 3u) << stiff;
    for (const auto& equilibrium : result.equilibria->list) {
      const auto at = [&](const std::string& q) {
        return equilibrium.sample.values[column(result, q)];
      };
      EXPECT_NEAR(std::abs(at("n1.x") - load / stiff), 1, 1e-12);
      EXPECT_NEAR(std::abs(at("n2.x") - at("n1.x") - load / 1e-3), 1, 1e-12);
    }
  }
}

/// A drive along x at the begin of the row puts its end to the targets: it stands where these are, less what the
/// springs give.
TEST(RowsOfSprings, AreHeldByTheirDrives) {
  const Stiffnesses rows[] = {
      {3e1, 1e-6}, {7e-4, 3e3}, {6e1, 2e-4, 1e-5}, {7e6, 2e-6}, {1e-4, 1e2}};
  for (const Stiffnesses& row : rows)
    for (const double stretch : {1e-9, -1e-4, 3e-2}) {
      const double load = stretch * softest_of(row), end = static_cast<double>(row.size());
      std::string text = row_of_springs(row, load,
                                        "kind = \"control\"\nprescribe = [\"x\"]\ncommands = "
                                        "[\"drive.u\"]\ntargets = [[" +
                                            number(end) + "], [" + number(end + 0.01) + "]]\n");
      text.replace(0, text.find("[[node]]", 1),
                   "[[body]]\nname = \"n0\"\ntask_space = \"xy\"\npose = [0, 0]\n[[chain]]\nname = "
                   "\"drive\"\nto = \"n0\"\nelements = [{ joint = \"prismatic\", axis = \"x\", "
                   "name = \"u\", role = \"actuated\", value = 0 }]\n");
      const StudyResult result = run(text).of("row");
      ASSERT_TRUE(result.start.found) << text;
      double given = 0;
      for (const double k : row) given += load / k;
      EXPECT_NEAR(value(result, 0, "drive.u.rho"), -given, 1e-8 * std::abs(given) + 1e-14) << text;
    }
}

/// One slider on a spring of stiffness 1 with a stop beyond `from`: lambda = x, and x + stop (x - from) behind.
void expect_slider_passes(double at, double stop, double from, double until) {
  const std::string text = "[[node]]\nname = \"a\"\nat = [" + number(at) +
                           ", 0]\nfixed = [\"y\"]\n[[node]]\nname = \"g\"\nat = [" +
                           number(at - 1) +
                           ", 0]\nfixed = true\n[[bar]]\nname = \"spring\"\nfrom = \"g\"\nto = "
                           "\"a\"\nlaw = { law = \"linear\", stiffness = 1 }\n[[bar]]\nname = "
                           "\"stop\"\nfrom = \"g\"\nto = \"a\"\nlaw = { law = \"one_sided\", "
                           "stiffness = " +
                           number(stop) + ", from = " + number(from) +
                           " }\n[[study]]\nname = \"push\"\nbody = \"a\"\ncontrol = \"load\"\n"
                           "direction = [1, 0]\nuntil = { lambda = [-0.4, " +
                           number(until) + "] }\n";
  SCOPED_TRACE(text);
  const StudyResult result = run(text).of("push");
  std::vector<EventKind> kinds;
  for (const auto& event : result.branches.at(0).events) kinds.push_back(event.kind);
  EXPECT_THAT(kinds,
              ElementsAre(EventKind::end_of_range, EventKind::switching, EventKind::end_of_range));
  for (std::size_t i = 0; i < result.branches.at(0).samples.size(); ++i) {
    const double lambda = value(result, i, "lambda");
    const double x = lambda <= from ? lambda : from + (lambda - from) / (1 + stop);
    EXPECT_NEAR(value(result, i, "a.x") - at, x, 1e-12);
  }
}

TEST(RowsOfSprings, RunOntoStiffStopsWhereverTheseBegin) {
  for (const double at : {0.0, 1.0})
    for (const double stop : {1e3, 1e6, 1e7, 1e8, 1e10})
      for (const double from : {1e-3, 0.01, 0.05, 0.1, 0.2, 0.123456})
        for (const double until : {0.3, 17.0}) expect_slider_passes(at, stop, from, until);
}

}  // namespace
}  // namespace springfold::io
