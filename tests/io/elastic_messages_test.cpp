// Elastic links in case files: what they become, and what is said about mistakes in them.
#include <gmock/gmock.h>

#include "case_files.hpp"
#include "springfold/model/elastic_link.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ElasticLinks : public CaseFiles {
 protected:
  static std::string text(const std::string& element, const std::string& space = "spatial") {
    const bool plane = space == "planar";
    return R"toml([parameters]
d = 0.02
N = 3
[[body]]
name = "tip"
task_space = ")toml" +
           space + "\"\n[[chain]]\nname = \"arm\"\nelements = [\n" + element +
           "\n]\n[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = " +
           (plane ? "[1, 0, 0]" : "[1, 0, 0, 0, 0, 0]") + "\n";
  }
  std::vector<std::string> about(const std::string& element,
                                 const std::string& space = "spatial") const {
    return messages(text(element, space));
  }
  model::Chain chain(const std::string& element, const std::string& space = "spatial",
                     const Overrides& overrides = {}) const {
    return load(text(element, space), overrides).runs.at(0).mechanism.chains.at(0);
  }
};

const std::string round_beam =
    R"({ elastic = "beam", length = 0.3, E = 7e10, G = 2.6e10, section = { shape = "round", diameter = "d" } })";

TEST_F(ElasticLinks, FromBeamDataAreCantilevers) {
  const model::Chain arm = chain(round_beam);
  const Matrix C = model::cantilever_compliance(0.3, 7e10, 2.6e10, model::round_section(0.02));
  ASSERT_EQ(arm.coupled_springs.size(), 1u);
  EXPECT_LT((arm.coupled_springs[0].stiffness * C - Matrix::Identity(6, 6)).norm(), 1e-9);
  EXPECT_EQ(std::get<model::Joint>(arm.elements[1]).name, "e1.Tx");
  EXPECT_EQ(std::get<model::Joint>(arm.elements[6]).name, "e1.Rz");
}

TEST_F(ElasticLinks, TakeTheirSectionAsNumbersOrShapes) {
  const auto tube = model::round_section(0.02, 0.01);
  const auto bar = model::rectangular_section(0.02, 0.03);
  for (const auto& [section, expected] :
       {std::pair{std::string{R"(section = { shape = "round", diameter = "d", inner = 0.01 })"},
                  tube},
        {R"(section = { shape = "rectangular", width = "d", height = 0.03 })", bar},
        {"A = 2, Iy = 3, Iz = 5, J = 7, Ay = 1.5, Az = 1.2",
         model::BeamSection{2, 3, 5, 7, 1.5, 1.2}}}) {
    const model::Chain arm =
        chain(R"({ elastic = "beam", length = 0.3, E = 7, G = 3, )" + section + " }");
    const Matrix C = model::cantilever_compliance(0.3, 7, 3, expected);
    EXPECT_LT((arm.coupled_springs[0].stiffness * C - Matrix::Identity(6, 6)).norm(), 1e-9)
        << section;
  }
}

TEST_F(ElasticLinks, AreCutIntoSegments) {
  const std::string beam = replaced(round_beam, "length = 0.3", "length = 0.3, segments = \"N\"");
  const model::Chain arm = chain(beam);
  ASSERT_EQ(arm.elements.size(), 21u);
  EXPECT_EQ(arm.coupled_springs.size(), 3u);
  EXPECT_DOUBLE_EQ(std::get<model::RigidLink>(arm.elements[14]).transform.p[0], 0.1);
  EXPECT_EQ(std::get<model::Joint>(arm.elements[15]).name, "e1.3.Tx");
  const Matrix C = model::cantilever_compliance(0.1, 7e10, 2.6e10, model::round_section(0.02));
  EXPECT_LT((arm.coupled_springs[2].stiffness * C - Matrix::Identity(6, 6)).norm(), 1e-9);
  EXPECT_EQ(chain(beam, "spatial", {{"N", "5"}}).coupled_springs.size(), 5u);
}

