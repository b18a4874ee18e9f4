#include "springfold/io/result_folder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "scratch_folder.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string refusal(const fs::path& folder) {
  try {
    const FolderLock lock{folder};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(FolderLock, ExcludesASecondRunAndNamesTheFirst) {
  const ScratchFolder scratch;
  const FolderLock lock{scratch.path()};
  const std::string why = refusal(scratch.path());
  EXPECT_THAT(why, HasSubstr(scratch.path().string() + " is being written by another run"));
  EXPECT_THAT(why, HasSubstr("process " + std::to_string(::getpid()) + " on "));
}

TEST(FolderLock, LeavesNothingBehind) {
  const ScratchFolder scratch;
  { const FolderLock lock{scratch.path()}; }
  EXPECT_EQ(count_files(scratch.path()), 0);
  EXPECT_EQ(refusal(scratch.path()), "");
}

TEST(FolderLock, OfAKilledProgramIsNone) {
  const ScratchFolder scratch;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock{scratch.path()};
    const char byte = 1;
    if (::write(ready[1], &byte, 1) == 1) ::pause();
    ::_exit(1);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(scratch.path() / ".springfold.lock")) << "its file is still there";
  EXPECT_EQ(refusal(scratch.path()), "");
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(FolderLock, SaysWhyThereCanBeNone) {
  const ScratchFolder scratch;
  EXPECT_THAT(refusal(scratch.path() / "nowhere"), HasSubstr("No such file or directory"));
}

TEST(FolderLock, DoesNotFollowALinkToAnotherFile) {
  const ScratchFolder scratch;
  put_text(scratch.path() / "precious", "text");
  fs::create_symlink("precious", scratch.path() / ".springfold.lock");
  EXPECT_THAT(refusal(scratch.path()), HasSubstr("cannot lock"));
  EXPECT_EQ(text_in(scratch.path() / "precious"), "text");
}

TEST(Leftovers, OfKilledRunsAreRemovedAndNothingElse) {
  const ScratchFolder scratch;
  for (const char* file :
       {".summary.json.part123", "branches/.push-1.csv.part9", "plots/.part77/a.png",
        "plots/.a.gp.part5", "graphs/.a.gv.part6", "sweeps/.a.csv.part7", ".springfold-aB3xYz",
        "branches/.springfold-000000"})
    put_text(scratch.path() / file, "half");
  const std::vector<std::string> kept{"summary.json",        ".checkpoint-map-1", "a.part12",
                                      ".springfold-notes",   ".partly",           ".part",
                                      "branches/push-1.csv", "other/.x.part1"};
  for (const std::string& file : kept) put_text(scratch.path() / file, "whole");
  remove_leftovers(scratch.path());
  for (const std::string& file : kept) EXPECT_TRUE(fs::exists(scratch.path() / file)) << file;
  EXPECT_EQ(count_files(scratch.path()), static_cast<int>(kept.size()));
  EXPECT_FALSE(fs::exists(scratch.path() / "plots/.part77"));
}

TEST(Leftovers, OfAFolderThatIsALinkAreNotRemovedElsewhere) {
  const ScratchFolder scratch, elsewhere;
  put_text(elsewhere.path() / "precious", "text");
  fs::create_directories(scratch.path() / "plots");
  fs::create_directory_symlink(elsewhere.path(), scratch.path() / "plots" / ".part1");
  remove_leftovers(scratch.path());
  EXPECT_TRUE(fs::exists(elsewhere.path() / "precious"));
  EXPECT_FALSE(fs::is_symlink(scratch.path() / "plots" / ".part1"));
}

}  // namespace
}  // namespace springfold::io
