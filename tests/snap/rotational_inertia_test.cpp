// Motions of bodies that turn about their centre of mass: closed forms and laws
// of rigid bodies.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/equimomental.hpp"
#include "io/case_files.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

/// Sum, centre and tensor of point masses.
void expect_moves_as(const std::vector<PointOfMass>& points, double mass,
                     const model::Mat3<double>& inertia) {
  double sum = 0;
  model::Vec3<double> centre = model::Vec3<double>::Zero();
  model::Mat3<double> tensor = model::Mat3<double>::Zero();
  for (const PointOfMass& p : points) {
    sum += p.mass;
    centre += p.mass * p.at;
    tensor +=
        p.mass * (p.at.squaredNorm() * model::Mat3<double>::Identity() - p.at * p.at.transpose());
  }
  EXPECT_NEAR(sum, mass, 1e-14);
  EXPECT_NEAR(centre.norm(), 0, 1e-14);
  EXPECT_NEAR((tensor - inertia).norm(), 0, 1e-14);
}

TEST(EquimomentalPoints, HaveMassCentreAndTensorOfTheBody) {
  model::Mat3<double> I;
  I << 0.9, 0.1, -0.05, 0.1, 0.8, 0.02, -0.05, 0.02, 0.7;
  expect_moves_as(equimomental_points(2, I), 2, I);
  expect_moves_as(equimomental_points(0, I), 0, I);
  // A thin rod along x and a plate.
  const model::Mat3<double> rod = Eigen::Vector3d(0, 0.3, 0.3).asDiagonal();
  expect_moves_as(equimomental_points(1, rod), 1, rod);
  const model::Mat3<double> plate = Eigen::Vector3d(0.2, 0.3, 0.5).asDiagonal();
  expect_moves_as(equimomental_points(1, plate), 1, plate);
  expect_moves_as(equimomental_points(1.5, model::Mat3<double>::Zero()), 1.5,
                  model::Mat3<double>::Zero());
}

/// A column on a hinge whose spring softens beyond 0.5 rad:
/// cases/snap-through/case-strut.toml as a body in the plane. What it carries
/// follows. It leaves the corner at the load that the README there derives.
std::string strut(const std::string& element, const std::string& body = "") {
  return R"(
[[body]]
name = "tip"
task_space = "planar"
pose = [0, 1, 0]
)" + body +
         R"(
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [-0.5, 0.5], stiffnesses = [0.5, 1, 0.5] } },
  )" + element +
         R"(
]
[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = [0, -1, 0]
until = { lambda = [-0.2, 1.5], strut.hinge = [-3, 3] }
snap = { inertia = { damping_ratio = 0.5 } }
)";
}

using RotationalInertia = io::CaseFiles;

const Jump* first_motion(const StudyResult& result) {
  for (const Jump& jump : result.snap->jumps)
    if (jump.loading > 0 && jump.inertial) return &jump;
  return nullptr;
}

TEST_F(RotationalInertia, OfADumbbellIsThatOfItsTwoMasses) {
  const auto motion_of = [&](const std::string& element) {
    const io::Case c = load(strut(element));
    const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
    const Jump* jump = first_motion(result);
    EXPECT_NE(jump, nullptr);
    return jump ? *jump->inertial : InertialMotion{};
  };
  // Two masses at 0.5 -+ 0.3 on the column, against one link with the moment of
  // inertia 2 (0.3)^2.
  const InertialMotion points = motion_of(
      R"({ point = "a", at = [0, 0.2], mass = 1 }, { point = "b", at = [0, 0.8], mass = 1 }, { rigid = [0, 1] },)");
  const InertialMotion link = motion_of(R"({ rigid = [0, 1], mass = 2, inertia = 0.18 },)");
  ASSERT_EQ(points.end, InertialMotion::End::rest);
  ASSERT_EQ(link.end, InertialMotion::End::rest);
  constexpr double integrated = 1e-4;
  EXPECT_NEAR(link.duration, points.duration, integrated * points.duration);
  EXPECT_NEAR(link.released, points.released, 1e-9);
  EXPECT_NEAR(link.dissipated, link.released, 1e-6);
  // The centre is at 0.5, the outer mass at 0.8.
  EXPECT_NEAR(link.peak_speed / points.peak_speed, 0.5 / 0.8, integrated);
}

