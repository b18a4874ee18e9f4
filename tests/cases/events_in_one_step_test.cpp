// Special points that share a step: the counts beside each of them, and none that hides another one.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "case_runs.hpp"
#include "io/result_access.hpp"
#include "number_text.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::ElementsAre;
using testing::HasSubstr;

/// A platform on six equal springs, turned by 8 degrees against its base, driven down: two modes become unstable under
/// dead load, soon after them a third one.
std::string driven_platform(const std::string& trace) {
  std::string text = R"(
[[body]]
name = "platform"
task_space = "spatial"
pose = [0, 0, 0.8, 0, 0, 0]
)";
  const auto at = [](double radius, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return "[" + number(radius * std::cos(angle)) + ", " + number(radius * std::sin(angle)) +
           ", 0]";
  };
  const double turn = 8 * std::numbers::pi / 180;
  const double length = std::sqrt(1 + 0.36 - 1.2 * std::cos(turn) + 0.64);
  for (int leg = 0; leg < 6; ++leg)
    text += "[[spring]]\nname = \"leg" + std::to_string(leg) + "\"\nfrom_at = " + at(1, 60 * leg) +
            "\nto = \"platform\"\nto_at = " + at(0.6, 60 * leg + (leg % 2 == 0 ? 8 : -8)) +
            "\nstiffness = 1\nfree = " + number(length) + "\n";
  return text +
         "[[study]]\nname = \"down\"\ncontrol = \"pose\"\ndirection = [0, 0, -1, 0, 0, 0]\n"
         "until = { lambda = [0, 0.1] }\n" +
         trace;
}

/// The count of modes that are unstable under dead load, before and after each change.
std::vector<std::pair<int, int>> counts(const std::string& text) {
  const analysis::StudyResult result = run(text).of("down");
  std::vector<std::pair<int, int>> list;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::stability_change)
      list.emplace_back(std::lround(value(result, event.row - 1, "index_force")),
                        std::lround(value(result, event.row + 1, "index_force")));
  return list;
}

TEST(EventsInOneStep, HaveTheCountsBesideThemWhateverTheSteps) {
  for (const char* trace : {"", "trace = { maximum_step = 0.02 }\n",
                            "trace = { maximum_step = 0.005 }\n", "trace = { maximum_step = 1 }\n"})
    EXPECT_THAT(counts(driven_platform(trace)), ElementsAre(std::pair{0, 2}, std::pair{2, 3}))
        << trace;
}

/// A point between four springs, pulled along their axis against a fifth one: both sideways motions lose their
/// stiffness at once where the transverse stiffness, of closed form, is zero.
TEST(EventsInOneStep, OfADoubleModeAreFoundInTheStepThatTheRangeCuts) {
  std::string text = "[[body]]\nname = \"tip\"\ntask_space = \"xyz\"\npose = [0, 0, 1]\n";
  for (const char* at : {"[1, 0, 0]", "[0, 1, 0]", "[-1, 0, 0]", "[0, -1, 0]"})
    text += std::string{"[[spring]]\nname = \"s"} + std::to_string(text.size()) +
            "\"\nfrom_at = " + at + "\nto = \"tip\"\nstiffness = 1\nfree = 1\n";
  text +=
      "[[spring]]\nname = \"c\"\nfrom_at = [0, 0, 2]\nto = \"tip\"\nstiffness = 1\nfree = 0.5\n"
      "[[study]]\nname = \"s\"\ncontrol = \"pose\"\ndirection = [0, 0, 1]\nstart = { solve = "
      "\"wrench\" }\nuntil = { deflection = [0, ";
  // Four springs of length l, of which two share a sideways motion: 4 (1 - 1/l) + 2/l^3; the fifth: 1 - 0.5/(2 - z).
  const auto transverse = [](double z) {
    const double l = std::hypot(1, z);
    return 4 * (1 - 1 / l) + 2 / (l * l * l) + 1 - 0.5 / (2 - z);
  };
  for (const double end : {0.851, 0.86, 0.87, 0.89, 1.2}) {
    const analysis::StudyResult result = run(text + number(end) + "] }\n").of("s");
    int changes = 0;
    for (const auto& event : result.branches.at(0).events) {
      if (event.kind != EventKind::stability_change) continue;
      ++changes;
      EXPECT_NEAR(transverse(value(result, event.row, "tip.z")), 0, 1e-8) << end;
    }
    EXPECT_EQ(changes, 1) << end;
  }
}

