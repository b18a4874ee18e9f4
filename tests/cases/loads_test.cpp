// Loads, several bodies and springs from the start pose, from case files to results.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::ElementsAre;
using testing::HasSubstr;

/// Cranks of length 1 at the feet, all parallel, under a coupler; the first has a spring of 2.
std::string cranks(const std::vector<double>& feet) {
  std::string text = R"toml(
[[body]]
name = "coupler"
task_space = "planar"
pose = ["cos(1)", "sin(1)", 0]
)toml";
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const std::string at = std::to_string(feet[i]);
    text +=
        "[[chain]]\nname = \"" + std::string(1, static_cast<char>('a' + i)) + "\"\nfrom_at = [" +
        at + ", 0]\nto_at = [" + at + ", 0]\nelements = [" +
        R"({ joint = "revolute", axis = "z", name = "foot", initial = 1)" +
        (i == 0
             ? R"(, role = "preloaded", spring = { law = "linear", stiffness = 2, origin = "start" } },)"
             : " },") +
        R"({ rigid = [1, 0] }, { joint = "revolute", axis = "z", name = "head", initial = -1 }]
)";
  }
  return text;
}

const std::string push = R"(
[[study]]
name = "swing"
control = "mixed"
direction = [1, 0, 0]
until = { deflection = [-1.5, 0.4] }
)";

TEST(RedundantCranks, AreNamedAndChangeNoForceNorStabilityBeyondAQuarterTurn) {
  const Ran two = run(cranks({0, 1}) + push), three = run(cranks({0, 1, 0.4}) + push);
  const StudyResult &a = two.of("swing"), &b = three.of("swing");
  EXPECT_EQ(a.start.redundant.count, 0);
  EXPECT_EQ(b.start.redundant.count, 1);
  EXPECT_THAT(b.start.redundant.chains, ElementsAre("a", "b", "c"));
  EXPECT_LT(b.start.redundant.largest_dropped, 1e-12);
  EXPECT_GT(b.start.redundant.smallest_kept, 1e-3);
  EXPECT_TRUE(complete(b));
  EXPECT_THAT(summary_table(three.read, three.results),
              HasSubstr("1 of 9 closure equations, among chains a, b, c"));
  for (const StudyResult* result : {&a, &b}) {
    const std::size_t last = result->branches[0].samples.size() - 1;
    for (std::size_t row = 0; row <= last; row += 7) {
      // M = 2 (t - 1) is balanced by the force F at x = cos t: F = -2 (t - 1) / sin t.
      const double t = value(*result, row, "a.foot");
      EXPECT_NEAR(value(*result, row, "force"), -2 * (t - 1) / std::sin(t), 1e-10);
      EXPECT_EQ(value(*result, row, "index"), 0);
    }
  }
}

TEST(RedundantCranks, BuckleAtTheLoadOfTheMechanismWithoutTheRedundantOne) {
  // Straight up, pressed by P: 2 t = P sin t, so that P = 2 at the branch point.
  const std::string press = R"(
[[study]]
name = "press"
control = "load"
direction = [0, -1, 0]
start = { pose = [0, 1, 0] }
until = { lambda = [0, 4] }
)";
  for (const auto& feet : {std::vector<double>{0, 1}, {0, 1, 0.4}, {0, 1, 0.4, 2.5}}) {
    std::string text = cranks(feet);
    for (std::size_t at; (at = text.find("initial = 1")) != std::string::npos;)
      text.replace(at, 11, "initial = \"pi/2\"");
    for (std::size_t at; (at = text.find("initial = -1")) != std::string::npos;)
      text.replace(at, 12, "initial = \"-pi/2\"");
    const StudyResult result = run(text + press).of("press");
    EXPECT_EQ(result.start.redundant.count, static_cast<int>(feet.size()) - 2);
    ASSERT_EQ(lambdas(result, EventKind::branch_point).size(), 1u);
    EXPECT_NEAR(lambdas(result, EventKind::branch_point)[0], 2, 1e-9);
    EXPECT_EQ(value(result, 0, "index"), 0);
    EXPECT_EQ(value(result, result.branches[0].samples.size() - 1, "index"), 1);
  }
}

