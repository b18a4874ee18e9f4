// What a case may say and hardly ever means, and where its parts stand. Private to io.
#pragma once

#include <string>
#include <vector>

#include "case_draft.hpp"

namespace springfold::io {

/// What a run makes of the parameters and of the two number tables.
struct RunValues {
  const Values& parameters;
  const std::vector<double>&of_mechanism, &of_study;
};

/// Angles of more than a turn that are written as plain numbers (degrees, probably), and joints of a
/// chain that turn about one line. Each hint stands once.
void add_hints(const CaseDraft& draft, std::size_t study, const RunValues& values,
               const model::Mechanism& mechanism, std::vector<std::string>& hints);

/// Joints of chains between bodies in the plane whose axes lead out of it, with their places.
void check_planes(const MechanismDraft& draft, const std::vector<double>& numbers,
                  const model::Mechanism& mechanism, const std::string& when, Problems& problems);

/// Every key of the study, and all bodies and chains.
std::vector<PartPlace> places_of(const StudyDraft& study, const MechanismDraft& mechanism);

/// "case.toml:40:9: study[1].start.pose".
std::string place_text(const Place& place, const std::string& key);

}  // namespace springfold::io
