// Every mistake is reported where it can be mended: position, key, what was got, what is needed.
#include <gmock/gmock.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CaseMessages : public CaseFiles {
 protected:
  /// Messages for the good case with one change.
  std::vector<std::string> after(const std::string& from, const std::string& to) const {
    return messages(replaced(orthoglide_text(), from, to));
  }
};

TEST_F(CaseMessages, AreNoneForAGoodCase) { EXPECT_THAT(messages(orthoglide_text()), IsEmpty()); }

TEST_F(CaseMessages, NameUnknownKeysWithTheNearestKnownOne) {
  EXPECT_THAT(after("pose = [0", "psoe = [0"),
              ElementsAre("case.toml:12:1: body[1].psoe: unknown key, did you mean \"pose\"?"));
  EXPECT_THAT(after("title =", "titel ="),
              ElementsAre("case.toml:1:1: titel: unknown key, did you mean \"title\"?"));
  EXPECT_THAT(
      after("attempts = 3", "colour = 3"),
      ElementsAre("case.toml:33:70: study[1].start.colour: unknown key; known here: pose, "
                  "solve, solver, attempts, seed, maximum_move, from, at, loads, hold, release"));
}

TEST_F(CaseMessages, TakeAMisspeltKeyForTheMissingOne) {
  EXPECT_THAT(after("spring = {", "sprnig = {"),
              ElementsAre("case.toml:17:73: chain[1].elements[2].sprnig: unknown key, did you mean "
                          "\"spring\"?"));
  EXPECT_THAT(
      after("joint = \"revolute\"", "jiont = \"revolute\""),
      ElementsAre("case.toml:17:3: chain[1].elements[2]: got neither joint, rigid nor elastic, "
                  "need exactly one of them; did you mean \"joint\" where \"jiont\" stands?"));
}

TEST_F(CaseMessages, NameMissingKeysAtTheirTable) {
  EXPECT_THAT(after("name = \"tool\"\n", ""),
              ElementsAre("case.toml:9:1: body[1].name: missing, need a name"));
  EXPECT_THAT(after("task_space = \"xy\"\n", ""),
              ElementsAre("case.toml:9:1: body[1].task_space: missing, need \"xy\", \"planar\", "
                          "\"xyz\" or \"spatial\""));
  EXPECT_THAT(after(", stiffness = \"Kv\"", ""),
              ElementsAre("case.toml:17:82: chain[1].elements[2].spring.stiffness: missing, need a "
                          "number >= 0 [N*mm/rad]"));
  EXPECT_THAT(after(", value = \"L\"", ""),
              ElementsAre("case.toml:16:3: chain[1].elements[1].value: missing, need a finite "
                          "number [mm]"));
  EXPECT_THAT(after("direction = [1, 1]\n", ""),
              ElementsAre("case.toml:27:1: study[1].direction: missing, need a direction such as "
                          "[1, 0]: control = \"mixed\" moves along it"));
  EXPECT_THAT(after("control = \"mixed\"\n", ""),
              ElementsAre("case.toml:27:1: study[1].control: missing, need \"load\", \"pose\", "
                          "\"mixed\", \"actuator\" or \"parameter\""));
}

TEST_F(CaseMessages, NameMissingTablesOfTheWholeFile) {
  EXPECT_THAT(messages("title = \"nothing\"\n"),
              ElementsAre("case.toml: body: missing, need at least one [[body]] or [[node]]",
                          "case.toml: chain: missing, need at least one [[chain]], [[bar]] or "
                          "[[spring]]: nothing holds what moves",
                          "case.toml: study: missing, need at least one [[study]]"));
  EXPECT_THAT(after("[[study]]", "[study]"),
              ElementsAre("case.toml:27:1: study: got a table, need a list of tables: [[study]] "
                          "with two brackets"));
}

