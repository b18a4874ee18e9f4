// The search for the design with the least changes. Private to analysis.
#pragma once

#include "design_jump.hpp"
#include "least_change.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

struct FoundDesign {
  DesignStatus status = DesignStatus::unresolved;
  Vector changes{};         ///< in units of the parameters
  std::vector<Way> ways{};  ///< in which the critical requirements are met
  double violation = 0;     ///< the largest of the scaled requirements, if they cannot be met
  double optimality = 0;    ///< as DesignReport::optimality
  bool jumps = false;       ///< next to the answer a requirement is missed by far
  bool is_least = false;    ///< the change is stationary
  std::vector<std::size_t> jumping{};   ///< requirements that jump there
  Vector jump_slope{};                  ///< as JumpEnd::slope
  std::vector<std::size_t> limiting{};  ///< requirements that decide, with their multipliers
  std::vector<double> multipliers{};
  std::vector<BoundState> bounds{};  ///< per parameter: at which it is held
  std::string why{};                 ///< unresolved: why
  bool stopped = false;
};

/// Designs are counted by their changes u: parameter = value in the case + unit * u.
class DesignSearch {
 public:
  DesignSearch(const Study& study, const Observer& observer);

  FoundDesign run();
  Vector values(const Vector& changes) const { return values_ + units_.cwiseProduct(changes); }
  double size_of(const Vector& changes) const;
  const Requirements& requirements() const { return requirements_; }
  int designs() const { return designs_; }
  /// The requirements at a design, rates as far as they are defined; nothing where they cannot be judged.
  std::optional<Assessment> judge(const Vector& changes, const std::vector<Way>& ways);
  std::vector<Way> first_ways() const;
  /// Changes that lead away from what limits a design, of length `size`, within the bounds.
  Vector inwards(const FoundDesign& design, double size);

 private:
  /// The same where all rates are defined.
  std::optional<Assessment> assess(const Vector& changes, const std::vector<Way>& ways);
  /// What is searched for: u = combine * v. For the sum of changes v are what grows and what falls, both >= 0.
  struct Variables {
    Matrix combine{};
    Vector low{}, high{};
    bool is_sum = false;
  };
  std::vector<std::vector<Way>> all_ways() const;
  Vector start(int k) const;
  Vector to_variables(const Vector& changes) const;
  InequalityValues values_at(const Assessment& at, const Vector& v) const;
  /// Where a search ended.
  struct Candidate {
    std::vector<Way> ways{};
    Vector changes{};
    double violation = 0;  ///< largest of the inequalities, at least 0
  };
  Vector least_changes(const std::vector<Way>& ways, const Vector& from, Depth how);
  Vector least_violation(const std::vector<Way>& ways, const Vector& from, Depth how);
  /// As JumpProblem::judge. @param ways  are looked at first
  std::optional<Assessment> nearest(const Vector& changes, const std::vector<Way>& ways,
                                    const std::vector<std::size_t>& only);
  double violation_at(const Vector& changes, const std::vector<Way>& ways);
  /// Looks for a design from one start. @returns nothing where the start cannot be judged
  std::optional<Candidate> search_from(const std::vector<Way>& ways, const Vector& from, Depth how);
  /// All ways from every start, in this order; from more of them, one by one, until one leads to a design.
  std::vector<Candidate> candidates();
  bool is_better(const Candidate& a, const Candidate& b) const;
  bool misses_less(const Candidate& a, const Candidate& b) const;
  bool is_same(const Candidate& a, const Candidate& b) const;
  std::vector<const Candidate*> promising(const std::vector<Candidate>& list) const;
  FoundDesign smoothest(FoundDesign design);
  FoundDesign best_of(const std::vector<Candidate>& list);
  /// Ends of searches where requirements jump.
  struct KnownEnds {
    std::vector<Vector> missed{};  ///< of those by derivatives
    std::vector<Vector> least{};   ///< of those along the boundary
  };
  std::optional<FoundDesign> followed(const Candidate& from, KnownEnds& known);
  /// Designs that searches by derivatives do not come to: bounds of one parameter alone that meet the requirements,
  /// and of paths that are to climb starts that do, drawn back roughly.
  std::vector<Candidate> met_starts();
  JumpProblem jump_problem(const std::vector<Way>& ways);
  FoundDesign along_jump(FoundDesign design, const JumpEnd& end);
  std::optional<FoundDesign> followed_to_jump(const Candidate& from, KnownEnds& known);
  /// The last design on the straight way to the case.
  FoundDesign drawn_to_case(const Candidate& from);
  /// What decides an answer: see design_conditions.cpp.
  struct Conditions;
  Conditions balance(const FoundDesign& design, const Assessment& at) const;
  void name_bound(FoundDesign& design, Index which) const;
  void conditions(FoundDesign& design);

  const Study& study_;
  Observer observer_{};
  Requirements requirements_;
  Vector values_{}, units_{}, low_{}, high_{};  ///< bounds of the changes
  Variables variables_{};
  bool stopped_ = false;
  int designs_ = 0;
  std::string why_{};
  /// The last design that was judged: searches ask for it again, and each way of meeting the requirements does.
  Vector last_changes_{};
  std::unique_ptr<TracedDesign> last_design_{};
  std::vector<Way> last_ways_{};
  std::optional<Assessment> last_{};
};

}  // namespace springfold::analysis
