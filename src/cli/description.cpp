// What a case contains, as text.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "check_command.hpp"
#include "law_text.hpp"
#include "selection.hpp"
#include "springfold/io/shown_text.hpp"
#include "study_details.hpp"

namespace springfold::cli {

namespace {

using analysis::ControlMode;
using analysis::StudyKind;
using model::Joint;
using model::JointKind;
using model::JointRole;
using model::Mechanism;
using model::TaskSpace;

std::string word_of(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return "xy";
    case TaskSpace::planar:
      return "planar";
    case TaskSpace::xyz:
      return "xyz";
    case TaskSpace::spatial:
      return "spatial";
  }
  return "";
}

std::string word_of(JointRole role) {
  switch (role) {
    case JointRole::passive:
      return "passive";
    case JointRole::preloaded:
      return "preloaded";
    case JointRole::compliant:
      return "virtual";
    case JointRole::actuated:
      return "actuated";
  }
  return "";
}

std::string counted(Index count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string body_name(const Mechanism& mechanism, Index body) {
  return body == 0 ? "base" : mechanism.bodies[static_cast<std::size_t>(body - 1)].name;
}

/// "drive (prismatic, actuated, with drive spring)".
std::string text_of(const Joint& joint, bool is_coupled) {
  const bool has_drive_spring = joint.role == JointRole::actuated && joint.spring.has_value();
  return fmt::format("{} ({}, {}{}{})", joint.name,
                     joint.kind == JointKind::revolute ? "revolute" : "prismatic",
                     word_of(joint.role), has_drive_spring ? ", with drive spring" : "",
                     is_coupled ? ", coupled" : "");
}

/// "foot (elastic in Tx Ty Tz Rx Ry Rz)".
std::string text_of(const model::Chain& chain, const model::CoupledSpring& spring) {
  std::string directions;
  for (const std::size_t i : spring.elements) {
    const std::string& name = std::get<Joint>(chain.elements[i]).name;
    directions += " " + name.substr(name.rfind('.') + 1);
  }
  return fmt::format("{} (elastic in{})", spring.name, directions);
}

std::string text_of(const Mechanism& mechanism, const model::Chain& chain) {
  std::string joints;
  Index links = 0;
  // An elastic link is named once, not by its up to six virtual joints.
  std::vector<const model::CoupledSpring*> coupled(chain.elements.size(), nullptr);
  std::vector<bool> shares(chain.elements.size(), false);  // a preloaded joint of a coupled spring
  for (const model::CoupledSpring& spring : chain.coupled_springs)
    for (const std::size_t i : spring.elements) {
      const bool preloaded = std::get<Joint>(chain.elements[i]).role == JointRole::preloaded;
      if (preloaded)
        shares[i] = true;
      else
        coupled[i] = &spring;
    }
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    const auto* joint = std::get_if<Joint>(&chain.elements[i]);
    if (joint == nullptr) ++links;
    if (joint == nullptr || (coupled[i] && coupled[i]->elements.front() != i)) continue;
    joints += (joints.empty() ? "" : ", ") +
              (coupled[i] ? text_of(chain, *coupled[i]) : text_of(*joint, shares[i]));
  }
  return fmt::format("  chain     {}: {} to {}, {}\n            joints: {}\n", chain.name,
                     body_name(mechanism, chain.from), body_name(mechanism, chain.to),
                     counted(links, "rigid link"), joints.empty() ? "none" : joints);
}

/// Joint coordinates and pose coordinates, less what the closure of the chains takes away.
std::string freedom_text(const Mechanism& mechanism) {
  Index coordinates = 0, inner = 0, closures = 0, poses = 0;
  for (const auto& chain : mechanism.chains) {
    closures += model::dimension(model::task_space_of(mechanism, chain));
    for (const auto& element : chain.elements)
      if (const auto* joint = std::get_if<Joint>(&element))
        coordinates += model::has_coordinate(*joint) ? 1 : 0;
  }
  for (const auto& spring : mechanism.shape_springs) inner += std::ssize(spring.before);
  for (const auto& body : mechanism.bodies) poses += model::dimension(body.task_space);
  const std::string series =
      inner > 0 ? ", " + counted(inner, "coordinate") + " of springs in series" : "";
  return fmt::format("  freedom   {}: {}{} and {} under {}\n",
                     counted(coordinates + inner + poses - closures, "degree") + " of freedom",
                     counted(coordinates, "joint coordinate"), series,
                     counted(poses, "pose coordinate"), counted(closures, "closure equation"));
}

/// The first ones of a kind of thing, one line each, and how many others there are.
class Listing {
 public:
  explicit Listing(std::string noun) : noun_{std::move(noun)} {}

