// Control mode mixed with any part of the pose prescribed.
#include <gmock/gmock.h>

#include "springfold/analysis/run.hpp"
#include "springfold/model/elastic_link.hpp"

namespace springfold::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// One cantilever of length 1 along x with EA = 100, EIy = 2, EIz = 3, GJ = 1.5.
model::Mechanism cantilever() {
  using enum model::ElasticDirection;
  model::Chain chain{.name = "beam"};
  add_elastic_link(chain, "link", 1, {Tx, Ty, Tz, Rx, Ry, Rz},
                   model::inverse_of(model::cantilever_compliance(
                       1, 1, 1, {.A = 100, .Iy = 2, .Iz = 3, .J = 1.5})),
                   Vector::Zero(6), Vector::Zero(6));
  model::Mechanism m;
  m.bodies = {{"tip", model::TaskSpace::spatial, Vector{{1, 0, 0, 0, 0, 0}}}};
  m.chains = {chain};
  return m;
}

Study driven(const Vector& direction, std::vector<std::string> prescribed) {
  Study study{.name = "drive", .control = ControlMode::mixed};
  study.direction = direction;
  study.prescribed = std::move(prescribed);
  study.until = {{"lambda", 0, 0.02}};
  study.trace.maximum_step = 0.01;
  return study;
}

double last(const StudyResult& result, const std::string& quantity) {
  for (std::size_t q = 0; q < result.quantities.size(); ++q)
    if (result.quantities[q].name == quantity)
      return result.branches.front().samples.back().values[q];
  ADD_FAILURE() << "no " << quantity;
  return 0;
}

StudyResult run(const Study& study) {
  EXPECT_THAT(problems_in(study, cantilever()), IsEmpty());
  StudyResult result = run_study(cantilever(), study);
  EXPECT_TRUE(complete(result));
  return result;
}

// 3 EI/L^3 with a free end, 12 EI/L^3 where the end is kept from turning; small displacements.
TEST(Prescribed, CoordinatesMakeACantileverThreeOrTwelve) {
  const Vector y = Vector::Unit(6, 1);
  Study free = driven(y, {"y"}), guided = driven(y, {"y", "rz"});
  for (Study* study : {&free, &guided}) study->until = {{"lambda", 0, 1e-4}};
  EXPECT_NEAR(last(run(free), "force"), 3 * 3 * 1e-4, 1e-10);
  EXPECT_NEAR(last(run(guided), "force"), 12 * 3 * 1e-4, 1e-10);
}

TEST(Prescribed, CoordinateAloneIsTheDisplacementAlongItsAxis) {
  const Vector z = Vector::Unit(6, 2);
  EXPECT_NEAR(last(run(driven(z, {"z"})), "force"), last(run(driven(z, {})), "force"), 1e-12);
}

TEST(Prescribed, CoordinatesAreKeptAndAllOthersAreFreeOfForce) {
  Vector screw = Vector::Zero(6);
  screw[1] = 1;
  screw[3] = 0.5;  // along y and about x
  const StudyResult result = run(driven(screw, {"y", "z", "rx"}));
  EXPECT_NEAR(last(result, "tip.y"), 0.02, 1e-14);
  EXPECT_NEAR(last(result, "tip.z"), 0, 1e-14);
  EXPECT_NEAR(last(result, "tip.rx"), 0.01, 1e-14);
  EXPECT_GT(std::abs(last(result, "tip.rz")), 1e-3);
  for (const char* free : {"beam.Fx", "beam.My", "beam.Mz"})
    EXPECT_LT(std::abs(last(result, free)), 2e-3 * std::abs(last(result, "beam.Fy"))) << free;
  EXPECT_NEAR(last(result, "beam.Fx"), 0, 1e-12);
}

TEST(Prescribed, CoordinatesAreCheckedInWords) {
  const auto problems = [](const Study& study) { return problems_in(study, cantilever()); };
  const Vector y = Vector::Unit(6, 1);
  EXPECT_THAT(problems(driven(y, {"y", "phi"})),
              ElementsAre("prescribed: the body has no pose coordinate \"phi\""));
  EXPECT_THAT(problems(driven(y, {"y", "y"})), ElementsAre("prescribed: \"y\" is named twice"));
  EXPECT_THAT(problems(driven(y, {"x"})),
              ElementsAre("direction: leads along y, which is not prescribed"));
  EXPECT_THAT(problems(driven(y, {"x", "y", "z", "rx", "ry", "rz"})),
              ElementsAre(HasSubstr("control = \"pose\"")));
  Study load = driven(y, {"y"});
  load.control = ControlMode::load;
  EXPECT_THAT(problems(load), ElementsAre(HasSubstr("need control = \"mixed\"")));
}

}  // namespace
}  // namespace springfold::analysis
