// What a case file says arrives in the plain data.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;

class CaseValues : public CaseFiles {};

const model::Joint& joint_of(const Case& c, std::size_t chain, std::size_t element) {
  return std::get<model::Joint>(c.runs[0].mechanism.chains[chain].elements[element]);
}

/// A spatial body held by one chain with the given element lines.
std::string spatial_text(const std::string& elements) {
  return "[[body]]\nname = \"tool\"\ntask_space = \"spatial\"\n[[chain]]\nname = \"leg\"\nelements "
         "= [\n" +
         elements + "\n]\n[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\n";
}

TEST_F(CaseValues, RefuseAxesOfAJointThatAreParallelToTheOneBefore) {
  const auto axes = [this](const std::string& list) {
    return messages(spatial_text(
        "{ joint = \"" + std::string{list.find("z") == list.npos ? "universal" : "spherical"} +
        "\", axes = " + list + " }"));
  };
  for (const char* list : {R"(["x", "x"])", R"(["x", "-x"])", R"(["x", [2, 0, 0]])"})
    EXPECT_THAT(axes(list), ElementsAre(testing::HasSubstr(
                                "axes[2]: is parallel to the axis before it: the joint would turn "
                                "twice about one line, need another direction")))
        << list;
  EXPECT_THAT(axes(R"(["z", "y", "y"])"), ElementsAre(testing::HasSubstr("axes[3]: is parallel")));
  EXPECT_THAT(axes(R"(["x", "y"])"), testing::IsEmpty());
  EXPECT_THAT(axes(R"(["x", [1, 0.01, 0]])"), testing::IsEmpty());
  EXPECT_THAT(axes(R"(["z", "x", "z"])"), testing::IsEmpty());  // Euler's angles
  EXPECT_THAT(axes(R"(["w", "w"])"), testing::SizeIs(2));       // nothing more about bad axes
}

TEST_F(CaseValues, OfBodiesAndChainsAreTheFormulasOfTheFile) {
  const Case c = load(orthoglide_text(), {{"L", "2"}});
  const model::Mechanism& m = c.runs[0].mechanism;
  ASSERT_EQ(m.bodies.size(), 1u);
  EXPECT_EQ(m.bodies[0].name, "tool");
  EXPECT_EQ(m.bodies[0].task_space, model::TaskSpace::xy);
  ASSERT_EQ(m.chains.size(), 2u);
  EXPECT_EQ(m.chains[0].from, 0);
  EXPECT_EQ(m.chains[0].to, 1);
  EXPECT_EQ(joint_of(c, 0, 0).name, "drive");
  EXPECT_EQ(joint_of(c, 0, 0).role, model::JointRole::actuated);
  EXPECT_EQ(joint_of(c, 0, 0).command, 2);
  EXPECT_EQ(std::get<model::LinearSpring>(*joint_of(c, 0, 0).spring).stiffness, 1);
  EXPECT_EQ(joint_of(c, 0, 1).axis, (model::Vec3<double>{0, 0, -1}));
  EXPECT_EQ(std::get<model::RigidLink>(m.chains[1].elements[2]).transform.p,
            (model::Vec3<double>{0, -2, 0}));
}

