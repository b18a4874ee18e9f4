// Rates of special points where a spring switches just beside the start: starts of other values lie on another piece.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// Two bars and a cable from above that is slack at the start by `slack`, and becomes active at the length lc.
std::string truss_with_cable(double slack, const std::string& control, const std::string& study) {
  const double length = std::hypot(0.6, 0.5);
  return "[parameters]\nlc = " + std::to_string(length + slack) + "\n" +
         supports_and_apex("a", "0.5") +
         R"toml([[bar]]
from = "l"
to = "a"
stiffness = 1
[[bar]]
from = "r"
to = "a"
stiffness = 1.5
[[spring]]
name = "cable"
from_at = [-0.6, 1]
to = "a"
law = { law = "one_sided", stiffness = 0.4, from = "lc" }
[[study]]
name = "s"
body = "a"
direction = [0, -1]
control = ")toml" +
         control + "\"\n" + study;
}

/// The cable is slack before it becomes active: the path to there, counted from a start that it does not touch, is the
/// same for all lc.
TEST(RatesOfSpecialPoints, DoNotMixPiecesOfTheStart) {
  for (const double slack : {1e-4, 1e-3, 5e-3, 2e-2}) {
    SCOPED_TRACE(slack);
    const auto result =
        run(truss_with_cable(slack, "mixed",
                             "until = { lambda = [-0.2, 1.2] }\nkind = \"sensitivity\"\n"
                             "sensitivity = { parameters = [\"lc\"] }\n"))
            .of("s");
    const auto& events = result.branches.at(0).events;
    const auto active = std::find_if(
        events.begin(), events.end(),
        [](const analysis::Event& event) { return event.kind == analysis::EventKind::switching; });
    ASSERT_NE(active, events.end());
    const double rate = value(result, active->row, "d(lambda)/d(lc)");
    EXPECT_GT(rate, 1);
    EXPECT_NEAR(value(result, active->row, "d(deflection)/d(lc)"), rate, 1e-8);
    EXPECT_NEAR(value(result, active->row, "d(a.y)/d(lc)"), -rate, 1e-8);
  }
}

TEST(RatesOfSpecialPoints, KeepAMarkedValueWhereItIs) {
  const auto result =
      run(truss_with_cable(1e-3, "load",
                           "until = { lambda = [-0.1, 0.1] }\nmark = { deflection = "
                           "[0.1] }\nkind = \"sensitivity\"\n"
                           "sensitivity = { parameters = [\"lc\"] }\n"))
          .of("s");
  const auto& events = result.branches.at(0).events;
  const auto mark = std::find_if(events.begin(), events.end(), [](const analysis::Event& event) {
    return event.kind == analysis::EventKind::user_value;
  });
  ASSERT_NE(mark, events.end());
  EXPECT_NEAR(value(result, mark->row, "d(deflection)/d(lc)"), 0, 1e-8);
}

}  // namespace
}  // namespace springfold::io
