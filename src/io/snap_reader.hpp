// The key `snap` of a study: jumps from losses of stability.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/snap_settings.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Kind of a study that traces branches and their jumps.
inline constexpr const char* snap_kind = "snap_through";
inline constexpr const char* cycle_kind = "load_cycle";
inline constexpr const char* transitions_kind = "transitions";

struct JointDampingDraft {
  std::string joint{};
  NumberId value = 0;
};

struct SnapDraft {
  bool on = false;
  bool is_kind = false;  ///< kind = "snap_through", "load_cycle" or "transitions"
  bool is_cycle = false, is_transitions = false;
  NumberId starts = 0, seed = 0;
  std::vector<JointDampingDraft> damping{};
  bool has_inertia = false;
  NumberId damping_ratio = 0;
  std::vector<JointDampingDraft> inertial_damping{};
  std::vector<NumberId> levels{}, search_at{}, barriers_at{};
  NumberId times = 0, search_starts = 0, maximum = 0;
};

/// `snap = true`, or a table of settings, which means true.
SnapDraft read_snap(const TableReader& study, NumberTable& numbers, Reading& reading);

/// @param numbers  values of the study's numbers
/// @returns nothing where no jumps are wanted
std::optional<analysis::SnapSettings> build_snap(const SnapDraft& draft,
                                                 const std::vector<double>& numbers);

}  // namespace springfold::io