TEST_F(CaseMessages, SayWhatWasGotAndWhatIsNeeded) {
  EXPECT_THAT(after("stiffness = \"K\"", "stiffness = 0"),
              ElementsAre("case.toml:16:98: chain[1].elements[1].stiffness: got 0, need a number > "
                          "0 [N/mm]"));
  EXPECT_THAT(
      after("stiffness = \"Kv\"", "stiffness = \"Kv - 1\""),
      ElementsAre("case.toml:17:112: chain[1].elements[2].spring.stiffness: got \"Kv - 1\" "
                  "= -0.99, need a number >= 0 [N*mm/rad], or falling = true for a law that "
                  "may fall"));
  EXPECT_THAT(after("stiffness = \"K\"", "stiffness = true"),
              ElementsAre("case.toml:16:98: chain[1].elements[1].stiffness: got true, need a "
                          "number > 0 [N/mm] or a formula"));
  EXPECT_THAT(after("pose = [0, 0]", "pose = [0, 0, 0]"),
              ElementsAre("case.toml:12:8: body[1].pose: got a list of 3, need [x, y]"));
  EXPECT_THAT(after("pose = [0, 0]", "pose = [nan, 2020-01-01]"),
              ElementsAre("case.toml:12:9: body[1].pose[1]: got nan, need a finite number [mm]",
                          "case.toml:12:14: body[1].pose[2]: got a date or time, need a finite "
                          "number [mm] or a formula"));
  EXPECT_THAT(after("pose = [0, 0]", "pose = [1.7e308, 0]"),
              ElementsAre("case.toml:12:9: body[1].pose[1]: got 1.7e+308, need at most 1e100 in "
                          "size, as products of "
                          "larger numbers are infinite"));
  EXPECT_THAT(after("rigid = [\"-L\", 0]", "rigid = \"L\""),
              ElementsAre("case.toml:18:13: chain[1].elements[3].rigid: got \"L\", need [x, y, z] "
                          "or { at = [...], rotate = {...} }"));
  EXPECT_THAT(after("axis = \"-z\"", "axis = \"w\""),
              ElementsAre("case.toml:17:32: chain[1].elements[2].axis: got \"w\", need \"x\", "
                          "\"y\", \"z\", \"-x\", \"-y\", \"-z\" or [x, y, z]"));
  EXPECT_THAT(after("axis = \"-z\"", "axis = [0, 0, 0]"),
              ElementsAre("case.toml:17:32: chain[1].elements[2].axis: got zeros only, need a "
                          "vector with a length: an axis is a direction"));
  EXPECT_THAT(after("task_space = \"xy\"", "task_space = \"plane\""),
              ElementsAre("case.toml:11:14: body[1].task_space: got \"plane\", need \"xy\", "
                          "\"planar\", \"xyz\" or \"spatial\", did you mean \"planar\"?"));
  EXPECT_THAT(after("length = \"mm\"", "length = 3"),
              ElementsAre("case.toml:3:10: units.length: got 3, need a text"));
  EXPECT_THAT(after("maximum_points = 99", "maximum_points = 9.5"),
              ElementsAre("case.toml:37:91: study[1].trace.maximum_points: got 9.5, need a whole "
                          "number from 2 to 1000000"));
  EXPECT_THAT(after("maximum_points = 99", "spacing = -1"),
              ElementsAre("case.toml:37:84: study[1].trace.spacing: got -1, need a number >= 0"));
  EXPECT_THAT(after("trace = {", "path = \"davidenk\"\ntrace = {"),
              ElementsAre("case.toml:37:8: study[1].path: got \"davidenk\", need \"arc_length\" or "
                          "\"davidenko\", did you mean \"davidenko\"?"));
  // Not a word that is written alike: what it is called elsewhere.
  const auto control = after("control = \"mixed\"", "control = \"force\"");
  EXPECT_THAT(control, Contains(HasSubstr("study[1].control: got \"force\"")));
  EXPECT_THAT(control, Contains(HasSubstr("did you mean \"load\"?")));
}

TEST_F(CaseMessages, OfRolesSayWhatGoesTogether) {
  EXPECT_THAT(after("role = \"preloaded\"", "role = \"passive\""),
              ElementsAre("case.toml:17:80: chain[1].elements[2].spring: a passive joint has no "
                          "spring, need role = \"preloaded\""));
  EXPECT_THAT(after("role = \"actuated\", ", ""),
              ElementsAre("case.toml:16:62: chain[1].elements[1].value: only an actuated joint has "
                          "a value, need role = \"actuated\"",
                          "case.toml:16:79: chain[1].elements[1].stiffness: a passive joint has no "
                          "spring, need role = \"virtual\""));
}