TEST_F(ElasticLinks, FromMatricesHaveTheDirectionsThatAreListed) {
  const model::Chain soft = chain(
      R"({ elastic = "compliance", directions = ["Tx", "Rz"], matrix = [[2, 1], [1, 2]], free = [0.1, 0], initial = [0.2, 0.3] })");
  ASSERT_EQ(soft.elements.size(), 2u);  // without length no rigid link
  Matrix K(2, 2);
  K << 2, -1, -1, 2;
  EXPECT_LT((soft.coupled_springs[0].stiffness - K / 3).norm(), 1e-15);
  EXPECT_EQ(soft.coupled_springs[0].free, (Vector{{0.1, 0}}));
  EXPECT_EQ(std::get<model::Joint>(soft.elements[1]).name, "e1.Rz");
  EXPECT_EQ(std::get<model::Joint>(soft.elements[1]).initial, 0.3);
}

TEST_F(ElasticLinks, InThePlaneGiveWayInThePlaneAndNeedWhatThatTakes) {
  const model::Chain arm =
      chain(R"({ elastic = "beam", length = 1, E = 1, A = 100, Iz = 2 })", "planar");
  EXPECT_EQ(arm.elements.size(), 4u);
  EXPECT_EQ(std::get<model::Joint>(arm.elements[3]).name, "e1.Rz");
  EXPECT_THAT(about(R"({ elastic = "beam", length = 1, E = 1, directions = ["Rx"] })", "planar"),
              ElementsAre(HasSubstr("got \"Rx\", need a list of \"Tx\", \"Ty\" or \"Rz\"")));
}

// A direction that is left out of a beam gives no way: its compliance is not there.
TEST_F(ElasticLinks, OfBeamsAreRigidWhereNotListed) {
  const model::Chain arm =
      chain(R"({ elastic = "beam", length = 0.5, E = 3, Iz = 2, directions = ["Rz"] })");
  EXPECT_NEAR(arm.coupled_springs[0].stiffness(0, 0), 3 * 2 / 0.5, 1e-14);
}

TEST_F(ElasticLinks, SayWhichDataAreMissing) {
  EXPECT_THAT(
      about(R"({ elastic = "beam", length = 0.3, E = 1, A = 1, Iy = 1 })"),
      ElementsAre(
          "case.toml:10:1: chain[1].elements[1].G: missing, need a number > 0 [N/m^2]",
          "case.toml:10:1: chain[1].elements[1].Iz: missing, need a number > 0 [m^4], or section = "
          "{ shape = ... }",
          "case.toml:10:1: chain[1].elements[1].J: missing, need a number > 0 [m^4], or section = "
          "{ "
          "shape = ... }"));
  EXPECT_THAT(about(R"({ elastic = "stiffness" })"),
              ElementsAre("case.toml:10:1: chain[1].elements[1].matrix: missing, need a list of 6 "
                          "rows of 6 numbers, rows and columns as directions"));
}

TEST_F(ElasticLinks, SayWhatIsWrongWithTheirMatrix) {
  const auto two = [this](const std::string& kind, const std::string& matrix) {
    return about(R"({ elastic = ")" + kind + R"(", directions = ["Tx", "Ty"], matrix = )" + matrix +
                 " }");
  };
  EXPECT_THAT(two("stiffness", "[[4, 3], [3, 1]]"),
              ElementsAre("case.toml:10:62: chain[1].elements[1].matrix: its smallest eigenvalue "
                          "is -0.5 (with the diagonal scaled to 1), need no negative eigenvalue"));
  EXPECT_THAT(two("stiffness", "[[1, 0.5], [0.25, 1]]"),
              ElementsAre(HasSubstr(".matrix: entry [1][2] is 0.5 and entry [2][1] is 0.25, need a "
                                    "symmetric matrix")));
  EXPECT_THAT(two("compliance", "[[0, 0], [0, 1]]"),
              ElementsAre(HasSubstr(".matrix: entry [1][1] is 0, need a number > 0")));
  EXPECT_THAT(two("stiffness", "[[1, 0]]"),
              ElementsAre(HasSubstr("got a list of 1, need a list of 2 rows of 2 numbers")));
  EXPECT_THAT(two("stiffness", "[[1, 0], [1]]"),
              ElementsAre(HasSubstr(".matrix[2]: got a list of 1, need a list of 2 numbers")));
  EXPECT_THAT(two("stiffness", "[[1, 0], [0, \"1/0\"]]"),
              ElementsAre(HasSubstr(".matrix[2][2]: ")));
}

