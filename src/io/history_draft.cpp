#include "history_draft.hpp"

#include <algorithm>

#include "hold_draft.hpp"
#include "springfold/analysis/history.hpp"
#include "study_draft.hpp"

namespace springfold::io {
namespace {

constexpr std::size_t most_steps = 16;  ///< studies one after the other, each runs those before it

/// "LP1", "UZ12", "J1": a code of one or two signs and a number.
bool is_label(const std::string& text) {
  const auto upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t code = text.size() > 1 && upper(text[1]) ? 2 : 1;
  return text.size() > code && text.size() <= 12 && upper(text[0]) &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(code), text.end(), digit);
}

/// A joint whose spring is counted from the start pose; empty: none.
std::string counted_from_start(const MechanismDraft& mechanism) {
  for (const ChainDraft& chain : mechanism.chains)
    for (const ElementDraft& element : chain.elements)
      if (const auto* joint = std::get_if<JointDraft>(&element.content); joint && joint->spring)
        if (std::visit([](const auto& spring) { return spring.from_start; }, *joint->spring))
          return chain.name + "." + joint->name;
  return {};
}

/// Holds of all studies, the earlier ones first. @pre no circles
void inherit_all(const MechanismDraft& mechanism, std::vector<StudyDraft>& studies,
                 Problems& problems) {
  std::vector<bool> done(studies.size(), false);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    std::vector<std::size_t> way{i};
    while (!done[way.back()] && studies[way.back()].history.study)
      way.push_back(*studies[way.back()].history.study);
    for (auto at = way.rbegin(); at != way.rend(); ++at) {
      StudyDraft& study = studies[*at];
      if (!done[*at] && study.history.study)
        inherit_holds(mechanism, studies[*study.history.study].history.holds, study, problems);
      done[*at] = true;
    }
  }
}

void check_history(const MechanismDraft& mechanism, const std::vector<StudyDraft>& studies,
                   const StudyDraft& study, Problems& problems) {
  const NamedPlace& at = study.history.from;
  const StudyDraft& earlier = studies[*study.history.study];
  const auto refuse = [&](const std::string& what) { problems.add(at.place, at.key, what); };
  if (!analysis::may_start_after(study.kind))
    return refuse(
        "a workspace is a matter of closed chains alone, which no load step changes, and starts in "
        "no "
        "state: need no from; the assembly is chosen by pose and initial");
  if (!analysis::has_states(earlier.kind))
    return refuse("study \"" + earlier.name + "\" is of kind \"" +
                  std::string(to_string(earlier.kind)) +
                  "\", which has no states of one mechanism to start from, need a study of kind "
                  "\"force_deflection\", \"load_cycle\", \"snap_through\", \"transitions\", "
                  "\"equilibrium\" or \"equilibria\"");
  if (earlier.runs() != 1 && earlier.runs() != study.runs())
    return refuse("study \"" + earlier.name + "\" has " + std::to_string(earlier.runs()) +
                  " runs and this one " + std::to_string(study.runs()) +
                  ", need as many, which go together by their numbers, or one");
  if (const std::string joint = counted_from_start(mechanism); !joint.empty())
    return refuse("the spring of " + joint +
                  " is counted from the start, origin = \"start\", which is no longer this "
                  "study's own, need origin = \"joint\"");
  std::size_t steps = 0;
  const StudyDraft* way = &study;
  while (way->history.study && ++steps <= most_steps) way = &studies[*way->history.study];
  if (steps > most_steps)
    refuse("studies start from each other in a circle, or more than " + std::to_string(most_steps) +
           " one after the other");
}

/// The names of the other studies.
std::vector<std::string> names_without(std::vector<std::string> names, std::size_t own) {
  names.erase(names.begin() + static_cast<std::ptrdiff_t>(own));
  return names;
}

}  // namespace

const std::vector<std::string>& history_keys() {
  static const std::vector<std::string> keys{"from", "at", "loads", "hold", "release"};
  return keys;
}

HistoryDraft read_history(const TableReader& start, const MechanismDraft& mechanism,
                          Reading& reading) {
  HistoryDraft history;
  const auto from = start.has("from") ? start.required_text("from", "the name of another study")
                                      : std::optional<std::string>{};
  if (!start.has("from")) {
    for (const char* key : {"at", "loads", "hold", "release"})
      if (const Node* node = start.find(key))
        reading.problems.add(node->place, start.key_of(key),
                             "goes with from, need from = \"...\", the name of an earlier study");
    return history;
  }
  if (!from) return history;
  history.from = {*from, start.find("from")->place, start.key_of("from")};
  for (const char* key : {"pose", "solve", "solver", "attempts", "seed"})
    if (const Node* node = start.find(key))
      reading.problems.add(node->place, start.key_of(key),
                           "has no meaning with from: the study starts in that state");
  const Node* at = start.find("at");
  if (at != nullptr) history.at = at->text;
  if (history.at != "start" && history.at != "end" && !is_label(history.at))
    reading.problems.add(
        at->place, start.key_of("at"),
        "got " + described(*at) + ", need \"start\", \"end\" or a label such as \"LP1\"");
  history.keeps_loads = start.choice("loads", {"kept", "own"}, 0) == 0;
  for (const Item& item : start.list("hold", "a list of coordinates such as [\"foot.x\"]"))
    read_hold(item, mechanism, history.holds, reading);
  for (const Item& item : start.list("release", "a list of coordinates such as [\"foot.x\"]"))
    read_release(item, mechanism, history, reading);
  return history;
}

void connect_histories(const MechanismDraft& mechanism, std::vector<StudyDraft>& studies,
                       Problems& problems) {
  std::vector<std::string> names;
  for (const StudyDraft& study : studies) names.push_back(study.name);
  for (StudyDraft& study : studies) {
    const NamedPlace& from = study.history.from;
    if (from.name.empty()) continue;
    const auto found = std::find(names.begin(), names.end(), from.name);
    const auto own = static_cast<std::size_t>(&study - studies.data());
    if (found == names.begin() + static_cast<std::ptrdiff_t>(own))
      problems.add(from.place, from.key,
                   "got \"" + from.name + "\", the study itself, need the name of another study" +
                       known_names(names_without(names, own)));
    else if (found == names.end())
      problems.add(from.place, from.key,
                   "got \"" + from.name + "\", need the name of another study" +
                       suggestion(from.name, names_without(names, own)));
    else
      study.history.study = static_cast<std::size_t>(found - names.begin());
  }
  const std::size_t before = problems.size();
  for (const StudyDraft& study : studies)
    if (study.history.study) check_history(mechanism, studies, study, problems);
  if (problems.size() == before) inherit_all(mechanism, studies, problems);
}

}  // namespace springfold::io
