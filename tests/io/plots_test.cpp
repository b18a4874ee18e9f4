#include "springfold/io/plots.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "io/gnuplot_process.hpp"
#include "io/sample_results.hpp"
#include "io/scratch_folder.hpp"
#include "io/sha256.hpp"
#include "io/undated.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A program that stands in for gnuplot.
fs::path fake_gnuplot(const fs::path& folder, const std::string& script) {
  const fs::path program = folder / "fake" / "gnuplot";
  put_text(program, "#!/bin/sh\n" + script + "\n");
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

PlotOutcome draw(const fs::path& folder, const PlotOptions& options) {
  return draw_plots(folder / "out", sample::two_runs(), sample::two_results(), options);
}

/// Does the process end soon? A kill needs a moment to arrive.
bool has_ended(pid_t process) {
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, process, 0));
  if (handle < 0) return errno == ESRCH;
  pollfd wanted{.fd = handle, .events = POLLIN, .revents = 0};
  const bool ended = ::poll(&wanted, 1, 20000) == 1;
  ::close(handle);
  return ended;
}

std::vector<std::string> data_block(const std::string& script, const std::string& name) {
  const std::size_t begin = script.find("$" + name + " << e\n");
  if (begin == std::string::npos) return {};
  std::istringstream text{script.substr(script.find('\n', begin) + 1)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line) && line != "e";) lines.push_back(line);
  return lines;
}

/// The real program: without it there is nothing to test here.
class RealGnuplot : public testing::Test {
 protected:
  void SetUp() override {
    if (!find_executable("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  }
  ScratchFolder scratch;
};

TEST_F(RealGnuplot, DrawsPngAndSvgWithoutAWarning) {
  const auto outcome = draw(scratch.path(), {});
  EXPECT_THAT(outcome.warnings, IsEmpty());
  const fs::path plots = scratch.path() / "out" / "plots";
  EXPECT_THAT(outcome.files, ElementsAre(plots / "push_from_Q2.png", plots / "push_from_Q2.svg"));
  EXPECT_THAT(text_in(plots / "push_from_Q2.png").substr(1, 3), "PNG");
  const std::string svg = text_in(plots / "push_from_Q2.svg");
  for (const char* text :
       {"deflection [m]", "force [N]", "Kv = 0.01", "LP1", "LP2", ">stable<", ">unstable<",
        "limit point (LP)", "rgb(  0, 114, 178)", "rgb(213,  94,   0)"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_EQ(count_files(plots), 3) << "pictures and script, nothing unfinished";
}

TEST_F(RealGnuplot, DrawsMarksOfTheSvgFileAsLargeAsThoseOfThePngFile) {
  draw(scratch.path(), {});
  const std::string svg = text_in(scratch.path() / "out" / "plots" / "push_from_Q2.svg");
  const std::regex disc{R"(#gpPt6' transform='translate\([^)]*\) scale\(([0-9.]+)\))"};
  std::smatch found;
  ASSERT_TRUE(std::regex_search(svg, found, disc));
  // pngcairo draws a limit point as a disc 13 pixels wide.
  EXPECT_NEAR(2 * std::stod(found[1]), 13, 1.5);
}

TEST_F(RealGnuplot, GivesTheSameBytesTwice) {
  const ScratchFolder other;
  draw(scratch.path(), {});
  draw(other.path(), {});
  for (const char* name : {"push_from_Q2.png", "push_from_Q2.svg", "push_from_Q2.gp"}) {
    const auto bytes = text_in(scratch.path() / "out" / "plots" / name);
    EXPECT_FALSE(bytes.empty());
    EXPECT_EQ(sha256(bytes), sha256(text_in(other.path() / "out" / "plots" / name))) << name;
  }
}

TEST(UndatedPdf, HasBlanksForItsDatesAndTheSameLength) {
  const std::string dated =
      "1 0 obj\n<< /Producer (cairo)\n   /CreationDate (D:20261125154530Z)\n"
      "   /ModDate (20261125154530+00'00) >>\n";
  const std::string undated = undated_pdf(dated);
  EXPECT_EQ(undated.size(), dated.size());
  EXPECT_THAT(undated, testing::Not(HasSubstr("2026")));
  EXPECT_THAT(undated, HasSubstr("/Producer (cairo)"));
  EXPECT_EQ(undated_pdf("(/CreationDate (of a case))"), "(/CreationDate (of a case))");
}

TEST(UndatedTex, LacksTheLineWithTheDateAlone) {
  const std::string before = "\\begin{tikzpicture}\n%% generated with GNUPLOT 5.4p4\n";
  const std::string behind = "\\path (0,0);\n%% gnuplot variables\n";
  EXPECT_EQ(undated_tex(before + "%% Wed Nov 25 15:45:30 2026\n" + behind), before + behind);
  EXPECT_EQ(undated_tex(before + behind), before + behind);
}

TEST(ValidSvg, EscapesTheEndOfACdataSectionInTextsAlone) {
  EXPECT_EQ(valid_svg("<text>a ]]> b]]></text>"), "<text>a ]]&gt; b]]&gt;</text>");
  EXPECT_EQ(valid_svg("<style><![CDATA[ a ]]></style>"), "<style><![CDATA[ a ]]></style>");
  EXPECT_EQ(
      valid_svg("<style><![CDATA[ a ]]></style><text>]]></text><style><![CDATA[ b ]]></style>"),
      "<style><![CDATA[ a ]]></style><text>]]&gt;</text><style><![CDATA[ b ]]></style>");
  EXPECT_EQ(valid_svg("]]>"), "]]&gt;");
}

TEST_F(RealGnuplot, WritesNoDateIntoPdfAndLatexFiles) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .curves = {{.study = "push from Q2"}}}};
  the_case.plots[0].look.formats = {"pdf", "tikz"};
  const auto outcome = draw_plots(scratch.path() / "out", the_case, sample::two_results(), {});
  EXPECT_THAT(outcome.warnings, IsEmpty());
  const fs::path plots = scratch.path() / "out" / "plots";
  EXPECT_THAT(text_in(plots / "a.pdf"), testing::Not(HasSubstr("/CreationDate (")));
  const std::regex date{"\n%% [A-Z][a-z]{2} [A-Z][a-z]{2} "};
  EXPECT_FALSE(std::regex_search(text_in(plots / "a.tex"), date));
}

TEST_F(RealGnuplot, HasItsPicturesInTheManifestSoThatTheNextRunRemovesThem) {
  const fs::path folder = scratch.path() / "out";
  write_results(folder, sample::two_runs(), sample::two_results());
  draw(scratch.path(), {});
  const auto manifest = nlohmann::json::parse(text_in(folder / "manifest.json"));
  int pictures = 0;
  for (const auto& file : manifest["files"]) {
    if (!file["path"].get<std::string>().starts_with("plots/")) continue;
    ++pictures;
    EXPECT_EQ(file["sha256"], sha256(text_in(folder / file["path"])));
  }
  EXPECT_EQ(pictures, 3);
  write_results(folder, sample::two_runs(), sample::two_results());
  EXPECT_EQ(count_files(folder / "plots"), 0);
}

TEST_F(RealGnuplot, TakesTitlesWithQuotesBackticksAndDollarsAsText) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a",
                     .title = "it's `echo no` $(no) \"K_v^2\" \\n {x}\nend",
                     .curves = {{.study = "push from Q2"}}}};
  const auto outcome = draw_plots(scratch.path(), the_case, sample::two_results());
  EXPECT_THAT(outcome.warnings, IsEmpty());
  EXPECT_THAT(text_in(scratch.path() / "plots" / "a.svg"),
              HasSubstr("it's `echo no` $(no) \"K_v^2\" \\n {x} end"));
}

