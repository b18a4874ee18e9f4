#include "draw.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "structures.hpp"

namespace springfold::guyed {
namespace {

using known_answers::choice;
using known_answers::log_uniform;
using known_answers::sign;
using known_answers::uniform;

constexpr double pretensions[] = {0, 0, 1e-12, 1e-6, 1e-3, 0.1, -1e-12, -1e-6, -1e-3, -0.1};

struct Anchor {
  std::size_t corner = 0;
  Vector at{};  ///< relative to the corner, horizontal parts first, the height last
};

Anchor random_anchor(const Bare& bare, Random& random) {
  Anchor anchor{
      .corner = static_cast<std::size_t>(choice(random, static_cast<int>(bare.corners.size()))),
      .at = Vector(bare.horizontals + 1)};
  const double reach = uniform(random, 0.4, 1.5);
  const double azimuth = uniform(random, 0, 2 * std::numbers::pi);
  if (bare.horizontals == 1)
    anchor.at << sign(random) * reach, 0;
  else
    anchor.at << reach * std::cos(azimuth), reach * std::sin(azimuth), 0;
  const double height = bare.corners[anchor.corner].place[bare.horizontals];
  anchor.at[bare.horizontals] = -uniform(random, -0.5, height + 0.5);
  return anchor;
}

double random_pretension(Random& random) {
  return pretensions[static_cast<std::size_t>(choice(random, std::size(pretensions)))];
}

/// A cable before it is attached.
struct Planned {
  Anchor anchor{};
  double stretch = 0;      ///< of its length
  bool is_second = false;  ///< of a pair: as stiff as the first one
  bool is_alone = false;   ///< tight, and nothing would hold against it
};

/// Where every cable is anchored. Tight ones come in opposite pairs, so that the structure stays upright.
/// @param pretension  not a number: of each pair its own
std::vector<Planned> planned(const Bare& bare, int count, double pretension, Random& random) {
  std::vector<Planned> list;
  while (static_cast<int>(list.size()) < count) {
    const double stretch = std::isnan(pretension) ? random_pretension(random) : pretension;
    list.push_back({random_anchor(bare, random), stretch});
    const bool is_tight = stretch > 0;
    if (is_tight && static_cast<int>(list.size()) < count) {
      list.push_back({list.back().anchor, stretch, true});
      list.back().anchor.at.head(bare.horizontals) *= -1;
    } else {
      list.back().is_alone = is_tight;
    }
  }
  return list;
}

/// A load between two of these that are well apart, with one to four below it.
double load_between(std::vector<double> loads, Random& random) {
  std::sort(loads.begin(), loads.end());
  constexpr double apart = 0.02;
  std::vector<double> places;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (i + 1 == loads.size() || loads[i + 1] > (1 + 2 * apart) * loads[i])
      places.push_back((1 + apart) * loads[i]);
  const auto few = std::min<std::size_t>(4, places.size());
  return places[static_cast<std::size_t>(choice(random, static_cast<int>(few)))];
}

std::vector<double> loads_of(const Structure& structure) {
  std::vector<double> loads;
  for (const double at_rest : {0.0, told_as_resting})
    for (const HalfBranch& branch : truth(structure, at_rest).leaving) loads.push_back(branch.load);
  return loads;
}

std::string study(const Bare& bare, const Draw& draw) {
  constexpr double sway = 0.1;
  std::string text = "[[study]]\nname = \"press\"\nbody = \"" + bare.loaded +
                     "\"\ncontrol = \"load\"\ndirection = " + bare.direction +
                     "\nuntil = { lambda = [" + number(draw.from) + ", " + number(draw.to) + "]";
  for (const Sway& column : draw.sways)
    text += ", \"" + column.quantity + "\" = [" + number(column.upright - sway) + ", " +
            number(column.upright + sway) + "]";
  return text + " }\nbranches = { depth = 1 }\n";
}

/// One try; false: it would fall under no load at all.
bool try_draw(Random& random, const Kind& kind, Draw& result) {
  result = {};
  result.pretension = kind.mixed ? std::nan("") : random_pretension(random);
  const bool hinges_give =
      kind.mixed || result.pretension < -told_as_resting || choice(random, 4) != 0;
  Bare bare =
      kind.space_frame ? random_space_frame(hinges_give, random) : random_bare(hinges_give, random);
  result.family = bare.family;
  result.sways = bare.sways;
  result.structure.springs = bare.springs;
  result.structure.load = bare.load;
  const int count = 1 + choice(random, 6);
  double stiffness = 1;
  std::string cables;
  const std::vector<Planned> list = planned(bare, count, result.pretension, random);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& [anchor, wanted, is_second, is_alone] = list[i];
    if (!is_second)
      stiffness = kind.wide ? log_uniform(random, 1e-4, 1e4) : log_uniform(random, 0.3, 3);
    const double stretch = !is_alone ? wanted : choice(random, 2) ? 0 : -wanted;
    const Attached cable = attach(bare, anchor.corner, anchor.at, stiffness, stretch);
    result.structure.cables.push_back(cable.cable);
    const bool as_chain = bare.horizontals == 1 && choice(random, 2) == 0;
    cables += as_chain ? cable_chain(cable, i + 1) : cable_spring(cable, i + 1);
  }
  constexpr double least_load = 0.02;
  const std::vector<double> loads = loads_of(result.structure);
  if (!(*std::min_element(loads.begin(), loads.end()) > least_load)) return false;
  result.to = load_between(loads, random);
  result.from = -0.1 * result.to;
  result.text = "title = \"" + bare.family + "\"\n" + bare.text + cables + study(bare, result);
  return true;
}

}  // namespace

Draw draw(Random& random, const Kind& kind) {
  Draw result;
  while (!try_draw(random, kind, result)) {
  }
  return result;
}

}  // namespace springfold::guyed