TEST_F(ElasticLinks, SayWhatIsWrongWithTheirKeys) {
  EXPECT_THAT(about(R"({ elastic = "bean", length = 1 })"),
              ElementsAre(HasSubstr("got \"bean\", need \"beam\", \"stiffness\" or \"compliance\", "
                                    "did you mean \"beam\"?")));
  EXPECT_THAT(about(replaced(round_beam, "\"beam\"", "\"rod\"")),
              ElementsAre(HasSubstr("got \"rod\", need \"beam\", \"stiffness\" or")));
  EXPECT_THAT(about(replaced(round_beam, "0.3", "-0.3")),
              ElementsAre(HasSubstr(".length: got -0.3, need a number > 0 [m]")));
  EXPECT_THAT(about(replaced(round_beam, "diameter = \"d\"", "diameter = \"d\", inner = \"2*d\"")),
              ElementsAre(HasSubstr("the inner diameter must be smaller than diameter")));
  EXPECT_THAT(about(replaced(round_beam, "E = 7e10", "E = 7e10, A = 1")),
              ElementsAre(HasSubstr(".A: either section or A, not both")));
  EXPECT_THAT(about(replaced(round_beam, "length = 0.3", "length = 0.3, segments = 5001")),
              ElementsAre(HasSubstr(".segments: got 5001, need a whole number from 1 to 5000")));
  EXPECT_THAT(about(replaced(round_beam, "length = 0.3", "length = 0.3, segments = 1.5")),
              ElementsAre(HasSubstr(".segments: got 1.5, need a whole number from 1 to 5000")));
  EXPECT_THAT(
      about(replaced(round_beam, "length = 0.3", R"(length = 0.3, directions = ["Rz", "Tx"])")),
      ElementsAre(HasSubstr(".directions[2]: got \"Tx\", need a list of")));
  EXPECT_THAT(about(replaced(round_beam, "length = 0.3", "length = 0.3, directions = []")),
              ElementsAre(HasSubstr("a link that nowhere gives way is { rigid = ... }")));
  EXPECT_THAT(about(replaced(round_beam, "length = 0.3", "length = 0.3, free = [1, 2]")),
              ElementsAre(HasSubstr(".free: got a list of 2, need a list of 6 numbers, one per "
                                    "direction")));
  EXPECT_THAT(about(replaced(round_beam, "\"round\"", "\"square\"")),
              ElementsAre(HasSubstr("got \"square\", need \"round\" or \"rectangular\"")));
  EXPECT_THAT(about(R"({ elastic = "beam", rigid = [1, 0, 0] })"),
              ElementsAre(HasSubstr("got rigid and elastic, need exactly one of them")));
  EXPECT_THAT(about(round_beam + ",\n" + replaced(round_beam, "length", "name = \"e1\", length")),
              ElementsAre(HasSubstr("\"e1\" is already the name of another joint")));
}

TEST_F(ElasticLinks, CannotChangeTheirSegmentsAlongABranch) {
  const std::string beam = replaced(round_beam, "length = 0.3", "length = 0.3, segments = \"N\"");
  const std::string good =
      replaced(text(beam), "control = \"load\"", "control = \"parameter\"\nparameter = \"d\"");
  EXPECT_THAT(messages(good), IsEmpty());
  EXPECT_THAT(messages(replaced(good, "parameter = \"d\"", "parameter = \"N\"")),
              ElementsAre(HasSubstr(".segments: the number of segments cannot depend on the "
                                    "parameter of study \"s\"")));
}

TEST_F(ElasticLinks, NameTheQuantityThatOneRunDoesNotHave) {
  const std::string beam = replaced(round_beam, "length = 0.3", "length = 0.3, segments = \"N\"");
  const std::string several = text(beam) +
                              "vary = { parameter = \"N\", values = [3, 2] }\n"
                              "until = { \"arm.e1.3.Rz\" = [-1, 1] }\n";
  EXPECT_THAT(messages(several),
              ElementsAre(HasSubstr("no quantity \"arm.e1.3.Rz\" in study \"s\"")));
  EXPECT_THAT(messages(replaced(several, "e1.3.Rz", "e1.2.Rz")), IsEmpty());
}

}  // namespace
}  // namespace springfold::io
