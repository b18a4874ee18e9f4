// Rows of a curve: as many as fit, otherwise a word about it and the curve without them.
#include <gmock/gmock.h>

#include <sstream>

#include "cli/exit_code.hpp"
#include "cli/run_main.hpp"
#include "cli/small_case.hpp"
#include "io/scratch_folder.hpp"

namespace springfold::cli {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class RowBudget : public testing::Test {
 protected:
  int run(const std::string& spacing) {
    std::string text = small_case();
    const std::string key = "direction = [1, 0]\n";
    text.insert(text.find(key) + key.size(), "trace = { spacing = " + spacing + " }\n");
    const auto file = scratch.path() / "case.toml";
    put_text(file, text);
    const std::string path = file.string(), out = (scratch.path() / "out").string();
    const char* words[] = {"springfold", "run", path.c_str(), "--out", out.c_str(), "--no-plots"};
    std::ostringstream table, messages;
    const int code = run_main(6, words, table, messages);
    said = messages.str();
    return code;
  }

  ScratchFolder scratch{};
  std::string said{};
};

TEST_F(RowBudget, BoundsTheRowsOfAWholeCurveWithPlaceNumberAndWhatToChange) {
  EXPECT_EQ(run("2.5e-8"), partial);
  EXPECT_THAT(said, ContainsRegex("case.toml:[0-9]+:[0-9]+: study.1..trace.spacing: got 2.5e-08"));
  EXPECT_THAT(said, HasSubstr("need at most 2 GB: a spacing of "));
  const std::string rows = text_in(scratch.path() / "out/branches/push-1.csv");
  EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 5) << "the curve itself is there";
}

TEST_F(RowBudget, LetsOrdinaryNumbersPass) { EXPECT_EQ(run("1e-3"), all_done) << said; }

}  // namespace
}  // namespace springfold::cli
