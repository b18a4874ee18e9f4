#include "check_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "draw_command.hpp"
#include "exit_code.hpp"
#include "messages.hpp"
#include "selection.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/shown_text.hpp"
#include "springfold/io/start_text.hpp"

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
  Index coordinates = 0, closures = 0, poses = 0;
  for (const auto& chain : mechanism.chains) {
    closures += model::dimension(model::task_space_of(mechanism, chain));
    for (const auto& element : chain.elements)
      if (const auto* joint = std::get_if<Joint>(&element))
        coordinates += model::has_coordinate(*joint) ? 1 : 0;
  }
  for (const auto& body : mechanism.bodies) poses += model::dimension(body.task_space);
  return fmt::format("  freedom   {}: {} and {} under {}\n",
                     counted(coordinates + poses - closures, "degree") + " of freedom",
                     counted(coordinates, "joint coordinate"), counted(poses, "pose coordinate"),
                     counted(closures, "closure equation"));
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
  return fmt::format("  study     {} ({}{}{}), {}{}\n", io::shown(name),
                     to_string(first->plan.kind),
                     is_curve ? ", control " + std::string(to_string(first->plan.control)) : "",
                     more, counted(runs, "run"), io::shown(labels));
}

}  // namespace

std::string description_of(const io::Case& the_case) {
  std::string text = io::shown(the_case.file.string()) + ": no mistakes found\n";
  if (!the_case.title.empty()) text += "  title     " + io::shown(the_case.title) + "\n";
  text += fmt::format("  units     length {}, force {}\n", io::shown(the_case.units.length),
                      io::shown(the_case.units.force));
  if (!the_case.runs.empty()) {
    const Mechanism& mechanism = the_case.runs.front().mechanism;
    for (const auto& body : mechanism.bodies)
      text += fmt::format("  body      {} ({})\n", body.name, word_of(body.task_space));
    for (const auto& chain : mechanism.chains) text += text_of(mechanism, chain);
    text += freedom_text(mechanism);
  }
  for (const auto& name : study_names(the_case)) text += study_text(the_case, name);
  for (const auto& plot : the_case.plots) text += "  figure    " + plot.name + "\n";
  for (const auto& plot : the_case.map_plots) text += "  figure    " + plot.name + "\n";
  if (!the_case.expected.values.empty())
    text += "  expected  " +
            counted(static_cast<Index>(the_case.expected.values.size()), "compared value") + "\n";
  return text;
}

namespace {

/// "push, run 2 (Kv = 0.01)".
std::string name_of(const io::PlannedRun& planned) {
  return planned.study + ", run " + std::to_string(planned.run) +
         (planned.label.empty() ? "" : " (" + planned.label + ")");
}

/// One line for a start that is found but deserves a word.
std::string remark_on(const analysis::StartReport& start) {
  if (start.free_motions.empty()) return {};
  return fmt::format("nothing resists a motion of {}", start.free_motions);
}

/// Solves the starts of all runs up to a number that is solved in no time.
int check_starts(const io::Case& the_case, const Session& session) {
  constexpr std::size_t most = 50;
  std::size_t tried = 0, found = 0, left_out = 0;
  int code = all_done;
  for (const auto& planned : the_case.runs) {
    if (session.signal() != 0) break;
    if (tried == most) {
      ++left_out;
      continue;
    }
    const auto* family = planned.family ? &*planned.family : nullptr;
    const auto start = analysis::solve_start(planned.mechanism, planned.plan, family);
    if (!start) continue;
    ++tried;
    const bool may_miss = planned.plan.kind == StudyKind::equilibria && !start->found;
    const std::string problem = io::start_problem(*start, &planned);
    if (may_miss)
      session.out << "  remark    " << io::shown(name_of(planned)) << ": none near the guess ("
                  << io::shown(problem) << "); the search looks elsewhere too\n";
    else if (!problem.empty())
      say(session.err,
          name_of(planned) + ": " +
              (start->found ? "nothing would be traced: " : "no trustworthy start point: ") +
              problem);
    if (!problem.empty() && !may_miss) code = no_start_point;
    if (problem.empty()) ++found;
    if (const std::string remark = remark_on(*start); problem.empty() && !remark.empty())
      session.out << "  remark    " << io::shown(name_of(planned) + ": " + remark) << "\n";
  }
  if (tried > 0)
    session.out << "  starts    " << found << " of " << tried << " found"
                << (left_out > 0 ? fmt::format("; {} more runs were not tried", left_out) : "")
                << "\n";
  return session.signal() != 0 ? interrupted_by(session.signal()) : code;
}

}  // namespace

int check_command(const Arguments& arguments, const Session& session) {
  const io::Case the_case =
      io::load_case(arguments.case_file, arguments.overrides, stop_request_of(session));
  session.out << description_of(the_case);
  for (const auto& hint : the_case.hints) session.out << "  hint      " << io::shown(hint) << "\n";
  int code = all_done;
  if (arguments.draws) code = draw_guess(arguments, the_case, session);
  if (arguments.solves_starts && code == all_done) code = check_starts(the_case, session);
  session.out.flush();
  if (session.out.good()) return code;
  say(session.err, "cannot write to standard output");
  return input_output;
}

}  // namespace springfold::cli
