#include "io/text.hpp"

#include <gmock/gmock.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <random>

namespace springfold::io {
namespace {

using testing::ElementsAre;

double read_back(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(Shortest, ReadsBackToTheSameNumber) {
  std::mt19937_64 generator{7};
  std::uniform_real_distribution<double> mantissa{-1, 1};
  std::uniform_int_distribution<int> exponent{-300, 300};
  for (int i = 0; i < 2000; ++i) {
    const double value = std::ldexp(mantissa(generator), exponent(generator));
    EXPECT_EQ(read_back(shortest(value)), value) << shortest(value);
  }
}

TEST(Shortest, HasNoMoreDigitsThanNeeded) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-1), "-1");
  EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(shortest(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Rounded, KeepsSignificantDigits) {
  EXPECT_EQ(rounded(1.0 / 3, 4), "0.3333");
  EXPECT_EQ(rounded(1234567.0, 10), "1234567");
  EXPECT_EQ(rounded(-0.0, 4), "0");
  EXPECT_EQ(rounded(0.0005, 12), "0.0005");
}

TEST(CsvText, IsQuotedOnlyWhereItHasTo) {
  EXPECT_EQ(csv_text("plain text"), "plain text");
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_text("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_text("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_text(""), "");
}

TEST(CsvNumber, IsEmptyForNan) {
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(0.5), "0.5");
}

TEST(SafeFileName, KeepsLettersAndDigitsAndReplacesTheRest) {
  EXPECT_EQ(safe_file_name("push along x"), "push_along_x");
  EXPECT_EQ(safe_file_name("../../etc/passwd"), "etc_passwd");
  EXPECT_EQ(safe_file_name(".hidden"), "hidden");
  EXPECT_EQ(safe_file_name("K = 0.01 (Δ)"), "K_0.01");
  EXPECT_EQ(safe_file_name("???"), "unnamed");
  EXPECT_EQ(safe_file_name(std::string(300, 'a')).size(), 80u);
}

TEST(UniqueNames, DifferEvenWithoutCase) {
  UniqueNames names;
  EXPECT_EQ(names.make("push-1"), "push-1");
  EXPECT_EQ(names.make("push-1"), "push-1_2");
  EXPECT_EQ(names.make("Push-1"), "Push-1_3");
  EXPECT_EQ(names.make("push-1_2"), "push-1_2_2");
}

TEST(Wrapped, BreaksBetweenWordsAndCountsCharactersNotBytes) {
  EXPECT_THAT(wrapped("one two  three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("ααα βββ", 7), ElementsAre("ααα βββ"));
  EXPECT_THAT(wrapped("unbreakable", 3), ElementsAre("unbreakable"));
  EXPECT_THAT(wrapped("  ", 3), ElementsAre());
}

TEST(Aligned, PadsCellsAndLeavesNoBlanksAtLineEnds) {
  EXPECT_EQ(aligned({{"a", "1"}, {"long", "22", "x"}}, {Align::left, Align::right}, 2),
            "  a      1\n"
            "  long  22  x\n");
  EXPECT_EQ(aligned({{"a", ""}}, {}, 0), "a\n");
}

}  // namespace
}  // namespace springfold::io
