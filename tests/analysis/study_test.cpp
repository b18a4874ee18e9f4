#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "cases/planar_orthoglide.hpp"

namespace springfold {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::AllOf;
using testing::HasSubstr;

StudyResult within(std::vector<analysis::Limit> until) {
  auto study = diagonal_study(0.454);
  study.until = std::move(until);
  return run_study(planar_orthoglide(linear_knee(0)), study);
}

TEST(Limits, EndTheBranchExactlyWhereTheyAreReached) {
  const StudyResult result = within({{"deflection", -0.1, 0.3}});
  ASSERT_TRUE(complete(result));
  const auto& samples = result.branches.front().samples;
  EXPECT_NEAR(samples.front().values[column(result, "deflection")], -0.1, 1e-12);
  EXPECT_NEAR(samples.back().values[column(result, "deflection")], 0.3, 1e-12);
}

TEST(Limits, OnWhoseEdgeTheStartLiesEndTheBranchThere) {
  const StudyResult up = within({{"deflection", 0, 0.3}}), down = within({{"deflection", -0.3, 0}});
  ASSERT_TRUE(complete(up) && complete(down));
  EXPECT_EQ(up.branches.front().start_row, 0u);
  EXPECT_EQ(up.branches.front().samples.front().event, "EP1");
  EXPECT_EQ(down.branches.front().start_row + 1, down.branches.front().samples.size());
  EXPECT_GT(up.branches.front().samples.size(), 5u);
}

TEST(Limits, OnWhoseEdgeADiagramStartsMakeItAnOrdinaryStart) {
  auto study = diagonal_study(-0.454);
  study.control = analysis::ControlMode::load;
  study.branches.depth = 1;
  study.until.push_back({"lambda", 0, 0.5});  // the branch point at -0.97 lies beyond
  const StudyResult result = run_study(planar_orthoglide(linear_knee(0)), study);
  ASSERT_TRUE(complete(result));
  EXPECT_EQ(result.branches.size(), 1u);
  EXPECT_TRUE(result.junctions.empty());
  EXPECT_TRUE(result.start.situation.empty());
  EXPECT_EQ(result.branches.front().start_row, 0u);
  EXPECT_EQ(result.branches.front().backward.reason,
            "end of the range: lambda reaches its lower limit");
}

TEST(Limits, ThatAreInfiniteDoNotEndTheBranch) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const StudyResult result = within({{"deflection", -0.02, infinity}, {"force", -infinity, 0.12}});
  ASSERT_TRUE(complete(result));
  const auto& samples = result.branches.front().samples;
  EXPECT_NEAR(samples.front().values[column(result, "deflection")], -0.02, 1e-12);
  EXPECT_NEAR(samples.back().values[column(result, "force")], 0.12, 1e-12);
  EXPECT_EQ(events_of_kind(result, EventKind::limit_point).size(), 2u);
}

TEST(Limits, OutsideOfWhichTheStartLiesMakeTheResultIncomplete) {
  const StudyResult result = within({{"tool.x", 0.5, 0.9}});
  EXPECT_TRUE(result.start.found);
  EXPECT_FALSE(complete(result));
  EXPECT_NE(result.start.outside.find("tool.x"), std::string::npos) << result.start.outside;
}

TEST(Marks, AreLocatedExactlyAndDoNotEndTheBranch) {
  auto study = diagonal_study(0.454);
  study.marks = {{"deflection", 0.2}, {"force", 0.01}};
  const StudyResult result = run_study(planar_orthoglide(linear_knee(0)), study);
  const auto marks = events_of_kind(result, EventKind::user_value);
  // The force passes 0.01 three times: before and after its maximum, and after its minimum.
  ASSERT_EQ(marks.size(), 4u);
  for (const auto& mark : marks)
    EXPECT_NEAR(at_event(result, mark, mark.detail), mark.detail == "force" ? 0.01 : 0.2, 1e-11);
  EXPECT_TRUE(complete(result));
}

TEST(Observer, StopsTheTraceAndKeepsWhatIsDone) {
  int calls = 0;
  const StudyResult result = run_study(planar_orthoglide(linear_knee(0)), diagonal_study(0.454),
                                       nullptr, [&calls](int, double) { return ++calls < 5; });
  EXPECT_FALSE(complete(result));
  EXPECT_GE(result.branches.front().samples.size(), 4u);
}

