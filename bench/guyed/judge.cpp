#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace springfold::guyed {
namespace {

using analysis::Branch;
using analysis::Event;
using analysis::EventKind;
using analysis::StudyResult;

constexpr double one_load = 1e-7;  // part of a load within which two are one
constexpr double place = 1e-9;     // part of the largest load by which an event may be off
constexpr double along = 0.99;     // cosine between a branch's first point and its tangent

struct Columns {
  std::size_t lambda = 0, index = 0;
  std::vector<std::size_t> sways{};
};

std::size_t column(const StudyResult& result, const std::string& name) {
  for (std::size_t i = 0; i < result.quantities.size(); ++i)
    if (result.quantities[i].name == name) return i;
  throw std::runtime_error("no column " + name);
}

Columns columns(const Draw& draw, const StudyResult& result) {
  Columns list{column(result, "lambda"), column(result, "index"), {}};
  for (const Sway& sway : draw.sways) list.sways.push_back(column(result, sway.quantity));
  return list;
}

Vector sway(const Draw& draw, const Columns& columns, const analysis::Sample& row) {
  Vector w(static_cast<Index>(draw.sways.size()));
  for (std::size_t i = 0; i < draw.sways.size(); ++i)
    w[static_cast<Index>(i)] = row.values[columns.sways[i]] - draw.sways[i].upright;
  return w;
}

std::string said(const char* format, double a, double b = 0, double c = 0) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

std::vector<std::string> reasons(const StudyResult& result) {
  std::vector<std::string> list = result.doubts;
  if (!result.start.found) list.push_back("no start: " + result.start.message);
  for (const Branch& branch : result.branches) {
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) list.push_back("stopped: " + stop->reason);
    for (const Event& event : branch.events)
      if (event.kind == EventKind::unresolved) list.push_back(event.detail);
  }
  if (list.empty() && !complete(result)) list.push_back("not complete");
  return list;
}

/// All that leaves at one load, or so near to it that it may be told as one.
using Group = std::vector<HalfBranch>;

std::vector<Group> groups(const Truth& truth, const Draw& draw) {
  std::vector<Group> list;
  for (const HalfBranch& branch : truth.leaving) {
    if (branch.load < draw.from || branch.load > draw.to) continue;
    if (list.empty() || branch.load - list.back().front().load > one_load * branch.load)
      list.emplace_back();
    list.back().push_back(branch);
  }
  return list;
}

struct Judge {
  const Draw& draw;
  const StudyResult& result;
  const Truth& truth;
  Columns at;
  std::vector<std::string> faults{};

  double load(std::size_t row) const { return result.branches[0].samples[row].values[at.lambda]; }

  void rows() {
    std::size_t wrong = 0;
    std::string first;
    for (const auto& row : result.branches[0].samples) {
      const double P = row.values[at.lambda], told = row.values[at.index];
      const double nearby = one_load * draw.to;
      const int expected = truth.index(P);
      if (sway(draw, at, row).norm() > 1e-7) {
        faults.push_back(said("sways by %.3g at %.12g", sway(draw, at, row).norm(), P));
        return;
      }
      if (truth.index(P - nearby) != truth.index(P + nearby) || !row.event.empty()) continue;
      if (told == expected) continue;
      if (wrong++ == 0) first = said("index %g at %.12g instead of %g", told, P, expected);
    }
    if (wrong > 0) faults.push_back(first + said(", in %g rows", static_cast<double>(wrong)));
  }

  /// Directions in which the result's branches leave an event, or come to it from another one.
  std::vector<Vector> directions(const std::string& label) const {
    std::vector<Vector> list;
    const auto add = [&](const Branch& branch, std::size_t row) {
      if (row >= branch.samples.size()) return;  // also before the first one
      const Vector w = sway(draw, at, branch.samples[row]);
      if (w.norm() > 0) list.push_back(w.normalized());
    };
    for (std::size_t b = 1; b < result.branches.size(); ++b) {
      const Branch& branch = result.branches[b];
      if (branch.origin == label) add(branch, 1);
      for (const Event& event : branch.events) {
        if (event.label != label || event.row == 0) continue;
        add(branch, event.row - 1);
        add(branch, event.row + 1);
      }
    }
    return list;
  }

