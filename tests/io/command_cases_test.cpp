// Studies of commands in case files: what they become, and what is said about mistakes in them.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CommandCases : public CaseFiles {
 protected:
  /// The planar Orthoglide with this study; its first line is line 17.
  static std::string text(const std::string& study) {
    return R"toml([parameters]
K = 1
Kv = 0.05
edge = "0.4"
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "a"
elements = [ { joint = "prismatic", axis = "x", name = "d", role = "actuated", value = 1, stiffness = "K" },
  { joint = "revolute", axis = "-z", name = "k", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } }, { rigid = [-1, 0] } ]
[[chain]]
name = "b"
elements = [ { joint = "prismatic", axis = "y", name = "d", role = "actuated", value = 1, stiffness = "K" },
  { joint = "revolute", axis = "z", name = "k", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } }, { rigid = [0, -1] } ]
[[study]]
name = "s"
)toml" + study +
           "\n";
  }
  std::vector<std::string> about(const std::string& study) const { return messages(text(study)); }
  analysis::Study plan(const std::string& study) const { return load(text(study)).runs.at(0).plan; }
};

TEST_F(CommandCases, ALineHasEquallySpacedTargetsAndLoads) {
  const auto study = plan(R"(kind = "control"
line = { from = [0, 0], to = ["edge", 0.2], points = 3 }
loads = [[0, 0], [1, 2]])");
  EXPECT_EQ(study.kind, analysis::StudyKind::control);
  ASSERT_EQ(study.targets.targets.size(), 3u);
  EXPECT_EQ(study.targets.targets[1], Vector({{0.2, 0.1}}));
  EXPECT_EQ(study.targets.targets[2], Vector({{0.4, 0.2}}));
  EXPECT_EQ(study.targets.loads[1], Vector({{0.5, 1}}));
}

TEST_F(CommandCases, TargetsMayStandInAFileWithWrenches) {
  write("path.csv", "# a path\nx, y, Fx\n0, 0, 0\n0.1, -0.2, 0.5 # end\n");
  const auto study = plan("kind = \"control\"\nfile = \"path.csv\"");
  ASSERT_EQ(study.targets.targets.size(), 2u);
  EXPECT_EQ(study.targets.targets[1], Vector({{0.1, -0.2}}));
  EXPECT_EQ(study.targets.loads[1], Vector({{0.5, 0}}));
}

TEST_F(CommandCases, TheFileOfTargetsBelongsToTheFingerprint) {
  write("path.csv", "x,y\n0,0\n");
  const std::string study = text("kind = \"control\"\nfile = \"path.csv\"");
  const std::string first = load(study).hash;
  write("path.csv", "x,y\n0,0.1\n");
  EXPECT_NE(load(study).hash, first);
}

TEST_F(CommandCases, SayWhatIsWrongInAFileOfTargets) {
  const std::string study = "kind = \"control\"\nfile = \"path.csv\"";
  EXPECT_THAT(about(study), ElementsAre(HasSubstr("study[1].file: \"path.csv\" cannot be read")));
  write("path.csv", "x,z\n0,0\n");
  EXPECT_THAT(about(study), ElementsAre(HasSubstr("path.csv:1:1: need a column \"y\""),
                                        HasSubstr("unknown column \"z\"")));
  write("path.csv", "x,y\n0,a\n1\n");
  EXPECT_THAT(about(study),
              ElementsAre(HasSubstr("path.csv:2:1: y: got \"a\", need a number"),
                          HasSubstr("path.csv:3:1: got 1 fields, need 2 as in the first line")));
  write("path.csv", "x,y\n");
  EXPECT_THAT(about(study), ElementsAre(HasSubstr("has no targets")));
}

TEST_F(CommandCases, NeedOnePathAndTargetsOfTheRightLength) {
  EXPECT_THAT(about("kind = \"control\""),
              ElementsAre(HasSubstr("need one of targets, line, circle and file, got none")));
  EXPECT_THAT(about("kind = \"control\"\ntargets = [[0, 0, 1]]"),
              ElementsAre(HasSubstr("targets[1]: got a list of 3, need a list of 2 numbers")));
  EXPECT_THAT(about("kind = \"control\"\ntargets = []"),
              ElementsAre(HasSubstr("targets: got an empty list, need at least one target")));
  EXPECT_THAT(about("kind = \"control\"\ntargets = [[0, 0]]\nloads = [[0, 0], [0, 1]]"),
              ElementsAre(HasSubstr("loads: got a list of 2, need 1: one for every target")));
  EXPECT_THAT(
      about("kind = \"control\"\ncircle = { centre = [0, 0], radius = -1, points = 1 }"),
      ElementsAre(HasSubstr("circle.radius: got -1, need a number > 0 [m]"),
                  HasSubstr("circle.points: got 1, need a whole number from 2 to 1000000")));
}

