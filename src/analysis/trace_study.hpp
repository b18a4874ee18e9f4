// How a study of a curve is traced from its start. Private to analysis.
#pragma once

#include <string>

#include "grow_diagram.hpp"

namespace springfold::analysis {

/// What is special about a start, as far as it is seen at once; branch points are found later.
std::string situation_of(const Tracing& t, const continuation::CurvePoint& start,
                         const continuation::Rays& rays);

/// A start that several curves leave needs the diagram, whatever the study asks for: none of them is
/// picked.
void trace_study(const Tracing& t, const continuation::CurvePoint& start, StudyResult& result);

}  // namespace springfold::analysis