  bool is_at(const HalfBranch& branch, double P) const {
    return std::abs(branch.load - P) <= place * draw.to;
  }

  /// Takes what an event tells from its group: all of it, or what leaves at just this load. Loads may be nearer than
  /// events are placed: an event tells of them as many as it has ways, and the others are told by the next one, or
  /// missed.
  void compare(Group& group, double P, const std::string& label) {
    const std::vector<Vector> found = directions(label);
    const bool all = found.size() == group.size();
    const auto belongs = [&](const HalfBranch& branch) { return all || is_at(branch, P); };
    const auto here = static_cast<std::size_t>(std::count_if(group.begin(), group.end(), belongs));
    if (found.size() > here || found.empty())
      faults.push_back(said("%g ways out at %.12g instead of %g", static_cast<double>(found.size()),
                            P, static_cast<double>(here)));
    for (const Vector& way : found) {
      auto best = group.end();
      for (auto it = group.begin(); it != group.end(); ++it)
        if (belongs(*it) &&
            (best == group.end() || it->direction.dot(way) > best->direction.dot(way)))
          best = it;
      if (best == group.end()) return;
      if (best->direction.dot(way) < along)
        faults.push_back(
            said("direction at %.12g is off, cosine %.6g", P, best->direction.dot(way)));
      group.erase(best);
    }
  }

  void events() {
    std::vector<Group> expected = groups(truth, draw);
    for (const Event& event : result.branches[0].events) {
      const double P = load(event.row);
      if (event.kind == EventKind::end_of_range || event.kind == EventKind::unresolved) continue;
      const bool leaves =
          event.kind == EventKind::branch_point || event.kind == EventKind::branching_kink;
      const auto same = std::find_if(expected.begin(), expected.end(), [&](const Group& group) {
        return std::any_of(group.begin(), group.end(),
                           [&](const HalfBranch& branch) { return is_at(branch, P); });
      });
      if (!leaves || same == expected.end())
        faults.push_back(event.label + said(" at %.12g is none: ", P) + event.detail);
      else
        compare(*same, P, event.label);
    }
    for (const Group& missed : expected)
      if (!missed.empty())
        faults.push_back(said("missed at %.12g: %g ways", missed.front().load,
                              static_cast<double>(missed.size())));
  }
};

std::vector<std::string> faults(const Draw& draw, const StudyResult& result, double at_rest) {
  if (result.branches.empty()) return {};
  const Truth true_state = truth(draw.structure, at_rest);
  Judge judge{draw, result, true_state, columns(draw, result)};
  judge.rows();
  judge.events();
  return judge.faults;
}

/// What is missing may be excused by what was left open; what is told must be right.
bool is_missing(const std::string& fault) {
  return fault.starts_with("missed") || fault.find(" ways out at ") != std::string::npos ||
         fault.starts_with("index nan") || fault.starts_with("index -nan");
}

}  // namespace

Verdict judge(const Draw& draw, const StudyResult& result) {
  constexpr double rounding = 1e-15;  // stretches that are zero in the case
  Verdict verdict{.reasons = reasons(result), .faults = faults(draw, result, rounding)};
  // Where each pair has its own, some of them may be as small.
  if (!verdict.faults.empty() && !(std::abs(draw.pretension) >= told_as_resting)) {
    const auto others = faults(draw, result, told_as_resting);
    if (others.size() < verdict.faults.size()) verdict.faults = others;
  }
  const bool excused = std::all_of(verdict.faults.begin(), verdict.faults.end(), is_missing);
  if (!verdict.reasons.empty() && excused)
    verdict.outcome = Outcome::unresolved;
  else if (!verdict.faults.empty())
    verdict.outcome = Outcome::wrong;
  return verdict;
}

}  // namespace springfold::guyed
