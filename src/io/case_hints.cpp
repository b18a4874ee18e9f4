#include "case_hints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "springfold/statics/system.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using model::Joint;
using model::JointKind;
using model::JointRole;
using model::Mat3;
using model::TaskSpace;
using model::Vec3;

/// Directions closer than this are parallel, those with a smaller cosine at right angles.
constexpr double same_direction = 1e-9;

void add_once(std::vector<std::string>& hints, const std::string& hint) {
  if (std::find(hints.begin(), hints.end(), hint) == hints.end()) hints.push_back(hint);
}

/// An angle in radians that looks like degrees: more than a turn, and not written with deg or pi.
void add_angle_hint(const Definition& at, double value, std::vector<std::string>& hints) {
  const double size = std::abs(value);
  if (at.place.file.empty() || !(size > 2 * std::numbers::pi) || !std::isfinite(size)) return;
  if (at.shown.find("deg") != std::string::npos || at.shown.find("pi") != std::string::npos) return;
  const std::string number = rounded(value, 6);
  add_once(hints, place_text(at.place, at.key) + ": " + number + " rad is more than " +
                      rounded(std::floor(size / (2 * std::numbers::pi)), 6) +
                      " full turns; if degrees are meant write \"" + number + "*deg\"");
}

/// Angles that a number is made of, as those of a pattern: their sum says nothing. Of all copies the first is named.
/// @returns whether there are any
bool add_part_hints(const Definition& of, const FormulaBook& book, const Values& parameters,
                    std::vector<std::string>& hints) {
  bool any = false;
  for (const DefinitionPart& part : of.parts) {
    if (!part.is_angle) continue;
    any = true;
    const auto stands_there = [at = place_text(part.place, "") + ": "](const std::string& hint) {
      return hint.starts_with(at);
    };
    if (std::any_of(hints.begin(), hints.end(), stands_there)) continue;
    add_angle_hint({.shown = part.shown, .place = part.place, .key = part.key},
                   book.value(part.formula, parameters.values), hints);
  }
  return any;
}

void add_angle_hints(const NumberTable& table, const std::vector<double>& values,
                     const FormulaBook& book, const Values& parameters,
                     std::vector<std::string>& hints) {
  for (NumberId id = 0; id < table.size() && id < values.size(); ++id) {
    const Definition& definition = table.definition(id);
    if (add_part_hints(definition, book, parameters, hints)) continue;
    if (table.rule(id).unit == "rad") add_angle_hint(definition, values[id], hints);
  }
}

/// Quantities of a study that are angles: coordinates of joints and bodies, commands.
std::set<std::string> angles_of(const model::Mechanism& mechanism) {
  const statics::System system = statics::prepare(mechanism);
  std::set<std::string> names;
  for (std::size_t i = 0; i < system.coordinate_names.size(); ++i)
    if (!system.is_wrench[i] && !system.is_length[i]) names.insert(system.coordinate_names[i]);
  for (std::size_t i = 0; i < system.command_names.size(); ++i)
    if (!system.command_is_length[i]) names.insert(system.command_names[i] + ".rho");
  return names;
}

/// What limits and marks are in is known from the mechanism only.
void add_range_hints(const StudyDraft& study, const std::vector<double>& values,
                     const model::Mechanism& mechanism, std::vector<std::string>& hints) {
  if (study.until.empty() && study.box.empty() && study.marks.empty()) return;
  const std::set<std::string> angles = angles_of(mechanism);
  const auto look = [&](const NamedPlace& quantity, NumberId id) {
    if (angles.contains(quantity.name))
      add_angle_hint(study.numbers.definition(id), values[id], hints);
  };
  for (const std::vector<LimitDraft>* limits : {&study.until, &study.box})
    for (const LimitDraft& limit : *limits)
      for (const NumberId id : {limit.low, limit.high}) look(limit.quantity, id);
  for (const MarkDraft& mark : study.marks) look(mark.quantity, mark.value);
}

/// A joint with the line that it turns about or the direction that it slides along, seen from the begin
/// of the chain with all joints at zero.
struct Line {
  const Joint* joint = nullptr;
  std::size_t element = 0;  ///< of the model's chain
  Vec3<double> through = Vec3<double>::Zero(), along = Vec3<double>::UnitZ();
};

std::vector<Line> lines_of(const model::Chain& chain) {
  std::vector<Line> lines;
  model::Pose<double> at = chain.from_attachment;
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    if (const auto* link = std::get_if<model::RigidLink>(&chain.elements[i]))
      at = at * link->transform;
    else if (const auto* joint = std::get_if<Joint>(&chain.elements[i]))
      lines.push_back({joint, i, at.p, at.R * joint->axis});
  }
  return lines;
}

