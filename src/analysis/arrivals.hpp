// What studies take over from the ones before them, for all values of the parameters. Private to analysis.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "history_state.hpp"

namespace springfold::analysis {

/// Values of parameters of the case that differ from the run's own, by their numbers.
using ParameterChanges = std::vector<std::pair<std::size_t, double>>;

/// The state in which a study starts, and what of the studies before it acts on.
struct Arrival {
  NamedValues state{};
  std::vector<model::Load> kept{};
  ParameterChanges moved{};  ///< parameters that earlier studies moved, as they left them
  std::string way{};         ///< as Variant has it
  std::string loss{};        ///< as loss_before() has it
  std::string problem{};     ///< why there is no such state, in words; empty: there is one
  double seconds = 0;        ///< CPU time of the studies before
};

/// A study as it starts after those before it.
struct Continued {
  model::Mechanism mechanism{};  ///< drawn in that state, with the loads that are kept
  Study study{};
  std::optional<ParameterFamily> family{};  ///< in the same state, with the same loads
  std::string problem{};                    ///< as Arrival has it
  double seconds = 0;
  ParameterChanges moved{};
  std::string way{};

  const ParameterFamily* family_or_none() const { return family ? &*family : nullptr; }
};

/// Runs the studies before one, once for every value that is asked for. Several threads may ask.
class Arrivals {
 public:
  /// @pre history.earlier
  Arrivals(History history, Observer observer);

  /// @param changes  of the case's parameters; none: the case as the run has it
  std::shared_ptr<const Arrival> at(ParameterChanges changes) const;
  const History& history() const { return history_; }

 private:
  Arrival run(const ParameterChanges& changes) const;
  Continued earlier_study(const ParameterChanges& changes) const;

  History history_;
  Observer observer_;
  std::unique_ptr<const Arrivals>
      before_{};  ///< of the earlier study itself; null: it starts on its own
  mutable std::mutex busy_{};
  mutable std::map<ParameterChanges, std::shared_ptr<const Arrival>> known_{};
};

/// The later study itself, as the run has it.
Continued continued(const Arrivals& arrivals, const model::Mechanism& mechanism, const Study& study,
                    const ParameterFamily* family);

/// The later study for other values of the parameters, the whole history being what it is with these.
/// @param arrivals  asked for every member's values but that of the parameter which is lambda: along a path that does
///                  not move the start
std::shared_ptr<const CaseFamily> after(std::shared_ptr<const Arrivals> arrivals,
                                        std::shared_ptr<const CaseFamily> cases,
                                        const Study& study);

}  // namespace springfold::analysis
