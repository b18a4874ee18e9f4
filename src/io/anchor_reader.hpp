// Where loads, springs and bars act: names of bodies, nodes and points of chains.
#pragma once

#include <string>
#include <vector>

#include "mechanism_reader.hpp"

namespace springfold::io {

/// "tool", "leg.knee", the name of a node; with `base_allowed` also "base" and fixed nodes. Reports
/// others.
/// @param numbers  those of whoever asks: the place of a fixed node is among them
void find_anchor(const Item& item, const MechanismDraft& draft, bool base_allowed,
                 AnchorDraft& anchor, NumberTable& numbers, Reading& reading);

/// Does the anchor stay in the plane? The base does if all bodies do.
bool lives_in_plane(const MechanismDraft& draft, const AnchorDraft& anchor);

/// The place `name` on the anchor, whose name is read; without the key that of a fixed node, or none.
std::vector<NumberId> read_at(const TableReader& table, const std::string& name,
                              const MechanismDraft& draft, const AnchorDraft& anchor,
                              NumberTable& numbers, Reading& reading);

/// `from`, `from_at`, `to`, `to_at`.
void read_ends(const TableReader& table, MechanismDraft& draft, AnchorDraft& from, AnchorDraft& to,
               Reading& reading);

/// "leg.knee" or { on = "leg.knee", at = [0, 1] }.
AnchorDraft read_anchor(const Item& item, const MechanismDraft& draft, NumberTable& numbers,
                        Reading& reading);

}  // namespace springfold::io
