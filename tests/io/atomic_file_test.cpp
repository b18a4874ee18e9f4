#include "io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>
#include <functional>

#include "io/scratch_folder.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(WriteFile, ReplacesWhatWasThereAndLeavesNothingElse) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "a.txt";
  write_file(file, "old");
  write_file(file, "new\n");
  EXPECT_EQ(text_in(file), "new\n");
  EXPECT_EQ(count_files(scratch.path()), 1);
}

TEST(WriteFile, NamesPathAndReasonWhenTheFolderIsMissing) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "missing" / "a.txt";
  EXPECT_EQ(message_of([&] { write_file(file, "text"); }),
            "cannot write " + file.string() + ": No such file or directory");
}

TEST(WriteFile, NamesPathAndReasonWhenAFolderStandsInTheWay) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "a.txt";
  fs::create_directories(file / "inside");
  EXPECT_THAT(message_of([&] { write_file(file, "text"); }), HasSubstr(file.string() + ": "));
  EXPECT_EQ(count_files(scratch.path()), 0);
}

/// Runs the action in a child process in which no file may get longer than `bytes`, as on a full
/// disk. Returns the child's exit code.
int with_file_size_limit(rlim_t bytes, const std::function<int()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);  // the write fails instead
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::_exit(action());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(WriteFile, KeepsTheOldFileWhenTheDiskIsFull) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "a.txt";
  write_file(file, "old");
  const int code = with_file_size_limit(1000, [&] {
    const std::string message = message_of([&] { write_file(file, std::string(100000, 'x')); });
    return message == "cannot write " + file.string() + ": File too large" ? 7 : 8;
  });
  EXPECT_EQ(code, 7);
  EXPECT_EQ(text_in(file), "old");
  EXPECT_EQ(count_files(scratch.path()), 1);
}

TEST(PutOnDisk, NamesPathAndReasonWhenTheFileIsMissing) {
  const ScratchFolder scratch;
  const fs::path file = scratch.path() / "a.txt";
  EXPECT_EQ(message_of([&] { put_on_disk(file); }),
            "cannot write " + file.string() + ": No such file or directory");
  write_file(file, "text");
  EXPECT_EQ(message_of([&] { put_on_disk(file); }), "nothing was thrown");
}

TEST(MakeFolder, MakesParentsAndAcceptsWhatIsThere) {
  const ScratchFolder scratch;
  make_folder(scratch.path() / "a" / "b");
  make_folder(scratch.path() / "a" / "b");
  EXPECT_TRUE(fs::is_directory(scratch.path() / "a" / "b"));
}

TEST(MakeFolder, NamesPathAndReasonWhenAFileStandsInTheWay) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "a", "a file");
  EXPECT_THAT(message_of([&] { make_folder(scratch.path() / "a"); }),
              HasSubstr((scratch.path() / "a").string() + ": "));
  EXPECT_THAT(message_of([&] { make_folder(scratch.path() / "a" / "b"); }),
              HasSubstr((scratch.path() / "a" / "b").string() + ": Not a directory"));
}

TEST(ReadFile, GivesAllBytesOrTheReason) {
  const ScratchFolder scratch;
  const std::string bytes(200000, '\0');
  write_file(scratch.path() / "a", bytes);
  EXPECT_EQ(read_file(scratch.path() / "a"), bytes);
  EXPECT_THAT(message_of([&] { read_file(scratch.path() / "b"); }),
              HasSubstr("/b: No such file or directory"));
}

}  // namespace
}  // namespace springfold::io