TEST_F(CaseValues, OfStudiesArriveAndDirectionsHaveUnitLength) {
  const Case c = load(orthoglide_text());
  EXPECT_EQ(c.title, "test");
  EXPECT_EQ(c.units.length, "mm");
  EXPECT_EQ(c.units.force, "N");
  const analysis::Study& s = c.runs[0].plan;
  EXPECT_EQ(s.control, analysis::ControlMode::mixed);
  EXPECT_NEAR(s.direction[0], 1 / std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(s.constant_load, Vector::Zero(2));
  EXPECT_EQ(s.start.solve, analysis::StartSolve::actuators);
  EXPECT_EQ(s.start.pose, Vector::Constant(2, 0.454));
  EXPECT_EQ(s.start.attempts, 3);
  EXPECT_EQ(s.start.seed, 7u);
  ASSERT_EQ(s.until.size(), 2u);
  EXPECT_EQ(s.until[0].quantity, "leg_x.knee");
  EXPECT_DOUBLE_EQ(s.until[0].high, 80 * std::numbers::pi / 180);
  EXPECT_TRUE(std::isinf(s.until[1].low));
  ASSERT_EQ(s.marks.size(), 2u);
  EXPECT_EQ(s.marks[1].value, 0.2);
  EXPECT_EQ(s.trace.maximum_points, 99);
  EXPECT_EQ(s.trace.minimum_step, 1e-7);
  EXPECT_EQ(s.trace.spacing, 0);
}

TEST_F(CaseValues, OfPlotsAreEvaluatedWithTheParametersOfTheFile) {
  const Case c = load(orthoglide_text(), {{"L", "4"}});
  ASSERT_EQ(c.plots.size(), 1u);
  EXPECT_EQ(c.plots[0].name, "figure");
  EXPECT_EQ(c.plots[0].x_factor, 0.25);
  ASSERT_EQ(c.plots[0].curves.size(), 1u);
  EXPECT_THAT(c.plots[0].curves[0].runs, ElementsAre(1, 2));
  EXPECT_THAT(c.plots[0].curves[0].labels, ElementsAre("one", "two"));
}

TEST_F(CaseValues, ThePathMayBeTheDavidenkoFlow) {
  const Case c = load(replaced(orthoglide_text(), "trace = {", "path = \"davidenko\"\ntrace = {"));
  EXPECT_EQ(c.runs[0].plan.path, analysis::Path::davidenko);
}

TEST_F(CaseValues, DefaultsHoldWhereTheFileIsSilent) {
  std::string text = orthoglide_text();
  text.erase(text.find("load ="));
  const Case c = load(text);
  const analysis::Study defaults, &s = c.runs[0].plan;
  EXPECT_EQ(s.constant_load.size(), 0);
  EXPECT_EQ(s.start.pose.size(), 0);
  EXPECT_EQ(s.start.attempts, defaults.start.attempts);
  EXPECT_EQ(s.path, analysis::Path::arc_length);
  EXPECT_EQ(s.trace.maximum_step, defaults.trace.maximum_step);
  EXPECT_EQ(s.trace.maximum_points, defaults.trace.maximum_points);
  EXPECT_EQ(c.runs.size(), 1u);
  EXPECT_EQ(c.runs[0].label, "");
}

TEST_F(CaseValues, EverySpringLawCanBeWritten) {
  const auto law = [this](const std::string& spring) {
    const Case c = load(replaced(orthoglide_text(), "{ law = \"linear\", stiffness = \"Kv\" }",
                                 "{ " + spring + " }"));
    return *joint_of(c, 0, 1).spring;
  };
  const auto linear =
      std::get<model::LinearSpring>(law("law = \"linear\", stiffness = 2, free = 0.5"));
  EXPECT_EQ(linear.stiffness, 2);
  EXPECT_EQ(linear.free, 0.5);
  const auto below = std::get<model::OneSidedSpring>(
      law("law = \"one_sided\", stiffness = 3, from = \"-pi/12\", side = \"below\""));
  EXPECT_EQ(below.stiffness, 3);
  EXPECT_EQ(below.from, -std::numbers::pi / 12);
  EXPECT_EQ(below.side, model::OneSidedSpring::Side::below);
  const auto pieces = std::get<model::PiecewiseLinearSpring>(
      law("law = \"piecewise_linear\", breakpoints = [-1, 1], stiffnesses = [1, 2, 3], free = 0.5, "
          "preload = -4"));
  EXPECT_THAT(pieces.breakpoints, ElementsAre(-1, 1));
  EXPECT_THAT(pieces.stiffnesses, ElementsAre(1, 2, 3));
  EXPECT_EQ(pieces.free, 0.5);
  EXPECT_EQ(pieces.preload, -4);
}

TEST_F(CaseValues, AGapHasNoTorqueInsideAndASpringOutside) {
  const Case c = load(replaced(orthoglide_text(), "law = \"linear\", stiffness = \"Kv\"",
                               "law = \"gap\", stiffness = 5, low = -0.1, high = 0.3"));
  const model::CompiledSpring s = model::compile(*joint_of(c, 0, 1).spring);
  const auto torque = [&s](double a) { return s.torque(s.segment_at(a), a); };
  EXPECT_EQ(torque(0.2), 0);
  EXPECT_NEAR(torque(0.4), 0.5, 1e-15);
  EXPECT_NEAR(torque(-0.3), -1, 1e-15);
}

TEST_F(CaseValues, StopsAddToALinearSpringWhereverItIsFree) {
  for (const double free : {0.0, 0.7, -0.9}) {
    const Case c = load(
        replaced(orthoglide_text(), "law = \"linear\", stiffness = \"Kv\"",
                 "law = \"stops\", stiffness = 2, stop_stiffness = 10, low = -0.5, high = 0.25, "
                 "free = " +
                     std::to_string(free)));
    const model::CompiledSpring s = model::compile(*joint_of(c, 0, 1).spring);
    for (const double a : {-1.0, -0.5, 0.0, 0.2, 0.25, 1.0}) {
      const double stop = a > 0.25 ? 10 * (a - 0.25) : a < -0.5 ? 10 * (a + 0.5) : 0;
      EXPECT_NEAR(s.torque(s.segment_at(a), a), 2 * (a - free) + stop, 1e-14) << a << ", " << free;
    }
  }
}

TEST_F(CaseValues, UniversalAndSphericalJointsAreTwoAndThreeRevoluteJoints) {
  const std::string springs =
      "[{ law = \"linear\", stiffness = 1 }, { law = \"linear\", stiffness = 2 }, "
      "{ law = \"one_sided\", stiffness = 3, from = 0 }]";
  const Case c =
      load(spatial_text("{ joint = \"universal\", axes = [\"x\", \"-y\"] },\n"
                        "{ joint = \"spherical\", name = \"ball\", role = \"preloaded\", "
                        "initial = [0.1, 0.2, 0.3], spring = " +
                        springs + " },\n"));
  ASSERT_EQ(c.runs[0].mechanism.chains[0].elements.size(), 5u);
  EXPECT_EQ(joint_of(c, 0, 0).name, "j1.1");
  EXPECT_EQ(joint_of(c, 0, 1).name, "j1.2");
  EXPECT_EQ(joint_of(c, 0, 1).axis, (model::Vec3<double>{0, -1, 0}));
  EXPECT_EQ(joint_of(c, 0, 1).role, model::JointRole::passive);
  EXPECT_EQ(joint_of(c, 0, 4).name, "ball.3");
  EXPECT_EQ(joint_of(c, 0, 4).axis, (model::Vec3<double>{0, 0, 1}));
  EXPECT_EQ(joint_of(c, 0, 4).initial, 0.3);
  EXPECT_EQ(std::get<model::LinearSpring>(*joint_of(c, 0, 3).spring).stiffness, 2);
  EXPECT_TRUE(std::holds_alternative<model::OneSidedSpring>(*joint_of(c, 0, 4).spring));
}

TEST_F(CaseValues, OneSpringForAJointWithSeveralAxesIsOnEachOfThem) {
  const Case c =
      load(spatial_text("{ joint = \"spherical\", role = \"virtual\", stiffness = 4 },"));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(joint_of(c, 0, i).role, model::JointRole::compliant);
    EXPECT_EQ(std::get<model::LinearSpring>(*joint_of(c, 0, i).spring).stiffness, 4);
  }
}

