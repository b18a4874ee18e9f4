#include "memory_limits.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/analysis/row_memory.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::most_memory;
using analysis::StudyKind;

/// Measured: 500 runs of 5,000 segments with three directions take 340 bytes for each of their joints
/// and links, names of columns and matrices of the springs included.
constexpr double bytes_per_element = 400;
constexpr double bytes_per_run = 4000, bytes_per_parameter = 150;

/// Measured: tracing a long chain takes 5.3 to 6 kB times the square of a segment's directions, 54 kB in the plane
/// and 175 kB in space, and 24 to 39 kB for a joint by itself.
constexpr double working_bytes_of_segment = 6e3, working_bytes_of_joint = 4e4;

/// A step holds several matrices of all unknowns at a time: derivatives, their factors, copies of both.
constexpr double dense_matrices = 8;

/// Chains with more unknowns are worked on stage by stage, without a matrix of entries.
constexpr double longest_dense_chain = 48;

std::string in_words(double bytes) {
  if (!(bytes < 1e15)) return "more memory than any machine has";
  return bytes < 1e9 ? rounded(bytes / 1e6, 2) + " MB" : rounded(bytes / 1e9, 2) + " GB";
}

const std::string at_most = ", need at most " + in_words(most_memory);

/// Joints and links of all chains with these parameters, and the link with most segments.
struct Size {
  double elements = 0;
  double working_bytes = 0;  ///< for one run at a time
  double most_segments = 0;
  NumberId segments = 0;  ///< of that link
};

double segments_of(const ElasticDraft& link, const CaseDraft& draft, const Values& parameters) {
  const Definition& definition = draft.mechanism.numbers.definition(link.segments);
  double value = definition.constant;
  if (definition.formula) value = draft.book.value(*definition.formula, parameters.values);
  return value >= 1 && value <= 1e6 ? value : 1;  // others are refused
}

Size size_of(const CaseDraft& draft, const Values& parameters) {
  Size size;
  for (const ChainDraft& chain : draft.mechanism.chains)
    for (const ElementDraft& element : chain.elements) {
      const auto* link = std::get_if<ElasticDraft>(&element.content);
      const double segments = link ? segments_of(*link, draft, parameters) : 1;
      const auto directions = link ? static_cast<double>(link->directions.size()) : 0;
      size.elements += link ? segments * (1 + directions) : 1;
      if (link) size.working_bytes += segments * working_bytes_of_segment * directions * directions;
      if (std::holds_alternative<JointDraft>(element.content))
        size.working_bytes += working_bytes_of_joint;
      if (!link || segments <= size.most_segments) continue;
      size.most_segments = segments;
      size.segments = link->segments;
    }
  return size;
}

bool has_formula(const CaseDraft& draft) {
  for (const ChainDraft& chain : draft.mechanism.chains)
    for (const ElementDraft& element : chain.elements)
      if (const auto* link = std::get_if<ElasticDraft>(&element.content))
        if (draft.mechanism.numbers.definition(link->segments).formula) return true;
  return false;
}

NamedPlace place_of(const StudyDraft& study, const std::string& name) {
  const auto entry = std::find_if(study.entries.begin(), study.entries.end(),
                                  [&name](const NamedPlace& e) { return e.name == name; });
  if (entry == study.entries.end()) return {name, study.place, study.key};
  return {name, entry->place, study.key + "." + name};
}

/// Mechanisms of all runs stand side by side, one is worked on. @returns whether they fit, with what there is already
bool check_runs(const CaseDraft& draft, const StudyDraft& study, bool varies, double& bytes,
                Problems& problems) {
  Problems ignored;  // formulas that are not defined are reported by check_numbers
  double largest = 0;
  Size size;
  for (int run = 1; run <= study.runs(); ++run) {
    if (run == 1 || varies)
      size =
          size_of(draft, evaluate(draft.parameters, study.changes(run), draft.book, "", ignored));
    largest = std::max(largest, size.elements);
    bytes += bytes_per_run + bytes_per_parameter * static_cast<double>(draft.parameters.size()) +
             bytes_per_element * size.elements;
    if (bytes + size.working_bytes <= most_memory) continue;
    const double all = bytes / run * study.runs() + size.working_bytes;
    const std::string parts = rounded(largest, 9) + " joints and links";
    if (study.runs() > 1) {
      const NamedPlace at =
          place_of(study, study.vary && study.vary->parameters.size() > 1 ? "vary" : "vary.values");
      problems.add(at.place, at.key,
                   "got " + std::to_string(study.runs()) + " runs of a mechanism with " + parts +
                       ", about " + in_words(all) + " of memory" + at_most +
                       ": fewer values, or fewer segments");
    } else if (size.most_segments > 1) {
      const Definition& at = draft.mechanism.numbers.definition(size.segments);
      problems.add(at.place, at.key,
                   "the mechanism has " + parts + ", about " + in_words(all) +
                       " of memory with all studies" + at_most + ": fewer segments");
    } else {
      problems.add(study.place, study.key,
                   "the mechanism has " + parts + ", about " + in_words(all) +
                       " of memory with all studies" + at_most + ": fewer studies");
    }
    return false;
  }
  return true;
}

