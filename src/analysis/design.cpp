// The study kind `design`: the least changes of parameters with which requirements are met.
#include "springfold/analysis/design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "beside_answer.hpp"
#include "critical_runs.hpp"
#include "design_search.hpp"
#include "first_unwanted.hpp"
#include "parameter_rules.hpp"
#include "run_kinds.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

/// Rows of the traced path may miss a range by this much, relative: it is known between nodes by interpolation.
constexpr double between_nodes = 1e-6;
constexpr int digits = 10;

std::string bound_text(const FoundParameter& parameter) {
  return parameter.name + " at its " +
         (parameter.bound == BoundState::at_low ? "lower bound " + rounded(parameter.low, digits)
                                                : "upper bound " + rounded(parameter.high, digits));
}

/// Bounds of each parameter no farther than the case may be given with it alone. What they measure by stays.
/// @param left_out  gets what is left out, and by which rule
Study within_rules(Study study, std::vector<std::string>& left_out) {
  const CaseFamily& cases = *study.critical.cases;
  for (DesignParameter& parameter : study.design.parameters) {
    const auto at = std::find(cases.names.begin(), cases.names.end(), parameter.name);
    const RuledRange rules = range_within_rules(
        cases, static_cast<std::size_t>(at - cases.names.begin()), parameter.low, parameter.high);
    if (!rules.is_cut()) continue;
    for (std::string& text : words_of_cut(rules, parameter.name, parameter.low, parameter.high))
      left_out.push_back(std::move(text));
    const double value = cases.values[static_cast<std::size_t>(at - cases.names.begin())];
    if (!(parameter.unit > 0) && value == 0) parameter.unit = parameter.high - parameter.low;
    parameter.low = rules.low;
    parameter.high = rules.high;
  }
  return study;
}

class Design {
 public:
  Design(const Study& study, const std::vector<std::string>& left_out, const Observer& observer,
         StudyResult& result)
      : study_{study},
        left_out_{left_out},
        observer_{observer},
        result_{result},
        search_{study, observer} {}

  void run() {
    const DesignPath before(path_case(), search_.values(Vector::Zero(count())));
    result_.start = before.base().report;
    if (!before.has_start()) return;
    FoundDesign found = search_.run();
    if (rests_on_rounding(found)) {
      found.status = DesignStatus::unresolved;
      found.why =
          "a requirement holds only because a parameter is moved by rounding, and not without "
          "that: either the parameter breaks a branch point, and an imperfection cannot be a "
          "parameter of a design, or the search has ended on an edge; other bounds, or another "
          "value in the case, begin it elsewhere";
    }
    report_.status = found.status;
    report_.change = search_.size_of(found.changes);
    report_.optimality = found.optimality;
    add_parameters(found);
    add_requirements(found);
    verify(found);
    say(found);
    const bool is_met =
        found.status == DesignStatus::met || found.status == DesignStatus::met_at_start;
    report_.message += confirmed_;
    if (is_met && !report_.verified) report_.message += ", not confirmed by tracing it again";
    for (const std::string& text : left_out_) report_.message += "; " + text;
    report_.designs = search_.designs();
    add_columns(before.base());
    draw(search_.values(Vector::Zero(count())));
    draw(search_.values(found.changes));
    label();
    if (found.status == DesignStatus::unresolved) result_.doubts.push_back(report_.message);
    result_.design = std::make_shared<const DesignReport>(std::move(report_));
  }

 private:
  Index count() const { return std::ssize(study_.design.parameters); }
  /// The study without the marks of its requirements.
  DesignCase path_case() const {
    DesignCase plain = search_.requirements().designs();
    plain.study.marks = study_.marks;
    return plain;
  }

