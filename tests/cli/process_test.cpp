// The program as a process of its own: exit codes, streams, signals.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs a shell command line; "$SPRINGFOLD" is the program. Returns the exit code.
int in_shell(const std::string& line) {
  const std::string command = "SPRINGFOLD='" SPRINGFOLD_PROGRAM "'; " + line;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class Process : public testing::Test {
 protected:
  Process() { put_text(scratch.path() / "case.toml", small_case()); }
  std::string in_scratch(const std::string& line) const {
    return "cd '" + scratch.path().string() + "' && " + line;
  }
  std::string text(const std::string& name) const { return text_in(scratch.path() / name); }

  ScratchFolder scratch{};
};

TEST_F(Process, PutsTablesOnStandardOutputAndMessagesOnStandardError) {
  EXPECT_EQ(in_shell(in_scratch("\"$SPRINGFOLD\" run case.toml --no-plots > out.txt 2> err.txt")),
            0);
  EXPECT_THAT(text("out.txt"), HasSubstr("push, run 1"));
  EXPECT_THAT(text("out.txt"), testing::Not(HasSubstr("springfold: ")));
  EXPECT_THAT(text("err.txt"), testing::StartsWith("springfold: "));
  EXPECT_THAT(text("err.txt"), testing::Not(HasSubstr("\r"))) << "no progress line in a file";
}

TEST_F(Process, EndsWithSixWhenStandardOutputIsFull) {
  EXPECT_EQ(in_shell(in_scratch("\"$SPRINGFOLD\" run case.toml --no-plots > /dev/full 2> err.txt")),
            6);
  EXPECT_THAT(text("err.txt"), HasSubstr("cannot write to standard output"));
  EXPECT_EQ(in_shell(in_scratch("\"$SPRINGFOLD\" --help > /dev/full")), 6);
}

TEST_F(Process, EndsWithSixWhenNobodyReadsStandardOutput) {
  EXPECT_EQ(in_shell(in_scratch("{ \"$SPRINGFOLD\" run case.toml --no-plots 2> err.txt; "
                                "echo $? > code.txt; } | true")),
            0);
  const std::string code = text("code.txt");
  EXPECT_TRUE(code == "6\n" || code == "0\n") << code;  // 0: written before the reader was gone
}

TEST_F(Process, EndsWithSixAndAReasonWhenTheDiskIsFull) {
  // The file size limit stands for a full disk: 1 block of 512 bytes.
  EXPECT_EQ(in_shell(in_scratch("ulimit -f 1; \"$SPRINGFOLD\" run case.toml --no-plots "
                                "> /dev/null 2> err.txt")),
            6);
  EXPECT_THAT(text("err.txt"), HasSubstr("cannot write results/"));
  EXPECT_THAT(text("err.txt"), HasSubstr("File too large"));
}

TEST_F(Process, DrawsFiguresAfterTheResultsAndSurvivesWithoutGnuplot) {
  EXPECT_EQ(
      in_shell(in_scratch("PATH=/nowhere \"$SPRINGFOLD\" run case.toml > /dev/null 2> err.txt")),
      0);
  EXPECT_THAT(text("err.txt"), HasSubstr("warning: figure 'push': there is no program 'gnuplot'"));
  EXPECT_THAT(fs::directory_iterator(scratch.path() / "results").operator*().path().filename(),
              scratch.path().filename());
}

TEST_F(Process, IsInterruptedCleanlyWhileGnuplotHangs) {
  // The fake gnuplot itself sends the signal to its parent, so that nothing depends on time.
  const fs::path fake = scratch.path() / "bin" / "gnuplot";
  put_text(fake, "#!/bin/sh\nkill -INT $PPID\nexec sleep 600\n");
  fs::permissions(fake, fs::perms::owner_all);
  EXPECT_EQ(in_shell(in_scratch("PATH=$PWD/bin:$PATH \"$SPRINGFOLD\" run case.toml --out out "
                                "> /dev/null 2> err.txt")),
            130);
  EXPECT_THAT(text("err.txt"), HasSubstr("stopped on request"));
  EXPECT_THAT(text("err.txt"), HasSubstr("interrupted by SIGINT after all runs were done"));
  EXPECT_THAT(text("err.txt"), HasSubstr("not drawn: plots/push.png, plots/push.svg"));
  EXPECT_THAT(text("out/manifest.json"), HasSubstr("\"pending\": [\n    \"plots/push.png\""));
  EXPECT_TRUE(fs::exists(scratch.path() / "out" / "summary.json"));
}

}  // namespace
}  // namespace springfold::cli