  void add(const std::string& line) {
    if (++count_ <= most) text_ += fmt::format("  {:<9} {}\n", noun_, io::shown(line));
  }
  std::string text() const {
    if (count_ <= most) return text_;
    return text_ + fmt::format("  {:<9} and {} more: {} in all\n", noun_, count_ - most, count_);
  }

 private:
  static constexpr std::size_t most = 12;
  std::string noun_{}, text_{};
  std::size_t count_ = 0;
};

template <class Numbers>
std::string list_text(const Numbers& numbers, Index count) {
  std::string text;
  for (Index i = 0; i < count; ++i)
    text += (i == 0 ? "" : ", ") + fmt::format("{:.6g}", numbers[i] + 0.0);
  return "[" + text + "]";
}

bool is_flat(const Mechanism& mechanism) {
  return std::all_of(mechanism.bodies.begin(), mechanism.bodies.end(),
                     [](const auto& body) { return model::translations(body.task_space) == 2; });
}

/// "base [0, 1]", "tip", "arm.knee".
std::string place_text(const Mechanism& mechanism, const model::Anchor& anchor) {
  std::string name = body_name(mechanism, anchor.body);
  if (anchor.chain >= 0) {
    const model::Chain& chain = mechanism.chains[static_cast<std::size_t>(anchor.chain)];
    const std::string& point = chain.points[anchor.point].name;
    name = chain.name + (point.empty() ? "" : "." + point);
  }
  const bool plain = anchor.at.isZero(0) && (anchor.chain >= 0 || anchor.body > 0);
  return plain ? name : name + " " + list_text(anchor.at, is_flat(mechanism) ? 2 : 3);
}

std::string load_name(const Mechanism& mechanism, std::size_t i) {
  const std::string& name = mechanism.loads[i].name;
  return name.empty() ? std::to_string(i + 1) : "\"" + name + "\"";
}

std::string word_of(model::ShapeKind kind) {
  switch (kind) {
    case model::ShapeKind::path:
      return "path";
    case model::ShapeKind::angle:
      return "angle";
    case model::ShapeKind::dihedral:
      return "fold";
    case model::ShapeKind::area:
      return "area";
    case model::ShapeKind::volume:
      return "volume";
    case model::ShapeKind::line:
      return "line";
    case model::ShapeKind::plane:
      return "plane";
  }
  return "";
}

/// "area of tip, base [0, 1], arm.knee".
std::string text_of(const Mechanism& mechanism, const model::Shape& shape) {
  constexpr std::size_t most = 6;
  std::string points;
  for (std::size_t i = 0; i < std::min(most, shape.points.size()); ++i)
    points += (i == 0 ? "" : ", ") + place_text(mechanism, shape.points[i]);
  if (shape.points.size() > most) points += fmt::format(" and {} more", shape.points.size() - most);
  const bool distance = shape.kind == model::ShapeKind::path && shape.points.size() == 2;
  return (distance ? "distance" : word_of(shape.kind)) + " of " + points;
}

/// "piecewise, ...", of springs in series one behind the other.
std::string laws_text(const model::ShapeSpring& spring) {
  if (spring.before.empty()) return law_text(spring.law);
  std::string text = fmt::format("{} springs in series: ", spring.before.size() + 1);
  for (const model::SeriesSpring& inner : spring.before) text += law_text(inner.law) + "; ";
  return text + law_text(spring.law);
}

std::string text_of(const Mechanism& mechanism, const model::ShapeSpring& spring) {
  return fmt::format("{}: {}, {}", spring.name, text_of(mechanism, spring.shape),
                     spring.gas ? fmt::format("gas with nRT {:.6g} at rest at {:.6g}",
                                              spring.gas->nRT, spring.gas->initial)
                                : laws_text(spring));
}

/// A bar that is no line spring.
std::string bar_text(const Mechanism& mechanism, const model::ShapeSpring& bar) {
  return fmt::format("{}: {} to {}, {}", bar.name, place_text(mechanism, bar.shape.points[0]),
                     place_text(mechanism, bar.shape.points[1]), laws_text(bar));
}

std::string text_of(const Mechanism& mechanism, std::size_t i) {
  const model::Load& load = mechanism.loads[i];
  if (load.kind == model::LoadKind::pressure)
    return fmt::format("{}: pressure {:.6g} in the {}{}", load_name(mechanism, i), load.vector[0],
                       text_of(mechanism, load.shape), load.with_lambda ? ", times lambda" : "");
  return fmt::format("{}: {} {} on {}{}{}", load_name(mechanism, i),
                     load.kind == model::LoadKind::force ? "force" : "moment",
                     list_text(load.vector, 3), place_text(mechanism, load.on),
                     load.with_lambda ? ", times lambda" : "",
                     load.follows ? ", turns with it" : "");
}

std::string node_text(const io::CaseNode& node) {
  std::string held;
  for (const std::string& direction : node.fixed) held += (held.empty() ? "" : ", ") + direction;
  return node.name + (!node.moves ? " (fixed)" : held.empty() ? "" : " (held in " + held + ")");
}

/// ", mass 2"; nothing of what has none.
std::string mass_text(double mass) { return mass != 0 ? fmt::format(", mass {:.6g}", mass) : ""; }

/// Points of chains that have a name or a mass.
void list_points(const model::Chain& chain, Listing& points) {
  for (const model::ChainPoint& point : chain.points)
    if (!point.name.empty())
      points.add(chain.name + "." + point.name + mass_text(point.mass));
    else if (point.mass != 0)
      points.add("on a link of " + chain.name + mass_text(point.mass));
}

/// Nodes, bodies, chains, points, springs, bars, gravity and loads.
std::string parts_text(const io::Case& the_case, const Mechanism& mechanism) {
  Listing nodes{"node"}, bodies{"body"}, points{"point"}, springs{"spring"}, bars{"bar"},
      loads{"load"};
  std::map<std::string, double> masses;
  for (const auto& body : mechanism.bodies) masses[body.name] = body.mass;
  std::set<std::string> names;
  for (const io::CaseNode& node : the_case.nodes) {
    nodes.add(node_text(node) + (node.moves ? mass_text(masses[node.name]) : ""));
    names.insert(node.name);
  }
  for (const auto& body : mechanism.bodies)
    if (!names.contains(body.name))
      bodies.add(body.name + " (" + word_of(body.task_space) + ")" + mass_text(body.mass));
  std::string chains, gravity;
  for (const auto& chain : mechanism.chains) {
    chains += text_of(mechanism, chain);
    list_points(chain, points);
  }
  if (!mechanism.gravity.isZero(0))
    gravity =
        fmt::format("  gravity   {}\n", list_text(mechanism.gravity, is_flat(mechanism) ? 2 : 3));
  const std::set<std::string> of_bars(the_case.bars.begin(), the_case.bars.end());
  for (const model::LineSpring& spring : mechanism.line_springs)
    (of_bars.contains(spring.name) ? bars : springs)
        .add(fmt::format("{}: {} to {}, stiffness {:.6g}, free length {:.6g}", spring.name,
                         place_text(mechanism, spring.from), place_text(mechanism, spring.to),
                         spring.stiffness, spring.free));
  for (const model::ShapeSpring& spring : mechanism.shape_springs)
    if (of_bars.contains(spring.name))
      bars.add(bar_text(mechanism, spring));
    else
      springs.add(text_of(mechanism, spring));
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) loads.add(text_of(mechanism, i));
  return nodes.text() + bodies.text() + chains + points.text() + springs.text() + bars.text() +
         gravity + loads.text();
}

