// Texts of a case in its figures: shown as they stand, never carried out.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <functional>

#include "io/gnuplot_process.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// As a value of a case file.
std::string toml(std::string text) {
  replace_all(text, "\\", "\\\\");
  replace_all(text, "\"", "\\\"");
  replace_all(text, "\n", "\\n");
  return '"' + text + '"';
}

/// As it stands in an SVG file.
std::string svg(std::string text) {
  replace_all(text, "&", "&amp;");
  replace_all(text, "<", "&lt;");
  replace_all(text, "\n", " ");
  return ">" + text + "<";
}

/// Without the whole picture in the message.
void expect_shown(const std::string& drawn, const std::string& text) {
  EXPECT_NE(drawn.find(text), std::string::npos) << "not in the picture: " << text;
}

/// Commands, if they are carried out, make a file called "pwned" beside the case.
class FigureText : public testing::Test {
 protected:
  void SetUp() override {
    if (!io::find_executable("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  }

  /// A text that gnuplot, its macros, its markup and its strings would each like to take apart.
  std::string bait(const std::string& name) const {
    const std::string touch = "touch " + (scratch.path() / "pwned").string();
    return "''" + name + "'' `" + touch + "` $(" + touch +
           ") @ink {/Symbol q} K_v^2 \\n \\ &{x} ' \" <b> &lt; %g\n!" + touch + "\n'; system('" +
           touch + "') # \"; system(\"" + touch + "\")";
  }
  /// Remembered, and looked for in the picture.
  std::string value(const std::string& name) {
    texts.push_back(bait(name));
    return toml(texts.back());
  }

  void run(const std::string& text) const {
    put_text(scratch.path() / "case.toml", text);
    const std::string command = "cd '" + scratch.path().string() +
                                "' && '" SPRINGFOLD_PROGRAM
                                "' run case.toml --out out > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 0) << text_in(scratch.path() / "err.txt");
    EXPECT_THAT(text_in(scratch.path() / "err.txt"), Not(HasSubstr("warning"))) << "of a figure";
  }
  std::string picture(const std::string& name) const {
    return text_in(scratch.path() / "out/plots" / (name + ".svg"));
  }
  void expect_all_literal(const std::string& drawn) const {
    for (const std::string& text : texts) expect_shown(drawn, svg(text));
    EXPECT_FALSE(fs::exists(scratch.path() / "pwned")) << "a text of the case was carried out";
  }

  ScratchFolder scratch{};
  std::vector<std::string> texts{};
};

/// A point on two springs.
std::string point(const std::string& vary) {
  return R"([parameters]
K_x = 2
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_1"
elements = [
  { joint = "prismatic", axis = "x", name = "slide", role = "virtual", stiffness = "K_x" },
  { joint = "prismatic", axis = "y", name = "lift", role = "virtual", stiffness = 1 },
]
[[study]]
name = "push_it"
control = "mixed"
direction = [1, 0]
until = { deflection = [-0.1, 0.3] }
mark = { deflection = [0.2] }
)" + vary;
}

std::string map_of_a_point(const std::string& vary) {
  return R"([parameters]
K_x = 1
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "leg_1"
elements = [ { joint = "prismatic", axis = "x", name = "d", role = "actuated", value = 1, stiffness = "K_x" },
  { joint = "revolute", axis = "-z", name = "k", role = "preloaded", spring = { law = "linear", stiffness = 0.5 } }, { rigid = [-1, 0] } ]
[[chain]]
name = "leg_2"
elements = [ { joint = "prismatic", axis = "y", name = "d", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "k" }, { rigid = [0, -1] } ]
[[study]]
name = "push_it"
kind = "map"
axes = [ { pose = "x", from = -0.3, to = 0.3, points = 3 }, { pose = "y", from = -0.3, to = 0.3, points = 3 } ]
)" + vary;
}

TEST_F(FigureText, OfTitlesAxesAndCurvesIsShownAsItStands) {
  run(point("vary = { parameter = \"K_x\", values = [1, 2] }\n[[plot]]\nname = \"a\"\ntitle = " +
            value("title") + "\nx_label = " + value("x") + "\ny_label = " + value("y") +
            "\ncurves = [{ study = \"push_it\", labels = [" + value("soft") + ", " +
            value("stiff") + "] }]\n"));
  expect_all_literal(picture("a"));
}

TEST_F(FigureText, OfLabelsOfVaryAndUnitsIsShownAsItStands) {
  const std::string length = bait("m"), force = bait("N");
  run("units = { length = " + toml(length) + ", force = " + toml(force) + " }\n" +
      point("vary = { parameter = \"K_x\", values = [1, 2], labels = [" + value("soft") + ", " +
            value("stiff") + "] }\n"));
  texts.push_back("deflection [" + length + "]");
  texts.push_back("force [" + force + "]");
  texts.emplace_back("push_it");
  expect_all_literal(picture("push_it"));
}

TEST_F(FigureText, OfNamesOfStudiesIsShownAsItStands) {
  std::string text = point("");
  replace_all(text, "\"push_it\"", value("study"));
  run(text);
  const fs::path plots = scratch.path() / "out/plots";
  for (const auto& file : fs::directory_iterator{plots})
    if (file.path().extension() == ".svg") expect_all_literal(text_in(file.path()));
  EXPECT_EQ(count_files(plots), 3) << "a script and two pictures";
}

TEST_F(FigureText, OfMapsIsShownAsItStands) {
  run(map_of_a_point(
      "[[map_plot]]\nname = \"a\"\nquantity = \"K_trans_min\"\ntitle = " + value("title") +
      "\nlabel = " + value("colours") + "\nx_label = " + value("x") + "\ny_label = " + value("y") +
      "\npanels = [{ study = \"push_it\", title = " + value("panel") + " }]\n"));
  expect_all_literal(picture("a"));
}

TEST_F(FigureText, OfMapsWithoutAPlotIsShownAsItStands) {
  run(map_of_a_point("vary = { parameter = \"K_x\", values = [1, 2], labels = [" + value("soft") +
                     ", \"stiff\"] }\n"));
  texts.emplace_back("push_it");
  texts.emplace_back("node.x [m]");
  expect_all_literal(picture("push_it-1"));
}

/// How gnuplot writes "K_v" with a subscript: the letter, then another piece of text, lower and smaller.
void expect_subscript(const std::string& drawn, const std::string& letter,
                      const std::string& below) {
  const std::size_t at = drawn.find(">" + letter + "</tspan>");
  ASSERT_NE(at, std::string::npos) << letter;
  const std::string rest = drawn.substr(at, 200);
  EXPECT_THAT(rest.substr(0, rest.find(">" + below + "</tspan>")), HasSubstr("dy="));
}

TEST_F(FigureText, IsMarkupWhereTheCaseAsksForIt) {
  run(
      point("vary = { parameter = \"K_x\", values = [1, 2], labels = [\"P_v\", \"Q_w\"] "
            "}\n[[plot]]\nname = \"a\"\n"
            "markup = true\ntitle = \"T_0 {/Symbol q}\"\nx_label = \"X_1\"\ncurves = [{ study = "
            "\"push_it\" }]\n"));
  const std::string drawn = picture("a");
  expect_subscript(drawn, "T", "0");
  expect_subscript(drawn, "X", "1");
  expect_subscript(drawn, "P", "v");
  expect_subscript(drawn, "Q", "w");
  expect_shown(drawn, "font-family=\"Symbol\" >q</tspan>");
}

TEST_F(FigureText, OfMapsIsMarkupWhereTheCaseAsksForIt) {
  run(map_of_a_point(
      "[[map_plot]]\nname = \"a\"\nmarkup = true\nquantity = \"K_trans_min\"\ntitle = \"T_0\"\n"
      "label = \"C_1\"\nx_label = \"X_2\"\npanels = [{ study = \"push_it\", title = \"P_3\" }]\n"));
  const std::string drawn = picture("a");
  expect_subscript(drawn, "T", "0");
  expect_subscript(drawn, "C", "1");
  expect_subscript(drawn, "X", "2");
  expect_subscript(drawn, "P", "3");
  expect_shown(drawn, ">node.y [m]<");  // made by the program: no markup
}

TEST_F(FigureText, ThatTheProgramMakesIsNoMarkup) {
  run(point(
      "vary = { parameter = \"K_x\", values = [1, 2] }\n[[plot]]\nname = \"a\"\nmarkup = true\n"
      "x = \"leg_1.slide\"\ncurves = [{ study = \"push_it\" }]\n"));
  expect_shown(picture("a"), ">leg_1.slide [m]<");
  expect_shown(picture("a"), ">K_x = 2<");
}

TEST_F(FigureText, WithMarkupRunsNoCommandEither) {
  run(
      point("vary = { parameter = \"K_x\", values = [1, 2] }\n[[plot]]\nname = \"a\"\nmarkup = "
            "true\ntitle = " +
            value("title") + "\nx_label = " + value("x") +
            "\ncurves = [{ study = \"push_it\", labels = [" + value("soft") + ", " +
            value("stiff") + "] }]\n"));
  EXPECT_FALSE(fs::exists(scratch.path() / "pwned"));
  EXPECT_FALSE(picture("a").empty());
}

}  // namespace
}  // namespace springfold::cli
