// The mechanism as a function of a parameter is the mechanism that the file gives for its value.
#include <gtest/gtest.h>

#include "case_files.hpp"

namespace springfold::io {
namespace {

class ParameterFamilies : public CaseFiles {
 protected:
  static std::string text() {
    std::string text = replaced(orthoglide_text(), "control = \"mixed\"",
                                "control = \"parameter\"\nparameter = \"L\"");
    text = replaced(text, "load = [0, 0]", "load = [\"0.01*Kw\", 0]\nset = { K = \"2*L^2\" }");
    text = replaced(text, "Kv = {", "Kw = \"Kv + K\"\nKv = {");
    text = replaced(
        text, "{ rigid = [\"-L\", 0] }",
        "{ rigid = { at = [\"-L\", 0], rotate = { axis = [\"L\", 0, 1], angle = \"L*deg\" } } }");
    text = replaced(
        text, "spring = { law = \"linear\", stiffness = \"Kv\" }",
        "spring = { law = \"stops\", stiffness = \"Kw\", stop_stiffness = 1, free = \"0.1*L\", "
        "low = -1, high = \"L\" }");
    return replaced(text, "y = \"force\"", "y = \"energy\"");
  }
};

void expect_same(const model::Pose<double>& a, const model::Pose<double>& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.R, b.R);
}

void expect_same(const model::Joint& a, const model::Joint& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.command, b.command);
  EXPECT_EQ(a.initial, b.initial);
  ASSERT_EQ(a.spring.has_value(), b.spring.has_value());
  if (!a.spring) return;
  const model::CompiledSpring s = model::compile(*a.spring), t = model::compile(*b.spring);
  EXPECT_EQ(s.breakpoints, t.breakpoints);
  ASSERT_EQ(s.segments.size(), t.segments.size());
  for (std::size_t i = 0; i < s.segments.size(); ++i) {
    EXPECT_EQ(s.segments[i].torque, t.segments[i].torque);
    EXPECT_EQ(s.segments[i].stiffness, t.segments[i].stiffness);
  }
}

void expect_same(const model::Mechanism& a, const model::Mechanism& b) {
  ASSERT_EQ(a.chains.size(), b.chains.size());
  for (std::size_t i = 0; i < a.chains.size(); ++i) {
    ASSERT_EQ(a.chains[i].elements.size(), b.chains[i].elements.size());
    for (std::size_t j = 0; j < a.chains[i].elements.size(); ++j) {
      const model::Element &x = a.chains[i].elements[j], &y = b.chains[i].elements[j];
      if (const auto* joint = std::get_if<model::Joint>(&x))
        expect_same(*joint, std::get<model::Joint>(y));
      else
        expect_same(std::get<model::RigidLink>(x).transform,
                    std::get<model::RigidLink>(y).transform);
    }
  }
}

TEST_F(ParameterFamilies, EqualAFreshReadingForEveryValue) {
  const Case c = load(text());
  ASSERT_TRUE(c.runs[0].family);
  EXPECT_EQ(c.runs[0].family->value, 1);
  EXPECT_EQ(c.runs[0].plan.parameter, "L");
  for (const char* value : {"1", "0.75", "3.125"}) {
    const Case fresh = load(text(), {{"L", value}});
    for (std::size_t run = 0; run < c.runs.size(); ++run) {
      const analysis::Situation s = c.runs[run].family->at(std::stod(value));
      expect_same(s.mechanism, fresh.runs[run].mechanism);
      EXPECT_EQ(s.constant_load, fresh.runs[run].plan.constant_load) << run << ", " << value;
    }
  }
}

TEST_F(ParameterFamilies, DoNotRememberEarlierValues) {
  const Case c = load(text());
  const auto& at = c.runs[1].family->at;
  const analysis::Situation first = at(2);
  at(-5);
  expect_same(at(2).mechanism, first.mechanism);
}

