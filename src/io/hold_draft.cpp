#include "hold_draft.hpp"

#include <algorithm>

#include "study_draft.hpp"

namespace springfold::io {
namespace {

std::vector<std::string> coordinates_of(const MechanismDraft& mechanism) {
  std::vector<std::string> names;
  for (const BodyDraft& body : mechanism.bodies)
    for (std::size_t i = 0; i < body.pose.size() && i < 3; ++i)
      if (body.task_space == model::TaskSpace::xy || body.task_space == model::TaskSpace::xyz)
        names.push_back(body.name + "." + "xyz"[i]);
  return names;
}

/// "foot.x": body 1, 2, ... and coordinate; reports others.
std::optional<ReleaseDraft> read_coordinate(const Item& item, const MechanismDraft& mechanism,
                                            Reading& reading) {
  const std::string& text = item.node->text;
  const std::vector<std::string> known = coordinates_of(mechanism);
  if (std::find(known.begin(), known.end(), text) == known.end()) {
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) +
                             ", need a coordinate of a node, or of a body with task space "
                             "\"xy\" or \"xyz\", such as \"foot.x\"" +
                             suggestion(text, known));
    return std::nullopt;
  }
  const auto body = std::find_if(
      mechanism.bodies.begin(), mechanism.bodies.end(),
      [name = text.substr(0, text.size() - 2)](const BodyDraft& b) { return b.name == name; });
  return ReleaseDraft{.at = {text, item.node->place, item.key},
                      .body = body - mechanism.bodies.begin() + 1,
                      .coordinate = static_cast<std::size_t>(text.back() - 'x')};
}

const BodyDraft& body_of(const MechanismDraft& mechanism, Index number) {
  return mechanism.bodies[static_cast<std::size_t>(number - 1)];
}

/// The hold of this body, none so far if there is none.
HoldDraft& hold_of(const MechanismDraft& mechanism, Index body, std::vector<HoldDraft>& holds) {
  const auto hold = std::find_if(holds.begin(), holds.end(),
                                 [body](const HoldDraft& h) { return h.body == body; });
  if (hold != holds.end()) return *hold;
  const BodyDraft& held = body_of(mechanism, body);
  holds.push_back({body, std::vector<bool>(held.pose.size(), false), held.name + ".hold",
                   std::vector<std::string>(held.pose.size())});
  return holds.back();
}

/// "foot.x", ...: what is held.
std::vector<std::string> held_names(const MechanismDraft& mechanism,
                                    const std::vector<HoldDraft>& holds) {
  std::vector<std::string> names;
  for (const HoldDraft& hold : holds)
    for (std::size_t i = 0; i < hold.held.size(); ++i)
      if (hold.held[i]) names.push_back(body_of(mechanism, hold.body).name + "." + "xyz"[i]);
  return names;
}

/// Gives up what the study releases of what the study before holds; reports what that does not hold.
void release(const MechanismDraft& mechanism, const HistoryDraft& history,
             std::vector<HoldDraft>& holds, Problems& problems) {
  const std::vector<std::string> held = held_names(mechanism, holds);
  for (const ReleaseDraft& release : history.releases) {
    if (std::find(held.begin(), held.end(), release.at.name) == held.end())
      problems.add(release.at.place, release.at.key,
                   "got \"" + release.at.name + "\", which study \"" + history.from.name +
                       "\" does not hold, need " +
                       (held.empty() ? "no release: it holds nothing" : choices(held)));
    else
      hold_of(mechanism, release.body, holds).held[release.coordinate] = false;
  }
  std::erase_if(holds, [](const HoldDraft& hold) {
    return std::find(hold.held.begin(), hold.held.end(), true) == hold.held.end();
  });
}

}  // namespace

void read_hold(const Item& item, const MechanismDraft& mechanism, std::vector<HoldDraft>& holds,
               Reading& reading) {
  const auto found = read_coordinate(item, mechanism, reading);
  if (!found) return;
  HoldDraft& hold = hold_of(mechanism, found->body, holds);
  const std::vector<std::string>& fixed = body_of(mechanism, found->body).fixed;
  const bool is_fixed = std::find(fixed.begin(), fixed.end(),
                                  found->at.name.substr(found->at.name.size() - 1)) != fixed.end();
  if (is_fixed || hold.held[found->coordinate])
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", which is " +
                             (is_fixed ? "fixed already" : "named twice") + ", need others");
  hold.held[found->coordinate] = true;
}