TEST_F(CaseMessages, OfNamesNameTheNearestKnownOne) {
  EXPECT_THAT(after("\"leg_x.knee\" =", "\"leg_x.kneee\" ="),
              ElementsAre("case.toml:34:11: study[1].until.leg_x.kneee: no quantity "
                          "\"leg_x.kneee\" in study \"Q2\", did you mean \"leg_x.knee\"?"));
  EXPECT_THAT(after("x = \"deflection\"", "x = \"deflexion\""),
              ElementsAre("case.toml:41:5: plot[1].x: no quantity \"deflexion\" in study \"Q2\", "
                          "did you mean \"deflection\"?"));
  EXPECT_THAT(after("curves = [{ study = \"Q2\"", "curves = [{ study = \"Q1\""),
              ElementsAre("case.toml:47:21: plot[1].curves[1].study: no study \"Q1\", did you mean "
                          "\"Q2\"?"));
  EXPECT_THAT(
      after("curves = [{ study", "curves = [\"Q2\", { study"),
      ElementsAre("case.toml:47:11: plot[1].curves[1]: got \"Q2\", need a table as in curves "
                  "= [{ study = \"Q2\" }]"));
  EXPECT_THAT(after("parameter = \"Kv\"", "parameter = \"Kw\""),
              ElementsAre("case.toml:36:22: study[1].vary.parameter: no parameter \"Kw\", did you "
                          "mean \"Kv\"?"));
  EXPECT_THAT(after("control = \"mixed\"", "body = \"tol\"\ncontrol = \"mixed\""),
              ElementsAre("case.toml:30:8: study[1].body: got \"tol\", need the name of a moving "
                          "body, did you mean \"tool\"?"));
  EXPECT_THAT(
      after("name = \"leg_y\"", "name = \"leg_y\"\nfrom = \"bse\""),
      ElementsAre("case.toml:22:8: chain[2].from: got \"bse\", need the name of a body, did "
                  "you mean \"base\"?"));
  const std::string actuator =
      replaced(orthoglide_text(), "control = \"mixed\"",
               "control = \"actuator\"\nactuators = { \"leg_x.drve\" = 1 }");
  EXPECT_THAT(messages(replaced(actuator, "y = \"force\"", "y = \"energy\"")),
              ElementsAre("case.toml:31:15: study[1].actuators.leg_x.drve: no actuator "
                          "\"leg_x.drve\", did you mean \"leg_x.drive\"?"));
}

TEST_F(CaseMessages, OfDuplicateNamesComeWithTheSecondOne) {
  EXPECT_THAT(
      after("name = \"leg_y\"", "name = \"leg_x\""),
      ElementsAre("case.toml:21:8: chain[2].name: \"leg_x\" is already taken: bodies, "
                  "chains and springs need different names, and \"base\" is the fixed body"));
  EXPECT_THAT(after("name = \"knee\"", "name = \"drive\""),
              ElementsAre("case.toml:17:45: chain[1].elements[2].name: \"drive\" is already the "
                          "name of another joint of this chain, need different names"));
  const std::string text = orthoglide_text();
  EXPECT_THAT(messages(text + "[[study]]\nname = \"Q2\"\nkind = \"equilibrium\"\n"),
              ElementsAre("case.toml:49:8: study[2].name: \"Q2\" is already the name of another "
                          "study, need different names"));
}

TEST_F(CaseMessages, OfRangesAndDirectionsSayWhy) {
  EXPECT_THAT(after("[\"-80*deg\", \"80*deg\"]", "[2, 1]"),
              ElementsAre("case.toml:34:30: study[1].until.leg_x.knee[2]: got 1, need more than 2 "
                          "(low < high)"));
  EXPECT_THAT(after("law = \"linear\", stiffness = \"Kv\"",
                    "law = \"gap\", stiffness = 1, low = \"L\", high = 0"),
              ElementsAre("case.toml:17:130: chain[1].elements[2].spring.high: got 0, need more "
                          "than 1 (low < high)"));
  EXPECT_THAT(after("direction = [1, 1]", "direction = [0, 0]"),
              ElementsAre("case.toml:31:13: study[1].direction: got zeros only, need a vector with "
                          "a length: lambda is measured along it"));
  std::string planar = replaced(orthoglide_text(), "\"xy\"\npose = [0, 0]", "\"planar\"");
  planar = replaced(planar, "direction = [1, 1]\nload = [0, 0]", "direction = [1, 0, 1]");
  EXPECT_THAT(messages(replaced(planar, "pose = [\"p\", \"p\"], ", "")),
              ElementsAre("case.toml:30:14: study[1].direction: got a translation and a rotation "
                          "together, need one of them alone in control = \"mixed\": the force-free "
                          "complement of a mixture would depend on the unit of length"));
}

