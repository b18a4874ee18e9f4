// Chains of two links: closed curves that begin on one of their own special points, bent branches that straighten.
#include <gmock/gmock.h>

#include <algorithm>

#include "case_runs.hpp"
#include "number_text.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::SizeIs;

/// A chain of two links under springs of these laws, whose curve from the given start is closed.
std::string two_links(const std::string& start, const std::string& first, const std::string& second,
                      const std::string& studies) {
  return "[[body]]\nname = \"p\"\ntask_space = \"xy\"\npose = " + start +
         "\n[[chain]]\nname = \"c\"\nelements = [\n"
         "  { joint = \"revolute\", axis = \"z\", name = \"a\", role = \"preloaded\", " +
         first + " },\n  { rigid = [1, 0] },\n" +
         "  { joint = \"revolute\", axis = \"z\", name = \"b\", role = \"preloaded\", " + second +
         " },\n  { rigid = [1, 0] },\n]\n" + studies;
}

/// Studies "first" and "then" of one closed curve, the second begun at a special point of the first.
std::string begun_twice(const std::string& direction, const std::string& at) {
  const std::string keys =
      "kind = \"snap_through\"\ncontrol = \"load\"\ndirection = " + direction +
      "\nuntil = { c.a = [-1.4, 1.4], c.b = [-2.5, 2.5], lambda = [-40, 40] }\n"
      "branches = { depth = 0 }\n";
  return "[[study]]\nname = \"first\"\n" + keys + "[[study]]\nname = \"then\"\n" + keys +
         "start = { from = \"first\", at = \"" + at + "\" }\n";
}

/// What the jumps from the first branch release, the least first.
std::vector<double> released_from_first_branch(const analysis::StudyResult& result) {
  std::vector<double> released;
  for (const auto& jump : result.snap->jumps)
    if (jump.branch == 1) released.push_back(jump.released);
  std::sort(released.begin(), released.end());
  return released;
}

std::ptrdiff_t count_of(const analysis::StudyResult& result, EventKind kind) {
  return std::ssize(lambdas(result, kind));
}

TEST(ClosedCurve, BegunOnItsOwnLimitPointHasItOnceAndJumps) {
  const auto ran = run(two_links(
      "[1.9104938267668738, 0.2110060660561654]",
      "initial = -0.17, spring = { law = \"piecewise_linear\", breakpoints = [-0.59, -0.29], "
      "stiffnesses = [0.5, -0.25, 1], free = -0.17, falling = true }",
      "initial = 0.56, spring = { law = \"polynomial\", coefficients = [0, 2, -4, 2], free = "
      "-0.29, falling = true }",
      begun_twice("[-0.6628, -0.7488]", "LP2")));
  for (const char* study : {"first", "then"}) {
    EXPECT_EQ(count_of(ran.of(study), EventKind::limit_point), 2) << study;
    EXPECT_THAT(released_from_first_branch(ran.of(study)), SizeIs(2)) << study;
  }
  const auto first = released_from_first_branch(ran.of("first")),
             then = released_from_first_branch(ran.of("then"));
  EXPECT_NEAR(first.at(0), then.at(0), 1e-9);
  EXPECT_NEAR(first.at(1), then.at(1), 1e-9);
}

TEST(ClosedCurve, BegunOnACornerClosesThere) {
  const auto ran = run(two_links(
      "[1.79428433848426, 0.5452223992565949]",
      "initial = -0.06, spring = { law = \"polynomial\", coefficients = [0, 2, 0, 1], free = 0.21 "
      "}",
      "initial = 0.71, spring = { law = \"piecewise_linear\", breakpoints = [0.49, 0.79], "
      "stiffnesses = [2, -1, 4], free = 0.71, falling = true }",
      begun_twice("[-0.4315, -0.9021]", "CL1")));
  for (const char* study : {"first", "then"}) {
    EXPECT_EQ(count_of(ran.of(study), EventKind::corner_limit_point), 2) << study;
    EXPECT_TRUE(ran.of(study).branches.at(0).forward.complete) << study;
    EXPECT_THAT(released_from_first_branch(ran.of(study)), SizeIs(2)) << study;
  }
}

/// A column of two links, bent beyond its critical load (3 - sqrt 5)/2, is straight again below it.
TEST(LoadCycle, DownABentBranchStraightensAtItsBranchPoint) {
  const auto result =
      run(two_links("[1.574289271237538, 1.1967816295037257]",
                    "initial = 0.5, spring = { law = \"linear\", stiffness = 1 }",
                    "initial = 0.3, spring = { law = \"linear\", stiffness = 1 }",
                    "[[study]]\nname = \"cycle\"\nkind = \"load_cycle\"\ncontrol = "
                    "\"load\"\ndirection = [-1, 0]\nload = [-0.42, 0]\nuntil = { c.a = [-2, 2], "
                    "c.b = [-2, 2], lambda = [-5, 5] }\ncycle = { levels = [-0.2] }\n"))
          .of("cycle");
  ASSERT_TRUE(result.snap && result.snap->cycle);
  EXPECT_EQ(result.snap->cycle->end, analysis::LoadCycle::End::complete);
  EXPECT_EQ(result.snap->cycle->jumps, 0);
  const auto& values = result.snap->cycle->steps.back().at.values;
  for (const char* angle : {"c.a", "c.b"})
    EXPECT_NEAR(values[static_cast<std::size_t>(column(result, angle))], 0, 1e-9) << angle;
}

}  // namespace
}  // namespace springfold::io
