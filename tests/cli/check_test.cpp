// `check` finds in a second what a run would fail at.
#include <gmock/gmock.h>

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

struct Outcome {
  int code = -1;
  std::string out{}, err{};
};

class Check : public testing::Test {
 protected:
  Outcome check(const std::string& text, std::vector<std::string> more = {}) const {
    put_text(file(), text);
    std::vector<std::string> words{"springfold", "check", file().string()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  static Outcome run(const std::vector<std::string>& words) {
    std::vector<const char*> argv;
    for (const auto& word : words) argv.push_back(word.c_str());
    std::ostringstream out, err;
    const int code = run_main(static_cast<int>(argv.size()), argv.data(), out, err);
    return {code, out.str(), err.str()};
  }
  std::filesystem::path file() const { return scratch.path() / "case.toml"; }
  ScratchFolder scratch{};
};

TEST_F(Check, SolvesTheStartsAndTracesNothing) {
  const Outcome good = check(small_case());
  EXPECT_EQ(good.code, all_done);
  EXPECT_THAT(good.out, HasSubstr("starts    2 of 2 found"));
  EXPECT_THAT(good.err, IsEmpty());
}

TEST_F(Check, NamesLineAndKeyOfAStartOutsideOfTheLimits) {
  const std::string text = small_case("", R"(
[[study]]
name = "late"
control = "load"
direction = [1, 0]
until = { lambda = [1, 2] }
)");
  const Outcome bad = check(text);
  EXPECT_EQ(bad.code, no_start_point);
  EXPECT_THAT(bad.err, HasSubstr("study[3].until.lambda: lambda is 0 at the start, outside of its "
                                 "limits 1 to 2; try limits that include the start"));
  EXPECT_THAT(bad.out, HasSubstr("starts    2 of 3 found"));
  const Outcome read_only = check(text, {"--no-solve"});
  EXPECT_EQ(read_only.code, all_done);
  EXPECT_THAT(read_only.out, Not(HasSubstr("starts")));
}

TEST_F(Check, AndOtherCommandsAreSuggestedForMistypedOnes) {
  const Outcome typo = run({"springfold", "chekc", "case.toml"});
  EXPECT_EQ(typo.code, wrong_usage);
  EXPECT_THAT(typo.err, HasSubstr("no command \"chekc\", did you mean \"check\"?"));
  EXPECT_THAT(run({"springfold", "case.toml"}).err,
              HasSubstr("did you mean \"springfold run case.toml\"?"));
}

TEST_F(Check, ListsEveryKindOfThingAndSaysWhatLambdaIs) {
  const Outcome good = check(R"([[node]]
name = "pin"
at = [0, 0]
fixed = true
[[node]]
name = "foot"
at = [2, 0]
fixed = ["y"]
[[node]]
repeat = { i = [0, 19] }
name = "n{i}"
at = [1, "1 + i"]
[[bar]]
from = "pin"
to = "foot"
stiffness = 3
[[bar]]
name = "cable"
from = "pin"
to = "n1"
stiffness = 3
tension_only = true
[[spring]]
name = "tie"
to = "n0"
to_at = [0, 0]
stiffness = 2
[[load]]
on = "n0"
force = [0, -1]
scale = "lambda"
[[study]]
name = "press"
body = "foot"
control = "load"
direction = [-2, 0]
[[study]]
name = "on"
body = "n0"
control = "mixed"
direction = [0, 1]
start = { from = "press", at = "start" }
[[study]]
name = "late"
body = "n0"
control = "load"
direction = [1, 0]
load = [0.1, -0.2]
start = { from = "press", at = "start", hold = ["foot.x", "n1.y"] }
)",
                             {"--no-solve"});
  EXPECT_EQ(good.code, all_done) << good.err;
  for (const char* line :
       {"node      pin (fixed)", "node      foot (held in y)", "node      and 10 more: 22 in all",
        "spring    tie: base [0, 0] to n0, stiffness 2, free length 0",
        "bar       pin-foot: base [0, 0] to foot, stiffness 3, free length 2",
        "bar       cable: base [0, 0] to n1, stiffness 3 above 2.23607",
        "load      1: force [0, -1, 0] on n0, times lambda",
        "lambda: force [N] on foot along [-1, 0], and factor of load 1",
        "starts from study \"press\" at start",
        "lambda: way [m] of n0 along [0, 1], free across it", "load: [0.1, -0.2] on n0, constant",
        "hold: foot.x, n1.y"})
    EXPECT_THAT(good.out, HasSubstr(line));
}

TEST_F(Check, AcceptsTheCaseThatImportMakes) {
  const std::filesystem::path mesh = scratch.path() / "tent.obj";
  put_text(mesh, "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const Outcome made = run({"springfold", "import", mesh.string(), "--output", file().string()});
  EXPECT_EQ(made.code, all_done);
  EXPECT_THAT(made.out, IsEmpty());
  EXPECT_THAT(made.err, HasSubstr("4 nodes, 5 bars, 1 fold"));
  const Outcome good = run({"springfold", "check", file().string()});
  EXPECT_EQ(good.code, all_done) << good.err;
  EXPECT_THAT(good.out, HasSubstr("starts    1 of 1 found"));
  const Outcome again = run({"springfold", "import", mesh.string(), "--output", file().string()});
  EXPECT_EQ(again.code, input_output);
  EXPECT_THAT(again.err, HasSubstr("it is there already"));
  EXPECT_THAT(run({"springfold", "import", mesh.string()}).out, HasSubstr("[[bar]]"));
  EXPECT_EQ(run({"springfold", "import", "nothing.obj"}).code, wrong_case_file);
}

}  // namespace
}  // namespace springfold::cli
