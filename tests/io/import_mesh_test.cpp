// Meshes of other programs as cases.
#include "springfold/io/import_mesh.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_files.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::io {
namespace {

using model::Mechanism;
using testing::_;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

const std::string square_obj = R"(# a square of paper
mtllib paper.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1/1/1 2//1 3
f -4 -2 -1
)";

const std::string square_fold = R"({
  "file_spec": 1.1,
  "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
  "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
  "edges_assignment": ["B", "B", "B", "B", "V"],
  "faces_vertices": [[0, 1, 2], [0, 2, 3]],
  "faceOrders": []
}
)";

/// A Miura unit of four rhombi, side 1, acute angle 60 deg, folded.
std::string miura(double turn = 0) {
  const double g = pi / 3, t = 40 * pi / 180, c = std::cos(t) * std::tan(g);
  const double H = std::sin(t) * std::sin(g), S = c / std::hypot(1, c), V = 1 / std::hypot(1, c);
  const double L = std::sqrt(1 - H * H);
  std::string text = "{ \"vertices_coords\": [";
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double x = i * S, y = j * L + (i == 1 ? V : 0), z = j == 1 ? H : 0;
      text += (i + j > 0 ? ", [" : "[") + std::to_string(x * std::cos(turn) - z * std::sin(turn)) +
              ", " + std::to_string(y) + ", " +
              std::to_string(x * std::sin(turn) + z * std::cos(turn)) + "]";
    }
  return text + "], \"faces_vertices\": [[0, 3, 4, 1], [1, 4, 5, 2], [3, 6, 7, 4], [4, 7, 8, 5]] }";
}

class ImportedMesh : public CaseFiles {
 protected:
  ImportedCase import(const std::string& name, const std::string& text) const {
    return import_mesh(write(name, text));
  }
  Mechanism mechanism_of(const std::string& name, const std::string& text) const {
    return load(import(name, text).text).runs.front().mechanism;
  }
  std::vector<std::string> problems(const std::string& name, const std::string& text) const {
    try {
      import(name, text);
    } catch (const CaseError& error) {
      std::vector<std::string> list = error.messages();
      for (std::string& message : list) message.erase(0, folder_.string().size() + 1);
      return list;
    }
    return {};
  }
};

double rest_of_fold(const Mechanism& mechanism, const std::string& name) {
  for (const model::ShapeSpring& spring : mechanism.shape_springs)
    if (spring.name == name) return std::get<model::LinearSpring>(spring.law).free;
  ADD_FAILURE() << name;
  return 0;
}

TEST_F(ImportedMesh, OfASquareWithADiagonalHasFiveBarsAndOneFlatFold) {
  for (const Mechanism& mechanism :
       {mechanism_of("square.obj", square_obj), mechanism_of("square.fold", square_fold)}) {
    EXPECT_EQ(mechanism.line_springs.size(), 5U);
    double sum = 0;
    for (const model::LineSpring& bar : mechanism.line_springs) sum += bar.free;
    EXPECT_DOUBLE_EQ(sum, 4 + std::sqrt(2.0));
    ASSERT_EQ(mechanism.shape_springs.size(), 1U);
    const auto& law = std::get<model::LinearSpring>(mechanism.shape_springs[0].law);
    EXPECT_DOUBLE_EQ(law.free, pi);
    EXPECT_DOUBLE_EQ(law.stiffness, std::sqrt(2.0));
  }
}

TEST_F(ImportedMesh, SaysWhatWasMadeAndWhatWasLeftOut) {
  EXPECT_THAT(import("square.obj", square_obj).report,
              ElementsAre("4 vertices, 5 edges, 2 faces: 4 nodes, 5 bars, 1 fold",
                          "held so that the whole cannot move, each motion once: v1, v3, v2; put "
                          "supports where they belong",
                          "stiffnesses are placeholders: put in your own, and loads",
                          "left out, having no meaning here: mtllib"));
  EXPECT_THAT(import("square.fold", square_fold).report,
              Contains("left out, having no meaning here: faceOrders"));
  EXPECT_THAT(import("square.fold", replaced(square_fold, "\"V\"", "\"C\"")).report,
              Contains("1 edge between two faces is a cut or border and has no fold"));
  EXPECT_THAT(
      import("fan.obj", square_obj + "v 0 0 1\nv 9 9 9\nf 1 3 5\n").report,
      testing::IsSupersetOf(
          {"left out: the fold over the edge from v1 to v3, which more than two faces share",
           "left out: 1 vertex without an edge"}));
}