TEST(FlatCranks, AreAKinematicSingularityThatIsPassedAndSaysWhatIsNotSearched) {
  for (const std::vector<double>& feet : {std::vector<double>{0, 1}, {0, 2, -1}, {0, 2}}) {
    const StudyResult result = run(cranks(feet) + R"(
[[study]]
name = "press"
control = "load"
direction = [0, -1, 0]
until = { a.foot = [-1, 1.5] }
branches = { depth = 1 }
)")
                                   .of("press");
    EXPECT_THAT(lambdas(result, EventKind::branch_point), ElementsAre());
    // The spring of 2 is relaxed at the angle 1, and the load is its moment.
    const auto flat = lambdas(result, EventKind::kinematic_singularity);
    ASSERT_EQ(flat.size(), 1u);
    EXPECT_NEAR(flat[0], 2, 1e-8);
    ASSERT_EQ(result.junctions.size(), 1u);
    EXPECT_THAT(result.junctions[0].ways, ElementsAre(1, 1));
    EXPECT_FALSE(result.junctions[0].complete);
    EXPECT_THAT(result.junctions[0].why, HasSubstr("lose rank together"));
    EXPECT_FALSE(complete(result));
    EXPECT_TRUE(result.branches[0].forward.complete && result.branches[0].backward.complete);
    const std::size_t last = result.branches[0].samples.size() - 1;
    for (std::size_t row = 0; row <= last; row += 9)
      EXPECT_NEAR(value(result, row, "coupler.phi"), 0, 1e-9);
  }
}

TEST(FlatCranks, WithARedundantOneAreNamedWhetherTheyCanBePassedOrNot) {
  const StudyResult result = run(cranks({0, 1, 0.4}) + R"(
[[study]]
name = "press"
control = "load"
direction = [0, -1, 0]
until = { a.foot = [-1, 1.5] }
)")
                                 .of("press");
  std::string said = result.branches[0].forward.reason + result.branches[0].backward.reason;
  for (const auto& event : result.branches[0].events) said += event.detail;
  EXPECT_THAT(said, HasSubstr("kinematic singularity"));
  EXPECT_THAT(lambdas(result, EventKind::branch_point), ElementsAre());
}

TEST(FlatCranks, AsAStartAreSaidToBeAKinematicSingularity) {
  std::string text = cranks({0, 1});
  for (const auto& [old, with] :
       std::vector<std::pair<std::string, std::string>>{{"\"cos(1)\", \"sin(1)\"", "1, 0"},
                                                        {"initial = 1", "initial = 0"},
                                                        {"initial = -1", "initial = 0"}})
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old))
      text.replace(at, old.size(), with);
  const StudyResult result = run(text + R"(
[[study]]
name = "press"
control = "load"
direction = [0, -1, 0]
)")
                                 .of("press");
  EXPECT_THAT(result.start.situation,
              HasSubstr("a kinematic singularity: the closures of chains a, b"));
  EXPECT_FALSE(complete(result));
}

TEST(SpringOrigins, AreWhereTheMechanismStands) {
  const StudyResult result =
      run(cranks({0, 1}) + "[[study]]\nname = \"e\"\nkind = \"equilibrium\"").of("e");
  EXPECT_NEAR(value(result, 0, "energy"), 0, 1e-24);
  EXPECT_NEAR(value(result, 0, "a.foot"), 1, 1e-13);
}

TEST(LoadsOnPoints, OfAnOffsetBodyPointFollowTheBody) {
  // A force F on a planar body on a hinge with spring c, at the distance d beyond the link:
  // c t = F (l + d) cos t.
  const Ran ran = run(R"(
[[body]]
name = "tip"
task_space = "planar"
pose = [1, 0, 0]
[[chain]]
name = "arm"
elements = [{ joint = "revolute", axis = "z", name = "h", role = "virtual", stiffness = 3 }, { rigid = [1, 0] }]
[[study]]
name = "pull"
control = "load"
loads = [{ at = [0.5, 0], force = [0, 1], scale = "lambda" }, { moment = 0.3 }]
until = { lambda = [0, 5] }
)");
  const StudyResult& result = ran.of("pull");
  EXPECT_TRUE(result.non_conservative.empty());
  const std::size_t last = result.branches[0].samples.size() - 1;
  for (const std::size_t row : {std::size_t{0}, last / 2, last}) {
    const double t = value(result, row, "arm.h"), F = value(result, row, "lambda");
    EXPECT_NEAR(3 * t, 1.5 * F * std::cos(t) + 0.3, 1e-11);
  }
}

TEST(LoadsOnPoints, WithoutAPotentialAreSaidToBeSo) {
  const Ran ran = run(R"(
[[body]]
name = "tip"
task_space = "planar"
pose = [2, 0, 0]
[[chain]]
name = "arm"
elements = [
  { joint = "revolute", axis = "z", name = "a", role = "virtual", stiffness = 1 }, { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "b", role = "virtual", stiffness = 1 }, { rigid = [1, 0] }, { point = "end" }]
[[study]]
name = "follow"
control = "load"
loads = [{ name = "P", on = "arm.end", force = [-1, 0], follows = true, scale = "lambda" }]
until = { lambda = [0, 6] }
)");
  const StudyResult& result = ran.of("follow");
  EXPECT_THAT(result.non_conservative, ElementsAre("follower force P"));
  EXPECT_TRUE(lambdas(result, EventKind::branch_point).empty());
  EXPECT_TRUE(lambdas(result, EventKind::limit_point).empty());
  EXPECT_TRUE(std::isnan(value(result, 0, "index")));
  for (std::size_t row = 0; row < result.branches[0].samples.size(); row += 20)
    EXPECT_NEAR(value(result, row, "T_det"), 1, 1e-11);
  EXPECT_THAT(summary_table(ran.read, ran.results),
              HasSubstr("NON-CONSERVATIVE: follower force P"));
  EXPECT_THAT(summary_json(ran.read, ran.results), HasSubstr("\"conservative\": false"));
}