  void add_parameters(const FoundDesign& found) {
    const Vector before = search_.values(Vector::Zero(count()));
    const Vector after = search_.values(found.changes);
    for (Index i = 0; i < count(); ++i) {
      const DesignParameter& of = study_.design.parameters[static_cast<std::size_t>(i)];
      FoundParameter parameter{.name = of.name,
                               .before = before[i],
                               .after = std::clamp(after[i], of.low, of.high),
                               .low = of.low,
                               .high = of.high,
                               .change = found.changes[i]};
      if (!found.bounds.empty()) parameter.bound = found.bounds[static_cast<std::size_t>(i)];
      report_.parameters.push_back(parameter);
    }
  }

  void add_requirements(const FoundDesign& found) {
    const auto first = search_.first_ways();
    const auto before = search_.judge(Vector::Zero(count()), first);
    const auto after = search_.judge(found.changes, first);
    report_.requirements = after ? after->requirements : search_.requirements().unknown();
    for (std::size_t i = 0; i < report_.requirements.size(); ++i)
      report_.requirements[i].before =
          before ? before->requirements[i].after : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < found.limiting.size(); ++i) {
      FoundRequirement& one = report_.requirements[found.limiting[i]];
      one.limits = true;
      one.multiplier = found.multipliers[i];
      report_.limits.push_back(one.name);
    }
    for (const FoundParameter& parameter : report_.parameters)
      if (parameter.bound != BoundState::free) report_.limits.push_back(bound_text(parameter));
  }

  bool all_hold(const std::vector<FoundRequirement>& requirements) const {
    return std::all_of(requirements.begin(), requirements.end(),
                       [](const FoundRequirement& one) { return one.holds; });
  }

  /// Are requirements met by changes of nothing but rounding, and not without them?
  bool rests_on_rounding(const FoundDesign& found) {
    constexpr double rounding_change = 1e-12;  // of a parameter's unit
    if (found.status != DesignStatus::met) return false;
    Vector changes = found.changes;
    // What a jump needs is told by its distance from it, and what a parameter needs that is said to be at its bound by
    // the bound.
    for (Index i = 0; i < changes.size(); ++i) {
      const bool at_bound = found.bounds[static_cast<std::size_t>(i)] != BoundState::free;
      const double nothing = found.jumps || at_bound ? nearest_beside : rounding_change;
      if (std::abs(changes[i]) < nothing) changes[i] = 0;
    }
    if (changes == found.changes) return false;
    const auto holds_at = [&](const Vector& at) {
      const auto there = search_.judge(at, search_.first_ways());
      return there && all_hold(there->requirements);
    };
    if (holds_at(changes)) return false;
    // On a limit whether it is met is rounding itself: a little inside by what was really changed it is not.
    const bool is_open =
        std::any_of(changes.begin(), changes.end(), [](double c) { return c != 0; });
    if (!is_open) return true;
    Vector inside = search_.inwards(found, nearest_beside);
    for (Index i = 0; i < inside.size(); ++i)
      if (changes[i] == 0) inside[i] = 0;
    return !holds_at(changes + inside);
  }

  /// The path of the answer is traced again; where limit points are born there, the one a little inside too.
  void verify(const FoundDesign& found) {
    if (found.status != DesignStatus::met && found.status != DesignStatus::met_at_start) return;
    report_.verified = all_hold(report_.requirements);
    const bool climbs = std::any_of(
        found.limiting.begin(), found.limiting.end(),
        [&](std::size_t i) { return i < found.ways.size() && found.ways[i] == Way::climbing; });
    const bool is_birth = climbs && !found.jumps;
    if (is_birth) verify_birth(found);
    const Vector values = search_.values(found.changes);
    const DesignPath path(search_.requirements().designs(), values);
    doubt_unstable_start(found, is_birth, path);
    doubt_broken_rule(found);
    doubt_jump_of_start(values, path);
    const bool rows_fit = check_rows(found);
    if (!rows_fit) report_.verified = false;
    if (!report_.verified)
      result_.doubts.push_back("traced again, the path does not confirm the design: " +
                               cause(is_birth, rows_fit));
  }

  /// On the limit itself limit points are one to rounding: what counts is the designs beside it.
  void verify_birth(const FoundDesign& found) {
    const auto beside = [&](double inwards) {
      const Vector way = search_.inwards(found, std::abs(inwards));
      const Vector changes = found.changes + (inwards < 0 ? Vector(-way) : way);
      return search_.judge(changes, search_.first_ways());
    };
    const auto distance = confirmed_beside([&](double inwards) -> std::optional<bool> {
      const auto there = beside(inwards);
      return there ? std::optional{all_hold(there->requirements)} : std::nullopt;
    });
    report_.verified = distance.has_value();
    if (!distance) return;
    confirmed_ = words_of_distance(*distance);
    const auto inside = beside(*distance);
    for (const std::size_t i : found.limiting)
      report_.requirements[i] = merged(report_.requirements[i], *inside, i);
  }

  /// A path that begins unstable has no first critical load, and is reached by no load from its start: what is wanted
  /// of it is met in words only. Where limit points merge at the start itself its stability on the limit is rounding.
  /// @param path  of the answer
  void doubt_unstable_start(const FoundDesign& found, bool is_birth, const DesignPath& path) {
    if (!search_.requirements().needs_path()) return;
    const auto modes_of = [&](const DesignPath& of) {
      return of.has_start() ? unstable_at_start(of.base(), study_.critical)
                            : std::optional<Index>{};
    };
    const auto inside = [&] {
      return search_.values(found.changes + search_.inwards(found, nearest_beside));
    };
    const auto modes =
        is_birth ? modes_of({search_.requirements().designs(), inside()}) : modes_of(path);
    if (modes && *modes > 0)
      result_.doubts.push_back(
          "the start of this design is unstable itself: stability is lost before the path begins");
  }

  /// Each parameter is within its bounds, but some rules are for several numbers.
  void doubt_broken_rule(const FoundDesign& found) {
    const Vector values = search_.values(found.changes);
    const std::vector<std::size_t>& numbers = search_.requirements().designs().numbers;
    std::vector<std::pair<std::size_t, double>> together;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      together.emplace_back(numbers[i], values[static_cast<Index>(i)]);
    const Variant answer = study_.critical.cases->at(together);
    const std::string rule = broken_rule(answer.mechanism, as_curve(answer.study));
    if (rule.empty()) return;
    report_.verified = false;
    result_.doubts.push_back("a case with the values of this design may not be given: " + rule);
  }

  /// The case with the values of the design may begin in another state, far away, that asks for nothing.
  void doubt_jump_of_start(const Vector& values, const DesignPath& path) {
    if (!path.has_start()) return;
    if (const auto part = jump_of_start(search_.requirements().designs(), values, path.base()))
      result_.doubts.push_back(
          "the start of this design is not that of the case: on the way there, when " +
          rounded(100 * *part, digits) + " % of the changes are made, that one vanishes");
  }

  /// Why an answer is not confirmed.
  std::string cause(bool is_birth, bool rows_fit) const {
    for (const FoundRequirement& one : report_.requirements)
      if (!one.holds)
        return one.name + (std::isnan(one.after) ? " has no value there" : " does not hold there");
    if (!rows_fit) return "a row of the path lies off the mean by more than is allowed";
    return is_birth ? "limit points are not born beside it" : "it could not be followed";
  }

  static FoundRequirement merged(FoundRequirement on, const Assessment& inside, std::size_t i) {
    on.holds = true;
    on.after = inside.requirements[i].after;
    return on;
  }

  /// Does every row of the traced path within the range keep near the mean?
  bool check_rows(const FoundDesign& found) {
    if (!study_.design.constant) return true;
    const ConstantRequirement& wanted = *study_.design.constant;
    double mean = 0;
    for (const FoundRequirement& one : report_.requirements)
      if (one.name == "constant.mean") mean = one.after;
    DesignPath path(search_.requirements().designs(), search_.values(found.changes));
    path.trace(observer_);
    const auto& quantities = path.base().quantities();
    const auto along =
        static_cast<std::size_t>(path.base().quantity(wanted.along) - quantities.data());
    const auto of =
        static_cast<std::size_t>(path.base().quantity(wanted.quantity) - quantities.data());
    int rows = 0;
    for (const Sample& row : path.path().branch.samples) {
      const double x = row.values[along];
      if (!(wanted.from <= x && x <= wanted.to)) continue;
      ++rows;
      if (!(std::abs(row.values[of] - mean) <= (wanted.within + between_nodes) * std::abs(mean)))
        return false;
      if (x >= wanted.to) break;  // only the first passage counts
    }
    return rows > 0;
  }

  void say(const FoundDesign& found) {
    std::string limits;
    for (const std::string& one : report_.limits) limits += (limits.empty() ? "" : ", ") + one;
    switch (found.status) {
      case DesignStatus::met_at_start:
        report_.message = "the case meets all requirements as it is";
        return;
      case DesignStatus::met:
        report_.message = "met with changes of " + rounded(report_.change, digits) +
                          (limits.empty() ? "" : ", decided by: " + limits);
        if (found.jumps) report_.message += ", where a requirement jumps";
        if (!found.is_least) report_.message += "; not shown to be the least change";
        return;
      case DesignStatus::cannot_be_met:
        report_.message =
            "no design within the bounds was found that meets all requirements" +
            (limits.empty() ? "" : "; at the nearest miss it is limited by: " + limits);
        return;
      case DesignStatus::unresolved:
        report_.message = found.why;
        return;
    }
  }

  void add_columns(const Member& base) {
    for (const QuantityDefinition& q : base.quantities())
      result_.quantities.push_back({q.name, q.unit});
    for (const DesignParameter& parameter : study_.design.parameters)
      result_.quantities.push_back({parameter.name, Unit::none});
    result_.lambda_unit = lambda_unit_of(base.study, base.setup.system);
  }

  /// The whole path of a design as a branch, both ways from its start.
  void draw(const Vector& values) {
    const DesignPath path(path_case(), values);
    if (!path.has_start()) return;
    BasePath traced = base_path(path.base(), observer_, {.forward_only = false});
    if (!traced.problem.empty()) {
      result_.doubts.push_back(traced.problem);
      return;
    }
    for (Sample& sample : traced.branch.samples)
      sample.values.insert(sample.values.end(), values.begin(), values.end());
    for (Event& event : traced.branch.events)
      for (auto* rates : {&event.rates_before, &event.rates_after})
        rates->resize(result_.quantities.size(), 0);
    result_.branches.push_back(std::move(traced.branch));
  }

  /// Special points are counted over both branches.
  void label() {
    std::map<std::string, int> counts;
    for (Branch& branch : result_.branches)
      for (Event& event : branch.events) {
        const std::string code = code_of(event.kind);
        const std::string old = event.label;
        event.label = code + std::to_string(++counts[code]);
        for (std::size_t row = event.row; row < std::min(event.row + 2, branch.samples.size());
             ++row)
          if (branch.samples[row].event == old) branch.samples[row].event = event.label;
      }
  }

  const Study& study_;
  const std::vector<std::string>& left_out_;  ///< of the bounds
  const Observer& observer_;
  StudyResult& result_;
  DesignSearch search_;
  DesignReport report_{};
  std::string confirmed_{};  ///< how far beside the answer, where that is not the nearest
};

}  // namespace

std::string_view to_string(DesignStatus status) {
  switch (status) {
    case DesignStatus::met_at_start:
      return "met at the start";
    case DesignStatus::met:
      return "met";
    case DesignStatus::cannot_be_met:
      return "cannot be met";
    case DesignStatus::unresolved:
      return "unresolved";
  }
  return "";
}

void run_design(const Study& study, const Observer& observer, StudyResult& result) {
  std::vector<std::string> left_out;
  const Study within = within_rules(study, left_out);
  Design(within, left_out, observer, result).run();
}

}  // namespace springfold::analysis
