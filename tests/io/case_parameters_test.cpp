// Parameters, their overrides, includes and variations.
#include <gmock/gmock.h>

#include <algorithm>
#include <clocale>
#include <locale>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string rest = R"([[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "leg"
elements = [{ joint = "prismatic", axis = "x", name = "drive", role = "virtual", stiffness = "K" }, { joint = "revolute", axis = "z" }, { rigid = ["L", 0] }]
[[study]]
name = "rest"
kind = "equilibrium"
)";

class CaseParameters : public CaseFiles {};

TEST_F(CaseParameters, MayDependOnEachOtherInAnyOrder) {
  const Case c = load("[parameters]\nL = \"2*K\"\nK = \"M + 1\"\nM = 4\n" + rest);
  EXPECT_EQ(c.runs[0].parameters, (std::map<std::string, double>{{"L", 10}, {"K", 5}, {"M", 4}}));
}

TEST_F(CaseParameters, MustNotDependOnThemselves) {
  EXPECT_THAT(messages("[parameters]\nL = \"K\"\nK = \"M\"\nM = \"2*L\"\n" + rest),
              ElementsAre("case.toml:2:5: parameters.L: depends on itself: L -> K -> M -> L"));
}

TEST_F(CaseParameters, CauseOneMessageForOneMistake) {
  EXPECT_THAT(
      messages("[parameters]\nL = \"2*Q\"\nK = \"L + 1\"\n" + rest),
      ElementsAre("case.toml:2:5: parameters.L: got \"2*Q\", need a number or a formula: no "
                  "parameter \"Q\"; known here: L, K"));
  EXPECT_THAT(messages("[parameters]\nL = \"1/0\"\nK = \"L + 1\"\n" + rest),
              ElementsAre("case.toml:2:5: parameters.L: got \"1/0\" = inf, need a finite number"));
}

TEST_F(CaseParameters, HaveNamesThatFormulasCanUse) {
  EXPECT_THAT(messages("[parameters]\nL = 1\nK = 1\npi = 3\n\"a b\" = 1\n" + rest),
              ElementsAre("case.toml:4:1: parameters.pi: formulas keep this name for themselves, "
                          "need another one",
                          "case.toml:5:1: parameters.a b: need a name of letters, digits and '_' "
                          "that does not begin with a digit"));
}

TEST_F(CaseParameters, MayBeTables) {
  EXPECT_EQ(load("[parameters]\nL = 1\n[parameters.K]\nvalue = \"3*L\"\nunit = \"N/m\"\n" + rest)
                .runs[0]
                .parameters.at("K"),
            3);
  EXPECT_THAT(
      messages("[parameters]\nL = 1\nK = { vale = 3 }\n" + rest),
      ElementsAre("case.toml:3:7: parameters.K.vale: unknown key, did you mean \"value\"?"));
}

TEST_F(CaseParameters, MayBeReplacedFromOutside) {
  const std::string text = "[parameters]\nL = 1\nK = \"2*L\"\n" + rest;
  const Case c = load(text, {{"L", "3"}, {"K", "L^2"}});
  EXPECT_EQ(c.runs[0].parameters.at("L"), 3);
  EXPECT_EQ(c.runs[0].parameters.at("K"), 9);
  EXPECT_EQ(c.overrides, (Overrides{{"L", "3"}, {"K", "L^2"}}));
  EXPECT_THAT(messages(text, {{"k", "1"}}),
              ElementsAre("--set: k: no parameter \"k\", did you mean \"K\"?"));
  EXPECT_THAT(
      messages(text, {{"K", "1,5"}}),
      ElementsAre("--set: K: got \"1,5\", need a number or a formula: unexpected \",\"; need "
                  "one value"));
  EXPECT_THAT(messages(text, {{"K", "-1"}}),
              ElementsAre("case.toml:9:94: chain[1].elements[1].stiffness: got \"K\" = -1, need a "
                          "number >= 0 [N/m]"));
}

TEST_F(CaseParameters, OfIncludedFilesComeFirstAndAreOverridden) {
  write("parts/lengths.toml", "[parameters]\nL = 1\nM = 7\n[units]\nlength = \"mm\"\n");
  write("parts/mechanism.toml", "include = \"lengths.toml\"\n[parameters]\nK = \"L\"\n" +
                                    rest.substr(0, rest.find("[[study]]")));
  const Case c = load("include = [\"parts/mechanism.toml\"]\n[parameters]\nL = \"M\"\n" +
                      rest.substr(rest.find("[[study]]")));
  EXPECT_EQ(c.runs[0].parameters.at("K"), 7);
  EXPECT_EQ(c.units.length, "mm");
  EXPECT_EQ(c.runs[0].mechanism.chains[0].name, "leg");
}

