// The case files of cases/orthoglide-planar in other units, and what they say. That they hold as they are is
// shown by scripts/verify-cases.sh.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "io/result_access.hpp"
#include "planar_orthoglide.hpp"
#include "springfold/io/case_file.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

const std::filesystem::path folder =
    std::filesystem::path{SPRINGFOLD_SOURCE_DIR} / "cases/orthoglide-planar";

std::vector<analysis::StudyResult> run_all(const Case& c) {
  std::vector<analysis::StudyResult> results;
  for (const PlannedRun& run : c.runs) {
    results.push_back(analysis::run_study(run.mechanism, run.plan));
    results.back().study = run.study;
    results.back().run = run.run;
    results.back().label = run.label;
  }
  return results;
}

void expect_all_of(const std::string& file, const std::map<std::string, std::string>& overrides) {
  const Case c = load_case(folder / file, overrides);
  const std::vector<analysis::StudyResult> results = run_all(c);
  EXPECT_TRUE(all_complete(c, results));
  const std::vector<Comparison> comparisons = compare(c.expected, results);
  EXPECT_GT(comparisons.size(), 4u);
  for (const Comparison& comparison : comparisons)
    EXPECT_TRUE(comparison.holds) << comparison.expected.group << ": " << comparison.expected.name
                                  << ": " << comparison.ours << ", expected "
                                  << comparison.expected.expected;
}

double at(const std::vector<analysis::StudyResult>& results, const std::string& study, int run,
          const std::string& event, const std::string& quantity) {
  const analysis::StudyResult* result = result_of(results, study, run);
  if (!result || result->branches.empty()) return std::nan("");
  const analysis::Branch& branch = result->branches[0];
  if (event == "start") return value_at(*result, branch, branch.start_row, quantity);
  for (const analysis::Event& e : branch.events)
    if (e.label == event) return value_at(*result, branch, e.row, quantity);
  return std::nan("");
}

TEST(OrthoglideCase, ItsCommandsMapsAndWorkspaceAgreeWithTable1AndTheClosedForm) {
  expect_all_of("case-commands.toml", {});
}

TEST(OrthoglideCase, ItsMapsOfFigure5AgreeWithTheClosedForm) {
  expect_all_of("case-figure-5.toml", {});
}

TEST(OrthoglideCase, AgreesInOtherUnitsAndOtherSizes) {
  expect_all_of("case.toml", {{"L", "1000"}, {"K", "0.001"}});
  expect_all_of("case-one-sided.toml", {{"L", "0.3"}, {"K", "7e4"}});
}

TEST(OrthoglideCase, WithTheRoundedPGivesTheNumbersOfTheNote) {
  const auto results = run_all(load_case(folder / "case.toml", {{"p", "0.45*L"}}));
  EXPECT_NEAR(at(results, "Q1", 1, "start", "leg_x.drive.rho"), 0.443, 0.0005);
  EXPECT_NEAR(at(results, "Q2", 1, "start", "leg_x.drive.rho"), 1.343, 0.0005);
  EXPECT_NEAR(at(results, "Q2", 1, "LP1", "force"), 0.0211, 0.00005);
}

TEST(OrthoglideCase, DescribesTheMechanismThatIsBuiltByHand) {
  const Case c = load_case(folder / "case.toml");
  const model::Mechanism hand = planar_orthoglide(linear_knee(0.01));
  const model::Mechanism& file = c.runs[1].mechanism;  // Q0, Kv = 0.01
  EXPECT_EQ(c.runs[1].label, "Kv = 0.01");
  ASSERT_EQ(file.chains.size(), hand.chains.size());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(file.chains[i].name, hand.chains[i].name);
    for (std::size_t j = 0; j < 2; ++j) {
      const auto& a = std::get<model::Joint>(file.chains[i].elements[j]);
      const auto& b = std::get<model::Joint>(hand.chains[i].elements[j]);
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.axis, b.axis);
      EXPECT_EQ(a.command, b.command);
      EXPECT_EQ(std::get<model::LinearSpring>(*a.spring).stiffness,
                std::get<model::LinearSpring>(*b.spring).stiffness);
    }
    EXPECT_EQ(std::get<model::RigidLink>(file.chains[i].elements[2]).transform.p,
              std::get<model::RigidLink>(hand.chains[i].elements[2]).transform.p);
  }
}

}  // namespace
}  // namespace springfold::io
