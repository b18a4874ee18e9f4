// Points at which springs and loads act.
#pragma once

#include <string>
#include <vector>

#include "mechanism_reader.hpp"

namespace springfold::io {

/// "tool" or "leg.knee"; reports others.
void find_anchor(const Item& item, const MechanismDraft& draft, bool base_allowed,
                 AnchorDraft& anchor, Reading& reading);

bool lives_in_plane(const MechanismDraft& draft, const AnchorDraft& anchor);

/// The table's entry `name`: a point in the frame of the anchor; nothing if it is missing.
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