/// What lambda is in a study that follows a curve.
std::string lambda_text(const io::PlannedRun& planned, const io::UnitLabels& units) {
  const analysis::Study& study = planned.plan;
  const std::string body = body_name(planned.mechanism, study.body);
  const Index d = study.direction.size();
  const bool moves =
      d > 0 &&
      !study.direction
           .head(model::translations(
               planned.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space))
           .isZero(0);
  const std::string along = d > 0 ? " along " + list_text(study.direction, d) : "";
  std::string growing;
  for (std::size_t i = 0; i < planned.mechanism.loads.size(); ++i)
    if (planned.mechanism.loads[i].with_lambda)
      growing += (growing.empty() ? "" : ", ") + load_name(planned.mechanism, i);
  if (!growing.empty()) growing = "factor of load " + growing;
  const std::string way = moves ? "way [" + units.length + "]" : "angle [rad]";
  switch (study.control) {
    case ControlMode::load:
      if (d == 0) return growing;
      return (moves ? "force [" + units.force + "]"
                    : "moment [" + units.force + "*" + units.length + "]") +
             " on " + body + along + (growing.empty() ? "" : ", and " + growing);
    case ControlMode::pose:
      return way + " of " + body + along + ", its pose driven";
    case ControlMode::mixed:
      return way + " of " + body + along + ", free across it";
    case ControlMode::actuator: {
      std::string drives;
      for (const auto& rate : study.actuators)
        drives +=
            (drives.empty() ? "" : ", ") + fmt::format("{:.6g}", rate.rate) + " * " + rate.actuator;
      return "way of the drives " + drives;
    }
    case ControlMode::parameter:
      return "parameter " + study.parameter;
  }
  return "";
}