/// Unknowns that no chain has for itself stand in matrices of entries.
void check_dense(const CaseDraft& draft, Problems& problems) {
  double unknowns = 0;
  for (const BodyDraft& body : draft.mechanism.bodies)
    unknowns += static_cast<double>(model::dimension(body.task_space));
  for (const ChainDraft& chain : draft.mechanism.chains) {
    const double own = 6 + static_cast<double>(chain.elements.size());
    if (own < longest_dense_chain) unknowns += own;
  }
  const auto add_series = [&unknowns](const std::optional<SeriesDraft>& series) {
    if (series) unknowns += static_cast<double>(series->laws.size()) - 1;
  };
  for (const ShapeSpringDraft& spring : draft.mechanism.shape_springs) {
    add_series(spring.series);
    if (spring.shape.turns) unknowns += 8;  // two chains of two joints
  }
  for (const BarDraft& bar : draft.mechanism.bars) add_series(bar.series);
  const double bytes = dense_matrices * sizeof(double) * unknowns * unknowns;
  if (bytes <= most_memory) return;
  const BodyDraft& at = draft.mechanism.bodies.front();
  problems.add(at.place, at.key,
               "bodies and chains have about " + rounded(unknowns, 6) +
                   " unknowns together, which take about " + in_words(bytes) + " of memory" +
                   at_most + ": fewer bodies and chains");
}

}  // namespace

void check_memory(const CaseDraft& draft, Problems& problems) {
  if (draft.mechanism.bodies.empty()) return;
  check_dense(draft, problems);
  const bool varies = has_formula(draft);
  double bytes = 0;
  for (const StudyDraft& study : draft.studies)
    if (!check_runs(draft, study, varies, bytes, problems)) return;
}

void RowCounter::add(const PlannedRun& planned, std::size_t columns, const StudyDraft& study,
                     Problems& problems) {
  const analysis::Study& plan = planned.plan;
  const double row = analysis::bytes_of_row(columns);
  if (plan.kind == StudyKind::map || plan.kind == StudyKind::control) {
    const bool is_map = plan.kind == StudyKind::map;
    double rows = is_map ? 1 : plan.targets.count();
    if (is_map)
      for (const analysis::MapAxis& axis : plan.map.axes) rows *= axis.points;
    const bool fitted = bytes_ <= most_memory;
    bytes_ += rows * row;
    if (fitted && bytes_ > most_memory) {
      const NamedPlace at = place_of(study, is_map ? "axes" : "targets");
      problems.add(at.place, at.key,
                   "got " + rounded(rows, 9) + (is_map ? " nodes" : " targets") + " with " +
                       std::to_string(columns) + " columns, with all runs about " +
                       in_words(bytes_ / planned.run * study.runs()) + " of memory" + at_most +
                       ": fewer points, or fewer runs");
    }
  }
  if (plan.trace.spacing == 0 || analysis::is_of_commands(plan.kind)) return;
  const double of_a_step = plan.trace.maximum_step / plan.trace.spacing;
  if (of_a_step * row <= most_memory) return;
  const NamedPlace at = place_of(study, "trace.spacing");
  problems.add(at.place, at.key,
               "got " + shortest(plan.trace.spacing) + ": the rows within one step of " +
                   rounded(plan.trace.maximum_step, 6) + " take " + in_words(of_a_step * row) +
                   at_most + ", so a spacing of " +
                   rounded(plan.trace.maximum_step * row / most_memory, 1) + " or more");
}

}  // namespace springfold::io
