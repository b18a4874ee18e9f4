// Members of very different stiffness side by side: ranks, stiffness and stability are still told.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <sstream>

#include "case_runs.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// The Gough-Stewart platform of the library, unloaded, its legs' stiffnesses as given.
StudyResult platform(const std::vector<double>& legs) {
  std::ifstream file{std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/gough-stewart/case.toml"};
  std::stringstream all;
  all << file.rdbuf();
  std::string text = all.str();
  text.erase(text.find("[[study]]\nname = \"press\""));
  std::size_t at = 0;
  const std::string key = "stiffness = \"k\"";
  for (const double stiffness : legs) {
    at = text.find(key, at);
    std::ostringstream with;
    with.precision(17);
    with << "stiffness = " << stiffness;
    text.replace(at, key.size(), with.str());
  }
  return run(text).of("unloaded");
}

/// Unit force along leg i and its moment about the platform's centre; README of the case.
Vector leg_wrench(int i) {
  const double deg = std::numbers::pi / 180, at = 60 * deg * i;
  const double turned = at + (i % 2 == 0 ? 20 : -20) * deg;
  const Eigen::Vector3d foot{std::cos(at), std::sin(at), 0};
  const Eigen::Vector3d head{0.6 * std::cos(turned), 0.6 * std::sin(turned), 0};
  const Eigen::Vector3d along = (head + Eigen::Vector3d{0, 0, 0.8} - foot).normalized();
  Vector w(6);
  w << along, head.cross(along);
  return w;
}

TEST(StiffMembers, BesideSoftOnesLeaveStiffnessAndStabilityDefined) {
  for (const double factor : {1e4, 1e8, 1e10}) {
    for (const bool is_stiff_alone : {true, false}) {
      std::vector<double> legs(6, is_stiff_alone ? 1 : factor);
      legs[0] = is_stiff_alone ? factor : 1;
      const StudyResult result = platform(legs);
      Matrix K = Matrix::Zero(6, 6);
      for (int i = 0; i < 6; ++i)
        K += legs[static_cast<std::size_t>(i)] * leg_wrench(i) * leg_wrench(i).transpose();
      ASSERT_EQ(result.start.stiffness.rows(), 6) << factor;
      EXPECT_LT((result.start.stiffness - K).norm(), 1e-13 * K.norm()) << factor;
      // What is soft is not lost beside what is stiff.
      const Matrix C = result.start.stiffness.inverse(), exact = K.inverse();
      EXPECT_LT((C - exact).norm(), 1e-15 * factor * exact.norm()) << factor;
      EXPECT_EQ(value(result, 0, "index"), 0) << factor;
      EXPECT_EQ(value(result, 0, "index_pose"), 0) << factor;
      EXPECT_EQ(result.start.zero_modes, 0) << factor;
    }
  }
}

TEST(StiffMembers, DoNotHideAMotionWithoutStiffness) {
  for (const double factor : {1.0, 1e8, 1e10}) {
    const StudyResult result = platform({0, factor, 1, factor, factor, 1});
    EXPECT_EQ(result.start.zero_modes, 1) << factor;
    EXPECT_TRUE(std::isnan(value(result, 0, "index"))) << factor;
  }
}

/// A bar of length 1 on a hinge with a spring, stretched by an axial spring: it buckles at c/l.
TEST(StiffMembers, HideNoBranchesOverThirtyOrders) {
  for (const double hinge : {1e-9, 1.0, 1e5})
    for (const double axial : {1e13, 1e16, 1e20}) {
      SCOPED_TRACE(std::to_string(hinge) + " and " + std::to_string(axial));
      std::ostringstream text;
      text.precision(17);
      text << R"([[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", role = "preloaded", initial = "90*deg", spring = { law = "linear", stiffness = )"
           << hinge << R"(, free = "90*deg" } },
  { joint = "prismatic", axis = "x", role = "virtual", stiffness = )"
           << axial << R"( },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
branches = { depth = 1 }
until = { lambda = [)"
           << -hinge << ", " << 2 * hinge << "] }\n";
      const StudyResult result = run(text.str()).of("press");
      EXPECT_TRUE(complete(result));
      ASSERT_EQ(result.branches.size(), 3u);
      const auto loads = lambdas(result, analysis::EventKind::branch_point);
      ASSERT_EQ(loads.size(), 1u);
      EXPECT_NEAR(loads[0] / hinge, 1, 1e-7);  // softer by hinge / axial, at most 1e-8
      for (std::size_t b : {1u, 2u}) {
        const auto& branch = result.branches[b];
        const std::size_t last = branch.samples.size() - 1;
        // An inextensible bar carries P sin(q)/q = c there.
        const double q =
            std::atan2(value(result, branch, last, "tip.x"), value(result, branch, last, "tip.y"));
        EXPECT_NEAR(
            value(result, branch, last, "lambda") * std::sin(std::abs(q)) / std::abs(q) / hinge, 1,
            1e-7);
      }
    }
}

TEST(RigidDirections, HaveAComplianceWhereThereIsNoStiffness) {
  const StudyResult result = run(R"(
[[body]]
name = "slide"
task_space = "planar"
[[chain]]
name = "rail"
elements = [ { rigid = { rotate = { axis = "z", angle = "30*deg" } } }, { joint = "prismatic", axis = "x", role = "virtual", stiffness = 4 } ]
[[study]]
name = "rest"
kind = "equilibrium"
)")
                                 .of("rest");
  EXPECT_EQ(result.start.stiffness.size(), 0);
  const double c = std::sqrt(0.75), s = 0.5;
  const Matrix expected{{c * c / 4, c * s / 4, 0}, {c * s / 4, s * s / 4, 0}, {0, 0, 0}};
  ASSERT_EQ(result.start.compliance.rows(), 3);
  EXPECT_LT((result.start.compliance - expected).norm(), 1e-15);
}

}  // namespace
}  // namespace springfold::io
