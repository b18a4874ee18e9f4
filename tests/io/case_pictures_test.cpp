// [[picture]]: drawn after a run, with the figures.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "case_files.hpp"
#include "cli/small_case.hpp"
#include "io/gnuplot_process.hpp"
#include "io/sha256.hpp"
#include "scratch_folder.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/plots.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

/// A point on two springs, pushed to EP2 at a deflection of 0.3, and pictures of it.
class CasePictures : public CaseFiles {
 protected:
  /// Runs the case and draws it, without gnuplot.
  PlotOutcome draw(const std::string& text) {
    the_case = load(text);
    results.clear();
    for (const PlannedRun& planned : the_case.runs) {
      results.push_back(analysis::run_study(planned.mechanism, planned.plan));
      results.back().study = planned.study;
      results.back().run = planned.run;
      results.back().label = planned.label;
    }
    write_results(out(), the_case, results, SetState::being_written);
    return draw_plots(out(), the_case, results, {.gnuplot = "/nowhere/gnuplot"});
  }
  static std::string with(const std::string& picture) {
    return cli::small_case("", "[[picture]]\n" + picture + "\n");
  }
  fs::path out() const { return folder_ / "out"; }
  std::string drawn(const std::string& name) const { return text_in(out() / "plots" / name); }

  Case the_case{};
  std::vector<analysis::StudyResult> results{};
};

/// Only what concerns pictures.
std::vector<std::string> about_pictures(std::vector<std::string> warnings) {
  std::erase_if(warnings, [](const std::string& text) { return !text.starts_with("picture"); });
  return warnings;
}

TEST_F(CasePictures, ShowTheMechanismAtAPointOfARun) {
  draw(with("name = \"pushed\"\nat = \"push/EP2\""));
  EXPECT_THAT(drawn("pushed.svg"), HasSubstr(">push: EP2<"));
  EXPECT_THAT(drawn("pushed.svg"), HasSubstr("lambda = 0.3 m"));
  // A spring of stiffness 2, 0.3 longer.
  EXPECT_THAT(drawn("pushed.svg"), HasSubstr("force = 0.6 N"));
}

TEST_F(CasePictures, NeedNoGnuplot) {
  const auto outcome = draw(with("name = \"pushed\"\nat = \"push/EP2\""));
  EXPECT_THAT(outcome.files, ElementsAre(out() / "plots/pushed.svg", out() / "plots/push.svg"));
  EXPECT_THAT(about_pictures(outcome.warnings), IsEmpty());
}

TEST_F(CasePictures, ShowSeveralPosturesSideBySide) {
  draw(with("name = \"both\"\nstudy = \"push\"\nat = [\"start\", \"end\"]"));
  for (const char* title : {">start<", ">end<"}) EXPECT_THAT(drawn("both.svg"), HasSubstr(title));
}

TEST_F(CasePictures, OfSeveralStudiesSayWhichIsWhich) {
  draw(with("name = \"both\"\nat = [\"push/EP1\", \"rest/start\"]"));
  for (const char* title : {">push: EP1<", ">rest: start<"})
    EXPECT_THAT(drawn("both.svg"), HasSubstr(title));
}

TEST_F(CasePictures, ShowAllSpecialPoints) {
  draw(with("name = \"all\"\nat = \"push/all\""));
  for (const char* title : {">start<", ">EP1<", ">EP2<"})
    EXPECT_THAT(drawn("all.svg"), HasSubstr(title));
}

TEST_F(CasePictures, ShowOnePointOfSeveralRuns) {
  const std::string varied = replaced(with("name = \"runs\"\nat = \"push/EP2\"\nrun = [1, 3]"),
                                      "[[study]]\nname = \"rest\"",
                                      "vary = { parameter = \"K\", values = [1, 2, 3] }\n"
                                      "[[study]]\nname = \"rest\"");
  draw(varied);
  EXPECT_THAT(drawn("runs.svg"), HasSubstr(">K = 1: EP2<"));
  EXPECT_THAT(drawn("runs.svg"), HasSubstr("force = 0.3 N"));
  EXPECT_THAT(drawn("runs.svg"), Not(HasSubstr(">K = 2: EP2<")));
  EXPECT_THAT(drawn("runs.svg"), HasSubstr(">K = 3: EP2<"));
  EXPECT_THAT(drawn("runs.svg"), HasSubstr("force = 0.9 N"));
}

TEST_F(CasePictures, HaveATitleOfTheirOwnInPlaceOfTheCases) {
  draw(with("name = \"pushed\"\nat = \"push/EP2\"\ntitle = \"Pushed far\""));
  EXPECT_THAT(drawn("pushed.svg"), HasSubstr(">Pushed far<"));
  EXPECT_THAT(drawn("pushed.svg"), Not(HasSubstr(">A point on two springs<")));
}

