// Files that cannot be read, TOML that is none, includes; and anything at all as input.
#include "case_files.hpp"

#include <gmock/gmock.h>

#include <random>

#include "io/problems.hpp"
#include "io/toml_reader.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class CaseSources : public CaseFiles {};

TEST_F(CaseSources, ThatAreMissingOrFoldersAreNamed) {
  EXPECT_THAT(messages_of(folder_ / "nothing.toml"),
              ElementsAre("nothing.toml: cannot be read: No such file or directory"));
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THAT(messages_of(folder_ / "empty"),
              ElementsAre("empty: cannot be read: it is a directory"));
  write("cases/case.toml", "");
  EXPECT_THAT(messages_of(folder_ / "cases"),
              ElementsAre("cases: cannot be read: it is a directory; its case is cases/case.toml"));
  EXPECT_THAT(
      messages("include = \"nothing.toml\"\n" + orthoglide_text()),
      ElementsAre("case.toml:1:11: include: \"nothing.toml\" cannot be read: No such file or "
                  "directory"));
  EXPECT_THAT(messages("expected = \"nothing.toml\"\n" + orthoglide_text()),
              ElementsAre("case.toml:1:12: expected: \"nothing.toml\" cannot be read: No such file "
                          "or directory"));
}

TEST_F(CaseSources, ThatAreTooLargeAreRefused) {
  EXPECT_THAT(messages(std::string((std::size_t{4} << 20) + 1, '\n')),
              ElementsAre("case.toml: cannot be read: it is larger than 4 MiB"));
}

TEST_F(CaseSources, ThatIncludeEachOtherInACircleAreRefused) {
  write("a.toml", "include = \"b.toml\"\n");
  write("b.toml", "title = \"b\"\ninclude = [\"./a.toml\"]\n");
  EXPECT_THAT(messages_of(folder_ / "a.toml"),
              ElementsAre("b.toml:2:12: include[1]: \"a.toml\" is being read already: the includes "
                          "form a circle"));
}

TEST_F(CaseSources, ThatIncludeTooDeepAreRefused) {
  for (int i = 0; i < 12; ++i)
    write(std::to_string(i) + ".toml", "include = \"" + std::to_string(i + 1) + ".toml\"\n");
  const std::vector<std::string> all = messages_of(folder_ / "0.toml");
  EXPECT_THAT(all, ElementsAre("8.toml:1:11: include: more than 8 includes within each other"));
}

TEST_F(CaseSources, IncludedTwiceCountOnce) {
  std::string text = orthoglide_text();
  write("parts.toml", text.substr(0, text.find("[[study]]")));
  write("again.toml", "include = \"parts.toml\"\n");
  text = "include = [\"parts.toml\", \"again.toml\"]\n" + text.substr(text.find("[[study]]"));
  EXPECT_EQ(load(text).runs[0].mechanism.chains.size(), 2u);
}

TEST_F(CaseSources, ThatAreNotTomlAreReportedWithPositionAndReason) {
  const auto message = [this](const std::string& text) {
    const std::vector<std::string> all = messages(text);
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? "" : all[0];
  };
  EXPECT_THAT(message("title = \"x\nL = 1\n"),
              AllOf(StartsWith("case.toml:1:11: not valid TOML: "), HasSubstr("closing quote")));
  EXPECT_THAT(message("[parameters]\nL = 2*K\n"), StartsWith("case.toml:2:6: not valid TOML: "));
  EXPECT_THAT(message("[parameters]\nL = K\n"),
              EndsWith("text and formulas stand in quotes: \"2*L\""));
  EXPECT_THAT(message("a = { b = 1,\n  c = 2 }\n"),
              EndsWith("what stands in { } stays on one line"));
  EXPECT_THAT(message("[parameters]\n[parameters]\n"),
              StartsWith("case.toml:2:1: not valid TOML: "));
  EXPECT_THAT(message("a = \"\xff\"\n"), StartsWith("case.toml:1:"));
}

