// Rows of a result as postures of the mechanism, and pictures of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/drawing/illustration.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Turns rows of one run into scenes. Keeps references to the plan and the result.
class RowScenes {
 public:
  RowScenes(const PlannedRun& planned, const analysis::StudyResult& result);

  /// Do the rows say where everything is? Those of a workspace or of critical points do not.
  bool has_postures() const { return has_columns_; }

  /// The mechanism in the posture of the row, with the loads that act there; nothing where a position
  /// is not known.
  std::optional<drawing::Scene> scene_of(const analysis::Sample& row) const;

  /// The same as a panel: stability, and the values of lambda, force and deflection as a note.
  std::optional<drawing::Panel> panel_of(const analysis::Sample& row, const std::string& title,
                                         const UnitLabels& units) const;

  /// How fast the points of the scene move along the branch, per arc length: central differences of exact
  /// positions. Empty where not all is known.
  /// @param rates  d(values)/ds at the row, as in analysis::Event
  std::vector<model::Vec3<double>> motion_at(const analysis::Sample& row,
                                             const std::vector<double>& rates) const;

 private:
  double value(const analysis::Sample& row, std::optional<std::size_t> column) const;
  double shown_value(const analysis::Sample& row, std::optional<std::size_t> column) const;
  std::optional<analysis::Variant> variant_of(const analysis::Sample& row) const;
  /// @param variant  of the row: see variant_of
  statics::System system_of(const analysis::Sample& row, double lambda,
                            const std::optional<analysis::Variant>& variant) const;
  void add_wrenches(const analysis::Sample& row, double lambda,
                    const std::optional<analysis::Variant>& variant,
                    drawing::Posture& posture) const;

  const PlannedRun& planned_;
  const analysis::StudyResult& result_;
  statics::System system_{};  ///< at the study's start
  bool has_columns_ = false;
  std::vector<std::optional<std::size_t>> z_columns_{}, rho_columns_{};
  std::vector<double> sizes_{};  ///< of the result's quantities: what is rounding beside them is 0
  std::optional<std::size_t> lambda_{}, force_{}, deflection_{}, dead_{}, driven_{};
};

/// "push, Kv = 0.1: LP1".
std::string posture_title(const PlannedRun& planned, const std::string& what);

/// Title and units of the case.
/// @param view    "xy", "xz", "yz": these planes; "perspective": natural_view from near; otherwise natural_view
/// @param colour  "force", "energy", "none"; otherwise stability
drawing::IllustrationOptions illustration_options(const Case& the_case, const std::string& view,
                                                  const std::string& colour);

/// The mechanism of a run as the case gives it, before anything is solved.
drawing::Panel guess_panel(const PlannedRun& planned, const std::string& title);

/// One row of a result, by name.
struct FoundRow {
  const analysis::Sample* row = nullptr;  ///< nullptr: there is none of this name
  std::string title{};                    ///< "LP1", "start", "EQ2"
};

/// @param label  of an event or an equilibrium ("LP1", "EQ2"), "start" or "end"
FoundRow row_at(const analysis::StudyResult& result, const std::string& label);

/// Why a run cannot be shown in this posture, and which ones there are instead.
/// @param label  empty: any @pre it cannot
std::string why_no_posture(const PlannedRun& planned, const analysis::StudyResult& result,
                           const std::string& label);

/// The start, then all special points of all branches, each once; of a study of kind equilibria these.
std::vector<FoundRow> special_rows(const analysis::StudyResult& result);

/// The same postures, each once: "start, EP1" where the start is an end.
std::vector<FoundRow> special_postures(const analysis::StudyResult& result);

}  // namespace springfold::io