TEST_F(CaseValues, FramesAreAShiftAndThenARotation) {
  const Case c = load(replaced(
      spatial_text(
          "{ rigid = { at = [1, 2, 3], rotate = { axis = [0, 0, 5], angle = \"90*deg\" } } },"),
      "elements",
      "from_at = [4, 5, 6]\nto_at = { rotate = { axis = \"x\", angle = \"pi\" } }\nelements"));
  const model::Chain& chain = c.runs[0].mechanism.chains[0];
  const auto& link = std::get<model::RigidLink>(chain.elements[0]).transform;
  EXPECT_EQ(link.p, (model::Vec3<double>{1, 2, 3}));
  EXPECT_LT((link.R * model::Vec3<double>::UnitX() - model::Vec3<double>::UnitY()).norm(), 1e-15);
  EXPECT_EQ(chain.from_attachment.p, (model::Vec3<double>{4, 5, 6}));
  EXPECT_LT(
      (chain.to_attachment.R * model::Vec3<double>::UnitY() + model::Vec3<double>::UnitY()).norm(),
      1e-15);
}

TEST_F(CaseValues, AnAxisGivenByNumbersIsMadeAUnitVector) {
  const Case c = load(spatial_text("{ joint = \"revolute\", axis = [\"3\", 0, 4] },"));
  EXPECT_LT((joint_of(c, 0, 0).axis - model::Vec3<double>{0.6, 0, 0.8}).norm(), 1e-15);
  EXPECT_EQ(joint_of(c, 0, 0).name, "j1");
}

TEST_F(CaseValues, ElementsMayBeTablesOfTheirOwn) {
  const Case c = load(
      "[[body]]\nname = \"tool\"\ntask_space = \"xy\"\n[[chain]]\nname = \"leg\"\n"
      "[[chain.elements]]\njoint = \"revolute\"\naxis = \"z\"\nname = \"hip\"\n"
      "[[chain.elements]]\nrigid = [1, 0]\n"
      "[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\n");
  EXPECT_EQ(c.runs[0].mechanism.chains[0].elements.size(), 2u);
  EXPECT_EQ(joint_of(c, 0, 0).name, "hip");
}

