// Guards the plan of the house: docs/design.md.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "architecture/rules.hpp"

namespace springfold::architecture {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<SourceFile> library_files() {
  return cpp_files(SPRINGFOLD_SOURCE_DIR, {"include", "src"});
}

std::vector<SourceFile> all_files() {
  return cpp_files(SPRINGFOLD_SOURCE_DIR, {"include", "src", "tests", "bench"});
}

TEST(SourceTree, IsFoundByTheseTests) {
  const std::vector<SourceFile> files = library_files();
  const auto is_there = [&](const std::string& path) {
    return std::any_of(files.begin(), files.end(),
                       [&](const SourceFile& file) { return file.path == path; });
  };
  EXPECT_TRUE(is_there("include/springfold/core/types.hpp"));
  EXPECT_TRUE(is_there("src/core/inertia.cpp"));
}

TEST(SourceTree, EveryLayerIncludesOnlyWhatLiesBelowIt) {
  for (const SourceFile& file : library_files()) EXPECT_THAT(forbidden_includes(file), IsEmpty());
}

TEST(SourceTree, EveryRoomOfTheEngineIncludesOnlyRoomsBelowIt) {
  for (const SourceFile& file : library_files()) EXPECT_THAT(forbidden_rooms(file), IsEmpty());
}

TEST(SourceTree, EveryRoomOfTheEngineSaysInItsReadmeWhatItsFilesAreFor) {
  for (const SourceFile& file : library_files()) {
    if (!file.path.starts_with("src/continuation/") && !file.path.starts_with("src/parameters/"))
      continue;
    const std::filesystem::path path = std::filesystem::path(SPRINGFOLD_SOURCE_DIR) / file.path;
    std::ostringstream readme;
    readme << std::ifstream{path.parent_path() / "README.md"}.rdbuf();
    EXPECT_NE(readme.str().find('`' + path.stem().string() + '`'), std::string::npos) << file.path;
  }
}

TEST(SourceTree, ThirdPartiesThatWeMayWantToReplaceStandInOneFileEach) {
  EXPECT_THAT(scattered_libraries(library_files()), IsEmpty());
}

TEST(SourceTree, NoLibraryCodePrintsOrEndsTheProgram) {
  for (const SourceFile& file : library_files()) {
    if (file.path.starts_with("src/cli/")) continue;
    EXPECT_THAT(prints_or_exits(file), IsEmpty());
  }
}

bool is_of_the_engine(const SourceFile& file) {
  return (file.path.starts_with("src/continuation/") ||
          file.path.starts_with("include/springfold/continuation/")) &&
         !file.path.ends_with("/numerics.hpp");
}

TEST(SourceTree, TheEngineHasItsTolerancesInOnePlace) {
  for (const SourceFile& file : library_files()) {
    if (!is_of_the_engine(file) || file.path.starts_with("include/"))
      continue;  // defaults of options
    EXPECT_THAT(bare_tolerances(file), IsEmpty());
  }
}

/// Names of numbers that a text defines, and those that it lists.
struct NamesIn {
  std::set<std::string> defined{}, listed{};
};

NamesIn names_in(const std::string& text) {
  static const std::regex definition{"inline constexpr double ([^;]*);"}, name{"(\\w+) = "},
      entry{"\\{\"(\\w+)\", (\\w+)\\}"};
  const std::sregex_iterator end;
  NamesIn names;
  for (std::sregex_iterator it(text.begin(), text.end(), definition); it != end; ++it) {
    const std::string line = (*it)[1];
    for (std::sregex_iterator n(line.begin(), line.end(), name); n != end; ++n)
      names.defined.insert((*n)[1]);
  }
  for (std::sregex_iterator it(text.begin(), text.end(), entry); it != end; ++it)
    if ((*it)[1] == (*it)[2]) names.listed.insert((*it)[1]);
  return names;
}

TEST(SourceTree, EveryNumberThatTheEngineJudgesByIsListedForTheManifest) {
  for (const SourceFile& file : library_files()) {
    if (!file.path.ends_with("/continuation/numerics.hpp")) continue;
    const NamesIn names = names_in(file.text);
    EXPECT_EQ(names.defined, names.listed);
    EXPECT_THAT(names.defined, testing::Contains("promised_place"));
    return;
  }
  FAIL() << "numerics.hpp was not found";
}

TEST(SourceTree, TheEngineHasFewNumbersOutsideThatPlace) {
  constexpr std::size_t most = 6;  // in a thousand lines of code
  std::size_t literals = 0, lines = 0;
  for (const SourceFile& file : library_files()) {
    if (!is_of_the_engine(file)) continue;
    literals += literals_of(file).size();
    lines += code_lines(file);
  }
  EXPECT_LE(1000 * literals, most * lines) << literals << " in " << lines << " lines";
}

TEST(SourceTree, NoFileIsLongerThan400Lines) {
  for (const SourceFile& file : all_files())
    EXPECT_LE(std::count(file.text.begin(), file.text.end(), '\n'), 400) << file.path;
}

TEST(SourceTree, EveryHeaderHasAGuard) {
  for (const SourceFile& file : all_files()) {
    if (!file.path.ends_with(".hpp")) continue;
    EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.path;
  }
}

TEST(ForbiddenIncludes, SeeALayerAbove) {
  EXPECT_THAT(
      forbidden_includes({"src/model/chain.cpp", "#include \"springfold/io/results.hpp\"\n"}),
      SizeIs(1));
  EXPECT_THAT(
      forbidden_includes({"src/continuation/trace.cpp", "#include \"springfold/model/se3.hpp\"\n"}),
      SizeIs(1));
  EXPECT_THAT(forbidden_includes(
                  {"src/analysis/run.cpp",
                   "#include \"springfold/model/se3.hpp\"\n#include \"springfold/version.hpp\"\n"}),
              IsEmpty());
}

TEST(ForbiddenIncludes, SeeThirdPartiesOutsideTheirPlace) {
  EXPECT_THAT(forbidden_includes({"src/model/chain.cpp", "#include <lapacke.h>\n"}), SizeIs(1));
  EXPECT_THAT(forbidden_includes({"src/core/inertia.cpp", "#include <lapacke.h>\n"}), IsEmpty());
  EXPECT_THAT(forbidden_includes({"include/springfold/core/a.hpp", "#include <lapacke.h>\n"}),
              SizeIs(1));
  EXPECT_THAT(forbidden_includes({"src/core/a.cpp", "#include <Eigen/LU>\n#include <vector>\n"}),
              IsEmpty());
  EXPECT_THAT(forbidden_includes({"src/io/a.cpp", "#include <gsl/gsl_vector.h>\n"}), SizeIs(1));
  EXPECT_THAT(forbidden_includes({"src/analysis/a.cpp", "#include <unistd.h>\n"}), SizeIs(1));
}

TEST(ForbiddenIncludes, SeePrivateHeadersOfOtherLayers) {
  EXPECT_THAT(forbidden_includes({"src/cli/run.cpp", "#include \"io/text.hpp\"\n"}), SizeIs(1));
  EXPECT_THAT(forbidden_includes({"src/io/run.cpp", "#include \"io/text.hpp\"\n"}), IsEmpty());
  EXPECT_THAT(forbidden_includes({"src/io/run.cpp", "#include \"text.hpp\"\n"}), IsEmpty());
}

TEST(ForbiddenRooms, SeeARoomAboveAndFilesInNone) {
  const std::string text = "#include \"continuation/kinks/kink_rays.hpp\"\n";
  EXPECT_THAT(forbidden_rooms({"src/continuation/points/step.cpp", text}), SizeIs(1));
  EXPECT_THAT(forbidden_rooms({"src/continuation/following/trace.cpp", text}), IsEmpty());
  EXPECT_THAT(forbidden_rooms({"src/continuation/trace.cpp", text}), SizeIs(1));
  EXPECT_THAT(forbidden_rooms({"src/statics/system.cpp", text}), IsEmpty());
}

TEST(LiteralsOf, SeesNumbersButNotCommentsStringsIntegersOrPlainShares) {
  EXPECT_THAT(literals_of({"a.cpp", "f(1e-7, 0.25, 3., .1, 2e3)"}),
              ElementsAre("1e-7", "0.25", "3.", ".1", "2e3"));
  EXPECT_THAT(
      literals_of({"a.cpp", "0.5 * x + 1.0 - 2.0 * a.b[12]; // 1e-7\n f(\"0.3\", 1'000, v1.e2);"}),
      IsEmpty());
}

TEST(BareTolerances, AreNumbersBelowAThousandth) {
  EXPECT_THAT(bare_tolerances({"a.cpp", "f(1e-7, 0.0003, 0.01, 1e3)"}), SizeIs(2));
}

TEST(CodeLines, LeaveOutEmptyOnesAndComments) {
  EXPECT_EQ(code_lines({"a.cpp", "int a;\n\n  // b\n/* c */\nint d;  // e\n"}), 2u);
}

TEST(ScatteredLibraries, AreSeenInASecondFile) {
  const SourceFile a{"src/core/a.cpp", "#include <lapacke.h>\n"};
  const SourceFile b{"src/core/b.cpp", "#include <lapacke.h>\n"};
  EXPECT_THAT(scattered_libraries({a}), IsEmpty());
  EXPECT_THAT(scattered_libraries({a, b}), SizeIs(1));
}

TEST(ScatteredLibraries, TellPartsOfBoostApart) {
  const SourceFile flow{"src/continuation/a.cpp", "#include <boost/numeric/odeint.hpp>\n"};
  const SourceFile steps{"src/continuation/b.cpp",
                         "#include <boost/numeric/odeint/stepper/euler.hpp>\n"};
  const SourceFile roots{"src/continuation/c.cpp", "#include <boost/math/tools/roots.hpp>\n"};
  EXPECT_THAT(scattered_libraries({flow, roots, {"src/continuation/d.cpp", roots.text}}),
              IsEmpty());
  EXPECT_THAT(scattered_libraries({flow, steps}), SizeIs(1));
}

TEST(PrintsOrExits, SeesCallsButNotCommentsStringsOrOtherNames) {
  EXPECT_THAT(prints_or_exits({"a.cpp", "std::cerr << 1; printf(\"x\"); std::exit(1); abort();"}),
              SizeIs(4));
  EXPECT_THAT(prints_or_exits({"a.cpp",
                               "// std::cerr\n/* abort() */ f(\"printf(\", '\"'); "
                               "snprintf(a, 3, b); way_exit(1); log = 1'000;"}),
              IsEmpty());
}

}  // namespace
}  // namespace springfold::architecture