TEST_F(ImportedMesh, HasNoFoldsBetweenFacesThatLieOnEachOther) {
  const ImportedCase twice = import("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  EXPECT_THAT(twice.report, Contains("left out: the fold over the edge from v1 to v2 and 2 more, "
                                     "whose faces lie on each other"));
  EXPECT_THAT(import("shut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 2 0\nf 1 2 3\nf 2 1 4\n").report,
              Contains("left out: the fold over the edge from v1 to v2, whose faces lie on each "
                       "other"));
}

// At a flat-foldable vertex of sector angles 60 and 120 deg: tan(minor/2) = cos 60 deg tan(major/2).
TEST_F(ImportedMesh, OfAMiuraUnitHasItsFoldAnglesAtRest) {
  const Mechanism mechanism = mechanism_of("miura.fold", miura());
  EXPECT_EQ(mechanism.line_springs.size(), 16U);
  EXPECT_EQ(mechanism.shape_springs.size(), 8U);
  const auto folded = [&](const std::string& name) { return pi - rest_of_fold(mechanism, name); };
  EXPECT_NEAR(folded("fold-v1-v4"), folded("fold-v4-v7"), 1e-5);  // six digits in the file
  EXPECT_NEAR(folded("fold-v3-v4"), -folded("fold-v4-v5"), 1e-5);
  EXPECT_NEAR(std::tan(std::abs(folded("fold-v3-v4")) / 2),
              std::cos(pi / 3) * std::tan(std::abs(folded("fold-v1-v4")) / 2), 1e-5);
  EXPECT_NEAR(folded("fold-v1-v3"), 0, 1e-5);  // a cut of a flat face
}

TEST_F(ImportedMesh, IsWhatTheCaseOfTheLibraryBeganWith) {
  const std::string folder = SPRINGFOLD_SOURCE_DIR "/cases/miura-unit/";
  const Mechanism made = load(import_mesh(folder + "unit.fold").text).runs[0].mechanism;
  const Mechanism used = load_case(folder + "case.toml", {}).runs[0].mechanism;
  ASSERT_EQ(made.line_springs.size(), used.line_springs.size());
  for (std::size_t i = 0; i < used.line_springs.size(); ++i) {
    EXPECT_EQ(made.line_springs[i].name, used.line_springs[i].name);
    EXPECT_EQ(made.line_springs[i].free, used.line_springs[i].free);
  }
  ASSERT_EQ(made.shape_springs.size(), used.shape_springs.size());
  for (const model::ShapeSpring& spring : used.shape_springs)
    EXPECT_EQ(rest_of_fold(made, spring.name), rest_of_fold(used, spring.name));
}

TEST_F(ImportedMesh, RestsAsDrawnAndCannotMoveAsAWhole) {
  std::vector<std::string> texts{import("square.obj", square_obj).text};
  for (const double turn : {0.0, 0.7, pi / 2})
    texts.push_back(import("miura.fold", miura(turn)).text);
  texts.push_back(import("bars.fold", R"({ "vertices_coords": [[0, 0], [1, 0], [0, 1]],
    "edges_vertices": [[0, 1], [1, 2], [2, 0]] })")
                      .text);
  for (const std::string& text : texts) {
    const Case read = load(text);
    const auto result = analysis::run_study(read.runs[0].mechanism, read.runs[0].plan);
    ASSERT_TRUE(result.start.found) << text;
    EXPECT_LT(result.start.moved, 1e-12) << text;
    EXPECT_EQ(result.start.zero_modes, 0) << text;
  }
}

