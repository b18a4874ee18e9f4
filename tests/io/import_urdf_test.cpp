// Robots of other programs as cases.
#include "springfold/io/import_urdf.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "case_files.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// Two links of length 1 and 0.5 in the plane.
const std::string arm_urdf = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="floor"/>
  <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="3"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="fore arm"/>
  <link name="hand"><inertial><mass value="0.5"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
    <visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="shoulder" type="revolute"><parent link="floor"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore arm"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 2"/><dynamics damping="0.1"/></joint>
  <joint name="wrist" type="fixed"><parent link="fore arm"/><child link="hand"/><origin xyz="0.5 0 0"/></joint>
</robot>
)";

class ImportedRobot : public CaseFiles {
 protected:
  void SetUp() override {
    if (!reads_urdf()) GTEST_SKIP() << "built without urdfdom";
  }
  ImportedCase import(const std::string& text) const { return import_urdf(write("a.urdf", text)); }
  Case read(const std::string& text) const { return load(import(text).text); }
  std::vector<std::string> problems(const std::string& text) const {
    try {
      import(text);
    } catch (const CaseError& error) {
      return error.messages();
    }
    return {};
  }
};

TEST_F(ImportedRobot, GivesWayAsItsDrivesDo) {
  const Case the_case = read(arm_urdf);
  const PlannedRun& run = the_case.runs.at(0);
  const auto result = analysis::run_study(run.mechanism, run.plan);
  ASSERT_TRUE(result.start.found) << result.start.message;
  // C = J K^-1 J^T with the lever arms 1.5 and 0.5 of the hand about the two axes.
  const double k = 1000;
  const Matrix& C = result.start.compliance;
  ASSERT_EQ(C.rows(), 6);
  EXPECT_NEAR(C(1, 1), (1.5 * 1.5 + 0.5 * 0.5) / k, 1e-12);
  EXPECT_NEAR(C(1, 5), (1.5 + 0.5) / k, 1e-12);
  EXPECT_NEAR(C(5, 5), 2 / k, 1e-12);
  EXPECT_NEAR(C(0, 0), 0, 1e-12);
  EXPECT_NEAR(C(2, 2), 0, 1e-12);
}

TEST_F(ImportedRobot, StandsWhereTheFramesOfItsOriginsPutIt) {
  const Case the_case =
      read(R"(<robot name="turned"><link name="base_link"/><link name="a"/><link name="b"/>
<joint name="j1" type="revolute"><parent link="base_link"/><child link="a"/><axis xyz="0 1 1"/>
<origin xyz="0.1 -0.2 0.3" rpy="0.4 -0.7 1.1"/><limit lower="0" upper="0" effort="0" velocity="0"/></joint>
<joint name="j2" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>
<origin xyz="0.5 0.6 -0.7" rpy="-1.2 0.8 0.3"/><limit lower="0" upper="0" effort="0" velocity="0"/></joint></robot>)");
  const auto rpy = [](double r, double p, double y) -> Eigen::Matrix3d {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    return (AngleAxisd(y, Vector3d::UnitZ()) * AngleAxisd(p, Vector3d::UnitY()) *
            AngleAxisd(r, Vector3d::UnitX()))
        .toRotationMatrix();
  };
  const Eigen::Matrix3d R1 = rpy(0.4, -0.7, 1.1), R = R1 * rpy(-1.2, 0.8, 0.3);
  const Eigen::Vector3d p = Eigen::Vector3d{0.1, -0.2, 0.3} + R1 * Eigen::Vector3d{0.5, 0.6, -0.7};
  const model::Body& hand = the_case.runs.at(0).mechanism.bodies.at(0);
  EXPECT_LT((hand.pose.head(3) - p).norm(), 1e-14);
  const Eigen::Vector3d turn = hand.pose.tail(3);
  EXPECT_LT((Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() - R).norm(),
            1e-14);
  const auto result = analysis::run_study(the_case.runs[0].mechanism, the_case.runs[0].plan);
  ASSERT_TRUE(result.start.found);
  EXPECT_LT(result.start.moved, 1e-12) << "the chain leads where the body is";
}