TEST_F(CaseMessages, OfSpringsCountTheirSegments) {
  EXPECT_THAT(
      after("law = \"linear\", stiffness = \"Kv\"",
            "law = \"piecewise_linear\", breakpoints = [1, 0], stiffnesses = [1, 2]"),
      ElementsAre("case.toml:17:128: chain[1].elements[2].spring.breakpoints[2]: got 0, need "
                  "more than 1 (breakpoints increase)",
                  "case.toml:17:146: chain[1].elements[2].spring.stiffnesses: got a list of "
                  "2, need 3: one for every segment, one more than breakpoints"));
  EXPECT_THAT(after("law = \"linear\"", "law = \"liner\""),
              ElementsAre("case.toml:17:90: chain[1].elements[2].spring.law: got \"liner\", need "
                          "\"linear\", \"one_sided\", \"piecewise_linear\", \"gap\", \"stops\", "
                          "\"polynomial\", \"table\", \"formula\", \"logarithmic\" or \"power\", "
                          "did you mean \"linear\"?"));
}

TEST_F(CaseMessages, OfOneRunSayWhich) {
  EXPECT_THAT(
      after("values = [0, \"0.1*K*L^2\"]", "values = [0, -0.1]"),
      ElementsAre("case.toml:17:112: chain[1].elements[2].spring.stiffness: got \"Kv\" = "
                  "-0.1, need a number >= 0 [N*mm/rad], or falling = true for a law that may "
                  "fall (study \"Q2\", run 2)",
                  "case.toml:24:111: chain[2].elements[2].spring.stiffness: got \"Kv\" = "
                  "-0.1, need a number >= 0 [N*mm/rad], or falling = true for a law that may "
                  "fall (study \"Q2\", run 2)"));
}

TEST_F(CaseMessages, OfTheAnalysisComeWithThePlaceOfTheKey) {
  EXPECT_THAT(after("solve = \"actuators\", solver = \"newton\"", "solver = \"fixed_point\""),
              ElementsAre(testing::StartsWith("case.toml:33:39: study[1].start.solver: the paper's "
                                              "fixed-point iteration works at a given pose")));
  EXPECT_THAT(after("maximum_step = 0.04", "maximum_step = 0.01"),
              ElementsAre("case.toml:37:26: study[1].trace.initial_step: got 0.02, need at most "
                          "maximum_step, 0.01 (study \"Q2\", run 1)"));
}

TEST_F(CaseMessages, OfBranchesSayWhatIsNeeded) {
  const auto with = [this](const std::string& branches) {
    std::vector<std::string> said =
        after("direction = [1, 1]\n", "direction = [1, 1]\nbranches = " + branches + "\n");
    for (std::string& text : said) text.erase(0, text.find(' ') + 1);  // without its place
    return said;
  };
  EXPECT_THAT(with("{ depth = 1, maximum = 20, search_at = [0, \"0.1*L\"], starts = 8, seed = 2 }"),
              IsEmpty());
  EXPECT_THAT(with("{ depth = -1 }"),
              ElementsAre("study[1].branches.depth: got -1, need a whole number >= 0"));
  EXPECT_THAT(with("{ maximum = 0 }"),
              ElementsAre(testing::StartsWith("study[1].branches.maximum: got 0, need a whole")));
  EXPECT_THAT(with("{ search_at = 1 }"), ElementsAre("study[1].branches.search_at: got 1, need a "
                                                     "list of values of lambda"));
  EXPECT_THAT(with("3"),
              ElementsAre("study[1].branches: got 3, need a table such as { depth = 1 }"));
  EXPECT_THAT(with("{ deep = 1 }"),
              ElementsAre(testing::StartsWith("study[1].branches.deep: unknown key")));
  EXPECT_THAT(with("{ depth = 1 }\npath = \"davidenko\""),
              ElementsAre("study[1].branches: path = \"davidenko\" follows the branch of the start "
                          "alone: it finds no branch points (study \"Q2\", run 1)"));
}

