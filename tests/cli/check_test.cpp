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

}  // namespace
}  // namespace springfold::cli
