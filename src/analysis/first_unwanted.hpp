// The first unwanted point on the path from the start. Private to analysis.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base_path.hpp"

namespace springfold::analysis {

struct FirstUnwanted {
  std::optional<SpecialPoint> point{};  ///< nothing: the path has none, unless `why` says otherwise
  std::string why{};                    ///< why it is not known; empty: it is known
  bool has_start = true;
};

/// Follows the curve from the start in the direction in which lambda grows. Where stability counts and the start has
/// none, there is no first loss of it. @param member nullptr: no start
FirstUnwanted first_unwanted(const Member* member, const CriticalPointSettings& settings,
                             const Observer& observer);

/// Modes that are unstable at the start, held as the study's load is or under dead load, whichever counts; nothing
/// where that is not known.
std::optional<Index> unstable_at_start(const Member& member, const CriticalPointSettings& settings);

/// The same on the path of a member, with the reason where it has no start.
FirstUnwanted first_unwanted(const CaseCurves& curves, double mu,
                             const CriticalPointSettings& settings, const Observer& observer);

/// Why a path no longer comes to an unwanted point: ", as the path ends first: top.y reaches its upper limit", or ", as
/// branches cross on the way to it, at lambda = 2". Empty: not known.
/// @param mu, first  a value where it does not, and what is known there
/// @param beside  a value next to that, where the path can be followed
std::string why_path_misses(const CaseCurves& curves, double mu, double beside,
                            const FirstUnwanted& first, const CriticalPointSettings& settings,
                            const Observer& observer);

/// Is this special point of the path one of those that are not wanted?
bool is_unwanted(const Member& member, const CriticalPointSettings& settings, const BasePath& path,
                 const SpecialPoint& point);

/// Does the load turn back there, whatever else happens at the point: where equal parts lose their stiffness together
/// it is a branch point as well?
bool turns_back(const Member& member, const CriticalPointSettings& settings, const BasePath& path,
                const SpecialPoint& point);

/// Why something is not known at values of a parameter: what holds at several of them is told once.
class DoubtedValues {
 public:
  void add(double value, const std::string& why);
  void forget(const std::function<bool(double)>& known);
  /// "at p = -1 to -0.2, 9 values: why"
  std::vector<std::string> told(const std::string& parameter) const;

 private:
  std::vector<std::pair<std::string, std::vector<double>>> by_reason_{};
};

/// Does the critical curve turn back in the parameter there, or is the point another one behind?
bool ends_piece(continuation::Degeneracy kind);

}  // namespace springfold::analysis