TEST_F(ImportedRobot, HasABodyWhereItsChainsPartAndWhereTheyEnd) {
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<link name=\"" + child + "\"/><joint name=\"to " + child +
           "\" type=\"continuous\"><parent link=\"" + parent + "\"/><child link=\"" + child +
           "\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 1 0\"/></joint>";
  };
  const Case the_case =
      read("<robot name=\"tree\"><link name=\"root\"/>" + joint("root", "trunk") +
           joint("trunk", "fork") + joint("fork", "left") + joint("fork", "right") + "</robot>");
  const model::Mechanism& tree = the_case.runs.at(0).mechanism;
  ASSERT_THAT(tree.bodies, SizeIs(3));
  ASSERT_THAT(tree.chains, SizeIs(3));
  EXPECT_EQ(tree.bodies[0].name, "fork");
  EXPECT_EQ(tree.chains[0].from, 0);
  for (const std::size_t arm : {std::size_t{1}, std::size_t{2}})
    EXPECT_EQ(tree.chains[arm].from, 1);
  EXPECT_EQ(tree.bodies[2].pose[0], 3);
}

TEST_F(ImportedRobot, SaysWhatWasLeftOut) {
  EXPECT_THAT(
      import(arm_urdf).report,
      ElementsAre("4 links: the base \"floor\", 1 body, 2 elastic drives",
                  "stiffnesses are placeholders: put in your own, and commands, loads and studies",
                  "masses have no weight until the case has a gravity",
                  "left out: damping and friction of joints (1)", "left out: limits of joints (1)",
                  "left out: shapes to be seen (1)"));
  const Case the_case = read(arm_urdf);
  EXPECT_EQ(the_case.runs.at(0).mechanism.bodies.at(0).mass, 0.5);
  const std::string mimic =
      replaced(arm_urdf, "<dynamics damping=\"0.1\"/>", "<mimic joint=\"shoulder\"/>");
  EXPECT_THAT(import(mimic).report,
              Contains("joint \"elbow\" mimics \"shoulder\": here it has a drive of its own"));
}

/// A rod along x of the frame of its moments of inertia, which stands across the link: about its ends' axis there is
/// none.
TEST_F(ImportedRobot, HasItsMomentsOfInertiaInTheAxesOfItsLinks) {
  const std::string inertial =
      "<origin xyz=\"0.5 0 0\" rpy=\"0 0 1.5707963267948966\"/><mass value=\"3\"/>";
  const std::string turned =
      replaced(arm_urdf, "<origin xyz=\"0.5 0 0\"/><mass value=\"3\"/>", inertial);
  const Case the_case = read(turned);
  const model::Mechanism& arm = the_case.runs.at(0).mechanism;
  ASSERT_THAT(arm.chains.at(0).points, SizeIs(1));
  const model::ChainPoint& upper = arm.chains[0].points[0];
  EXPECT_EQ(upper.mass, 3);
  EXPECT_LT((upper.at - model::Vec3<double>(0.5, 0, 0)).norm(), 1e-15);
  model::Mat3<double> across = model::Mat3<double>::Zero();
  across.diagonal() << 0.1, 0, 0.1;
  EXPECT_LT((upper.inertia - across).norm(), 1e-15);
  const std::string impossible = replaced(arm_urdf, "<mass value=\"0.5\"/><inertia ixx=\"0\"",
                                          "<mass value=\"0.5\"/><inertia ixx=\"0.2\"");
  EXPECT_THAT(import(impossible).report,
              Contains(HasSubstr("left out: the moments of inertia of link \"hand\": no body has "
                                 "these moments")));
}

TEST_F(ImportedRobot, IsRefusedWithWhatIsWrong) {
  EXPECT_THAT(problems(replaced(arm_urdf, "type=\"continuous\"", "type=\"floating\"")),
              ElementsAre(HasSubstr(
                  "a.urdf: joint \"elbow\": got a floating or planar joint, need revolute")));
  EXPECT_THAT(problems(replaced(arm_urdf, "0 0 2", "0 0 0")),
              ElementsAre(HasSubstr("joint \"elbow\": got an axis without a direction")));
  EXPECT_THAT(problems("<robot name=\"x\"><link"),
              ElementsAre(HasSubstr("a.urdf:1:17: no URDF: the tag <link has no >")));
  EXPECT_THAT(
      problems("<?xml version=\"1.0\"?>\n<robot name=\"x\">\n  <!-- > -->\n  <link name=\"a\">\n"
               "  </joint>\n</robot>"),
      ElementsAre(HasSubstr("a.urdf:5:3: no URDF: got the end of <joint>, need that of <link> "
                            "first")));
  EXPECT_THAT(problems("<robot name=\"x\">\n<link name=\"a\"/>"),
              ElementsAre(HasSubstr("a.urdf:1:1: no URDF: <robot> has no end")));
  EXPECT_THAT(problems(""), ElementsAre(HasSubstr("no URDF: ")));
  EXPECT_THAT(problems("<robot name=\"x\"><link name=\"a\"/></robot>"),
              ElementsAre(HasSubstr("no joint moves")));
  std::string deep = "<robot name=\"x\">";
  for (int i = 0; i < 2000; ++i) deep += "<a>";
  EXPECT_THAT(problems(deep), ElementsAre(HasSubstr("nested too deeply")));
}