TEST(Counterweights, BalanceABeam) {
  const Ran ran = run(R"toml(
gravity = [0, -9.81]
[[body]]
name = "end"
task_space = "planar"
pose = ["2*cos(0.4)", "2*sin(0.4)", 0.4]
mass = 1.5
[[chain]]
name = "beam"
elements = [{ joint = "revolute", axis = "z", name = "h", initial = 0.4 }, { point = "weight", at = [-0.5, 0], mass = 6 }, { rigid = [2, 0] }]
[[study]]
name = "balance"
kind = "equilibrium"
)toml");
  const StudyResult& result = ran.of("balance");
  EXPECT_TRUE(result.start.found);
  EXPECT_EQ(result.start.zero_modes, 1);
  EXPECT_NEAR(value(result, 0, "beam.weight.x"), -0.5 * std::cos(0.4), 1e-13);
}

TEST(Cables, AreSlackOnOneSideAndPullOnTheOther) {
  // A point on two cables along x: the one that is longer than its rest length pulls.
  const std::string cable =
      R"(elements = [{ joint = "revolute", axis = "z", name = "foot", initial = FOOT },
  { joint = "prismatic", axis = "x", name = "cable", role = "virtual", initial = 1, spring = { law = "one_sided", stiffness = 4, from = 1.1 } }]
)";
  const auto with = [&cable](const std::string& foot) {
    std::string text = cable;
    return text.replace(text.find("FOOT"), 4, foot);
  };
  const Ran ran = run(R"(
[[body]]
name = "knot"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "left"
from_at = [-1, 0]
)" + with("0") + "[[chain]]\nname = \"right\"\nfrom_at = [1, 0]\n" +
                      with("\"pi\"") + R"(
[[study]]
name = "pull"
control = "pose"
direction = [1, 0]
until = { deflection = [-0.5, 0.5] }
)");
  const StudyResult& result = ran.of("pull");
  EXPECT_EQ(lambdas(result, EventKind::switching).size() +
                lambdas(result, EventKind::corner_limit_point).size(),
            2u);
  const std::size_t last = result.branches[0].samples.size() - 1;
  EXPECT_NEAR(value(result, last, "force"), 4 * 0.4, 1e-12);
  EXPECT_NEAR(value(result, last, "right.Fx"), 0, 1e-12);
  EXPECT_NEAR(value(result, 0, "force"), -4 * 0.4, 1e-12);
}

TEST(SeveralBodies, OfDifferentTaskSpacesJoinAndCarryLoads) {
  // A planar body on a hinge with spring c holds a point by a bar that only pulls along itself.
  const Ran ran = run(R"(
[[body]]
name = "arm"
task_space = "planar"
pose = [1, 0, 0]
[[body]]
name = "bob"
task_space = "xy"
pose = [1, -1]
[[chain]]
name = "hinge"
to = "arm"
elements = [{ joint = "revolute", axis = "z", name = "h", role = "virtual", stiffness = 5 }, { rigid = [1, 0] }]
[[chain]]
name = "string"
from = "arm"
to = "bob"
elements = [{ joint = "revolute", axis = "z", name = "top", initial = "-90*deg" }, { rigid = [1, 0] }]
[[study]]
name = "hang"
body = "bob"
control = "load"
direction = [0, -1]
loads = [{ on = "bob", force = [0, -0.5] }, { on = "arm", at = [0, 0.2], force = [0.1, 0] }]
until = { lambda = [0, 3] }
)");
  const StudyResult& result = ran.of("hang");
  ASSERT_TRUE(result.start.found);
  const std::size_t last = result.branches[0].samples.size() - 1;
  for (const std::size_t row : {std::size_t{0}, last}) {
    const double t = value(result, row, "hinge.h"), P = value(result, row, "lambda") + 0.5;
    EXPECT_NEAR(5 * t, -P * std::cos(t) - 0.1 * (std::sin(t) + 0.2 * std::cos(t)), 1e-11);
    EXPECT_NEAR(value(result, row, "bob.y"), std::sin(t) - 1, 1e-11);
    EXPECT_EQ(value(result, row, "index"), 0);
  }
}

}  // namespace
}  // namespace springfold::io