TEST_F(CasePictures, AreColouredAsTheCaseSays) {
  draw(with("name = \"a\"\nat = \"push/EP2\"\ncolour = \"force\"") +
       "[[picture]]\nname = \"b\"\nat = \"push/EP2\"\n");
  EXPECT_THAT(drawn("a.svg"), Not(HasSubstr("stable under dead load")));
  EXPECT_THAT(drawn("b.svg"), HasSubstr("stable under dead load"));
}

TEST_F(CasePictures, AreSeenFromWhereTheCaseSays) {
  draw(with("name = \"plan\"\nat = \"push/EP2\"\nview = \"xy\"") +
       "[[picture]]\nname = \"side\"\nat = \"push/EP2\"\nview = \"xz\"\n" +
       "[[picture]]\nname = \"usual\"\nat = \"push/EP2\"\n");
  EXPECT_EQ(drawn("plan.svg"), drawn("usual.svg")) << "a planar mechanism is seen in plan";
  EXPECT_NE(drawn("side.svg"), drawn("usual.svg"));
}

TEST_F(CasePictures, ShowTextsOfTheCaseAsText) {
  const std::string bait = R"(</text><script>alert('1')</script> \"; system(\"ls\"))";
  std::string text = with("name = \"bait\"\nat = \"" + bait + "/EP2\"\ntitle = \"" + bait + "\"");
  text = replaced(text, "name = \"push\"", "name = \"" + bait + "\"");
  const auto outcome = draw(text);
  EXPECT_THAT(about_pictures(outcome.warnings), IsEmpty());
  EXPECT_THAT(drawn("bait.svg"), Not(HasSubstr("<script>")));
  const std::string shown =
      "&lt;/text&gt;&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt; &quot;; "
      "system(&quot;ls&quot;)";
  EXPECT_THAT(drawn("bait.svg"), HasSubstr(">" + shown + "<")) << "title";
  EXPECT_THAT(drawn("bait.svg"), HasSubstr(">" + shown + ": EP2<")) << "name of the study";
}

TEST_F(CasePictures, WriteOutWhatIsNoVisibleCharacterOfATitle) {
  draw(with("name = \"two\"\nat = \"push/EP2\"\ntitle = \"one\\ntwo\\u0007\""));
  EXPECT_THAT(drawn("two.svg"), HasSubstr(R"(>one two\x07<)"));
  EXPECT_THAT(drawn("two.svg"), Not(HasSubstr("\uFFFD")));
}

TEST_F(CasePictures, OfTheGuessAreDrawnWhereNothingCouldBeSolved) {
  const auto outcome = draw(cli::too_short() + "[[picture]]\nname = \"wanted\"\nat = \"guess\"\n");
  EXPECT_THAT(about_pictures(outcome.warnings), IsEmpty());
  EXPECT_THAT(drawn("wanted.svg"), HasSubstr("does not close"));
}

TEST_F(CasePictures, SayWhichPosturesThereAreForOneThatIsNot) {
  const auto outcome = draw(with("name = \"none\"\nat = \"push/LP7\""));
  EXPECT_THAT(about_pictures(outcome.warnings),
              ElementsAre("picture 'none': there is no posture \"LP7\" in push; there are: start, "
                          "EP1, EP2, end"));
  EXPECT_THAT(outcome.missing, testing::Contains("plots/none.svg"));
  EXPECT_FALSE(fs::exists(out() / "plots/none.svg"));
}

TEST_F(CasePictures, AreInTheManifestWithTheirHashes) {
  draw(with("name = \"pushed\"\nat = \"push/EP2\""));
  const auto manifest = nlohmann::json::parse(text_in(out() / "manifest.json"));
  bool is_listed = false;
  for (const auto& file : manifest["files"])
    if (file["path"] == "plots/pushed.svg") {
      is_listed = true;
      EXPECT_EQ(file["sha256"], sha256(drawn("pushed.svg")));
    }
  EXPECT_TRUE(is_listed);
}

TEST_F(CasePictures, OfAnEarlierRunAreRemoved) {
  draw(with("name = \"pushed\"\nat = \"push/EP2\""));
  draw(with("name = \"other\"\nat = \"push/EP2\""));
  EXPECT_FALSE(fs::exists(out() / "plots/pushed.svg"));
  EXPECT_TRUE(fs::exists(out() / "plots/other.svg"));
}

TEST_F(CasePictures, LeaveNothingUnfinishedBehind) {
  draw(with("name = \"pushed\"\nat = \"push/EP2\""));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator{out() / "plots"})
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, UnorderedElementsAre("pushed.svg", "push.gp", "push.svg"));
}

TEST_F(CasePictures, KeepTheirNamesBesideTheFigureOfAStudyOfThatName) {
  draw(with("name = \"push\"\nat = \"push/EP2\""));
  EXPECT_THAT(drawn("push.svg"), HasSubstr(">push: EP2<"));
  EXPECT_THAT(drawn("push_2.gp"), HasSubstr("figure_name = 'push_2'"));
  EXPECT_FALSE(fs::exists(out() / "plots/push.gp"));
}