TEST(Equilibrium, IsOneRowWithStiffnessAndIndex) {
  auto study = diagonal_study(0.454);
  study.kind = analysis::StudyKind::equilibrium;
  study.until.clear();
  const StudyResult result = run_study(planar_orthoglide(linear_knee(0)), study);
  ASSERT_TRUE(complete(result));
  ASSERT_EQ(result.branches.front().samples.size(), 1u);
  EXPECT_EQ(at_start(result, "index"), 0);
  EXPECT_NEAR(at_start(result, "stiffness"), 0.240552110109, 1e-9);
}

TEST(Start, ThatCannotBeClosedIsNotFoundAndSaysWhy) {
  auto study = diagonal_study(0);
  study.start.solve = analysis::StartSolve::pose;
  auto mechanism = planar_orthoglide(linear_knee(0));
  for (auto& chain : mechanism.chains) {  // rigid drives, far apart: the legs cannot meet
    std::get<model::Joint>(chain.elements[0]).spring.reset();
    std::get<model::Joint>(chain.elements[0]).command = 10;
  }
  const StudyResult result = run_study(mechanism, study);
  EXPECT_FALSE(result.start.found);
  EXPECT_NE(result.start.message.find("cannot be closed"), std::string::npos);
  EXPECT_TRUE(result.branches.empty());
}

TEST(Study, FindsTheSameSpecialPointsWithTheLegsInOtherOrder) {
  auto mechanism = planar_orthoglide(linear_knee(0.01));
  const StudyResult one = run_study(mechanism, diagonal_study(0.454));
  std::swap(mechanism.chains[0], mechanism.chains[1]);
  const StudyResult other = run_study(mechanism, diagonal_study(0.454));
  const auto a = events_of_kind(one, EventKind::limit_point),
             b = events_of_kind(other, EventKind::limit_point);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(at_event(one, a[i], "force"), at_event(other, b[i], "force"), 1e-12);
}

TEST(Study, GivesTheSameBitsTwice) {
  const auto mechanism = planar_orthoglide(one_sided_knee());
  const StudyResult a = run_study(mechanism, diagonal_study(0.454));
  const StudyResult b = run_study(mechanism, diagonal_study(0.454));
  ASSERT_EQ(a.branches[0].samples.size(), b.branches[0].samples.size());
  for (std::size_t i = 0; i < a.branches[0].samples.size(); ++i)
    for (std::size_t q = 0; q < a.quantities.size(); ++q) {
      const double x = a.branches[0].samples[i].values[q], y = b.branches[0].samples[i].values[q];
      EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y)));
    }
}

TEST(StudiesOfTheLibrary, ThatCannotBeUsedAreRefusedWithAllThatIsWrong) {
  const auto mechanism = planar_orthoglide(linear_knee(0.01));
  const auto said_by = [](const model::Mechanism& given, const analysis::Study& study) {
    try {
      run_study(given, study);
    } catch (const std::invalid_argument& error) {
      return std::string{error.what()};
    }
    return std::string{};
  };
  const auto study = diagonal_study(0.454);
  auto wrong = study;
  wrong.start.pose = Vector::Zero(3);
  wrong.direction = Vector::Zero(2);
  EXPECT_THAT(said_by(mechanism, wrong), AllOf(HasSubstr("start.pose"), HasSubstr("direction")));
  wrong = study;
  wrong.body = 2;
  EXPECT_THAT(said_by(mechanism, wrong), HasSubstr("no such moving body"));
  wrong = study;
  wrong.control = analysis::ControlMode::parameter;
  wrong.parameter = "Kv";
  EXPECT_THAT(said_by(mechanism, wrong), HasSubstr("needs a family"));
  auto broken = mechanism;
  broken.bodies[0].mass = -1;
  broken.chains[1].to = 7;
  EXPECT_THAT(said_by(broken, study), AllOf(HasSubstr("mass"), HasSubstr("no such body")));
  EXPECT_THROW(solve_start(broken, study), std::invalid_argument);
}

}  // namespace
}  // namespace springfold