TEST_F(RealGnuplot, TakesTextsThatBeginWithQuotesAsText) {
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a",
                     .title = "''; system('echo no') '",
                     .x_label = "'",
                     .curves = {{.study = "push from Q2", .labels = {"'`first", "'''second"}}}}};
  const auto outcome = draw_plots(scratch.path(), the_case, sample::two_results());
  EXPECT_THAT(outcome.warnings, IsEmpty());
  const std::string svg = text_in(scratch.path() / "plots" / "a.svg");
  for (const char* text : {"''; system('echo no') '", ">'<", "'`first", "'''second"})
    EXPECT_THAT(svg, HasSubstr(text));
}

TEST_F(RealGnuplot, DrawsAFigureOfASinglePoint) {
  auto results = sample::two_results();
  results.resize(1);
  auto& branch = results[0].branches[0];
  branch.samples = {branch.samples[branch.start_row]};
  branch.start_row = 0;
  branch.events.clear();
  Case the_case = sample::two_runs();
  the_case.plots = {{.name = "a", .curves = {{.study = "push from Q2"}}}};
  const auto outcome = draw_plots(scratch.path(), the_case, results);
  EXPECT_THAT(outcome.warnings, IsEmpty());
  EXPECT_THAT(outcome.files, SizeIs(2));
}

TEST_F(RealGnuplot, ReportsAMistakeInATemplateWithGnuplotsWords) {
  fs::copy(fs::path{SPRINGFOLD_SOURCE_DIR} / "plots", scratch.path() / "templates");
  put_text(scratch.path() / "templates" / "style.gp", "set nonsense\n");
  const auto outcome = draw(scratch.path(), {.templates = scratch.path() / "templates"});
  EXPECT_THAT(outcome.files, IsEmpty());
  ASSERT_THAT(outcome.warnings, SizeIs(1));
  EXPECT_THAT(outcome.warnings[0], HasSubstr("gnuplot ended with code 1: "));
  EXPECT_THAT(outcome.warnings[0], HasSubstr("set nonsense"));
}

