#include "label_layout.hpp"

#include <algorithm>

#include "curve_labels.hpp"
#include "label_scene.hpp"

namespace springfold::io {

namespace {

/// Curves that lie on each other have the same points: one label is enough.
bool is_labelled_already(const Figure& figure, const LabelScene& scene, std::size_t mark) {
  constexpr double near = 14;
  for (std::size_t i = 0; i < mark; ++i)
    if (figure.marks[i].label == figure.marks[mark].label &&
        pixels_between(scene.marks[i].centre, scene.marks[mark].centre) < near)
      return true;
  return false;
}

/// Do two marks of one kind lie on each other? Mirrored points do where the mirror is not shown.
bool is_covered(const Figure& figure, const LabelScene& scene, std::size_t a, std::size_t b) {
  constexpr double near = 3;
  return figure.marks[a].code == figure.marks[b].code &&
         pixels_between(scene.marks[a].centre, scene.marks[b].centre) < near;
}

/// "LP3, LP6": labels of all marks that lie on this one; empty if an earlier one has said them.
std::string shared_label(const Figure& figure, const LabelScene& scene, std::size_t mark) {
  for (std::size_t i = 0; i < mark; ++i)
    if (is_covered(figure, scene, i, mark)) return "";
  std::vector<std::string> labels;
  for (std::size_t i = mark; i < figure.marks.size(); ++i) {
    const std::string& label = figure.marks[i].label;
    const bool is_new = std::find(labels.begin(), labels.end(), label) == labels.end();
    if (is_new && !label.empty() && is_covered(figure, scene, i, mark)) labels.push_back(label);
  }
  std::string text;
  for (const std::string& label : labels) text += (text.empty() ? "" : ", ") + label;
  return text;
}

PlacedLabel placed(const FigureText& text, const LabelCandidate& best) {
  PlacedLabel label{.text = text, .at = best.box.centre};
  label.leader_from = best.anchor;
  label.leader_to = best.box.nearest(best.anchor);
  label.has_leader = needs_leader(best.box, best.anchor);
  return label;
}

LabelCandidate place_of_mark(const LabelScene& scene, const LabelBox& box,
                             const PlotPoint& anchor) {
  LabelCandidate best;
  for (const double gap : {12.0, 18.0, 26.0, 40.0, 60.0, 85.0, 115.0})
    try_around(best, scene, box, anchor, gap, 0.4 * gap);
  return best;
}

}  // namespace

std::vector<PlacedLabel> place_labels(const Figure& figure, const Canvas& canvas) {
  LabelScene scene = label_scene_of(figure, canvas);
  std::vector<PlacedLabel> labels;
  const auto keep = [&](const FigureText& text, const LabelCandidate& best, bool is_curve_label) {
    if (std::any_of(scene.labels.begin(), scene.labels.end(),
                    [&best](const LabelBox& other) { return best.box.overlaps(other, 0); }))
      return;  // two texts on each other: neither could be read
    scene.labels.push_back(best.box);
    labels.push_back(placed(text, best));
    if (labels.back().has_leader)
      scene.leaders.emplace_back(labels.back().leader_from, labels.back().leader_to);
    labels.back().is_curve_label = is_curve_label;
  };
  for (std::size_t i = 0; i < figure.marks.size(); ++i) {
    if (!is_in_frame(scene.marks[i].centre, canvas)) continue;
    if (is_labelled_already(figure, scene, i)) continue;
    const FigureText text{shared_label(figure, scene, i)};
    if (text.text.empty()) continue;
    keep(text, place_of_mark(scene, box_of(text, canvas), scene.marks[i].centre), false);
  }
  const CurveTwins twins = twins_of(scene);
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const FigureText text = shared_curve_label(figure, twins, i);
    if (text.text.empty() || scene.curves[i].empty()) continue;
    keep(text, place_on_curve(scene, twins, box_of(text, canvas), i), true);
  }
  return labels;
}

}  // namespace springfold::io
