// The whole cases that docs/case-file.md shows are read and traced as they stand there.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "case_files.hpp"
#include "io/result_access.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::io {
namespace {

class CaseExamples : public CaseFiles {
 protected:
  /// The block of the document that begins with this title.
  static std::string block(const std::string& title) {
    std::ostringstream document;
    document << std::ifstream{std::string{SPRINGFOLD_SOURCE_DIR} + "/docs/case-file.md"}.rdbuf();
    const std::string text = document.str();
    const std::string begin = "```toml\ntitle = \"" + title + "\"";
    const std::size_t at = text.find(begin);
    EXPECT_NE(at, std::string::npos) << title;
    if (at == std::string::npos) return {};
    return text.substr(at + 8, text.find("```", at + 8) - at - 8);
  }

  Case show(const std::string& title) const { return load(block(title)); }

  static analysis::StudyResult run(const PlannedRun& planned) {
    analysis::StudyResult result = analysis::run_study(planned.mechanism, planned.plan,
                                                       planned.family ? &*planned.family : nullptr);
    EXPECT_TRUE(analysis::complete(result)) << planned.study;
    return result;
  }

  /// Value of a quantity at the named event.
  static double at(const analysis::StudyResult& result, const std::string& event,
                   const std::string& quantity) {
    for (const analysis::Branch& branch : result.branches)
      for (const analysis::Event& e : branch.events)
        if (e.label == event) return value_at(result, branch, e.row, quantity);
    ADD_FAILURE() << "no " << event;
    return std::nan("");
  }
};

TEST_F(CaseExamples, TheStrutBendsAsTheClosedFormSays) {
  const Case c = show("Crooked strut");
  const analysis::StudyResult result = run(c.runs[0]);
  const double crooked = std::numbers::pi / 180;
  for (const auto& [event, degrees] : {std::pair{"UZ1", 45.0}, {"UZ2", 90.0}}) {
    // kt (a - crooked) = F l sin a, where the force shortens the strut: l = L - F cos a / ka.
    const double a = degrees * crooked, F = at(result, event, "lambda");
    EXPECT_NEAR(a - crooked, F * (1 - F * std::cos(a) / 1000) * std::sin(a), 1e-9);
  }
}

TEST_F(CaseExamples, TheTrussSnapsAtTheClosedFormHeight) {
  const Case c = show("Two-bar truss");
  ASSERT_EQ(c.runs.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) {
    const analysis::StudyResult result = run(c.runs[i]);
    const double a = 100, bar = c.runs[i].parameters.at("bar");
    const double y = std::sqrt(std::pow(a * a * bar, 2.0 / 3) - a * a);
    EXPECT_NEAR(at(result, "LP1", "apex.y"), y, 1e-6);
    EXPECT_NEAR(at(result, "LP1", "force"), 2 * 50 * y * (bar / std::hypot(a, y) - 1), 1e-8);
  }
  // The force at the limit point is proportional to the stiffness of the bars.
  const analysis::StudyResult loaded = run(c.runs[1]), softened = run(c.runs[3]);
  EXPECT_NEAR(at(softened, "LP1", "lambda") / 50, 10 / at(loaded, "LP1", "force"), 1e-9);
}

TEST_F(CaseExamples, ThePlatformPassesTheBacklashOfItsDrive) {
  const Case c = show("Planar 3-RPR platform");
  ASSERT_EQ(c.runs.size(), 2u);
  for (const PlannedRun& planned : c.runs) {
    const analysis::StudyResult result = run(planned);
    EXPECT_NEAR(std::abs(at(result, "SA1", "b.drive.theta")), 0.001, 1e-12);
  }
}

}  // namespace
}  // namespace springfold::io