TEST(DrawPlots, SeparatesPartsOfOneStabilityByEmptyLines) {
  const ScratchFolder scratch;
  draw(scratch.path(), {.gnuplot = "no-such-program"});
  const std::string script = text_in(scratch.path() / "out" / "plots" / "push_from_Q2.gp");
  const auto stable = data_block(script, "stable_1"), unstable = data_block(script, "unstable_1");
  EXPECT_EQ(std::count(stable.begin(), stable.end(), ""), 1) << "between two parts";
  EXPECT_EQ(std::count(unstable.begin(), unstable.end(), ""), 0) << "one part";
  EXPECT_THAT(data_block(script, "point_LP"), SizeIs(4));
}

TEST(DrawPlots, WithoutGnuplotOnlyThePngFileIsMissing) {
  const ScratchFolder scratch;
  const auto outcome = draw(scratch.path(), {.gnuplot = "no-such-program"});
  const fs::path plots = scratch.path() / "out" / "plots";
  EXPECT_THAT(outcome.files, ElementsAre(plots / "push_from_Q2.svg"));
  EXPECT_THAT(outcome.missing, ElementsAre("plots/push_from_Q2.png"));
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("there is no program 'no-such-program': no "
                                                      "png file (script kept: ")));
  EXPECT_TRUE(fs::exists(plots / "push_from_Q2.gp"));
  EXPECT_THAT(text_in(plots / "push_from_Q2.svg"), HasSubstr(">limit point (LP)</text>"));
}

TEST(DrawPlots, WarnsWhenGnuplotFailsWithItsCodeAndWords) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "echo 'bad font' >&2; exit 3");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string()});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("gnuplot ended with code 3: bad font")));
}

TEST(DrawPlots, WarnsWhenGnuplotEndsWellWithoutAPicture) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "exit 0");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string()});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("gnuplot wrote no push_from_Q2.png")));
}

TEST(DrawPlots, WarnsWhenGnuplotDiesByASignal) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "kill -9 $$");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string()});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("ended by signal 9")));
}

TEST(DrawPlots, StopsAGnuplotThatHangs) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "exec sleep 600");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string(), .timeout_seconds = 0.5});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("did not finish within 0.5 s")));
}

TEST(DrawPlots, StopsTheChildrenOfGnuplotAsWell) {
  const ScratchFolder scratch;
  const fs::path pid_file = scratch.path() / "child";
  const auto program =
      fake_gnuplot(scratch.path(), "sleep 600 & echo $! > " + pid_file.string() + ".part; mv " +
                                       pid_file.string() + ".part " + pid_file.string() + "; wait");
  const auto outcome =
      draw(scratch.path(),
           {.gnuplot = program.string(), .stop_requested = [&] { return fs::exists(pid_file); }});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("stopped on request")));
  ASSERT_FALSE(text_in(pid_file).empty());
  EXPECT_TRUE(has_ended(std::stoi(text_in(pid_file))));
}

TEST(DrawPlots, StopsAGnuplotThatClosedItsOutputAndHangs) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "exec 2>&-; exec sleep 600");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string(), .timeout_seconds = 0.3});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("did not finish within 0.3 s")));
}

TEST(DrawPlots, SurvivesAGnuplotThatTalksALot) {
  const ScratchFolder scratch;
  const auto program =
      fake_gnuplot(scratch.path(),
                   "i=0; while [ $i -lt 20000 ]; do echo \"line $i\" >&2; i=$((i+1)); done; "
                   "echo last >&2; exit 1");
  const auto outcome = draw(scratch.path(), {.gnuplot = program.string()});
  ASSERT_THAT(outcome.warnings, SizeIs(1));
  EXPECT_THAT(outcome.warnings[0], HasSubstr("; last"));
  EXPECT_LT(outcome.warnings[0].size(), 800u);
}

TEST(DrawPlots, EndsWhenItIsAskedTo) {
  const ScratchFolder scratch;
  const auto program = fake_gnuplot(scratch.path(), "exec sleep 600");
  int asked = 0;
  const auto outcome = draw(
      scratch.path(), {.gnuplot = program.string(), .stop_requested = [&] { return ++asked > 2; }});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("stopped on request")));
}

TEST(DrawPlots, WarnsWhenTheTemplatesAreMissing) {
  const ScratchFolder scratch;
  const auto outcome = draw(scratch.path(), {.templates = scratch.path() / "nowhere"});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("nowhere/style.gp: No such file")));
}

TEST(DrawPlots, WarnsWhenItCannotWrite) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "out" / "plots", "a file where a folder is needed");
  const auto outcome = draw(scratch.path(), {});
  EXPECT_THAT(outcome.warnings, ElementsAre(HasSubstr("cannot create folder")));
}

TEST(FindExecutable, LooksInThePathUnlessTheNameHasASlash) {
  EXPECT_TRUE(find_executable("sh").has_value());
  EXPECT_TRUE(find_executable("/bin/sh").has_value());
  EXPECT_FALSE(find_executable("/etc/passwd").has_value()) << "cannot be executed";
  EXPECT_FALSE(find_executable("no-such-program").has_value());
}

}  // namespace
}  // namespace springfold::io