TEST_F(ImportedMesh, OfTwoCoordinatesWithoutFacesLiesInThePlane) {
  const Mechanism mechanism = mechanism_of("bars.fold", R"({ "vertices_coords": [[0, 0], [1, 0],
    [0, 1]], "edges_vertices": [[0, 1], [1, 2], [2, 0]] })");
  EXPECT_EQ(mechanism.bodies.front().task_space, model::TaskSpace::xy);
}

TEST_F(ImportedMesh, CutsQuadrilateralsAlongTheirShorterDiagonal) {
  const Mechanism mechanism =
      mechanism_of("kite.obj", "v 0 0 0\nv 1 -1 0\nv 3 0 0\nv 1 1 0\nf 1 2 3 4\n");
  ASSERT_EQ(mechanism.line_springs.size(), 5U);
  EXPECT_EQ(mechanism.line_springs.back().name, "v2-v4");
  EXPECT_EQ(mechanism.line_springs.back().free, 2);
}

TEST_F(ImportedMesh, CutsFacesWithACornerThatPointsInwardsInside) {
  // An arrowhead, either way round: the shorter diagonal, v1 to v3, lies outside of it.
  for (const char* face : {"f 1 2 3 4\n", "f 4 3 2 1\n"}) {
    const Mechanism arrow =
        mechanism_of("arrow.obj", std::string{"v 3 2 0\nv 2.2 2.2 0\nv 2 3 0\nv 0 0 0\n"} + face);
    ASSERT_EQ(arrow.line_springs.size(), 5U);
    EXPECT_EQ(arrow.line_springs.back().name, "v2-v4");
  }
  // An L of area 3: its triangles cover it, none of them twice.
  const Mechanism corner = mechanism_of(
      "l.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n");
  ASSERT_EQ(corner.line_springs.size(), 9U);
  for (std::size_t i = 6; i < 9; ++i) {
    const std::string& name = corner.line_springs[i].name;
    EXPECT_NE(name, "v3-v5") << "outside";
    EXPECT_NE(name, "v3-v6") << "it crosses the corner that points inwards";
    EXPECT_NE(name, "v2-v5") << "it crosses the corner that points inwards";
  }
  EXPECT_THAT(problems("tie.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\nf 1 2 3 4\n"),
              ElementsAre(HasSubstr("its sides cross each other, need a face that does not")));
}

TEST_F(ImportedMesh, SaysWhatIsNotJoinedAndWhatItsSupportsDoNotHold) {
  const ImportedCase apart =
      import("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n");
  EXPECT_THAT(apart.report, testing::IsSupersetOf(
                                {"not joined: v2 and v4 are at one place, and so are 1 more",
                                 "the mesh has 2 separate parts: the supports hold one of them, "
                                 "need more for the others"}));
  EXPECT_THAT(import("angles.fold", replaced(square_fold, "\"faceOrders\": []",
                                             "\"edges_foldAngle\": [0, 0, 0, 0, 90]"))
                  .report,
              ElementsAre(_, _, _,
                          "left out: the angles of edges_foldAngle; folds rest as drawn, put other "
                          "angles into `free`"));
}

// Seen from above the square's faces run counter-clockwise: a valley closes above, below pi.
TEST_F(ImportedMesh, TellsValleysFromMountains) {
  const auto angle = [&](const std::string& height) {
    return rest_of_fold(
        mechanism_of("square.obj", replaced(square_obj, "v 0 1 0", "v 0 1 " + height)),
        "fold-v1-v3");
  };
  EXPECT_LT(angle("0.5"), pi);
  EXPECT_NEAR(angle("0.5") + angle("-0.5"), 2 * pi, 1e-12);
}

TEST_F(ImportedMesh, TakesTheFileNameAsTextAndNothingElse) {
  const std::string name = "a\"]\n[x] \\ \x7f";
  EXPECT_EQ(load(import(name + ".obj", square_obj).text).title, name);
}

TEST_F(ImportedMesh, KeepsCharactersBeyondTheBasicPlaneInItsTitle) {
  const std::string name = "\xf0\x9f\x98\x80";
  EXPECT_EQ(load(import(name + ".obj", square_obj).text).title, name);
}

