// What reaches the terminal: text of a case is shown, it does not steer.
#include <gmock/gmock.h>

#include <chrono>
#include <sstream>

#include "cli/messages.hpp"
#include "cli/progress.hpp"
#include "cli/run_main.hpp"
#include "cli/selection.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* escapes =
    "a\\u001b[31;1mRED\\u0007\\u001b]0;title\\u0007\\u009b1m\\nspringfold: x";
constexpr const char* escapes_shown =
    "a\\x1b[31;1mRED\\x07\\x1b]0;title\\x07\\x9b1m\\nspringfold: x";

/// A case in which every text that it may choose freely has control characters.
std::string steering_case() {
  const std::string text = escapes;
  return "title = \"" + text + R"("
[units]
length = ")" +
         text + R"("
force = ")" +
         text + R"("
[parameters]
K = 2
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg"
elements = [
  { joint = "prismatic", axis = "x", name = "slide", role = "virtual", stiffness = "K" },
  { joint = "prismatic", axis = "y", name = "lift", role = "virtual", stiffness = 1 },
]
[[study]]
name = ")" +
         text + R"("
control = "mixed"
direction = [1, 0]
until = { deflection = [-0.1, 0.3] }
vary = { parameter = "K", values = [1, 2], labels = ["one", ")" +
         text + R"("] }
)";
}

std::string steering_expectations() {
  const std::string text = escapes;
  return "notes = [\"" + text + "\"]\n[[value]]\nname = \"" + text + "\"\ngroup = \"" + text +
         "\"\nsource = \"" + text + "\"\nstudy = \"" + text +
         "\"\nquantity = \"lambda\"\nexpected = 0\ntolerance = 1\n";
}

struct Output {
  int code = -1;
  std::string out{}, err{};
};

Output run(std::vector<const char*> words, bool is_terminal = false) {
  words.insert(words.begin(), "springfold");
  std::ostringstream out, err;
  const int code = run_main(static_cast<int>(words.size()), words.data(), out, err, is_terminal);
  return {code, out.str(), err.str()};
}

/// No control character but the ends of lines, and no line that the case began.
void expect_plain(const std::string& text) {
  for (const char c : text)
    EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F)) << text;
  EXPECT_THAT(text, Not(HasSubstr("\xC2\x9B")));
  EXPECT_THAT(text, Not(HasSubstr("\nspringfold: x")));
}

class Terminal : public testing::Test {
 protected:
  Terminal() {
    put_text(scratch.path() / "case.toml", steering_case());
    put_text(scratch.path() / "expected.toml", steering_expectations());
  }
  std::string case_file() const { return (scratch.path() / "case.toml").string(); }
  std::string folder() const { return (scratch.path() / "out").string(); }
  ScratchFolder scratch;
};

TEST_F(Terminal, ShowsTextsOfARunWithTheirControlCharactersWrittenOut) {
  const std::string file = case_file(), out = folder();
  const Output output = run({"run", file.c_str(), "--out", out.c_str(), "--no-plots"});
  EXPECT_EQ(output.code, 0) << output.err;
  expect_plain(output.out);
  expect_plain(output.err);
  EXPECT_THAT(output.out, StartsWith(std::string{escapes_shown} + "\n"));
}

TEST_F(Terminal, ShowsTextsOfACheckAndOfATableOfManyCasesSo) {
  const std::string file = case_file();
  const Output check = run({"check", file.c_str()}), verify = run({"verify", file.c_str()});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_EQ(verify.code, 0) << verify.err;
  expect_plain(check.out);
  expect_plain(verify.out);
  EXPECT_THAT(check.out, HasSubstr(escapes_shown));
  EXPECT_THAT(verify.out, HasSubstr(escapes_shown));
}

TEST_F(Terminal, ShowsMistakesSo) {
  put_text(case_file(), "\"k\\u001b[2J\\n\" = 1\n");
  const std::string file = case_file();
  const Output output = run({"check", file.c_str()});
  EXPECT_EQ(output.code, 3);
  expect_plain(output.err);
  EXPECT_THAT(output.err, HasSubstr("k\\x1b[2J\\n: unknown key"));
}

TEST_F(Terminal, ShowsUnknownStudiesAndFileNamesSo) {
  const std::string file = case_file();
  expect_plain(run({"run", file.c_str(), "--study", "\x1b[2J"}).err);
  expect_plain(run({"run", "/nowhere/\x1b[2J.toml"}).err);
  expect_plain(run({"\x1b[2J"}).err);
}

TEST_F(Terminal, ShowsWordsOfGnuplotSo) {
  const fs::path fake = scratch.path() / "bin" / "gnuplot";
  put_text(fake, "#!/bin/sh\nprintf 'bad \\033[2J font\\n' >&2\nexit 3\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string command = "PATH='" + fake.parent_path().string() +
                              "':$PATH '" SPRINGFOLD_PROGRAM "' run '" + case_file() + "' --out '" +
                              folder() + "' > /dev/null 2> '" + folder() + ".err'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string words = text_in(folder() + ".err");
  expect_plain(words);
  EXPECT_THAT(words, HasSubstr("bad \\x1b[2J font"));
}

TEST(ProgressLine, ShowsWhatRunsWithItsControlCharactersWrittenOut) {
  std::ostringstream err;
  Progress progress{err, true};
  progress.begin("1/1 \x1b]0;x\a");
  EXPECT_THAT(err.str(), HasSubstr("1/1 \\x1b]0;x\\x07"));
}

/// What stands on the line after some time of work.
std::string line_after(double seconds, int points, int most) {
  std::ostringstream err;
  Progress::Time now{};
  Progress progress{err, true, [&now] { return now; }};
  progress.begin_runs(1);
  progress.begin("1/1 push");
  now +=
      std::chrono::duration_cast<Progress::Time::duration>(std::chrono::duration<double>(seconds));
  progress.points(points, most);
  return err.str();
}

TEST(ProgressLine, BoundsTheTimeThatIsLeftOfALongCurve) {
  EXPECT_THAT(line_after(300, 100, 200), HasSubstr("100 points, at most 5 min left"));
  EXPECT_THAT(line_after(20, 100, 0), HasSubstr("100 points, 20 s"));
  EXPECT_THAT(line_after(0, 100, 200), testing::EndsWith("100 points"));
}

TEST(ProgressLine, TellsTheTimeThatIsLeftFromTheRunsThatAreDone) {
  std::ostringstream err;
  Progress::Time now{};
  Progress progress{err, true, [&now] { return now; }};
  progress.begin_runs(4);
  progress.begin("1/4 push");
  now += std::chrono::seconds{10};
  progress.end_run();
  progress.begin("2/4 push");
  progress.points(20);
  EXPECT_THAT(err.str(), HasSubstr("2/4 push: 20 points, about 30 s left"));
}

TEST(DefaultFolder, LiesBelowResultsWhateverTheCaseIsCalled) {
  for (const char* name : {"..toml", "...toml", "....toml", ".toml", "a/..toml", "../...toml",
                           "case.toml", "/case.toml", "x/../case.toml", "case"}) {
    const fs::path folder = default_folder(name).lexically_normal();
    EXPECT_EQ(*folder.begin(), "results") << name;
    EXPECT_EQ(std::distance(folder.begin(), folder.end()), 2) << name << ": " << folder;
    EXPECT_NE(folder.filename(), "..") << name;
  }
  EXPECT_NE(default_folder("..toml"), default_folder("...toml"));
}

}  // namespace
}  // namespace springfold::cli