TEST_F(CommandCases, NeedAsManyCommandsAsPrescribedCoordinates) {
  EXPECT_THAT(about("kind = \"control\"\nprescribe = [\"x\"]\ntargets = [[0]]"),
              ElementsAre(HasSubstr("prescribe: need as many pose coordinates as commands, got 1 "
                                    "coordinates and 2 actuated joints")));
  EXPECT_THAT(about("kind = \"control\"\nprescribe = [\"x\", \"z\"]\ntargets = [[0, 0]]"),
              testing::Contains(HasSubstr("prescribe[2]: got \"z\", need a pose coordinate of "
                                          "\"tool\": \"x\" or \"y\"")));
  EXPECT_THAT(about("kind = \"control\"\ncommands = [\"a.c\"]\ntargets = [[0, 0]]"),
              testing::Contains(HasSubstr("commands[1]: no actuator \"a.c\"")));
}

TEST_F(CommandCases, HaveKeysOfTheirOwn) {
  EXPECT_THAT(about("kind = \"control\"\ntargets = [[0, 0]]\nuntil = { lambda = [0, 1] }"),
              ElementsAre(HasSubstr("study[1].until: unknown key")));
  EXPECT_THAT(about("kind = \"force_deflection\"\ncontrol = \"load\"\ndirection = [1, 0]\n"
                    "targets = [[0, 0]]"),
              ElementsAre(HasSubstr("study[1].targets: unknown key")));
}

TEST_F(CommandCases, AMapRunsOverPosesAndParameters) {
  const auto study = plan(R"(kind = "map"
axes = [ { parameter = "Kv", from = 0, to = 0.1, points = 3 }, { pose = "y", from = "-edge", to = "edge", points = 5 } ]
pose = ["Kv", 0]
directions = [[3, 4]]
critical = { direction = [1, 0], up_to = "K" })");
  ASSERT_EQ(study.map.axes.size(), 2u);
  EXPECT_EQ(study.map.axes[0].name, "Kv");
  EXPECT_EQ(study.map.axes[1].name, "node.y");
  EXPECT_EQ(study.map.nodes(), 15);
  EXPECT_EQ(study.map.directions[0], Vector({{0.6, 0.8}}));
  const analysis::Situation at = study.map.situation({0.1});
  EXPECT_EQ(at.pose[0], 0.1);
  const auto& knee = std::get<model::Joint>(at.mechanism.chains[0].elements[1]);
  EXPECT_EQ(std::get<model::LinearSpring>(*knee.spring).stiffness, 0.1);
}

TEST_F(CommandCases, SayWhatIsWrongInAMap) {
  EXPECT_THAT(about("kind = \"map\""), ElementsAre(HasSubstr("study[1].axes: missing")));
  EXPECT_THAT(about("kind = \"map\"\naxes = [{ from = 0, to = 1, points = 2 }]"),
              ElementsAre(HasSubstr("need pose = \"x\" or parameter = \"name\"")));
  EXPECT_THAT(
      about("kind = \"map\"\naxes = [{ parameter = \"Kw\", from = 0, to = 1, points = 2 }]"),
      testing::Contains(HasSubstr("no parameter \"Kw\"")));
  EXPECT_THAT(about("kind = \"map\"\naxes = [{ pose = \"x\", from = 1, to = 1, points = 2 }]"),
              ElementsAre(HasSubstr("axis 1: need two different finite ends")));
  EXPECT_THAT(about("kind = \"map\"\naxes = [{ pose = \"x\", from = 0, to = 1, points = 2 }]\n"
                    "critical = { direction = [0, 0], up_to = 1 }"),
              ElementsAre(HasSubstr("the load grows along it")));
  EXPECT_THAT(about("kind = \"map\"\naxes = [{ pose = \"x\", from = 0, to = 1, points = 2 }]\n"
                    "command = \"given\""),
              ElementsAre(HasSubstr("with command = \"given\" the pose is a result")));
}

