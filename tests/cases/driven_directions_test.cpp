// Critical curves over the direction in which a body is driven, its other ways free.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// Two bars, and a spring that holds the apex aside, in space two more; pressed down, and askew by psi.
std::string pressed_apex(const std::string& control, bool in_space) {
  std::string text = "[parameters]\npsi = 0.1\n";
  const auto bar = [&text](const std::string& name, const std::string& from, double stiffness) {
    text += "[[spring]]\nname = \"" + name + "\"\nfrom_at = " + from +
            "\nto = \"apex\"\nstiffness = " + std::to_string(stiffness) +
            "\nfree = \"sqrt(1.25)\"\n";
  };
  const std::string end = in_space ? ", 0]" : "]";
  text += std::string{"[[body]]\nname = \"apex\"\n"} +
          (in_space ? "task_space = \"xyz\"\npose = [0, 0, 0.5]\n"
                    : "task_space = \"xy\"\npose = [0, 0.5]\n");
  bar("left", "[-1, 0" + end, 1);
  bar("right", "[1, 0" + end, 1.3);
  if (in_space) {
    bar("front", "[0, -1, 0]", 1.1);
    bar("back", "[0, 1, 0]", 0.9);
  }
  return text + "[[spring]]\nname = \"side\"\nfrom_at = [3, 0" + end +
         "\nto = \"apex\"\nstiffness = 0.3\nfree = \"sqrt(9.25)\"\n[[study]]\nname = \"s\"\nkind = "
         "\"critical_curve\"\ncontrol = \"" +
         control + "\"\ndirection = [\"sin(psi)\", " + (in_space ? "0, " : "") +
         "\"-cos(psi)\"]\nuntil = { lambda = [-0.1, 2] }\ncritical_curve = { of = \"LP1\", "
         "parameter = \"psi\", range = [-0.3, 0.3] }\n";
}

/// The force at both ends of the range.
std::pair<double, double> forces(const analysis::StudyResult& result) {
  EXPECT_TRUE(complete(result));
  const analysis::Branch& branch = result.branches.at(0);
  EXPECT_NEAR(branch.samples.front().values.back(), -0.3, 1e-12);
  EXPECT_NEAR(branch.samples.back().values.back(), 0.3, 1e-12);
  return {value(result, 0, "force"), value(result, branch.samples.size() - 1, "force")};
}

TEST(DrivenDirections, GiveTheLimitPointsOfTheForceThatLoadsGiveThroughThePlumbLine) {
  for (const bool in_space : {false, true}) {
    const auto driven = forces(run(pressed_apex("mixed", in_space)).of("s"));
    const auto loaded = forces(run(pressed_apex("load", in_space)).of("s"));
    EXPECT_NEAR(driven.first, loaded.first, 1e-9) << in_space;
    EXPECT_NEAR(driven.second, loaded.second, 1e-9) << in_space;
  }
}

}  // namespace
}  // namespace springfold::io