TEST_F(ImportedMesh, IsRefusedWhereItsCaseWouldBeTooLarge) {
  std::string text;
  for (int i = 0; i <= 1800; ++i) text += "v " + std::to_string(i) + " 0 0\n";
  EXPECT_THAT(
      problems("large.obj", text + "f 1 2 3\n"),
      Contains(testing::HasSubstr("large.obj:1801:1: v: got \"v\", need at most 1800 vertices")));
}

TEST_F(ImportedMesh, SaysOnceThatThereAreTooManyVertices) {
  std::string obj, fold;
  for (int i = 0; i < 2000; ++i) {
    obj += "v " + std::to_string(i) + " 0 0\n";
    fold += (i == 0 ? "[" : ",\n[") + std::to_string(i) + ", 0]";
  }
  EXPECT_THAT(problems("large.obj", obj + "f 1900 1901 1902\n"), testing::SizeIs(1));
  EXPECT_THAT(problems("large.fold", "{\"vertices_coords\": [" + fold +
                                         "],\n\"edges_vertices\": [[1900, 1901]]}"),
              ElementsAre(HasSubstr("vertices_coords[1801]: got a list of 2, need at most 1800 "
                                    "vertices")));
}

TEST_F(ImportedMesh, RefusesCoordinatesThatNoCaseMayHave) {
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "v 0 1 0", "v 0 -1e200 0")),
              ElementsAre("a.obj:6:5: v: got \"-1e200\", need a finite number, at most 1e100 in "
                          "size"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "[1, 0]", "[1, 1e101]")),
              ElementsAre(HasSubstr("vertices_coords[2]: got 1e+101, need a finite number, at most "
                                    "1e100")));
}

TEST_F(ImportedMesh, ReadsLinesThatABackslashContinues) {
  const std::string broken = replaced(replaced(square_obj, "f -4 -2 -1", "f -4 \\\n-2\\\r\n  -1"),
                                      "v 1 1 0", "v 1\\\n1 \\  \n0");
  EXPECT_EQ(import("square.obj", broken).text, import("square.obj", square_obj).text);
  EXPECT_EQ(import("square.obj", square_obj + "# no line \\\n").text,
            import("square.obj", square_obj).text);
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "-4 -2 -1", "1 \\\n 7 4 \\")),
              ElementsAre(HasSubstr("a.obj:9:2: f: got \"7\", need the number of a vertex")));
}

TEST_F(ImportedMesh, HasTheUnitOfLengthOfItsFrame) {
  const auto made = [&](const std::string& keys) {
    return import("square.fold", replaced(square_fold, "\"faceOrders\": []", keys));
  };
  const ImportedCase millimetres = made("\"frame_unit\": \"mm\"");
  EXPECT_EQ(load(millimetres.text).units.length, "mm");
  EXPECT_THAT(millimetres.report, testing::Each(testing::Not(HasSubstr("left out"))));
  const ImportedCase none = made("\"frame_unit\": \"unit\"");
  EXPECT_EQ(load(none.text).units.length, "m");
  EXPECT_THAT(none.report, testing::Each(testing::Not(HasSubstr("left out"))));
  EXPECT_THAT(made("\"frame_unit\": \"ell\"").report,
              Contains("left out, having no meaning here: frame_unit"));
  EXPECT_THAT(made("\"file_title\": \"t\", \"frame_title\": \"a\", \"frame_classes\": [], "
                   "\"own:key\": 1")
                  .report,
              Contains("left out, having no meaning here: file_title, frame_title, "
                       "frame_classes, own:key"));
}

TEST_F(ImportedMesh, IsTheSameWithAByteOrderMark) {
  EXPECT_EQ(import("marked.obj", "\xef\xbb\xbf" + square_obj).report,
            import("square.obj", square_obj).report);
  EXPECT_EQ(mechanism_of("marked.obj", "\xef\xbb\xbfv 9 9 9\nv 0 0 0\nv 1 0 0\nf 1 2 3\n")
                .line_springs.size(),
            3U);
}

