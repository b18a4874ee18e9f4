// The curve of a study for every value of one of the case's parameters. Private to analysis.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "parameter_rules.hpp"
#include "quantities.hpp"
#include "setup.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/parameters/two_parameter.hpp"
#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/moved_places.hpp"

namespace springfold::analysis {

/// The study for one value of the parameter, its start found.
struct Member {
  double mu = 0;  ///< dimensionless
  int sheet = 0;  ///< members of the same one have starts that belong to each other
  Study study{};  ///< of kind force_deflection
  Setup setup{};
  StartReport report{};
  statics::FirstEquilibrium first{};
  bool start_is_open = false;  ///< not looked for: of `first` the inputs alone are given
  bool pose_is_known = false;  ///< start_is_open: that which deflections are counted from is
  std::unique_ptr<PathProblem> problem{};

  continuation::CurvePoint start() const;
  Vector start_pose() const;  ///< of the study's body
  Vector counted_from()
      const;  ///< the pose that deflections are counted from; undefined without a start
  /// Columns and what evaluates them: made when they are asked for, which most members never are.
  const std::vector<QuantityDefinition>& quantities() const;
  const Evaluator& evaluator() const;
  /// Columns and what evaluates them are forgotten, for another value of the parameter; memory is kept.
  void forget_columns();
  const QuantityDefinition* quantity(const std::string& name) const;

  const Member* columns_of = nullptr;  ///< the member whose columns these are; nullptr: its own

 private:
  mutable std::unique_ptr<Evaluator> evaluator_{};
  mutable bool evaluator_is_old_ = false;  ///< of a problem that has been renewed
  mutable std::vector<QuantityDefinition> quantities_{};
};

/// The study as a curve that is traced, whatever its kind: limits and marks of `parameter` left out.
Study as_curve(Study study);

/// Of differences in mu.
inline constexpr double step_of_family = 0x1p-9;

/// Members of the grid of differences are as far apart. Those within it of mu on both sides enclose mu: whether det J
/// keeps its sign along the starts is asked at them.
inline constexpr double grid_step = 4 * step_of_family;

/// Members share the scales of the first one, the case's own. Starts of the others are found from the nearest
/// one that is known; where the settings do not tie them, commands stay those of the first.
class CaseCurves {
 public:
  /// @param parameter  its number in study.critical.cases
  /// @param lambda_unit  in that which the response at the case's own start asks for
  CaseCurves(const Study& study, std::size_t parameter, double lambda_unit = 1);
  /// The same, begun at a member of other curves of the same study: with its scales, and with the start that
  /// belongs to its own.
  /// @param held  parameters that have its values, not the case's own: their names and values
  CaseCurves(const Study& study, std::size_t parameter, const Member& from,
             std::vector<std::pair<std::string, double>> held);

  double scale() const { return scale_; }  ///< parameter = scale() * mu
  double value() const { return value_; }  ///< of the parameter in the case
  const std::string& name() const { return name_; }
  const Member& base() const { return *base_; }       ///< base().report.found: can be used
  bool has_base() const { return base_ != nullptr; }  ///< always, unless begun at a member
  const std::vector<std::pair<std::string, double>>& held() const { return held_; }
  /// Nothing where the case has no start. Valid for the next two dozen calls.
  const Member* at(double mu) const;
  /// The same where the case has no start, if nothing of it enters the equations (report.found is false then, and what
  /// is counted from the start is undefined). On a line of members the start is not looked for: at() does.
  const Member* equations_at(double mu) const;
  /// Do the equations depend on what the start is, commands that it fixes or forces that it holds?
  bool start_enters_equations() const;
  /// Why there is no start, where the last at(mu) gave nothing: in words.
  std::string why_none(double mu) const;
  continuation::Family family() const;
  /// The member's problem at mu, and what evaluates states of it: with laws as a curve is followed in (ContinuedLaws),
  /// its own otherwise.
  struct Followed {
    const Member* member = nullptr;
    const PathProblem* problem = nullptr;
    const Evaluator* evaluator = nullptr;
  };
  using FollowedAt = std::function<std::optional<Followed>(double mu)>;
  std::optional<Followed> followed_at(double mu) const;
  /// While a curve is followed in problems of its own; empty: no longer.
  void follow_in(FollowedAt problems) const { followed_ = std::move(problems); }
  /// Where the parameter's range ends at rules for the case's numbers, and at which.
  const RuledRange& rules() const { return rules_; }
  void end_at_rules(RuledRange rules) { rules_ = std::move(rules); }
  /// A point of `member`'s curve on the given piece.
  static continuation::CurvePoint point_of(const continuation::CriticalPoint& point,
                                           const Piece& piece);

