// The state in which an earlier study leaves a mechanism, and what of it a later one takes over. Private to analysis.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "springfold/analysis/history.hpp"

namespace springfold::analysis {

/// Values of one state by the names of their columns, in the units of the case.
using NamedValues = std::map<std::string, double, std::less<>>;

/// Why the result has no point `at` ("start", "end", a label), in words; empty: it has.
std::string trouble_at(const StudyResult& result, const std::string& at);

/// @pre trouble_at(result, at).empty()
NamedValues state_at(const StudyResult& result, const std::string& at);

/// The label of the special point between the start of the first branch and a point of it behind which the state,
/// stable at the start, is unstable: what is loaded slowly leaves the branch there. Empty: there is none.
std::string loss_before(const StudyResult& result, const std::string& at);

/// The label of the equilibrium of a search that is nearest to a state of a neighbouring value of a parameter: a search
/// may number them otherwise there. Empty where another one is about as near.
std::string label_near(const StudyResult& result, const NamedValues& state);

/// What the study passed between its start and that point, as one word: kinds of special points and springs that act.
/// Of neighbouring values of a parameter with different ones, the points do not belong to each other.
std::string way_to(const StudyResult& result, const std::string& at);

/// What acts in the state of the earlier study and not by itself in the later one, as constant loads.
/// @param mechanism, study  the earlier ones, as they ran
std::vector<model::Load> kept_loads(const Earlier& earlier, const model::Mechanism& mechanism,
                                    const Study& study, const NamedValues& state);

/// The forces by which the earlier study held what is released, as constant loads on the bodies.
std::vector<model::Load> holding_forces(const std::vector<Released>& released,
                                        const NamedValues& state);

/// Bodies, joints and commands as they are in the state; chains that hold a body begin there. Angles of shapes go on
/// counting the turns of the drawing.
/// @param held  names of chains
void put_in_state(const NamedValues& state, const std::vector<std::string>& held,
                  model::Mechanism& mechanism);

}  // namespace springfold::analysis
