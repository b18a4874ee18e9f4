// Studies that are no curves of the engine. Private to analysis.
#pragma once

#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// Kind `control`: commands along a path of targets.
StudyResult run_control(const model::Mechanism& mechanism, const Study& study,
                        const Observer& observer);

/// Kind `map`: quantities over a grid.
StudyResult run_map(const model::Mechanism& mechanism, const Study& study, const Observer& observer,
                    const RunOptions& options);

/// Kind `workspace`: the largest region within bounds of the transmission factors.
StudyResult run_workspace(const model::Mechanism& mechanism, const Study& study,
                          const Observer& observer);

/// Kinds of critical points: special points in further parameters.
StudyResult run_critical(const Study& study, const Observer& observer);
std::vector<std::string> critical_columns(const Study& study, const model::Mechanism& mechanism);
std::vector<std::string> problems_of_design(const Study& study, const model::Mechanism& mechanism);
std::vector<std::string> problems_of_critical(const Study& study,
                                              const model::Mechanism& mechanism);

/// Columns of control, map and workspace, in order.
std::vector<Quantity> columns_of(const Study& study, const model::Mechanism& mechanism);

/// Every rule that a study of these kinds breaks, as sentences.
std::vector<std::string> problems_of_kind(const Study& study, const model::Mechanism& mechanism);

}  // namespace springfold::analysis
