#include "point_names.hpp"

#include <array>
#include <utility>

namespace springfold::io {

std::string point_name(const std::string& code) {
  constexpr std::array<std::pair<const char*, const char*>, 29> names{{
      {"start", "start"},
      {"LP", "limit point (LP)"},
      {"CL", "corner limit point (CL)"},
      {"SA", "spring activation (SA)"},
      {"BP", "branch point (BP)"},
      {"KB", "branching kink (KB)"},
      {"KS", "kinematic singularity (KS)"},
      {"TP", "touching point (TP)"},
      {"FM", "family (FM)"},
      {"UZ", "marked value (UZ)"},
      {"ES", "stable equilibrium (EQ)"},
      {"EU", "unstable equilibrium (EQ)"},
      {"SC", "stability changes (SC)"},
      {"CP", "cusp (CP)"},
      {"IC", "isola centre (IC)"},
      {"CX", "crossing of branches (CX)"},
      {"HT", "hilltop (HT)"},
      {"BB", "birth of branch points (BB)"},
      {"C2", "another mode (C2)"},
      {"FA", "fold meets activation (FA)"},
      {"CR", "corner loses its reversal (CR)"},
      {"TA", "touch of an activation (TA)"},
      {"AA", "two activations (AA)"},
      {"SB", "supercritical, subcritical (SB)"},
      {"PT", "turn of the parameter (PT)"},
      {"EX", "extremum (EX)"},
      {"TH", "threshold (TH)"},
      {"JP", "jump (JP)"},
      {"UR", "unresolved (UR)"},
  }};
  for (const auto& [known, name] : names)
    if (code == known) return name;
  return code;
}

}  // namespace springfold::io