/// Two joints one after the other that turn about one line, whatever the mechanism does, one of them
/// freely: their angles cannot be told apart.
void add_line_hints(const ChainDraft& draft, const model::Chain& chain,
                    const std::vector<double>& numbers, std::vector<std::string>& hints) {
  const std::vector<Line> lines = lines_of(chain);
  const std::vector<std::size_t> origins = origins_of(draft, numbers);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Line &a = lines[i - 1], &b = lines[i];
    const auto is_elastic = [](const Line& line) {
      return line.joint->role == JointRole::compliant;
    };
    const bool free = a.joint->role == JointRole::passive || b.joint->role == JointRole::passive;
    if (a.joint->kind != JointKind::revolute || b.joint->kind != JointKind::revolute || !free ||
        is_elastic(a) || is_elastic(b))
      continue;
    const Vec3<double> between = b.through - a.through;
    const double size = std::max({1e-300, a.through.norm(), b.through.norm()});
    if (a.along.cross(b.along).norm() > same_direction ||
        between.cross(a.along).norm() > same_direction * size)
      continue;
    const ElementDraft& at = draft.elements[origins[b.element]];
    add_once(hints,
             place_text(at.place, at.key) + ": joints \"" + a.joint->name + "\" and \"" +
                 b.joint->name +
                 "\" turn about one line, there is no length between them (a crank of length "
                 "0?): what one turns the other turns back");
  }
}

bool is_flat_space(TaskSpace space) { return space == TaskSpace::xy || space == TaskSpace::planar; }

/// Do both ends stay in the plane?
bool lies_in_plane(const model::Mechanism& mechanism, const model::Chain& chain) {
  for (const Index body : {chain.from, chain.to})
    if (body > 0 && !is_flat_space(mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space))
      return false;
  return true;
}

}  // namespace

void add_hints(const CaseDraft& draft, std::size_t study, const RunValues& values,
               const model::Mechanism& mechanism, std::vector<std::string>& hints) {
  const auto& [parameters, of_mechanism, of_study] = values;
  add_angle_hints(draft.mechanism.numbers, of_mechanism, draft.book, parameters, hints);
  add_angle_hints(draft.studies[study].numbers, of_study, draft.book, parameters, hints);
  add_range_hints(draft.studies[study], of_study, mechanism, hints);
  for (std::size_t i = 0; i < draft.mechanism.chains.size(); ++i)
    add_line_hints(draft.mechanism.chains[i], mechanism.chains[i], of_mechanism, hints);
}

void check_planes(const MechanismDraft& draft, const std::vector<double>& numbers,
                  const model::Mechanism& mechanism, const std::string& when, Problems& problems) {
  for (std::size_t i = 0; i < draft.chains.size(); ++i) {
    const model::Chain& chain = mechanism.chains[i];
    if (!lies_in_plane(mechanism, chain)) continue;
    const std::vector<std::size_t> origins = origins_of(draft.chains[i], numbers);
    for (const Line& line : lines_of(chain)) {
      const double out = std::abs(line.along.z());
      const bool turns = line.joint->kind == JointKind::revolute;
      if (turns ? out >= 1 - same_direction : out <= same_direction) continue;
      const ElementDraft& at = draft.chains[i].elements[origins[line.element]];
      problems.add(at.place, at.key,
                   "joint \"" + line.joint->name + "\" leads out of the plane in which chain \"" +
                       chain.name + "\" closes, need " +
                       (turns ? "an axis along z" : "an axis in the x-y plane") +
                       ", or bodies in space (\"xyz\", \"spatial\")",
                   when);
    }
  }
}

std::string place_text(const Place& place, const std::string& key) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  return key.empty() ? text : text + ": " + key;
}

std::vector<PartPlace> places_of(const StudyDraft& study, const MechanismDraft& mechanism) {
  std::vector<PartPlace> places{{"", place_text(study.place, study.key)}};
  for (const NamedPlace& entry : study.entries)
    places.push_back({entry.name, place_text(entry.place, study.key + "." + entry.name)});
  for (const BodyDraft& body : mechanism.bodies)
    places.push_back({"body." + body.name, place_text(body.place, body.key)});
  for (const ChainDraft& chain : mechanism.chains)
    places.push_back({"chain." + chain.name, place_text(chain.place, chain.key)});
  return places;
}

}  // namespace springfold::io