TEST_F(CasePictures, BecomePngAndPdfFilesByRsvgConvert) {
  if (!find_executable("rsvg-convert")) GTEST_SKIP() << "rsvg-convert is not installed";
  const auto outcome =
      draw(with("name = \"pushed\"\nat = \"push/EP2\"\nformats = [\"png\", \"pdf\"]"));
  EXPECT_THAT(about_pictures(outcome.warnings), IsEmpty());
  EXPECT_THAT(outcome.files,
              testing::IsSupersetOf({out() / "plots/pushed.png", out() / "plots/pushed.pdf"}));
  EXPECT_EQ(drawn("pushed.png").substr(1, 3), "PNG");
  EXPECT_EQ(drawn("pushed.pdf").substr(0, 5), "%PDF-");
}

class PictureMessages : public CaseFiles {
 protected:
  std::vector<std::string> of(const std::string& picture) const {
    return messages(cli::small_case("", "[[picture]]\n" + picture + "\n"));
  }
};

TEST_F(PictureMessages, NameAllMistakesAtOnce) {
  EXPECT_THAT(
      of("name = \"a/b\"\nat = [\"push/LP\", \"pull/LP1\", 3]\nview = \"zz\"\ncolour = \"red\"\n"
         "formats = [\"gif\"]\ncolor = \"force\""),
      testing::UnorderedElementsAre(
          HasSubstr("case.toml:25:8: picture[1].name: got \"a/b\", need a file name"),
          HasSubstr("case.toml:26:7: picture[1].at[1]: got \"push/LP\", need the label of a "
                    "special point"),
          HasSubstr("case.toml:26:18: picture[1].at[2]: no study \"pull\""),
          HasSubstr("case.toml:26:30: picture[1].at[3]: got 3, need a posture"),
          HasSubstr("case.toml:27:8: picture[1].view: got \"zz\", need \"xy\", \"xz\", \"yz\" or "
                    "\"perspective\""),
          HasSubstr("case.toml:28:10: picture[1].colour: got \"red\", need \"stability\""),
          HasSubstr("case.toml:29:12: picture[1].formats[1]: got \"gif\", need one of \"svg\""),
          HasSubstr("case.toml:30:1: picture[1].color: unknown key")));
}

TEST_F(PictureMessages, WantANameAndAPosture) {
  EXPECT_THAT(of(""), UnorderedElementsAre(HasSubstr("picture[1].name: missing"),
                                           HasSubstr("picture[1].at: missing")));
  EXPECT_THAT(of("name = \"a\"\nat = []"), ElementsAre(HasSubstr("at: got an empty list")));
}

TEST_F(PictureMessages, WantTheStudyWhereThereAreSeveral) {
  EXPECT_THAT(of("name = \"a\"\nat = \"EP1\""),
              ElementsAre(HasSubstr("picture[1].at: got \"EP1\", need its study too")));
  EXPECT_THAT(of("name = \"a\"\nat = \"EP1\"\nstudy = \"push\""), IsEmpty());
  EXPECT_THAT(of("name = \"a\"\nat = [\"EP1\", \"EP2\"]\nstudy = \"pusch\""),
              ElementsAre(HasSubstr("picture[1].study: no study \"pusch\", did you mean")));
}

TEST_F(PictureMessages, WantRunsThatThereAre) {
  EXPECT_THAT(
      of("name = \"a\"\nat = \"push/EP1\"\nrun = 2"),
      ElementsAre(HasSubstr("picture[1].run: got 2, need the number of a run of \"push\"")));
  EXPECT_THAT(of("name = \"a\"\nat = \"push/EP1\"\nrun = [1, -1e300]"),
              ElementsAre(HasSubstr("picture[1].run[2]: got -1e+300")));
  EXPECT_THAT(
      of("name = \"a\"\nat = 3\nrun = \"x\""),
      ElementsAre(HasSubstr("picture[1].at: got 3"), HasSubstr("picture[1].run: got \"x\"")));
  EXPECT_THAT(of("name = \"a\"\nat = \"push/EP1\"\nrun = []"),
              ElementsAre(HasSubstr("picture[1].run: got an empty list")));
}

TEST_F(PictureMessages, RefuseTheNameOfAFigure) {
  EXPECT_THAT(of("name = \"a\"\nat = \"push/EP1\"\n[[plot]]\nname = \"a\"\n"
                 "curves = [{ study = \"push\" }]"),
              ElementsAre(HasSubstr("picture[1].name: \"a\" is already the name of another plot")));
}

TEST_F(PictureMessages, WantCurvesThatAreKept) {
  const std::string text =
      replaced(cli::small_case("", "[[picture]]\nname = \"a\"\nat = \"push/EP1\"\n"),
               "[[study]]\nname = \"rest\"",
               "vary = { parameter = \"K\", values = [1, 2], curves = false, table = [{ quantity = "
               "\"count.LP\" }] }\n[[study]]\nname = \"rest\"");
  EXPECT_THAT(messages(text), ElementsAre(HasSubstr("vary.curves: got false, need true: picture "
                                                    "\"a\" draws these curves")));
}

}  // namespace
}  // namespace springfold::io
