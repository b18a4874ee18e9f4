// Springs over thirty orders of magnitude in one column: it buckles where it should, and bends beside that load.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "case_runs.hpp"
#include "number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// Links one above the other on hinges with springs, pressed from above, and a little from the side.
std::string column(const std::vector<double>& springs, const std::vector<double>& links,
                   double aside, const std::string& lambda) {
  std::string elements;
  double height = 0;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const std::string name = "q" + std::to_string(i + 1);
    elements += R"({ joint = "revolute", axis = "z", name = ")" + name +
                R"(", role = "preloaded", spring = { law = "linear", stiffness = )" +
                number(springs[i]) + " } }, { rigid = [0, " + number(links[i]) + "] }, ";
    height += links[i];
  }
  return R"toml(
[[body]]
name = "top"
task_space = "xy"
pose = [0, )toml" +
         number(height) + "]\n[[chain]]\nname = \"a\"\nelements = [ " + elements + R"toml(]
[[study]]
name = "press"
control = "load"
direction = [)toml" +
         number(aside) + ", -1]\nuntil = { lambda = " + lambda +
         ", a.q1 = [-2, 2], a.q2 = [-2, 2] }\nbranches = { depth = 0 }\n";
}

/// Loads at the branch points, in order; every other event is an end.
std::vector<double> branch_loads(const StudyResult& result) {
  std::vector<double> loads;
  for (const auto& event : result.branches.at(0).events) {
    if (event.kind == EventKind::end_of_range) continue;
    EXPECT_EQ(event.kind, EventKind::branch_point);
    loads.push_back(value(result, event.row, "lambda"));
  }
  return loads;
}

/// In the angles of the links K = [k1 + k2, -k2; -k2, k2]: lambda^2 - (k1 + 2 k2) lambda + k1 k2 = 0.
TEST(OrdersOfStiffness, HaveBothBucklingLoadsOfAColumnThirtyOrdersApart) {
  for (const auto& [foot, middle] :
       {std::pair{1.0, 1e-18}, {1.0, 1e-25}, {3e-22, 0.017}, {5e-28, 2.0}}) {
    const double sum = foot + 2 * middle;
    const double large = (sum + std::sqrt(sum * sum - 4 * foot * middle)) / 2;
    const double small = foot * middle / large;
    const StudyResult result =
        run(column({foot, middle}, {1, 1}, 0,
                   "[" + number(-0.1 * large) + ", " + number(1.3 * large) + "]"))
            .of("press");
    EXPECT_TRUE(complete(result)) << foot << " " << middle;
    const std::vector<double> loads = branch_loads(result);
    ASSERT_EQ(loads.size(), 2u) << foot << " " << middle;
    EXPECT_NEAR(loads[0] / small, 1, 1e-9);
    EXPECT_NEAR(loads[1] / large, 1, 1e-9);
    EXPECT_EQ(value(result, 0, "index"), 0);
    EXPECT_EQ(value(result, result.branches[0].samples.size() - 1, "index"), 2);
  }
}

/// k q = 2 lambda (sin q - a cos q) with the other hinge as good as rigid: the column leans more and more, and is
/// stable.
TEST(OrdersOfStiffness, LetAColumnPressedAskewBendBesideItsSoftestSpring) {
  for (const double foot : {1e-18, 5e-27})
    for (const double aside : {4e-5, 0.02}) {
      const StudyResult result =
          run(column({foot, 0.3}, {1, 1}, aside, "[-0.05, 0.7]")).of("press");
      EXPECT_TRUE(complete(result)) << foot << " " << aside;
      EXPECT_THAT(branch_loads(result), testing::IsEmpty()) << foot << " " << aside;
      for (std::size_t row = 0; row < result.branches.at(0).samples.size(); ++row) {
        EXPECT_EQ(value(result, row, "index"), 0) << foot << " " << aside;
        const double q = value(result, row, "a.q1"), lambda = value(result, row, "lambda");
        const double moment =
            2 * lambda / std::hypot(1, aside) * (std::sin(q) - aside * std::cos(q));
        EXPECT_NEAR(moment / foot, q, 1e-8 * std::max(1.0, std::abs(2 * lambda / foot)))
            << foot << " " << aside;
      }
    }
}

/// What is stable under its load is so if the way of the load is driven: its displacement, of 1e-17 here, goes on.
TEST(OrdersOfStiffness, LetNothingTurnBackAlongTheLoadWhileItIsStable) {
  const StudyResult result =
      run(column({7.02e-10, 7.809e-12, 6.052e-14, 1.91e-13}, {0.54, 0.647, 0.952, 0.335},
                 3.96681250347641e-09, "[-1.3e-10, 1.7e-9]"))
          .of("press");
  EXPECT_TRUE(complete(result));
  EXPECT_THAT(branch_loads(result), testing::IsEmpty());
}

/// Two links on a soft hinge k, whose load leads past it, and a stiff one of 1.
StudyResult arm(double k) {
  return run(R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0.7214027689288547, -1.695413070290583]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "q0", role = "preloaded", initial = -0.769, spring = { law = "linear", stiffness = )toml" +
             number(k) + R"toml(, free = -0.769 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "q1", role = "preloaded", initial = -0.799, spring = { law = "linear", stiffness = 1, free = -0.799 } },
  { rigid = [1, 0] },
]
[[study]]
name = "pull"
control = "load"
direction = [1, 0]
until = { lambda = [-1, 1], arm.q0 = [-12, 12], arm.q1 = [-12, 12] }
)toml")
      .of("pull");
}

/// The soft hinge turns until the load leads through it; from there on it is as good as none, however soft it is.
TEST(OrdersOfStiffness, LetAnArmTurnOverOneSoftHingeToTheSamePlacesHoweverSoftItIs) {
  const StudyResult firm = arm(1e-9);
  const std::size_t end = firm.branches.at(0).samples.size() - 1;
  for (const double k : {1e-12, 1e-14, 1e-16}) {
    const StudyResult soft = arm(k);
    EXPECT_TRUE(complete(soft)) << k;
    EXPECT_THAT(branch_loads(soft), testing::IsEmpty()) << k;
    const std::size_t last = soft.branches.at(0).samples.size() - 1;
    EXPECT_NEAR(value(soft, 0, "lambda"), -1, 1e-12) << k;
    EXPECT_NEAR(value(soft, last, "lambda"), 1, 1e-12) << k;
    for (const char* joint : {"arm.q0", "arm.q1"}) {
      EXPECT_NEAR(value(soft, 0, joint), value(firm, 0, joint), 2e-8) << k;
      EXPECT_NEAR(value(soft, last, joint), value(firm, end, joint), 2e-8) << k;
    }
  }
}

}  // namespace
}  // namespace springfold::io
