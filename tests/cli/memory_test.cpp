// Running out of memory, two runs in one folder, and what killed runs leave.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/child.hpp"
#include "cli/exit_code.hpp"
#include "cli/run_command.hpp"
#include "cli/run_main.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"
#include "springfold/io/result_folder.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class Folder : public testing::Test {
 protected:
  Folder() { put_text(scratch.path() / "case.toml", small_case()); }
  fs::path folder() const { return scratch.path() / "out"; }
  json manifest() const { return json::parse(text_in(folder() / "manifest.json")); }

  int run(const RunStudy& engine, std::string& messages) const {
    std::ostringstream out, err;
    const Session session{.out = out, .err = err, .signal = [] { return 0; }, .run_study = engine};
    const int code = run_command(
        {.case_file = scratch.path() / "case.toml", .folder = folder(), .draws_plots = false},
        session);
    messages = err.str();
    return code;
  }

  static analysis::StudyResult point() {
    analysis::StudyResult result;
    result.start.found = true;
    result.quantities = {{"s"}, {"index"}};
    analysis::Branch branch;
    branch.samples = {{.values = {0, 0}}};
    result.branches = {branch};
    return result;
  }

  ScratchFolder scratch;
};

TEST_F(Folder, OutOfMemoryInOneRunKeepsThoseBefore) {
  for (const bool is_too_long : {false, true}) {
    int runs = 0;
    std::string messages;
    const auto engine = [&](const auto&, const auto&) {
      if (++runs == 1) return point();
      if (is_too_long) throw std::length_error{"vector::reserve"};
      throw std::bad_alloc{};
    };
    EXPECT_EQ(run(engine, messages), out_of_memory);
    EXPECT_THAT(messages, HasSubstr("out of memory in rest, run 1: 1 of 2 runs were done"));
    EXPECT_EQ(manifest()["state"], "interrupted");
    EXPECT_TRUE(fs::exists(folder() / "branches" / "push-1.csv"));
  }
}

TEST_F(Folder, IsRefusedToASecondRunWhileTheFirstWrites) {
  std::string messages;
  fs::create_directories(folder());
  const io::FolderLock first{folder()};
  bool was_run = false;
  const auto engine = [&](const auto&, const auto&) {
    was_run = true;
    return point();
  };
  EXPECT_EQ(run(engine, messages), input_output);
  EXPECT_FALSE(was_run);
  EXPECT_THAT(messages, HasSubstr("is being written by another run: springfold, process " +
                                  std::to_string(::getpid())));
}

TEST_F(Folder, OfAKilledRunIsCleanedByTheNext) {
  const fs::path fake = scratch.path() / "bin" / "gnuplot";
  put_text(fake, "#!/bin/sh\ntouch \"$PWD/../../../ready\"\nexec sleep 600\n");
  fs::permissions(fake, fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
  pid_t gnuplots_parent = 0;
  {
    Child child{scratch.path(), {"run", "case.toml", "--out", "out"}};
    gnuplots_parent = child.process();
    for (int i = 0; i < 2000 && !fs::exists(scratch.path() / "ready"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    child.send(SIGKILL);
    EXPECT_EQ(child.wait(10), 128 + SIGKILL);
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(manifest()["state"], "being written") << "figures were still to come";
  EXPECT_TRUE(fs::exists(folder() / "plots" / (".part" + std::to_string(gnuplots_parent))));
  EXPECT_TRUE(fs::exists(folder() / ".springfold.lock"));
  std::string messages;
  EXPECT_EQ(run([](const auto&, const auto&) { return point(); }, messages), all_done) << messages;
  EXPECT_EQ(manifest()["state"], "whole");
  for (const auto& entry : fs::recursive_directory_iterator{folder()})
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

TEST_F(Folder, WithADeepManifestIsWrittenAllTheSame) {
  const std::string deep(200000, '[');
  for (const std::string& text :
       {deep, "{\"program\":\"springfold\",\"files\":[" + deep + std::string(200000, ']') + "]}",
        std::string{"{\"program\":\"springfold\",\"files\":[{}, 1, {\"path\":[]}]}"},
        std::string{"\xff\xfe{"}, std::string{}}) {
    put_text(folder() / "manifest.json", text);
    std::string messages;
    EXPECT_EQ(run([](const auto&, const auto&) { return point(); }, messages), all_done)
        << messages;
    EXPECT_EQ(manifest()["state"], "whole");
  }
}

}  // namespace
}  // namespace springfold::cli
