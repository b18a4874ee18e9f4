// The study kinds that look at special points in a second parameter. Private to analysis.
#pragma once

#include "base_path.hpp"
#include "case_curves.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// The same study as kind force_deflection, limits and marks of the parameter included.
Study base_study(const Study& study);

/// @param path  the case's own
void run_critical_curve(const CaseCurves& curves, const BasePath& path, const Study& study,
                        const Observer& observer, StudyResult& result);
void run_threshold(const CaseCurves& curves, const Study& study, const Observer& observer,
                   StudyResult& result);
void run_critical_load(const CaseCurves& curves, const Study& study, const Observer& observer,
                       StudyResult& result);
void run_design(const Study& study, const Observer& observer, StudyResult& result);
void run_sensitivity(const Study& study, const Observer& observer, StudyResult& result);

}  // namespace springfold::analysis
