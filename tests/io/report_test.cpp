// The HTML page: what is in it, and that texts of a case stay texts.
#include "springfold/io/report.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "io/case_files.hpp"
#include "io/report_data.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/postures.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;
using testing::Not;

class Report : public CaseFiles {
 protected:
  std::string page_of(const std::string& text) {
    read = load(text);
    for (const PlannedRun& run : read.runs) {
      results.push_back(analysis::run_study(run.mechanism, run.plan));
      results.back().study = run.study;
      results.back().run = run.run;
    }
    return report_html(read, results);
  }
  Case read{};
  std::vector<analysis::StudyResult> results{};
};

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64_of({}), "");
  EXPECT_EQ(base64_of({1.0}), "AAAAAAAA8D8=");  // bytes 00 00 00 00 00 00 f0 3f
  EXPECT_EQ(base64_of({0.0, 0.0, 0.0}), std::string(32, 'A'));
}

TEST_F(Report, NeedsNothingFromElsewhere) {
  if (!has_report()) GTEST_SKIP() << "built without the page";
  const std::string page = page_of(orthoglide_text());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* link : {"src=\"http", "href=\"http", "@import", "@DATA@", "@SCRIPT@", "@D3@"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
  EXPECT_THAT(page, HasSubstr("Michael Bostock"));  // D3's licence goes with it
}

TEST_F(Report, TextsOfTheCaseAreText) {
  if (!has_report()) GTEST_SKIP() << "built without the page";
  const std::string evil =
      R"(</title></script><script>window.injected = 1</script> \"; system(ls))";
  std::string text = replaced(orthoglide_text(), "title = \"test\"", "title = \"" + evil + "\"");
  text = replaced(text, "name = \"Q2\"\nkind", "name = \"Q2 </script><b>\"\nkind");
  text = replaced(text, "study = \"Q2\"", "study = \"Q2 </script><b>\"");
  const std::string page = page_of(text);
  EXPECT_THAT(page, Not(HasSubstr("<script>window")));
  EXPECT_THAT(page, Not(HasSubstr("</script><b>")));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/title&gt;&lt;/script&gt;&lt;script&gt;window.injected"));
  EXPECT_THAT(page, HasSubstr("Q2 \\u003c/script>\\u003cb>"));
}

TEST_F(Report, EveryRowHasItsPostureInTheSameParts) {
  page_of(orthoglide_text());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const RowScenes scenes{read.runs[i], results[i]};
    const auto first = scenes.scene_of(results[i].branches.at(0).samples.at(0));
    ASSERT_TRUE(first);
    for (const analysis::Sample& row : results[i].branches[0].samples) {
      const auto scene = scenes.scene_of(row);
      ASSERT_TRUE(scene);
      EXPECT_EQ(scene->points.size(), first->points.size());
      EXPECT_EQ(scene->loads.size(), first->loads.size());
      EXPECT_EQ(scene->springs.size(), first->springs.size());
    }
  }
}

}  // namespace
}  // namespace springfold::io
