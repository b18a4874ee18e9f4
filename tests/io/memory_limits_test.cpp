// Products of counts are bounded before anything is built.
#include <gmock/gmock.h>

#include "io/case_files.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

class MemoryLimits : public CaseFiles {
 protected:
  static std::string values(int count) {
    std::string list = "1";
    for (int i = 1; i < count; ++i) list += ", 1";
    return "[" + list + "]";
  }

  /// The test's Orthoglide with a beam of so many segments in its first leg, and so many runs.
  static std::string with_beam(const std::string& segments, int runs) {
    const std::string beam =
        "{ elastic = \"beam\", name = \"beam\", length = \"L\", E = 1, A = 1, Iz = 1, segments = " +
        segments + " }";
    return replaced(replaced(orthoglide_text(), "{ rigid = [\"-L\", 0] }", beam),
                    "values = [0, \"0.1*K*L^2\"]", "values = " + values(runs));
  }
};

TEST_F(MemoryLimits, RefuseRunsTimesSegmentsAtTheValues) {
  const auto found =
      messages(replaced(with_beam("5000", 500), ", labels = [\"one\", \"two\"]", ""));
  EXPECT_THAT(found,
              testing::Contains(HasSubstr("study[1].vary.values: got 500 runs of a mechanism")));
  EXPECT_THAT(found,
              testing::Contains(HasSubstr("need at most 2 GB: fewer values, or fewer segments")));
}

TEST_F(MemoryLimits, RefuseMoreSegmentsThanCanBeWorkedOn) {
  const auto beams = [](int count) {
    std::string text = "[[body]]\nname = \"t\"\ntask_space = \"planar\"\npose = [1, 0, 0]\n";
    for (int i = 0; i < count; ++i)
      text += "[[chain]]\nname = \"c" + std::to_string(i) +
              "\"\nelements = [{ elastic = \"beam\", length = 1, E = 1, A = 1, Iz = 1, "
              "segments = 5000 }]\n";
    return text +
           "[[study]]\nname = \"push\"\ncontrol = \"load\"\ndirection = [0, -1, 0]\n"
           "until = { lambda = [0, 1] }\n";
  };
  // Each takes about 270 MB where it is traced.
  EXPECT_THAT(messages(beams(5)), IsEmpty());
  EXPECT_THAT(messages(beams(30)),
              testing::Contains(testing::AllOf(
                  HasSubstr("segments: the mechanism has"),
                  HasSubstr("of memory with all studies, need at most 2 GB: fewer segments"))));
}

TEST_F(MemoryLimits, LetOrdinaryCasesPass) {
  EXPECT_THAT(messages(orthoglide_text()), IsEmpty());
  EXPECT_THAT(messages(replaced(with_beam("50", 20), ", labels = [\"one\", \"two\"]", "")),
              testing::Each(testing::Not(HasSubstr("memory"))));
}

TEST_F(MemoryLimits, RangeCheckEveryCountBeforeItIsUsed) {
  for (const char* count : {"4294967296", "2147483648"}) {
    const std::string text = replaced(
        orthoglide_text(), "mark =", "branches = { depth = " + std::string{count} + " }\nmark =");
    const auto found = messages(text);
    EXPECT_THAT(found, testing::Contains(HasSubstr("need a whole number from 0 to 1000000")))
        << count;
  }
}

TEST_F(MemoryLimits, RefuseMoreRunsThanAnybodyWants) {
  const auto found = messages(
      replaced(orthoglide_text(), "values = [0, \"0.1*K*L^2\"]", "values = " + values(10001)));
  EXPECT_THAT(found, testing::Contains(HasSubstr(
                         "study[1].vary.values: got a list of 10001, need at most 10000 values")));
}

TEST_F(MemoryLimits, RefuseMoreTablesThanAnybodyWants) {
  std::string bodies;
  for (int i = 0; i < 10001; ++i)
    bodies +=
        "[[body]]\nname = \"b" + std::to_string(i) + "\"\ntask_space = \"xy\"\npose = [0, 0]\n";
  EXPECT_THAT(messages(bodies),
              testing::Contains(HasSubstr("body: got 10001 tables, need at most 10000")));
}

TEST_F(MemoryLimits, PrintTheFirstHundredMistakesAndTheNumberOfOthers) {
  std::string keys;
  for (int i = 0; i < 250; ++i) keys += "key" + std::to_string(i) + " = 1\n";
  const auto found = messages(keys + orthoglide_text());
  ASSERT_THAT(found, SizeIs(101));
  EXPECT_THAT(found.front(), StartsWith("case.toml:1:1: key0: unknown key"));
  EXPECT_EQ(found.back(), "and 150 other mistakes");
}

}  // namespace
}  // namespace springfold::io
