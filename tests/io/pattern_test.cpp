// `pattern`: copies are the whole turned about an axis of the base, as the case draws it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_files.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/model/closure.hpp"

namespace springfold::io {
namespace {

class PatternsAsDrawn : public CaseFiles {};

using Point3 = model::Vec3<double>;

/// Of a point of the base, or of a planar body as the case draws it.
Point3 drawn_place(const model::Mechanism& mechanism, const model::Anchor& anchor) {
  if (anchor.body == 0) return anchor.at;
  const Vector& pose = mechanism.bodies[static_cast<std::size_t>(anchor.body - 1)].pose;
  const double phi = pose.size() == 3 ? pose[2] : 0, c = std::cos(phi), s = std::sin(phi);
  return {pose[0] + c * anchor.at[0] - s * anchor.at[1],
          pose[1] + s * anchor.at[0] + c * anchor.at[1], anchor.at[2]};
}

/// Each spring is the first one turned about a point of the plane, at both ends.
void expect_turned_springs(const model::Mechanism& mechanism, double angle, const Point3& about) {
  ASSERT_GT(mechanism.line_springs.size(), 1U);
  const model::LineSpring& first = mechanism.line_springs.front();
  for (std::size_t i = 0; i < mechanism.line_springs.size(); ++i) {
    const Point3 turn{0, 0, static_cast<double>(i) * angle};
    const auto turned_place = [&](const model::Anchor& anchor) -> Point3 {
      return about + model::exp_rotation(turn) * (drawn_place(mechanism, anchor) - about);
    };
    const model::LineSpring& own = mechanism.line_springs[i];
    EXPECT_LT((drawn_place(mechanism, own.from) - turned_place(first.from)).norm(), 1e-14) << i;
    EXPECT_LT((drawn_place(mechanism, own.to) - turned_place(first.to)).norm(), 1e-14) << i;
  }
}

/// Three springs from the base to a planar body.
std::string three_springs(const std::string& pose, const std::string& about) {
  return "[[body]]\nname = \"w\"\ntask_space = \"planar\"\n" + pose +
         "[[spring]]\npattern = { i = [0, 2], angle = \"120*deg\"" + about +
         " }\nname = \"s{i}\"\nfrom_at = [3, 0.4]\nto = \"w\"\nto_at = [0.5, 0.1]\nstiffness = 3\n"
         "[[study]]\nname = \"a\"\nkind = \"equilibrium\"\nbody = \"w\"\n";
}

TEST_F(PatternsAsDrawn, PatternsTurnWhatStandsInABodyAsTheBodyIsDrawn) {
  const double third_of_a_turn = 2 * std::numbers::pi / 3;
  const std::string about = ", about = [0.5, \"0.2\"]";
  for (const char* pose : {"pose = [0.5, 0.2, 0]\n", "pose = [0.5, \"0.2\", 0.3]\n",
                           "pose = [\"0.1 + 0.2\", -0.7, 0.3]\n"})
    expect_turned_springs(load(three_springs(pose, about)).runs[0].mechanism, third_of_a_turn,
                          {0.5, 0.2, 0});
  for (const char* pose : {"", "pose = [0, 0, 0.3]\n", "pose = [1, 2, 0.3]\n"})
    expect_turned_springs(load(three_springs(pose, "")).runs[0].mechanism, third_of_a_turn,
                          {0, 0, 0});
  expect_turned_springs(
      load(three_springs("pose = [1, 2, 0.3]\n", about + ", axis = \"-z\"")).runs[0].mechanism,
      -third_of_a_turn, {0.5, 0.2, 0});
}

// By symmetry it is at rest with its centre on the axis, wherever that is.
TEST_F(PatternsAsDrawn, AWheelOfPatternedSpringsRestsOnTheAxis) {
  const Case the_case = load(three_springs("pose = [0.5, 0.2, 0]\n", ", about = [0.5, 0.2]"));
  const auto result = analysis::run_study(the_case.runs[0].mechanism, the_case.runs[0].plan);
  ASSERT_TRUE(result.start.found);
  const auto value = [&](const std::string& name) {
    const auto found =
        std::find_if(result.quantities.begin(), result.quantities.end(),
                     [&](const analysis::Quantity& quantity) { return quantity.name == name; });
    return result.branches.at(0).samples.at(0).values.at(
        static_cast<std::size_t>(found - result.quantities.begin()));
  };
  EXPECT_NEAR(value("w.x"), 0.5, 1e-12);
  EXPECT_NEAR(value("w.y"), 0.2, 1e-12);
}

TEST_F(PatternsAsDrawn, PatternsJoinBodiesOfPatterns) {
  const auto joined = [](const std::string& space, const std::string& pose,
                         const std::string& from) {
    return "[[body]]\npattern = { k = [0, 3], angle = \"90*deg\", about = [1, 2] }\n"
           "name = \"b{k}\"\ntask_space = \"" +
           space + "\"\npose = " + pose +
           "\n[[spring]]\npattern = { i = [0, 3], angle = \"90*deg\", about = [1, 2] }\n"
           "name = \"s{i}\"\nfrom = \"b{i}\"\nfrom_at = [0.3, 0.1]\nto = \"" +
           from +
           "\"\nto_at = [0.2, -0.1]\nstiffness = 1\n"
           "[[study]]\nname = \"a\"\nkind = \"equilibrium\"\nbody = \"b0\"\n";
  };
  for (const char* to : {"b{i}", "b{(i + 1) % 4}", "base"})
    expect_turned_springs(load(joined("planar", "[3, 2, 0.1]", to)).runs[0].mechanism,
                          std::numbers::pi / 2, {1, 2, 0});
}

TEST_F(PatternsAsDrawn, PatternsRefuseWhatTheyCannotTurnAsDrawn) {
  EXPECT_THAT(
      messages(three_springs("", ", about = [0.5, 0.2]")),
      testing::ElementsAre(testing::HasSubstr(
          "spring[1, i = 0].to_at: the pattern turns it about a point of the base, and where "
          "\"w\" stands is not given, need its pose, or a pattern about the origin")));
  const std::string text =
      replaced(three_springs("pose = [0, 0, 1, 0, 0.1, 0]\n", ""), "\"planar\"", "\"spatial\"");
  const std::string in_space =
      replaced(replaced(text, "[3, 0.4]", "[3, 0.4, 0]"), "[0.5, 0.1]", "[0.5, 0.1, 0]");
  EXPECT_THAT(messages(in_space),
              testing::ElementsAre(testing::HasSubstr(
                  "to_at: \"w\" is not drawn turned about the axis of the pattern alone")));
  EXPECT_THAT(messages(replaced(in_space, "0, 0.1, 0]", "0, 0, 0.1]")), testing::IsEmpty());
}

}  // namespace
}  // namespace springfold::io