TEST_F(ImportedRobot, IsRefusedWhereJointsMakeACircle) {
  const std::string circle = replaced(
      arm_urdf, "</robot>",
      "<link name=\"p\"/><link name=\"q\"/>"
      "<joint name=\"pq\" type=\"fixed\"><parent link=\"p\"/><child link=\"q\"/></joint>"
      "<joint name=\"qp\" type=\"fixed\"><parent link=\"q\"/><child link=\"p\"/></joint></robot>");
  EXPECT_THAT(problems(circle), ElementsAre(HasSubstr("only 4 of 6 links hang on the root")));
}

TEST_F(ImportedRobot, IsRefusedWhereALinkHasTwoParents) {
  const auto joint = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return "<joint name=\"" + name + "\" type=\"continuous\"><parent link=\"" + parent +
           "\"/><child link=\"" + child + "\"/></joint>";
  };
  const std::string links =
      "<robot name=\"r\"><link name=\"b\"/><link name=\"a\"/><link name=\"c\"/>" +
      joint("j", "b", "a");
  const std::string in_a_circle = joint("k", "a", "c") + joint("l", "c", "a") + "</robot>";
  EXPECT_THAT(problems(links + in_a_circle),
              ElementsAre(HasSubstr("joint \"l\": leads to link \"a\" as joint \"j\" does, "
                                    "need a tree")));
  const std::string two_ways = joint("k", "b", "c") + joint("l", "a", "c") + "</robot>";
  EXPECT_THAT(problems(links + two_ways),
              ElementsAre(HasSubstr("joint \"l\": leads to link \"c\" as joint \"k\" does")));
  EXPECT_THAT(problems(links + joint("k", "b", "a") + joint("m", "a", "c") + "</robot>"),
              ElementsAre(HasSubstr("joint \"k\": leads to link \"a\" as joint \"j\" does")));
}

TEST_F(ImportedRobot, NamesEveryElementThatItPassesOver) {
  std::string text =
      replaced(arm_urdf, "</robot>",
               "<transmission name=\"t\"><joint name=\"elbow\"/><new/></transmission>"
               "<transmission name=\"u\"/><gazebo>1 &lt; 2</gazebo><!-- <ghost/> -->"
               "<xacro:leg xmlns:xacro=\"q\" side=\"/>\"/></robot>");
  text = replaced(text, "<dynamics damping=\"0.1\"/>", "<calibration rising=\"0\"/>");
  text = replaced(text, "<mass value=\"3\"/>", "<mass value=\"3\"/><sensor/>");
  std::vector<std::string> named;
  for (const std::string& line : import(text).report)
    if (line.find('<') != std::string::npos) named.push_back(line);
  EXPECT_THAT(
      named,
      ElementsAre("left out: <calibration> in <joint> (1)", "left out: <gazebo> in <robot> (1)",
                  "left out: <sensor> in <inertial> (1)", "left out: <transmission> in <robot> (2)",
                  "left out: <xacro:leg> in <robot> (1)"));
}

TEST_F(ImportedRobot, HasNamesThatACaseMayHave) {
  std::string text =
      replaced(arm_urdf, "<link name=\"hand\">", "<link name=\"the &quot;hand&quot;\">");
  text = replaced(text, "<child link=\"hand\"/>", "<child link=\"the &quot;hand&quot;\"/>");
  EXPECT_EQ(read(text).runs.at(0).mechanism.bodies.at(0).name, "the__hand_");
  EXPECT_THAT(import(text).report, Contains(HasSubstr("1 name is written otherwise")));
}

}  // namespace
}  // namespace springfold::io
