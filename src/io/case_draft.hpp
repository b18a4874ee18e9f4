// Everything that a case says, its numbers still formulas.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanism_draft.hpp"
#include "plot_look_reader.hpp"
#include "source_files.hpp"
#include "springfold/io/case_file.hpp"
#include "study_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

struct PlotDraft {
  PlotSpec spec{};  ///< without its factors
  NumberTable numbers{};
  NumberId x_factor = 0, y_factor = 0;
  NamedPlace x{};
  std::vector<NamedPlace> y{};
  PlotLookDraft look{};
};

struct MapPlotDraft {
  MapPlotSpec spec{};  ///< without its numbers
  NumberTable numbers{};
  NumberId factor = 0, x_factor = 0, y_factor = 0;
  std::vector<NumberId> levels{}, range{};
  SheetLookDraft look{};
  NamedPlace quantity{};
};

struct TornadoDraft {
  TornadoSpec spec{};  ///< without its numbers
  NumberTable numbers{};
  SheetLookDraft look{};
  std::optional<std::size_t> study{};  ///< position in CaseDraft::studies
  NamedPlace quantity{};
};

struct PictureDraft {
  PictureSpec spec{};
  std::vector<std::size_t>
      studies{};  ///< positions in CaseDraft::studies of those that it shows after a run
};

struct CaseDraft {
  std::string title{};
  UnitLabels units{};
  FormulaBook book{std::vector<std::string>{}};
  std::vector<Parameter> parameters{};
  MechanismDraft mechanism{};
  std::vector<StudyDraft> studies{};
  std::vector<PlotDraft> plots{};
  std::vector<MapPlotDraft> map_plots{};
  std::vector<TornadoDraft> tornados{};
  std::vector<PictureDraft> pictures{};
  std::vector<ExpectedDraft> expected{};
  std::vector<std::string> notes{};
  bool wants_report = false;
};

/// Reads the tables of all documents (included ones first). `overrides` replace parameters.
/// @param expected_file  documents with the expectations: one or none
/// @param files          reads other files that the case names
CaseDraft read_case(const std::vector<Document>& documents,
                    const std::map<std::string, std::string>& overrides,
                    const std::vector<Document>& expected_file, const FileReader& files,
                    Problems& problems);

/// Checks all numbers: with the case's own parameters, then as every run has them.
void check_numbers(const CaseDraft& draft, Problems& problems);

/// All runs of all studies, plots and expectations. What mechanism and study say about each other
/// (names of quantities, rules of the analysis) is checked. @pre check_numbers found nothing
Case build_case(std::shared_ptr<const CaseDraft> draft, Problems& problems);

/// The mechanism and the load of one run as a function of its parameter.
/// @param parameters  as the run has them @pre the study's control mode is `parameter`
analysis::ParameterFamily family_of(std::shared_ptr<const CaseDraft> draft, std::size_t study,
                                    int run, const Values& parameters);

/// Mechanism and study of one run as a function of all named parameters. @param parameters  as the run has them
std::shared_ptr<const analysis::CaseFamily> cases_of(std::shared_ptr<const CaseDraft> draft,
                                                     std::size_t study, int run,
                                                     const Values& parameters);

/// Mechanism and load of a map's run as a function of those axes that are parameters; empty if none
/// is. Several threads may call it.
std::function<analysis::Situation(const std::vector<double>&)> situations_of(
    std::shared_ptr<const CaseDraft> draft, std::size_t study, int run);

}  // namespace springfold::io
