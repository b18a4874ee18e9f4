// `draw` shows the mechanism, also where nothing can be solved.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/run_main.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Draw : public testing::Test {
 protected:
  int run(std::vector<std::string> words, const std::string& text = small_case()) {
    put_text(scratch.path() / "case.toml", text);
    words.insert(words.begin(), "springfold");
    words.push_back((scratch.path() / "case.toml").string());
    if (words[1] == "draw" || words[2] == "--draw") {
      words.push_back("--output");
      words.push_back(file().string());
    }
    std::vector<const char*> argv;
    for (const auto& word : words) argv.push_back(word.c_str());
    std::ostringstream out, messages;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, messages);
    err = messages.str();
    return code;
  }
  std::filesystem::path file() const { return scratch.path() / "picture.svg"; }
  std::string picture() const {
    std::ostringstream text;
    text << std::ifstream{file()}.rdbuf();
    return text.str();
  }
  ScratchFolder scratch{};
  std::string err{};
};

TEST_F(Draw, ShowsTheFirstEquilibriumOfTheFirstStudy) {
  EXPECT_EQ(run({"draw"}), all_done);
  EXPECT_THAT(picture(), HasSubstr(">push: first equilibrium</text>"));
  EXPECT_THAT(picture(), HasSubstr(">tool</text>"));
  EXPECT_THAT(picture(), HasSubstr("stable under dead load"));
}

TEST_F(Draw, TheCaseMayStandBehindTheStudy) {
  EXPECT_EQ(run({"draw", "--study", "rest"}), all_done);
  EXPECT_THAT(picture(), HasSubstr(">rest: first equilibrium</text>"));
}

TEST_F(Draw, ShowsAPostureByTheLabelOfItsPoint) {
  EXPECT_EQ(run({"draw", "--at", "push/EP2"}), all_done);
  // Driven to the end of its range: the spring of stiffness 2 is 0.3 longer.
  EXPECT_THAT(picture(), HasSubstr("lambda = 0.3 m"));
  EXPECT_THAT(picture(), HasSubstr("force = 0.6 N"));
}

TEST_F(Draw, ShowsAllSpecialPointsOfAStudySideBySide) {
  EXPECT_EQ(run({"draw", "--all", "push"}), all_done);
  for (const char* label : {">start<", ">EP1<", ">EP2<"}) EXPECT_THAT(picture(), HasSubstr(label));
}

TEST_F(Draw, NamesTheLabelsThereAreForOneThatIsNot) {
  EXPECT_EQ(run({"draw", "--at", "push/LP7"}), wrong_usage);
  EXPECT_THAT(err,
              HasSubstr("there is no posture \"LP7\" in push; there are: start, EP1, EP2, end"));
  EXPECT_EQ(run({"draw", "--at", "pull/EP1"}), wrong_usage);
  EXPECT_THAT(err, HasSubstr("there is no study \"pull\""));
  EXPECT_THAT(picture(), IsEmpty());
}

TEST_F(Draw, ShowsTheGuessWhereThereIsNoEquilibriumAndSaysSo) {
  EXPECT_EQ(run({"draw"}, too_short()), no_start_point);
  EXPECT_THAT(err, HasSubstr("no first equilibrium"));
  EXPECT_THAT(picture(), HasSubstr("guess, no equilibrium"));
  EXPECT_THAT(picture(), HasSubstr("chain arm does not close: 4 apart"));
}

TEST_F(Draw, ShowsTheGuessWithoutSolvingAnything) {
  EXPECT_EQ(run({"draw", "--guess"}, too_short()), all_done);
  EXPECT_THAT(err, Not(HasSubstr("equilibrium")));
  EXPECT_THAT(picture(), HasSubstr("does not close"));
}

TEST_F(Draw, CheckShowsWhatWasUnderstood) {
  EXPECT_EQ(run({"check", "--draw"}, too_short()), no_start_point);
  EXPECT_THAT(picture(), HasSubstr("hold: as it is given"));
}

TEST_F(Draw, TextsOfTheCaseAreTextInThePicture) {
  std::string text = small_case();
  const std::string title = "A point on two springs";
  text.replace(text.find(title), title.size(),
               R"(</title><script>alert(1)</script> \"; system(ls))");
  EXPECT_EQ(run({"draw"}, text), all_done);
  EXPECT_THAT(picture(), Not(HasSubstr("<script>")));
  EXPECT_THAT(picture(), HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt; &quot;; system(ls)"));
}

TEST_F(Draw, WantsANameThatSaysWhatKindOfPicture) {
  const std::string file = (scratch.path() / "case.toml").string();
  const std::vector<const char*> argv{"springfold", "draw", file.c_str(), "--output", "a.jpg"};
  std::ostringstream out, messages;
  EXPECT_EQ(run_main(5, argv.data(), out, messages), wrong_usage);
  EXPECT_THAT(messages.str(), HasSubstr(".svg, .png or .pdf"));
}

class PictureOfACase : public Draw {
 protected:
  /// @param study  the one that is run; empty: all
  int run_case(const std::string& study) {
    std::vector<std::string> words{"run", "--out", out().string()};
    if (!study.empty()) words.insert(words.end(), {"--study", study, "--quiet"});
    return run(words, small_case("", "[[picture]]\nname = \"pushed\"\nat = \"push/EP2\"\n"));
  }
  std::filesystem::path out() const { return scratch.path() / "out"; }
};

TEST_F(PictureOfACase, IsThereWhenTheRunSaysThatItIsWhole) {
  EXPECT_EQ(run_case(""), all_done);
  EXPECT_THAT(text_in(out() / "plots/pushed.svg"), HasSubstr(">push: EP2</text>"));
  const std::string manifest = text_in(out() / "manifest.json");
  EXPECT_THAT(manifest, HasSubstr("\"state\": \"whole\""));
  EXPECT_THAT(manifest, HasSubstr("\"plots/pushed.svg\""));
}

TEST_F(PictureOfACase, IsLeftOutWhereItsStudyIsNotRun) {
  EXPECT_EQ(run_case("rest"), all_done);
  EXPECT_THAT(err, Not(HasSubstr("pushed")));
  EXPECT_FALSE(std::filesystem::exists(out() / "plots/pushed.svg"));
}

}  // namespace
}  // namespace springfold::cli
