// Load steps that begin at a limit point of another study: along its own load they repeat that study, shifted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// A point held by two bars of free length zero and more, pulled along the line of its first study, then again from
/// there.
std::string two_bars(double first, double second) {
  const std::string study =
      "body = \"n0\"\ncontrol = \"load\"\nbranches = { depth = 1 }\ndirection = [0.78, 0.63]\n"
      "until = { n0.x = [-0.228, 0.472], n0.y = [-0.388, 0.312] }\n";
  return "[[node]]\nname = \"n0\"\nat = [0.122, -0.038]\n[[node]]\nname = \"f0\"\nat = [-1.249, "
         "0.933]\nfixed = true\n[[node]]\nname = \"f1\"\nat = [0.084, -1.203]\nfixed = true\n"
         "[[bar]]\nname = \"b0\"\nfrom = \"f0\"\nto = \"n0\"\nfree = 1.68\nlaw = { law = "
         "\"linear\", "
         "stiffness = " +
         number(first) +
         ", free = 0.0 }\n[[bar]]\nname = \"b1\"\nfrom = \"f1\"\nto = \"n0\"\nfree = 1.1656\nlaw = "
         "{ "
         "law = \"linear\", stiffness = " +
         number(second) + ", free = 0.0 }\n[[study]]\nname = \"p\"\n" + study +
         "[[study]]\nname = \"q\"\nstart = { from = \"p\", at = \"LP1\" }\n" + study;
}

TEST(StepsFromLimitPoints, AlongTheSameLoadRepeatThePathFromThere) {
  for (const double unit : {1e-3, 1.0, 1e5})
    for (const double second : {0.3, 0.08, 0.065, 0.05, 0.03}) {
      SCOPED_TRACE(number(unit) + ", " + number(second));
      const Ran ran = run(two_bars(0.3 * unit, second * unit));
      const StudyResult &p = ran.of("p"), &q = ran.of("q");
      EXPECT_TRUE(complete(q));
      const auto before = lambdas(p, EventKind::limit_point),
                 after = lambdas(q, EventKind::limit_point);
      ASSERT_FALSE(before.empty());
      ASSERT_EQ(after.size(), before.size());
      EXPECT_NEAR(after[0], 0, 1e-10 * unit);
      const auto ends = lambdas(p, EventKind::end_of_range),
                 again = lambdas(q, EventKind::end_of_range);
      ASSERT_EQ(again.size(), ends.size());
      // Both may be numbered from either side.
      for (const double end : ends) {
        double off = 1;
        for (const double other : again)
          off = std::min(off, std::abs(other + before[0] - end) / unit);
        EXPECT_LT(off, 1e-9);
      }
    }
}

/// A slider on k x - x^3 + 0.2 x^5, pulled up to its limit point: a study that begins there with the loads as they are
/// begins there, whatever rounding makes of a matrix that is singular.
TEST(StepsFromLimitPoints, BeginAtThemWhereNothingIsAdded) {
  for (int i = 0; i < 20; ++i) {
    const double k = 1.01 + 0.01 * i;
    const auto ran = run(
        "[[body]]\nname = \"t\"\ntask_space = \"xy\"\n[[chain]]\nname = \"s\"\nelements = [{ joint "
        "= "
        "\"prismatic\", axis = \"x\", name = \"x\", role = \"preloaded\", spring = { law = "
        "\"polynomial\", coefficients = [0, " +
        std::to_string(k) +
        ", 0, -1, 0, 0.2], falling = true } }]\n[[study]]\nname = \"pull\"\ncontrol = \"load\"\n"
        "direction = [1, 0]\nuntil = { t.x = [-2, 2.5] }\n[[study]]\nname = \"push\"\ncontrol = "
        "\"mixed\"\ndirection = [1, 0]\nstart = { from = \"pull\", at = \"LP1\" }\nuntil = { t.x = "
        "[-3, "
        "3] }\n");
    const auto& start = ran.of("push").start;
    ASSERT_TRUE(start.found) << k;
    EXPECT_LE(start.moved, 1e-6) << k;
  }
}

}  // namespace
}  // namespace springfold::io