/// The kind as the case names it: studies with jumps are traced as others are.
std::string kind_of(const analysis::Study& plan) {
  if (plan.snap && plan.snap->transitions) return "transitions";
  if (plan.snap && plan.snap->cycle) return "load_cycle";
  return std::string(to_string(plan.kind)) + (plan.snap ? " with jumps" : "");
}

std::string study_text(const io::Case& the_case, const std::string& name) {
  std::string labels;
  Index runs = 0;
  const io::PlannedRun* first = nullptr;
  for (const auto& planned : the_case.runs) {
    if (planned.study != name) continue;
    if (first == nullptr) first = &planned;
    ++runs;
    if (!planned.label.empty()) labels += (labels.empty() ? ": " : "; ") + planned.label;
  }
  const bool is_curve = first->plan.kind == StudyKind::force_deflection;
  const auto& branches = first->plan.branches;
  std::string more;
  if (branches.depth > 0) more += fmt::format(", branches to depth {}", branches.depth);
  if (!branches.search_at.empty())
    more += ", searches at " + counted(std::ssize(branches.search_at), "value") + " of lambda";
  if (const auto& after = first->history.earlier)
    more += ", starts from study \"" + after->study.name + "\" at " + after->at;
  const std::string line =
      fmt::format("  study     {} ({}{}{}), {}{}\n", io::shown(name), kind_of(first->plan),
                  is_curve ? ", control " + std::string(to_string(first->plan.control)) : "",
                  io::shown(more), counted(runs, "run"), io::shown(labels));
  const bool has_lambda = is_curve || analysis::is_of_critical_points(first->plan.kind);
  const std::string lambda =
      has_lambda ? "            lambda: " + io::shown(lambda_text(*first, the_case.units)) + "\n"
                 : "";
  return line + lambda + study_details(*first);
}

}  // namespace

std::string description_of(const io::Case& the_case) {
  std::string text = io::shown(the_case.file.string()) + ": no mistakes found\n";
  if (!the_case.title.empty()) text += "  title     " + io::shown(the_case.title) + "\n";
  text += fmt::format("  units     length {}, force {}\n", io::shown(the_case.units.length),
                      io::shown(the_case.units.force));
  if (!the_case.runs.empty()) {
    const Mechanism& mechanism = the_case.runs.front().mechanism;
    text += parts_text(the_case, mechanism);
    text += freedom_text(mechanism);
  }
  for (const auto& name : study_names(the_case)) text += study_text(the_case, name);
  for (const auto& plot : the_case.plots) text += "  figure    " + plot.name + "\n";
  for (const auto& plot : the_case.map_plots) text += "  figure    " + plot.name + "\n";
  for (const auto& plot : the_case.tornados) text += "  figure    " + plot.name + "\n";
  for (const auto& picture : the_case.pictures) text += "  picture   " + picture.name + "\n";
  if (!the_case.expected.values.empty())
    text += "  expected  " +
            counted(static_cast<Index>(the_case.expected.values.size()), "compared value") + "\n";
  return text;
}

}  // namespace springfold::cli
