// [[plot]] tables and the file of expected values.
#pragma once

#include <set>
#include <vector>

#include "case_draft.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// Position of the named study; reports an unknown one with the nearest known one.
std::optional<std::size_t> study_number(const std::string& name, const Item& at,
                                        const std::vector<StudyDraft>& studies, Reading& reading);

std::vector<PlotDraft> read_plots(const std::vector<Item>& tables,
                                  const std::vector<StudyDraft>& studies, Reading& reading);

/// Reports parameters as axes that its studies do not have, and loads that cannot be shaded.
/// @param table  the plot's @param draft  what was read of it
void check_parameter_plot(const TableReader& table, const PlotDraft& draft,
                          const std::vector<StudyDraft>& studies, Reading& reading);

/// [[map_plot]] tables. @param plots  whose names are taken
std::vector<MapPlotDraft> read_map_plots(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies,
                                         const std::vector<PlotDraft>& plots, Reading& reading);

/// [[tornado]] tables. @param taken  names of other plots
std::vector<TornadoDraft> read_tornados(const std::vector<Item>& tables,
                                        const std::vector<StudyDraft>& studies,
                                        std::set<std::string> taken, Reading& reading);

/// [[picture]] tables. @param taken  names of plots
std::vector<PictureDraft> read_pictures(const std::vector<Item>& tables,
                                        const std::vector<StudyDraft>& studies,
                                        std::set<std::string> taken, Reading& reading);

/// Reports a name that cannot be a file name, or that another plot has already.
void check_plot_name(const TableReader& table, const std::string& name,
                     const std::set<std::string>& taken, Reading& reading);

/// Key `markup` of a plot. If it is true, all texts of the plot are checked. @param plot  the same table
bool read_markup(const TableReader& table, const Item& plot, Reading& reading);

/// A whole number from 1 to the number of the study's runs, written as such.
std::optional<int> read_run(const Item& item, const StudyDraft& study, Reading& reading);

std::vector<ExpectedDraft> read_expected(const std::vector<Item>& tables,
                                         const std::vector<StudyDraft>& studies, Reading& reading);

}  // namespace springfold::io