TEST_F(CaseValues, ChainsMayJoinTwoMovingBodies) {
  const Case c = load(
      "[[body]]\nname = \"a\"\ntask_space = \"planar\"\npose = [1, 2, \"pi\"]\n"
      "[[body]]\nname = \"b\"\ntask_space = \"planar\"\n"
      "[[chain]]\nname = \"ground\"\nto = \"a\"\nelements = [{ joint = \"revolute\", axis = \"z\" "
      "}]\n"
      "[[chain]]\nname = \"link\"\nfrom = \"a\"\nto = \"b\"\nfrom_at = [1, 0]\n"
      "elements = [{ joint = \"revolute\", axis = \"z\" }]\n"
      "[[study]]\nname = \"rest\"\nkind = \"equilibrium\"\nbody = \"b\"\n");
  const model::Mechanism& m = c.runs[0].mechanism;
  EXPECT_EQ(m.bodies[0].pose, (Vector{{1, 2, std::numbers::pi}}));
  EXPECT_EQ(m.chains[1].from, 1);
  EXPECT_EQ(m.chains[1].to, 2);
  EXPECT_EQ(c.runs[0].plan.body, 2);
}

TEST_F(CaseValues, DirectionsOfBodiesThatTurnHaveUnitTranslationOrElseUnitRotation) {
  const auto direction = [this](const std::string& entries) {
    return load(
               "[[body]]\nname = \"tool\"\ntask_space = \"planar\"\n[[chain]]\nname = \"leg\"\n"
               "elements = [{ joint = \"revolute\", axis = \"z\" }]\n[[study]]\nname = \"turn\"\n"
               "control = \"pose\"\ndirection = " +
               entries + "\n")
        .runs[0]
        .plan.direction;
  };
  EXPECT_EQ(direction("[3, 4, 10]"), (Vector{{0.6, 0.8, 2}}));
  EXPECT_EQ(direction("[0, 0, -4]"), (Vector{{0, 0, -1}}));
}

TEST_F(CaseValues, NamesWithDotsNeedNoQuotes) {
  const Case c = load(replaced(orthoglide_text(), "\"leg_x.knee\" =", "leg_x.knee ="));
  EXPECT_EQ(c.runs[0].plan.until[0].quantity, "leg_x.knee");
}

TEST_F(CaseValues, OfActuatorControlAreRates) {
  std::string text =
      replaced(orthoglide_text(), "control = \"mixed\"",
               "control = \"actuator\"\nactuators = { \"leg_x.drive\" = 1, leg_y.drive = -0.5 }");
  const Case c = load(replaced(text, "y = \"force\"", "y = \"energy\""));
  ASSERT_EQ(c.runs[0].plan.actuators.size(), 2u);
  EXPECT_EQ(c.runs[0].plan.actuators[1].actuator, "leg_y.drive");
  EXPECT_EQ(c.runs[0].plan.actuators[1].rate, -0.5);
}

TEST_F(CaseValues, OfExpectationsUseTheParametersOfTheirRun) {
  write("expected.toml", R"(notes = ["first", "second"]
[[value]]
name = "stiffness"
group = "table"
study = "Q2"
run = 2
at = "LP1"
quantity = "stiffness"
expected = "1 + Kv"
tolerance = 1e-3
factor = "1/K"
source = "a book"
[[value]]
name = "no limit point"
study = "Q2"
quantity = "count.LP"
expected = 0
tolerance = 0
)");
  const Case c = load(orthoglide_text());
  ASSERT_EQ(c.expected.values.size(), 2u);
  EXPECT_THAT(c.expected.notes, ElementsAre("first", "second"));
  const ExpectedValue& v = c.expected.values[0];
  EXPECT_EQ(v.expected, 1.1);  // Kv = 0.1 in run 2
  EXPECT_EQ(v.tolerance, 1e-3);
  EXPECT_EQ(v.at, "LP1");
  EXPECT_EQ(v.group, "table");
  EXPECT_EQ(v.source, "a book");
  EXPECT_EQ(c.expected.values[1].at, "start");
  EXPECT_EQ(c.expected.values[1].run, 1);
  EXPECT_TRUE(load("expected = \"\"\n" + orthoglide_text()).expected.values.empty());
}

}  // namespace
}  // namespace springfold::io