/// Two bars of length l0 on feet 2 apart, pressed down at the apex. The load turns where l^3 = l0, and the apex sways
/// from where l^3 - l0 l^2 + l0 = 0: at the same place where l0^2 = 8.
std::string truss(double l0, const std::string& step) {
  const double height = std::sqrt(l0 * l0 - 1), angle = std::atan(height);
  const auto leg = [&](const std::string& name, const std::string& x, double initial) {
    return "[[chain]]\nname = \"" + name + "\"\nfrom_at = [" + x +
           ", 0]\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(initial) +
           " }, { joint = \"prismatic\", axis = \"x\", role = \"virtual\", stiffness = 1 }, { "
           "rigid "
           "= [" +
           number(l0) + ", 0] }]\n";
  };
  return "[[body]]\nname = \"apex\"\ntask_space = \"xy\"\npose = [0, " + number(height) + "]\n" +
         leg("left", "-1", angle) + leg("right", "1", std::numbers::pi - angle) +
         "[[study]]\nname = \"down\"\ncontrol = \"load\"\ndirection = [0, -1]\nuntil = { "
         "deflection = [-0.1, 2.5] }\ntrace = { maximum_step = " +
         step + " }\n";
}

TEST(EventsInOneStep, LimitAndBranchPointOfATrussHaveTheCountBetweenThem) {
  for (const char* step : {"0.05", "0.15", "0.19137", "0.2"}) {
    const analysis::StudyResult result =
        run(truss(std::sqrt(8.0) * (1 - 1.726e-5), step)).of("down");
    const auto& events = result.branches.at(0).events;
    const auto turn = std::find_if(events.begin(), events.end(), [](const auto& event) {
      return event.kind == EventKind::limit_point;
    });
    ASSERT_NE(turn, events.end());
    const auto& sway = *std::prev(turn);
    ASSERT_EQ(sway.kind, EventKind::branch_point);
    EXPECT_EQ(value(result, sway.row - 1, "index"), 1) << step;
    EXPECT_EQ(value(result, sway.row + 1, "index"), 0) << step;
    EXPECT_EQ(value(result, turn->row - 1, "index"), 0) << step;
    EXPECT_EQ(value(result, turn->row + 1, "index"), 1) << step;
  }
}

TEST(EventsInOneStep, ABranchPointThatIsNotToldFromALimitPointSaysThatTheForceTurns) {
  for (const double off : {0.0, 1e-9, -1e-9}) {
    const analysis::StudyResult result = run(truss(std::sqrt(8.0) * (1 + off), "0.05")).of("down");
    int turns = 0;
    for (const auto& event : result.branches.at(0).events) {
      if (event.kind != EventKind::branch_point) continue;
      const bool at_the_top = std::abs(value(result, event.row, "lambda") - 2) < 1e-6;
      EXPECT_EQ(event.detail.find("the force turns back") != std::string::npos, at_the_top);
      turns += at_the_top ? 1 : 0;
    }
    EXPECT_EQ(turns, 1);
  }
}

/// A mast of four links with two cables that rest; the piece on which only the second one acts is singular within
/// 1.2e-5 of the piece on which both act, whose mode leads out of it.
const std::string mast_with_a_weak_cable = R"(
[[body]]
name = "top"
task_space = "xy"
pose = [0, 4.301399249660857]
[[chain]]
name = "mast"
elements = [
  { joint = "revolute", axis = "-z", name = "h0", role = "preloaded", spring = { law = "linear", stiffness = 1.5631810597954092 } },
  { rigid = [0, 0.9529662109414131] },
  { joint = "revolute", axis = "-z", name = "h1", role = "preloaded", spring = { law = "linear", stiffness = 0.2960458913103954 } },
  { point = "q0", at = [0, 1.4795710338874923] },
  { rigid = [0, 1.4795710338874923] },
  { joint = "revolute", axis = "-z", name = "h2", role = "preloaded", spring = { law = "linear", stiffness = 0.17656209845795023 } },
  { point = "q1", at = [0, 0.044633285712256686] },
  { rigid = [0, 0.7137815734842681] },
  { joint = "revolute", axis = "-z", name = "h3", role = "preloaded", spring = { law = "linear", stiffness = 1.4351710788954013 } },
  { rigid = [0, 1.1550804313476832] },
]
[[spring]]
name = "c0"
from_at = [-1.272775896192037, 0.22419821408654778]
to = "mast.q0"
law = { law = "one_sided", stiffness = 0.15123999036780597, from = 2.54886636696150445 }
[[spring]]
name = "c1"
from_at = [-1.6087995291453416, 0.01425510957561077]
to = "mast.q1"
law = { law = "one_sided", stiffness = 17.885952275399074, from = 2.9418001794493439 }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [0, 0.3] }
)";

TEST(EventsInOneStep, OfTwoPiecesAtRestTheOneWhoseBranchLeadsOnIsFoundWhateverTheSteps) {
  for (const char* trace :
       {"", "trace = { maximum_step = 0.02 }\n", "trace = { maximum_step = 0.005 }\n",
        "trace = { maximum_step = 0.2 }\n"})
    EXPECT_THAT(lambdas(run(mast_with_a_weak_cable + trace).of("press"), EventKind::branching_kink),
                ElementsAre(testing::DoubleNear(0.0464506509, 1e-9),
                            testing::DoubleNear(0.0908948053, 1e-9)))
        << trace;
}

}  // namespace
}  // namespace springfold::io
