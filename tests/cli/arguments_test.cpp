#include "cli/arguments.hpp"

#include <gmock/gmock.h>

namespace springfold::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

ParsedArguments parse(std::vector<const char*> words) {
  words.insert(words.begin(), "springfold");
  return parse_arguments(static_cast<int>(words.size()), words.data());
}

TEST(Arguments, OfRunAreAllRead) {
  const auto parsed = parse({"run", "--study", "a", "case.toml", "--set", "K=1", "--set", "L=2*K=1",
                             "--study", "b", "--out", "there", "--no-plots", "--json"});
  ASSERT_TRUE(parsed.arguments.has_value()) << parsed.error;
  const Arguments& a = *parsed.arguments;
  EXPECT_EQ(a.command, Command::run);
  EXPECT_EQ(a.case_file, "case.toml");
  EXPECT_THAT(a.studies, ElementsAre("a", "b"));
  EXPECT_THAT(a.overrides, ElementsAre(Pair("K", "1"), Pair("L", "2*K=1")));
  EXPECT_EQ(a.folder, "there");
  EXPECT_FALSE(a.draws_plots);
  EXPECT_TRUE(a.prints_json);
}

TEST(Arguments, HaveAShortNameForWhereThingsAreWritten) {
  EXPECT_EQ(parse({"run", "case.toml", "-o", "there"}).arguments.value().folder, "there");
  for (const char* command : {"draw", "animate"})
    EXPECT_EQ(parse({command, "case.toml", "-o", "a.svg"}).arguments.value().picture_file, "a.svg");
  EXPECT_EQ(parse({"import", "mesh.obj", "-o", "a.toml"}).arguments.value().new_case, "a.toml");
}

TEST(Arguments, HaveDefaults) {
  const auto parsed = parse({"run", "case.toml"});
  ASSERT_TRUE(parsed.arguments.has_value()) << parsed.error;
  EXPECT_TRUE(parsed.arguments->draws_plots);
  EXPECT_FALSE(parsed.arguments->prints_json);
  EXPECT_FALSE(parsed.arguments->folder.has_value());
}

TEST(Arguments, OfCheckAreRead) {
  const auto parsed = parse({"check", "case.toml", "--set", "K=1"});
  ASSERT_TRUE(parsed.arguments.has_value()) << parsed.error;
  EXPECT_EQ(parsed.arguments->command, Command::check);
}

TEST(Arguments, ThatAreWrongAreExplained) {
  EXPECT_THAT(parse({}).error, HasSubstr("subcommand"));
  EXPECT_THAT(parse({"run"}).error, HasSubstr("CASE"));
  EXPECT_THAT(parse({"fly", "case.toml"}).error, testing::Not(""));
  EXPECT_THAT(parse({"run", "case.toml", "--plot"}).error, HasSubstr("--plot"));
  EXPECT_THAT(parse({"check", "case.toml", "--json"}).error, HasSubstr("--json"));
  EXPECT_THAT(parse({"run", "case.toml", "--set", "K"}).error, HasSubstr("need name=value"));
  EXPECT_THAT(parse({"run", "case.toml", "--set", "=1"}).error, HasSubstr("need name=value"));
  EXPECT_THAT(parse({"run", "case.toml", "--set", "K="}).error, HasSubstr("need name=value"));
  EXPECT_THAT(parse({"run", "case.toml", "--set", "K=1", "--set", "K=2"}).error,
              HasSubstr("given twice"));
  EXPECT_THAT(parse({"run", "a.toml", "b.toml"}).error, HasSubstr("b.toml"));
}

TEST(Arguments, HelpShowsExamplesAndVersionTheVersion) {
  const auto help = parse({"--help"});
  EXPECT_FALSE(help.arguments.has_value());
  EXPECT_EQ(help.error, "");
  EXPECT_THAT(help.text, HasSubstr("springfold run case.toml --study push --set Kv=0.02"));
  EXPECT_THAT(help.text, HasSubstr("Exit codes"));
  EXPECT_THAT(parse({"run", "--help"}).text, HasSubstr("--no-plots "));
  EXPECT_THAT(parse({"--version"}).text, testing::MatchesRegex("springfold [0-9.]+\n"));
}

TEST(Arguments, OptionsThatACommandDoesNotHaveGetTheNearestOne) {
  EXPECT_EQ(parse({"run", "case.toml", "--output", "there"}).error,
            "\"run\" has no option \"--output\", did you mean \"--out\"?");
  EXPECT_EQ(parse({"run", "case.toml", "--thread=2"}).error,
            "\"run\" has no option \"--thread\", did you mean \"--threads\"?");
  EXPECT_THAT(parse({"plot", "there", "--quickly"}).error,
              HasSubstr("there are: --help, --changed"));
}

}  // namespace
}  // namespace springfold::cli