TEST_F(CaseSources, ThatAreNestedTooDeepAreRefused) {
  const std::string deep(100, '[');
  EXPECT_THAT(messages("x = 1\na = " + deep),
              ElementsAre(HasSubstr("case.toml:2:1: nested too deep")));
  std::string key = "a";
  for (int i = 0; i < 100000; ++i) key += ".a";
  EXPECT_THAT(messages("\n\n" + key + " = 1\n"),
              ElementsAre(HasSubstr("case.toml:3:1: nested too deep")));
  EXPECT_THAT(messages("[" + key + "]\n"), ElementsAre(HasSubstr("nested too deep")));
}

TEST_F(CaseSources, MayHaveDotsAndBracketsInTextAndComments) {
  const std::string brackets(200, '['), dots(200, '.');
  const std::string text = "# " + brackets + dots + "\ntitle = \"" + brackets + dots +
                           " \\\" #\"\n" +
                           orthoglide_text().substr(orthoglide_text().find("[units]"));
  EXPECT_THAT(messages(text), testing::IsEmpty());
  Problems problems;
  EXPECT_TRUE(read_toml("a = '''\n" + brackets + "''\n'''\nb = \"\"\"" + dots + "\"\" \"\"\"\n",
                        "f", problems));
  EXPECT_TRUE(problems.empty());
}

TEST(NearestName, IsTheOneWithTheFewestSlips) {
  const std::vector<std::string> known{"stiffness", "spring", "name", "K", "Kv"};
  EXPECT_EQ(nearest("stifness", known), "stiffness");
  EXPECT_EQ(nearest("sprnig", known), "spring");
  EXPECT_EQ(nearest("Name", known), "name");
  EXPECT_EQ(nearest("Kw", known), "Kv");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest("completely_different", known), "");
  EXPECT_EQ(nearest("x", known), "");
  EXPECT_EQ(suggestion("colour", {"at", "rotate"}), "; known here: at, rotate");
}

/// Truncations, deletions, copies and wrong bytes of a good case, each one a usable case or a
/// CaseError. Anything else (a crash, another exception) fails the test.
TEST_F(CaseSources, OfAnyContentAreACaseOrACaseError) {
  std::string good = orthoglide_text();
  good = replaced(
      good, "spring = { law = \"linear\", stiffness = \"Kv\" }",
      "spring = { law = \"piecewise_linear\", breakpoints = [0.1], stiffnesses = [0, \"Kv\"] }");
  good = replaced(good, "{ rigid = [\"-L\", 0] }",
                  "{ rigid = { at = [\"-L\", 0], rotate = { axis = \"z\", angle = 0 } } }");
  good += "[[study]]\nname = \"K\"\ncontrol = \"parameter\"\nparameter = \"K\"\nset = { L = 2 }\n";
  ASSERT_THAT(messages(good), testing::IsEmpty());

  std::mt19937 random{20240229};
  const auto pick = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>{0, n - 1}(random);
  };
  const std::string alphabet = "[]{}=\",.#'\n -+*/^()0123456789eLKvpxyz\\\x01\xc3";
  int usable = 0, refused = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    std::string text = good;
    for (std::size_t change = 0, n = 1 + pick(2); change < n; ++change) {
      const std::size_t at = pick(text.size());
      const std::size_t length = 1 + pick(12);
      switch (pick(6)) {
        case 0:
          text.resize(at + 1);
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(pick(text.size()), length));
          break;
        case 3:
          text.insert(at, 1, alphabet[pick(alphabet.size())]);
          break;
        default:
          text[at] = alphabet[pick(alphabet.size())];
      }
      if (text.empty()) text = "\n";
    }
    try {
      load_case(write("case.toml", text));
      ++usable;
    } catch (const CaseError& error) {
      ++refused;
      EXPECT_FALSE(error.messages().empty());
      for (const std::string& message : error.messages())
        EXPECT_THAT(message, testing::Not(HasSubstr("\n"))) << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(usable, 20);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace springfold::io