TEST_F(ParameterFamilies, OutliveTheCase) {
  std::optional<analysis::ParameterFamily> family;
  {
    const Case c = load(text());
    family = c.runs[0].family;
  }
  EXPECT_EQ(std::get<model::Joint>(family->at(4).mechanism.chains[0].elements[0]).command, 4);
}

TEST_F(ParameterFamilies, BelongToParameterControlOnly) {
  for (const PlannedRun& run : load(orthoglide_text()).runs) EXPECT_FALSE(run.family);
}

TEST_F(ParameterFamilies, StartAtTheValueOfTheRun) {
  std::string varied = replaced(text(), "parameter = \"Kv\"", "parameter = \"L\"");
  varied = replaced(varied, "values = [0, \"0.1*K*L^2\"]", "values = [1.5, 2]");
  const Case c = load(varied);
  EXPECT_EQ(c.runs[0].family->value, 1.5);
  EXPECT_EQ(c.runs[1].family->value, 2);
  expect_same(c.runs[1].family->at(2).mechanism, c.runs[1].mechanism);
}

/// A strut with something of every sort that a parameter may move alone.
class MovedNumbers : public CaseFiles {
 protected:
  static std::string text() {
    return R"toml([parameters]
k = 1
c = "2*k"
pull = 0.1
size = 1
seed = 3
[[body]]
name = "tip"
task_space = "planar"
pose = [1, 0, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "foot", role = "virtual", stiffness = "k" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = "c" },
  { rigid = ["size", 0] },
  { joint = "revolute", axis = "z", name = "head", role = "preloaded" },
  { joint = "prismatic", axis = "y", name = "slide", role = "preloaded" },
]
coupled_springs = [{ joints = ["head", "slide"], stiffness = [["k^2", 0.1], [0.1, 2]], free = ["pull", 0] }]
[[spring]]
name = "stay"
from_at = [0, 1]
to = "tip"
stiffness = "3*k"
free = "0.5"
[[load]]
name = "dead"
on = "tip"
force = [0, "-pull"]
[[study]]
name = "all"
kind = "sensitivity"
control = "load"
direction = [-1, 0, 0]
start = { seed = "seed" }
)toml";
  }
  static const analysis::CaseFamily& family(const Case& c) {
    return *c.runs[0].plan.critical.cases;
  }
  static std::size_t number_of(const Case& c, const std::string& name) {
    const auto& names = family(c).names;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

TEST_F(MovedNumbers, PutInPlaceAreThoseOfTheWholeCase) {
  const Case c = load(text());
  const analysis::MovingCase& moving = family(c).moving;
  for (const std::string name : {"k", "c", "pull"}) {
    const std::size_t number = number_of(c, name);
    ASSERT_NE(moving.moved(number), nullptr) << name;
    model::Mechanism m = family(c).at({{number, 5}}).mechanism;
    ASSERT_TRUE(moving.put(number, 0.7, m)) << name;
    const model::Mechanism whole = family(c).at({{number, 0.7}}).mechanism;
    expect_same(m, whole);
    EXPECT_EQ(m.chains[0].coupled_springs[0].stiffness,
              whole.chains[0].coupled_springs[0].stiffness);
    EXPECT_EQ(m.chains[0].coupled_springs[0].free, whole.chains[0].coupled_springs[0].free);
    EXPECT_EQ(m.line_springs[0].stiffness, whole.line_springs[0].stiffness);
    EXPECT_EQ(m.loads[0].vector, whole.loads[0].vector);
  }
}

TEST_F(MovedNumbers, AreNotAllWhereAParameterMovesTheShapeOrTheStudy) {
  const Case c = load(text());
  const analysis::MovingCase& moving = family(c).moving;
  for (const std::string name : {"size", "seed"})
    EXPECT_EQ(moving.moved(number_of(c, name)), nullptr) << name;
}

}  // namespace
}  // namespace springfold::io