TEST_F(CaseParameters, OfIncludedFilesAreReportedInTheirFile) {
  write("mechanism.toml",
        "[parameters]\nL = 1\nK = -1\n" + rest.substr(0, rest.find("[[study]]")) + "[[study]]\n");
  EXPECT_THAT(
      messages("include = \"mechanism.toml\"\n" + rest.substr(rest.find("[[study]]"))),
      ElementsAre("mechanism.toml:9:94: chain[1].elements[1].stiffness: got \"K\" = -1, "
                  "need a number >= 0 [N/m]",
                  "mechanism.toml:10:3: study: belongs into the case file itself, not into an "
                  "included file"));
}

TEST_F(CaseParameters, VaryOverRunsAndAreSetPerStudy) {
  const Case c =
      load("[parameters]\nL = 1\nK = \"2*L\"\nM = 3\n" + rest +
           "set = { L = \"M\" }\nvary = { parameter = \"M\", values = [4, \"2^-1\"] }\n"
           "[[study]]\nname = \"other\"\nkind = \"equilibrium\"\n"
           "vary = { parameter = \"L\", values = [1, 2], labels = [\"short\", \"long\"] }\n");
  ASSERT_EQ(c.runs.size(), 4u);
  EXPECT_EQ(c.runs[0].label, "M = 4");
  EXPECT_EQ(c.runs[0].parameters.at("K"), 8);
  EXPECT_EQ(c.runs[2].label, "short");
  EXPECT_EQ(c.runs[3].label, "long");
  EXPECT_EQ(c.runs[3].run, 2);
  EXPECT_EQ(c.runs[3].parameters.at("K"), 4);
  EXPECT_EQ(c.runs[3].parameters.at("M"), 3);
}

TEST_F(CaseParameters, ThatVaryMustNotMakeACircle) {
  EXPECT_THAT(messages("[parameters]\nL = 1\nK = \"2*L\"\n" + rest + "set = { L = \"K\" }\n"),
              ElementsAre("case.toml:13:13: study[1].set.L: depends on itself: L -> K -> L (study "
                          "\"rest\")"));
}

TEST_F(CaseParameters, ThatVaryAreCheckedLikeAllOthers) {
  const std::string head = "[parameters]\nL = 1\nK = 1\n" + rest;
  EXPECT_THAT(
      messages(head + "vary = { parameter = \"K\", values = [] }\n"),
      ElementsAre("case.toml:13:36: study[1].vary.values: got an empty list, need a list of "
                  "numbers, one for every run"));
  EXPECT_THAT(messages(head + "vary = { parameter = \"K\", values = [1, 2], labels = [\"a\"] }\n"),
              ElementsAre("case.toml:13:53: study[1].vary.labels: got a list of 1, need 2: one for "
                          "every value"));
  EXPECT_THAT(
      messages(head + "set = { K = 2 }\nvary = { parameter = \"K\", values = [1] }\n"),
      ElementsAre("case.toml:14:22: study[1].vary.parameter: \"K\" is in set too, need one of "
                  "them"));
}

TEST_F(CaseParameters, ReadTheSameInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::string text = "[parameters]\nL = 0.25\nK = \"1.5*L\"\n" + rest;
  const Case plain = load(text, {{"L", "0.75"}});
  const std::locale before = std::locale::global(std::locale{std::locale::classic(), new Comma});
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
  const Case comma = load(text, {{"L", "0.75"}});
  const std::vector<std::string> problems = messages(text, {{"K", "-0.5"}});
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  EXPECT_EQ(comma.runs[0].parameters, plain.runs[0].parameters);
  EXPECT_EQ(comma.hash, plain.hash);
  EXPECT_THAT(problems, ElementsAre(HasSubstr("= -0.5, need")));
}

TEST_F(CaseParameters, AndBytesMakeTheFingerprint) {
  const std::string text = "[parameters]\nL = 1\nK = 1\n" + rest;
  const std::string hash = load(text).hash;
  EXPECT_EQ(load(text).hash, hash);
  EXPECT_NE(load(text + "\n").hash, hash);
  EXPECT_NE(load(text, {{"L", "1"}}).hash, hash);
  write("expected.toml", "notes = []\n");
  EXPECT_NE(load(text).hash, hash);
}

}  // namespace
}  // namespace springfold::io
