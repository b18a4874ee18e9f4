// Texts with gnuplot's markup, for figures that ask for it.
#include <gmock/gmock.h>

#include "case_files.hpp"
#include "io/gnuplot_text.hpp"

namespace springfold::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FigureMarkup : public CaseFiles {
 protected:
  std::vector<std::string> of_plot(const std::string& lines) const {
    return messages(orthoglide_text() + "[[plot]]\nname = \"markup\"\n" + lines +
                    "curves = [{ study = \"Q2\" }]\n");
  }
};

TEST_F(FigureMarkup, MayNameFontsAndSizes) {
  EXPECT_THAT(
      of_plot("markup = true\ntitle = \"{/Symbol q}_1 {/=20 big} {/DejaVu-Sans:Bold *2 x}\"\n"),
      IsEmpty());
}

TEST_F(FigureMarkup, RefusesFontsThatWouldEndTheirNameInAPicture) {
  for (const char* font : {"a'b", "a<b", "a>b", "a&b"})
    EXPECT_THAT(of_plot(std::string{"markup = true\ntitle = \"{/"} + font + " x}\"\n"),
                ElementsAre(testing::EndsWith(
                    std::string{"title: the name of a font, \""} + font +
                    "\", has a quote, '<', '>', '&' or '\\', which markup does not allow")));
  EXPECT_THAT(of_plot("markup = true\ny_label = '{ / a\"onload=\"x y}'\n"), testing::SizeIs(1));
}

TEST_F(FigureMarkup, LeavesTextsOfOtherFiguresAlone) {
  EXPECT_THAT(of_plot("title = \"{/a<b x}\"\n"), IsEmpty());
}

TEST_F(FigureMarkup, IsTrueOrFalse) {
  EXPECT_THAT(of_plot("markup = 1\n"),
              ElementsAre(testing::EndsWith("markup: got 1, need true or false")));
}

TEST(WithoutMarkup, IsAboutWhatIsSeen) {
  EXPECT_EQ(without_markup("K_v^{2}"), "Kv2");
  EXPECT_EQ(without_markup("{/Symbol q}_{1}"), " q1");
  EXPECT_EQ(without_markup("a\\_b"), "a_b");
  EXPECT_EQ(without_markup("plain"), "plain");
  EXPECT_EQ(without_markup("{/=20"), "");
}

TEST(GnuplotString, EndsOnlyWhereItShould) {
  EXPECT_EQ(gnuplot_string("it's\n`a` \\"), R"('it'."\047".'s `a` \')");
  EXPECT_EQ(gnuplot_string("''"), R"(''."\047".''."\047".'')");
  EXPECT_EQ(gnuplot_string(std::string{"\r\t\x1b\0", 4}), "'\\r\\t\\x1b\\x00'");
}

}  // namespace
}  // namespace springfold::io