 private:
  Member* member_at(double mu) const;
  struct Neighbours {
    const Member* inward;   ///< on the side of the first member, or that one itself
    const Member* outward;  ///< nullptr: none is known
  };
  Neighbours neighbours(double mu) const;
  const Member& nearest(double mu) const;
  std::optional<double> let_go_between(double mu) const;
  void settle_start(Member& member) const;
  std::unique_ptr<Member> make(double mu, const Member* near,
                               std::unique_ptr<Member> spare = nullptr) const;
  bool set_up_anew(Member& member, const Member* near, bool again, model::Mechanism& mechanism,
                   std::optional<ParameterFamily>& along, std::optional<std::string>& way) const;
  bool put_numbers(Member& member, bool again) const;
  std::optional<statics::StartProblem> problem_beside(const Member& member,
                                                      const Member& near) const;
  bool solve_beside(Member& member, const Member& near) const;
  std::unique_ptr<Member> on_the_way(double mu, const Member& near) const;
  bool walk_to(Member& member, const Member& near) const;
  bool solve_behind(Member& member, const Member& near) const;
  bool solve_near(Member& member, const Member& near) const;
  bool solve(Member& member, const statics::StartProblem& problem) const;
  bool solve_by_itself(Member& member) const;
  bool starts_move_freely() const;
  bool solve_in_state(Member& member, const std::string& way) const;
  std::optional<statics::Inputs> inputs_without_start(const Member& member,
                                                      const Member& near) const;
  std::optional<statics::Inputs> inputs_on_line(const Member& member) const;
  bool leave_start_open(Member& member, const Member& near) const;
  bool go_without_start(Member& member, const Member& near) const;
  std::shared_ptr<const Lu> start_factors(const Member& member) const;
  bool keeps_commands(const Study& study) const;
  static bool counts_from_one_origin(const Study& study);
  StartOptions start_beside(const Study& study) const;
  statics::Foresight foresight(double mu, const Member& near) const;

  /// Where the parameter moves few numbers members are set up once; the others get their numbers in place.
  struct Pattern {
    model::Mechanism mechanism{};  ///< of any member, in the units of the case
    std::function<bool(std::size_t, double, model::Mechanism&)> put{};  ///< its numbers, MovingCase
    Study study{};
    Setup setup{};
    statics::MovedPlaces places{};
  };
  void keep_pattern(const Member& member, model::Mechanism mechanism) const;
  void keep_start(Member& member) const;
  bool recall_start(Member& member) const;
  /// Four members of the grid of differences in equal steps, whose numbers may lie on a line.
  struct Line {
    bool holds = false;
    statics::Inputs first{}, last{};  ///< at the starts of the outer two
    Vector counted{};                 ///< the pose of all four starts; empty: it is not one
  };
  std::optional<double> line(double mu) const;
  Line line_through(double first, double step) const;
  const Line* known_line(double mu) const;
  void look_for_line(double mu) const;
  static double first_on_line(double mu);

  Study study_;
  std::size_t parameter_ = 0;
  std::string name_{};
  double value_ = 0, scale_ = 1, lambda_unit_ = 1;
  RuledRange rules_{};
  std::vector<std::pair<std::string, double>> held_{};
  bool begins_at_member_ = false;  ///< whose case need have no start
  /// Neutral equilibria: which one it is, the guess says. Empty: not asked yet.
  mutable std::optional<bool> starts_move_freely_{};
  std::unique_ptr<Member> base_{};
  mutable std::optional<Pattern> pattern_{};
  struct Recent {
    std::unique_ptr<Member> member{};
    std::list<double>::iterator call{};  ///< the last one that asked for it, in calls_
  };
  mutable FollowedAt followed_{};
  mutable std::map<double, Recent> recent_{};  ///< by mu
  mutable std::list<double> calls_{};  ///< mu of the recent members, the one asked for last first
  struct KnownStart {
    int sheet = 0;
    statics::FirstEquilibrium first{};
  };
  mutable std::map<double, KnownStart> starts_{};  ///< by mu: of members that were let go
  mutable std::map<double, Line> lines_{};         ///< by mu of the first member: line()
  mutable bool starts_lie_on_lines_ = false;       ///< those of the line that was looked for last
  /// Where none was found, which is dearer than one, and why.
  mutable std::map<double, std::string> without_start_{};
  mutable std::string why_none_{};  ///< of the member that was made last
  mutable std::map<std::string, int>
      ways_{};              ///< to starts that earlier studies lead to: their sheets
  mutable int sheets_ = 0;  ///< so many are known besides the first member's
  /// By sheet, and whether mu grows: where a start was not to be followed any more.
  mutable std::map<std::pair<int, bool>, double> vanished_{};
  mutable statics::Workspace start_work_{};  ///< of equations at starts
};

}  // namespace springfold::analysis