void read_release(const Item& item, const MechanismDraft& mechanism, HistoryDraft& history,
                  Reading& reading) {
  const auto found = read_coordinate(item, mechanism, reading);
  if (!found) return;
  const auto refuse = [&](const std::string& what) {
    reading.problems.add(item.node->place, item.key,
                         "got " + described(*item.node) + ", which is " + what);
  };
  for (const HoldDraft& hold : history.holds)
    if (hold.body == found->body && hold.held[found->coordinate])
      return refuse("held by this study too, need hold or release");
  for (const ReleaseDraft& other : history.releases)
    if (other.at.name == found->at.name) return refuse("named twice, need others");
  history.releases.push_back(*found);
}

void inherit_holds(const MechanismDraft& mechanism, const std::vector<HoldDraft>& before,
                   StudyDraft& study, Problems& problems) {
  std::vector<HoldDraft> holds = before;
  release(mechanism, study.history, holds, problems);
  for (const HoldDraft& own : study.history.holds) {
    HoldDraft& hold = hold_of(mechanism, own.body, holds);
    for (std::size_t i = 0; i < own.held.size(); ++i) {
      if (own.held[i] && !hold.held[i]) hold.since[i] = study.name;
      hold.held[i] = hold.held[i] || own.held[i];
    }
  }
  study.history.holds = std::move(holds);
}

void add_holds(const HistoryDraft& history, model::Mechanism& mechanism) {
  for (const HoldDraft& hold : history.holds)
    analysis::hold(hold.body, hold.held, "hold", mechanism);
}

analysis::History history_of(const HistoryDraft& history, const MechanismDraft& mechanism) {
  analysis::History built;
  for (const HoldDraft& hold : history.holds) built.held.push_back(hold.chain);
  for (const ReleaseDraft& release : history.releases)
    built.released.push_back({release.body, static_cast<Index>(release.coordinate),
                              body_of(mechanism, release.body).name + ".hold"});
  return built;
}

std::string held_drive(const HistoryDraft& history, const MechanismDraft& mechanism,
                       const PlannedRun& planned) {
  const analysis::Study& study = planned.plan;
  const auto hold = std::find_if(history.holds.begin(), history.holds.end(),
                                 [&study](const HoldDraft& h) { return h.body == study.body; });
  const bool drives =
      study.kind == analysis::StudyKind::force_deflection || is_of_critical_points(study.kind);
  if (hold == history.holds.end() || !drives) return {};
  std::string held, since;
  bool also_free = false;
  const bool drives_all = study.control == analysis::ControlMode::pose;
  for (Index i = 0; i < study.direction.size(); ++i) {
    const auto coordinate = static_cast<std::size_t>(i);
    if (study.direction[i] == 0 && !drives_all) continue;
    also_free = also_free || !hold->held[coordinate];
    if (!hold->held[coordinate] || !held.empty()) continue;
    held = body_of(mechanism, hold->body).name + "." + "xyz"[coordinate];
    since = hold->since[coordinate];
  }
  if (held.empty()) return {};
  if (drives_all)
    return "control: \"pose\" drives all of the body, and study \"" + since + "\" holds " + held +
           ": need \"mixed\", which drives along the direction alone, " +
           (since == study.name ? "or no hold" : "or start.release = [\"" + held + "\"]");
  const std::string which = held + ", which study \"" + since + "\" holds: need ";
  const std::string help = since == study.name
                               ? "another direction, or no hold"
                               : "another direction, or start.release = [\"" + held + "\"]";
  if (study.control == analysis::ControlMode::mixed) return "direction: drives " + which + help;
  const bool others = std::any_of(planned.mechanism.loads.begin(), planned.mechanism.loads.end(),
                                  [](const model::Load& load) { return load.with_lambda; });
  if (study.control == analysis::ControlMode::load && !also_free && !others)
    return "direction: pushes only on " + which + help;
  return {};
}

}  // namespace springfold::io
