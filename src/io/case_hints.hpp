// What a case may say and hardly ever means, and where its parts stand. Private to io.
#pragma once

#include <string>
#include <vector>

#include "case_draft.hpp"

namespace springfold::io {

/// Angles of more than a turn that are written as plain numbers (degrees, probably), and joints of a
/// chain that turn about one line. Each hint stands once.
/// @param of_mechanism, of_study  values of the two number tables
void add_hints(const CaseDraft& draft, std::size_t study, const std::vector<double>& of_mechanism,
               const std::vector<double>& of_study, const model::Mechanism& mechanism,
               std::vector<std::string>& hints);

/// Joints of chains between bodies in the plane whose axes lead out of it, with their places.
void check_planes(const MechanismDraft& draft, const std::vector<double>& numbers,
                  const model::Mechanism& mechanism, const std::string& when, Problems& problems);

/// Every key of the study, and all bodies and chains.
std::vector<PartPlace> places_of(const StudyDraft& study, const MechanismDraft& mechanism);

/// "case.toml:40:9: study[1].start.pose".
std::string place_text(const Place& place, const std::string& key);

}  // namespace springfold::io