/// A physical pendulum with the centre of mass at r: (m r^2 + I) theta'' =
/// torque. At one damping ratio all motions are the same one, in times that go
/// with the root of m r^2 + I.
TEST_F(RotationalInertia, SlowsAPendulumByTheRootOfItsMoment) {
  const auto motion_of = [&](double inertia) {
    const io::Case c =
        load(strut("{ rigid = [0, 1] },",
                   "mass = 2\ncom = [0, -0.5]\ninertia = " + std::to_string(inertia) + "\n"));
    const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
    const Jump* jump = first_motion(result);
    EXPECT_NE(jump, nullptr);
    return jump ? *jump->inertial : InertialMotion{};
  };
  const InertialMotion without = motion_of(0), with = motion_of(1.5);
  const double slower = std::sqrt((2 * 0.25 + 1.5) / (2 * 0.25));
  constexpr double integrated = 1e-4;
  EXPECT_NEAR(without.peak_speed / with.peak_speed, slower, integrated * slower);
  EXPECT_GT(with.duration / without.duration, 1.5);
  EXPECT_NEAR(with.dissipated, with.released, 1e-6);
}

TEST_F(RotationalInertia, LetsABodyTurnAboutItsCentreOfMass) {
  const auto end_of = [&](const std::string& more) {
    const io::Case c = load(strut("{ rigid = [0, 1] },", "mass = 1\ncom = [0, -1]\n" + more));
    const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
    const Jump* jump = first_motion(result);
    EXPECT_NE(jump, nullptr);
    return jump ? jump->inertial->end : InertialMotion::End::no_end;
  };
  EXPECT_EQ(end_of(""), InertialMotion::End::no_mass);
  EXPECT_EQ(end_of("inertia = 0.1\n"), InertialMotion::End::rest);
}

TEST_F(RotationalInertia, IsRefusedWhereNoBodyCanHaveIt) {
  const std::string rigid = "{ rigid = [0, 1] },";
  EXPECT_EQ(messages(strut(rigid, "mass = 1\ninertia = -1\n")).size(), 1u);
  EXPECT_EQ(messages(strut(rigid, "inertia = 1\n")).size(), 1u);
  EXPECT_EQ(messages(strut(rigid, "mass = 1\ninertia = [1, 1, 1]\n")).size(), 1u);
  EXPECT_TRUE(messages(strut(rigid, "mass = 1\ninertia = 0.5\n")).empty());
  const std::string spatial = R"(
[[body]]
name = "tip"
task_space = "spatial"
mass = 1
inertia = )";
  const std::string chain = R"(
[[chain]]
name = "hinge"
elements = [ { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = 1 } } ]
[[study]]
name = "turn"
kind = "equilibrium"
)";
  EXPECT_TRUE(messages(spatial + "[1, 2, 2.5]\n" + chain).empty());
  EXPECT_TRUE(messages(spatial + "[[1, 0.1, 0], [0.1, 2, 0], [0, 0, 2.5]]\n" + chain).empty());
  EXPECT_EQ(messages(spatial + "[1, 2, 3.5]\n" + chain).size(), 1u);
  EXPECT_EQ(messages(spatial + "[[1, 0.1, 0], [0.2, 2, 0], [0, 0, 2.5]]\n" + chain).size(), 1u);
  EXPECT_EQ(messages(spatial + "[1, 2]\n" + chain).size(), 1u);
  EXPECT_EQ(messages(spatial + "1\n" + chain).size(), 1u);
}

}  // namespace
}  // namespace springfold::analysis