TEST_F(CaseMessages, ComeAllAtOnceInTheOrderOfTheFile) {
  std::string text = orthoglide_text();
  text = replaced(text, "task_space = \"xy\"", "task_space = \"yx\"");
  text = replaced(text, "\"prismatic\"", "\"primatic\"");
  text = replaced(text, "p = \"0.454*L\"", "p = \"0.454*M\"");
  text = replaced(text, "attempts = 3", "attempts = 0");
  text = replaced(text, "runs = [1, 2]", "runs = [1, 3]");
  const std::vector<std::string> all = messages(text);
  ASSERT_EQ(all.size(), 5u) << testing::PrintToString(all);
  EXPECT_THAT(all[0], testing::StartsWith("case.toml:8:5: parameters.p: "));
  EXPECT_THAT(all[1], testing::StartsWith("case.toml:11:14: body[1].task_space: "));
  EXPECT_THAT(all[2], testing::StartsWith("case.toml:16:13: chain[1].elements[1].joint: "));
  EXPECT_THAT(all[3], testing::StartsWith("case.toml:33:81: study[1].start.attempts: "));
  EXPECT_THAT(all[4], testing::StartsWith("case.toml:47:38: plot[1].curves[1].runs[2]: "));
}

TEST_F(CaseMessages, OfExpectationsHaveTheirOwnFile) {
  const std::string neighbour =
      "expected.toml: was read because it lies beside case.toml; if it belongs to another case, "
      "write "
      "expected = \"\" at the top of case.toml";
  write("expected.toml",
        "[[value]]\nname = \"a\"\nstudy = \"Q3\"\nquantity = \"force\"\nexpected = 1\ntolerance = "
        "-1\n"
        "[[value]]\nname = \"b\"\nstudy = \"Q2\"\nquantity = \"count.XX\"\nat = \"LP0\"\nrun = 3\n"
        "expected = \"1/0\"\ntolerance = 1\n");
  const std::vector<std::string> all = messages(orthoglide_text());
  EXPECT_THAT(
      all,
      ElementsAre(
          neighbour, "expected.toml:3:9: value[1].study: no study \"Q3\", did you mean \"Q2\"?",
          "expected.toml:10:12: value[2].quantity: got \"count.XX\", need count. "
          "and one of \"branches\", \"jumps\", \"equilibria\", \"LP\", \"BP\", \"SA\", \"CL\", "
          "\"KB\", \"KS\", "
          "\"TP\", \"FM\", \"UZ\", "
          "\"EP\", \"SC\", \"UR\", \"CP\", \"IC\", \"CX\", \"HT\", \"BB\", \"C2\", "
          "\"FA\", \"CR\", \"TA\", \"AA\", \"SB\", \"PT\", \"EX\", \"TH\" or \"JP\"",
          "expected.toml:11:6: value[2].at: got \"LP0\", need \"start\", \"end\", "
          "an event such as \"LP1\", \"target 2\" of a study of commands, or the code of "
          "an event or \"row\" and `near`",
          "expected.toml:12:7: value[2].run: got 3, need the number of a run of "
          "\"Q2\", which has 2",
          "expected.toml:13:12: value[2].expected: got \"1/0\" = inf, need a "
          "finite number (study \"Q2\", run 1)"));
  write("expected.toml",
        "[[value]]\nname = \"a\"\nstudy = \"Q2\"\nquantity = \"forse\"\nexpected = 1\n"
        "tolerance = 1\n");
  EXPECT_THAT(messages(orthoglide_text()),
              ElementsAre(neighbour,
                          "expected.toml:4:12: value[1].quantity: no quantity \"forse\" in study "
                          "\"Q2\", did you mean \"force\"?"));
}

TEST_F(CaseMessages, NeverSpanTwoLines) {
  const std::vector<std::string> all = messages("\"a\\nb\" = 1\n" + orthoglide_text());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].find('\n'), std::string::npos);
}

}  // namespace
}  // namespace springfold::io