TEST_F(ImportedMesh, NamesLineAndColumnOfMistakesInObjFiles) {
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "-4 -2 -1", "1 7 4")),
              ElementsAre("a.obj:8:5: f: got \"7\", need the number of a vertex that stands before "
                          "it, 1 to 4, or -1 for the last one"));
  EXPECT_THAT(
      problems("a.obj", replaced(square_obj, "v 0 1 0", "v 0 one 0")),
      ElementsAre("a.obj:6:5: v: got \"one\", need a finite number, at most 1e100 in size"));
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "v 0 1 0", "v 0 1")),
              ElementsAre("a.obj:6:1: v: got \"v\", need three coordinates behind it"));
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "-4 -2 -1", "1 3")),
              ElementsAre("a.obj:8:1: f: got \"f\", need at least 3 vertices behind it"));
  EXPECT_THAT(problems("a.obj", replaced(square_obj, "-4 -2 -1", "1 3 3")),
              ElementsAre("a.obj:8:1: f: a corner stands twice, need different ones"));
  EXPECT_THAT(problems("a.obj", square_obj + "v 2 2 0\nf 1 3 5\n"),
              ElementsAre("a.obj:10:1: f: the corners v1, v3, v5 lie on one line, need triangles "
                          "with an area"));
  EXPECT_THAT(problems("a.obj", "v 0 0 0\n"),
              ElementsAre("a.obj: there are no edges and no faces, need some"));
  EXPECT_THAT(problems("a.stl", square_obj),
              ElementsAre("a.stl: got a file that ends in \".stl\", need \".obj\", "
                          "\".fold\" or \".urdf\""));
}

TEST_F(ImportedMesh, NamesLineAndColumnOfMistakesInFoldFiles) {
  EXPECT_THAT(
      problems("a.fold", replaced(square_fold, "[1, 2]", "[1, 9]")),
      Contains("a.fold:4:34: edges_vertices[2]: got 9, need the number of a vertex, 0 to 3"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "[1, 0]", "[1, \"0\"]")),
              ElementsAre("a.fold:3:35: vertices_coords[2]: got \"0\", need a finite number, at "
                          "most 1e100 in size"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "\"V\"", "\"X\"")),
              ElementsAre(HasSubstr("a.fold:5:44: edges_assignment[5]: got \"X\", need \"M\", ")));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, ", \"V\"", "")),
              ElementsAre("a.fold:5:23: edges_assignment: got a list of 4, need one for each of "
                          "the 5 edges of edges_vertices"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, ", [0, 2]]", "]")),
              Contains(HasSubstr("a.fold:5:23: edges_assignment: got a list of 5, need one for "
                                 "each of the 4 edges")));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "[3, 0]", "[1, 0]")),
              ElementsAre("a.fold:4:46: edges_vertices[4]: the edge from v1 to v0 stands twice, "
                          "need it once"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "[0, 2, 3]]", "[0, 1, 3]]")),
              ElementsAre(HasSubstr("a.fold:6:33: faces_vertices[2]: its side from v1 to v3 is no "
                                    "edge of edges_vertices, need one")));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "1.1,", "1.1")),
              ElementsAre(HasSubstr("a.fold:3:19: no JSON: syntax error")));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "1.1,", "1e999,")),
              ElementsAre("a.fold:2:21: no JSON: number overflow parsing '1e999'"));
  EXPECT_THAT(problems("a.fold", replaced(square_fold, "\"faceOrders\"", "\"file_spec\"")),
              ElementsAre("a.fold:7:3: file_spec: stands twice, need it once"));
  EXPECT_THAT(problems("a.fold", std::string(100, '[')),
              ElementsAre("a.fold:1:33: nested more than 32 deep, need less"));
  EXPECT_THAT(problems("a.fold", "[1]"),
              ElementsAre("a.fold:1:1: got a list of 1, need an object with vertices_coords"));
}

TEST_F(ImportedMesh, IsWrittenOnlyWhereNothingIs) {
  const std::filesystem::path file = write("there.toml", "mine");
  EXPECT_THROW(write_new_case(file, "new"), std::runtime_error);
  write_new_case(folder_ / "new.toml", "new");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "new.toml"));
}

}  // namespace
}  // namespace springfold::io
