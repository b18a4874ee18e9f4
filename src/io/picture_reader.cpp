// [[picture]] tables.
#include <cmath>

#include "compared_quantity.hpp"
#include "plot_look_reader.hpp"
#include "plot_reader.hpp"

namespace springfold::io {
namespace {

const std::vector<std::string> view_words{"xy", "xz", "yz", "perspective"};
const std::vector<std::string> colour_words{"stability", "force", "energy", "none"};

bool is_posture_label(const std::string& text) {
  return text == "start" || text == "end" || text == "guess" || text == "all" ||
         is_event_label(text);
}

/// "press/LP1", the label behind the last slash; a label alone belongs to the study of the table.
PostureSpec split(const std::string& text, const std::string& study) {
  const auto slash = text.rfind('/');
  if (slash == std::string::npos) return {study, text};
  return {text.substr(0, slash), text.substr(slash + 1)};
}

/// The study whose postures are meant where `at` names none: that of the table, or the only one.
std::string usual_study(const TableReader& table, const std::vector<StudyDraft>& studies) {
  if (const auto named = table.text("study")) return *named;
  return studies.size() == 1 ? studies.front().name : "";
}

/// What all postures of a picture share.
struct PictureKeys {
  std::string study{};  ///< of labels alone; may be empty
  Item study_at{};      ///< where it is named; its node may be null
  std::vector<Item> runs{};
};

/// Reads one posture, and checks the runs that it is taken from.
void read_posture(const Item& at, const PictureKeys& shared, const std::vector<StudyDraft>& studies,
                  PictureDraft& draft, Reading& reading) {
  const auto add = [&](const std::string& what) {
    reading.problems.add(at.node->place, at.key, what);
  };
  const std::string example = "a posture such as \"press/LP1\"";
  if (at.node->kind != Node::Kind::text)
    return add("got " + described(*at.node) + ", need " + example);
  const PostureSpec posture = split(at.node->text, shared.study);
  if (!is_posture_label(posture.label))
    return add("got \"" + at.node->text +
               "\", need the label of a special point (\"press/LP1\"), " +
               "\"start\", \"end\", \"guess\" or \"all\", each with its study before a slash");
  if (posture.study.empty())
    return add("got \"" + at.node->text + "\", need its study too, \"press/" + posture.label +
               "\", or the key study");
  const bool is_usual = at.node->text == posture.label && shared.study_at.node;
  const auto study = study_number(posture.study, is_usual ? shared.study_at : at, studies, reading);
  if (!study) return;
  const analysis::StudyKind kind = studies[*study].kind;
  const bool has_postures =
      kind != analysis::StudyKind::map && kind != analysis::StudyKind::workspace;
  if (posture.label != "guess" && !has_postures)
    return add("got \"" + at.node->text +
               "\", need \"guess\": a study of this kind has no labelled postures");
  for (const Item& run : shared.runs) read_run(run, studies[*study], reading);
  if (posture.label != "guess") draft.studies.push_back(*study);
  draft.spec.postures.push_back(posture);
}

/// A number, or a list of them: those that can be numbers of runs, others are reported. Which of them a study
/// has is not looked at.
std::vector<Item> run_items(const TableReader& table, Reading& reading) {
  constexpr double most = 1e6;
  const Node* node = table.find("run");
  if (!node) return {};
  const std::string key = table.key_of("run");
  const std::vector<Item> items = node->kind == Node::Kind::array
                                      ? table.list("run", "a list of numbers of runs")
                                      : std::vector<Item>{{node, key}};
  if (items.empty())
    reading.problems.add(node->place, key,
                         "got an empty list, need the number of a run, or several");
  std::vector<Item> usable;
  for (const Item& item : items) {
    const double number = item.node->number;
    if (item.node->kind == Node::Kind::number && number >= 1 && number <= most &&
        number == std::floor(number))
      usable.push_back(item);
    else
      reading.problems.add(
          item.node->place, item.key,
          "got " + described(*item.node) + ", need the number of a run: 1, 2, ...");
  }
  return usable;
}

PictureDraft read_picture(const Item& item, const std::vector<StudyDraft>& studies,
                          std::set<std::string>& taken, Reading& reading) {
  const TableReader table{*item.node,
                          item.key,
                          {"name", "title", "study", "run", "at", "view", "colour", "formats"},
                          reading};
  PictureDraft draft;
  PictureSpec& spec = draft.spec;
  spec.name = table.required_text("name", "a file name without ending").value_or("");
  check_plot_name(table, spec.name, taken, reading);
  taken.insert(spec.name);
  spec.title = table.text("title").value_or("");
  if (table.has("view")) spec.view = view_words[table.choice("view", view_words, 0)];
  spec.colour = colour_words[table.choice("colour", colour_words, 0)];
  spec.formats = read_formats(table, {"svg", "png", "pdf"}, spec.formats, reading);
  const PictureKeys shared{usual_study(table, studies),
                           {table.find("study"), table.key_of("study")},
                           run_items(table, reading)};
  if (!shared.runs.empty()) spec.runs.clear();
  for (const Item& run : shared.runs) spec.runs.push_back(static_cast<int>(run.node->number));
  if (shared.study_at.node && !shared.study.empty())
    study_number(shared.study, shared.study_at, studies, reading);
  const Node* at = table.require("at", "a posture such as \"press/LP1\", or a list of them");
  if (!at) return draft;
  if (at->kind != Node::Kind::array) {
    read_posture({at, table.key_of("at")}, shared, studies, draft, reading);
    return draft;
  }
  for (const Item& one : table.list("at", "a posture, or a list of them"))
    read_posture(one, shared, studies, draft, reading);
  if (at->items.empty())
    reading.problems.add(at->place, table.key_of("at"),
                         "got an empty list, need at least one posture such as \"press/LP1\"");
  return draft;
}

}  // namespace

std::vector<PictureDraft> read_pictures(const std::vector<Item>& tables,
                                        const std::vector<StudyDraft>& studies,
                                        std::set<std::string> taken, Reading& reading) {
  std::vector<PictureDraft> drafts;
  for (const Item& item : tables) drafts.push_back(read_picture(item, studies, taken, reading));
  return drafts;
}

}  // namespace springfold::io