TEST_F(CommandCases, SayWhatIsWrongInAWorkspace) {
  EXPECT_THAT(about("kind = \"workspace\"\nup_to = 1"),
              ElementsAre(HasSubstr("study[1].velocity_factors: missing")));
  EXPECT_THAT(about("kind = \"workspace\"\nup_to = 0\nvelocity_factors = [2, 0.5]"),
              ElementsAre(HasSubstr("up_to: got 0, need a number > 0"),
                          HasSubstr("need more than 2 (low < high)")));
  EXPECT_THAT(about("kind = \"workspace\"\nup_to = 1\nvelocity_factors = [0.5, 2]\n"
                    "shape = \"cube\""),
              ElementsAre(HasSubstr("shape: a body in the plane has a square or a disc")));
}

TEST_F(CommandCases, SayWhatIsWrongInAFigureOfMaps) {
  const std::string map =
      "kind = \"map\"\naxes = [{ pose = \"x\", from = 0, to = 1, points = 2 }, "
      "{ pose = \"y\", from = 0, to = 1, points = 2 }]\n";
  EXPECT_THAT(about(map + "[[map_plot]]\nname = \"m\"\nquantity = \"K_trans_min\"\n"
                          "panels = [{ study = \"s\" }]"),
              IsEmpty());
  EXPECT_THAT(about(map + "[[map_plot]]\nname = \"m\"\nquantity = \"K_trans_mix\"\n"
                          "panels = [{ study = \"s\" }]"),
              ElementsAre(HasSubstr("no quantity \"K_trans_mix\"")));
  EXPECT_THAT(about("kind = \"control\"\ntargets = [[0, 0]]\n[[map_plot]]\nname = \"m\"\n"
                    "quantity = \"K_trans_min\"\npanels = [{ study = \"s\", slice = 2 }]"),
              ElementsAre(HasSubstr("need a study of kind \"map\" with at least two axes")));
}

TEST_F(CommandCases, LoadsThatGrowOrHaveNoPotentialAreRefused) {
  const std::string study = "kind = \"control\"\ntargets = [[0, 0]]\n[[load]]\n";
  EXPECT_THAT(about(study + "force = [1, 0]"), IsEmpty());
  EXPECT_THAT(about(study + "force = [1, 0]\nscale = \"lambda\""),
              ElementsAre(HasSubstr("load 1 grows with lambda, which this kind does not have")));
  std::string follows = text(study + "name = \"F\"\non = \"a.p\"\nforce = [1, 0]\nfollows = true");
  follows.replace(follows.find("{ rigid = [-1, 0] }"), 19,
                  "{ rigid = [-1, 0] }, { point = \"p\" }");
  EXPECT_THAT(messages(follows), ElementsAre(HasSubstr("load \"F\" has no potential")));
}

TEST_F(CommandCases, SpringsCountedFromAStartPoseAreRefused) {
  for (const std::string kind : {"kind = \"control\"\ntargets = [[0, 0]]",
                                 "kind = \"workspace\"\nvelocity_factors = [0.5, 2]\nup_to = 1"}) {
    std::string counted = text(kind);
    const std::string law = "law = \"linear\",";
    ASSERT_NE(counted.find(law), std::string::npos) << counted;
    counted.replace(counted.find(law), law.size(), law + " origin = \"start\",");
    EXPECT_THAT(messages(counted),
                ElementsAre(HasSubstr("with origin = \"start\": this kind has no start pose, need "
                                      "the spring's own origin")));
  }
}

TEST_F(CommandCases, RedundantClosuresAreRefused) {
  const std::string rod = R"([[chain]]
name = "ROD"
from_at = [-2, 0]
elements = [ { joint = "revolute", axis = "z", name = "k" }, { rigid = [2, 0] }, { joint = "revolute", axis = "z", name = "e" } ]
)";
  std::string both;
  for (const char* name : {"p", "q"}) both += std::string(rod).replace(rod.find("ROD"), 3, name);
  EXPECT_THAT(about("kind = \"control\"\ntargets = [[0, 0]]\n" + both),
              ElementsAre(HasSubstr("closure equations are redundant")));
}

}  // namespace
}  // namespace springfold::io
