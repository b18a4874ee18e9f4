// Sensitivities of critical loads against differences of traced ones, for every parameter of ten cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;

/// A case of the library and a study to be put at its end, without name and kind.
struct Example {
  std::string file{};
  std::string study{};
  std::map<std::string, std::string> set{};  ///< parameters, as with --set
};

class Sensitivities : public testing::TestWithParam<Example> {};

std::string text_of(const fs::path& file) {
  std::ifstream stream{file, std::ios::binary};
  std::ostringstream text;
  // Paths of expected values and of what is included are relative to the file.
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("expected =")) text << line << "\n";
  return text.str();
}

/// Loads of all special points of the study `name` by label.
std::map<std::string, double> loads_of(const fs::path& file, const std::string& name,
                                       const std::map<std::string, std::string>& set) {
  const Case read = load_case(file, set);
  for (const PlannedRun& planned : read.runs) {
    if (planned.study != name) continue;
    const StudyResult result = analysis::run_study(planned.mechanism, planned.plan);
    std::map<std::string, double> loads;
    for (const auto& branch : result.branches)
      for (const auto& event : branch.events)
        if (event.kind != analysis::EventKind::end_of_range)
          loads[event.label] = branch.samples[event.row].values[1];
    return loads;
  }
  ADD_FAILURE() << "no study " << name;
  return {};
}

std::string digits(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// d(load)/d(parameter) at every special point that is there at all four values, error O(h^4).
std::map<std::string, double> differences(const fs::path& file, const Example& example,
                                          const std::string& parameter, double value) {
  const double h = 3e-4 * (value == 0 ? 0.1 : std::abs(value));
  std::map<std::string, double> sums;
  std::map<std::string, int> seen;
  for (const auto& [step, weight] : {std::pair{1, 8.0}, {-1, -8.0}, {2, -1.0}, {-2, 1.0}}) {
    auto set = example.set;
    set[parameter] = digits(value + step * h);
    for (const auto& [label, load] : loads_of(file, "traced", set)) {
      sums[label] += weight * load / (12 * h);
      ++seen[label];
    }
  }
  std::erase_if(sums, [&](const auto& sum) { return seen[sum.first] != 4; });
  return sums;
}

TEST_P(Sensitivities, AreDifferencesOfTracedCriticalLoadsForEveryParameter) {
  const Example& example = GetParam();
  std::string name = example.file;
  std::replace(name.begin(), name.end(), '/', '-');
  const fs::path file = fs::path{testing::TempDir()} / ("springfold-sensitivity-" + name);
  std::ofstream{file, std::ios::binary}
      << "expected = \"\"\n"
      << text_of(fs::path{SPRINGFOLD_SOURCE_DIR} / "cases" / example.file)
      << "\n[[study]]\nname = \"rates\"\nkind = \"sensitivity\"\n"
      << example.study << "\n[[study]]\nname = \"traced\"\n"
      << example.study;
  const Case read = load_case(file, example.set);
  const auto planned = std::find_if(read.runs.begin(), read.runs.end(),
                                    [](const PlannedRun& run) { return run.study == "rates"; });
  ASSERT_NE(planned, read.runs.end());
  const StudyResult result = analysis::run_study(planned->mechanism, planned->plan);
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& family = *planned->plan.critical.cases;
  int compared = 0;
  for (std::size_t k = 0; k < family.names.size(); ++k) {
    const auto traced = differences(file, example, family.names[k], family.values[k]);
    const auto column =
        std::find_if(result.quantities.begin(), result.quantities.end(), [&](const auto& quantity) {
          return quantity.name == "d(lambda)/d(" + family.names[k] + ")";
        });
    ASSERT_NE(column, result.quantities.end());
    for (const auto& event : result.branches[0].events) {
      const auto found = traced.find(event.label);
      const double rate = result.branches[0]
                              .samples[event.row]
                              .values[static_cast<std::size_t>(column - result.quantities.begin())];
      if (std::isnan(rate) || found == traced.end()) continue;
      EXPECT_NEAR(rate, found->second, 1e-6 * std::max(1.0, std::abs(rate)))
          << event.label << " by " << family.names[k];
      ++compared;
    }
  }
  EXPECT_GE(compared, static_cast<int>(family.names.size())) << "a special point per parameter";
  fs::remove(file);
}

INSTANTIATE_TEST_SUITE_P(OfTenCases, Sensitivities,
                         testing::Values(Example{"von-mises-truss/case.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
until = { apex.y = ["-1.2*h", "1.2*h"] }
)toml",
                                                 {{"a", "0.7"}}},
                                         Example{"toggle/case.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
until = { crank.foot = ["-1.1*alpha", "1.1*alpha"] }
)toml",
                                                 {{"gap", "5*L"}}},
                                         Example{"guyed-bar/case-imperfection.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
until = { lambda = ["-0.2*k*L", "1.2*k*L"], bar.hinge = [-1.2, 1.2] }
)toml",
                                                 {{"t0", "0.03"}}},
                                         Example{"bar-roller-spring/case-imperfection.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
load = ["H", 0]
until = { lambda = ["-0.2*k*L", "2*k*L"], bar.hinge = [-1.4, 1.4] }
)toml",
                                                 {{"t0", "0.05"}, {"beta", "0.5"}}},
                                         Example{"quasi-zero-stiffness/case.toml",
                                                 R"toml(control = "load"
direction = [1, 0]
start = { pose = ["1.2*a", 0] }
until = { deflection = ["-2.5*a", "0.5*a"] }
)toml",
                                                 {{"kv", "0.5*k"}}},
                                         Example{"n-bar-dome/case.toml",
                                                 R"toml(control = "load"
direction = [0, 0, -1]
until = { apex.z = ["0.1*a", "1.05*a*tan(alpha)"], lambda = ["-0.5*k*a", "4*k*a"] }
)toml",
                                                 {{"alpha", "45*deg"}}},
                                         Example{"link-column/case.toml", R"toml(control = "load"
direction = [-1, 0]
until = { lambda = ["-0.2*k/L", "4*k/L"], column.hinge1 = ["-60*deg", "60*deg"] }
)toml"},
                                         Example{"critical-curves/case-softening.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
load = [0, "-1.1*c/L"]
start = { pose = ["L*sin(0.76)", "L*cos(0.76)"] }
until = { lambda = ["-0.09*c/L", "1.5*c/L"], strut.hinge = [0.1, 3] }
)toml"},
                                         Example{"critical-curves/case-pusher.toml",
                                                 R"toml(control = "actuator"
actuators = { pusher.drive = -1 }
until = { lambda = ["-0.1*a", "3*a"] }
)toml",
                                                 {{"c", "0.5*k"}}},
                                         Example{"critical-curves/case-stop.toml",
                                                 R"toml(control = "load"
direction = [0, -1]
until = { crank.foot = ["-0.2*alpha", "1.1*alpha"] }
)toml",
                                                 {{"gap", "0.35"}}}));

}  // namespace
}  // namespace springfold::io
