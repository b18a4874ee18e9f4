#include "switch_words.hpp"

#include <algorithm>

#include "branch_rows.hpp"

namespace springfold::analysis {

const model::CompiledSpring& law_of(const statics::System& system, const statics::Switch& s) {
  return s.of_shape() ? system.shapes[s.spring].law : system.springs[s.spring].law;
}

const std::string& name_of(const statics::System& system, const statics::Switch& s) {
  return s.of_shape() ? system.shapes[s.spring].name : system.springs[s.spring].name;
}

std::size_t first_switch_of(const statics::System& system, const statics::Switch& s) {
  return static_cast<std::size_t>(s.of_shape() ? system.shapes[s.spring].first_switch
                                               : system.springs[s.spring].first_switch);
}

namespace {

std::size_t segment_in(const statics::System& system, const statics::Switch& s,
                       const Piece& piece) {
  return s.of_shape() ? segment_of(system.shapes[s.spring], piece)
                      : segment_of(system.springs[s.spring], piece);
}

}  // namespace

bool is_between_equal_segments(const statics::System& system, const continuation::Hit& hit,
                               const Piece& before, const Piece& after) {
  return !hit.switches.empty() &&
         std::all_of(hit.switches.begin(), hit.switches.end(), [&](Index j) {
           const statics::Switch& s = system.switches[static_cast<std::size_t>(j)];
           const model::CompiledSpring& law = law_of(system, s);
           const std::size_t from = segment_in(system, s, before),
                             to = segment_in(system, s, after);
           return law.is_straight(from) && law.is_straight(to) &&
                  law.stiffness(from, s.breakpoint) == law.stiffness(to, s.breakpoint);
         });
}

namespace {

/// Both ends of a narrow gap are switches of one spring.
bool is_named_before(const statics::System& system, const std::vector<Index>& switches,
                     std::size_t k) {
  const auto at = [&](std::size_t i) -> const statics::Switch& {
    return system.switches[static_cast<std::size_t>(switches[i])];
  };
  for (std::size_t i = 0; i < k; ++i)
    if (at(i).of_shape() == at(k).of_shape() && at(i).spring == at(k).spring) return true;
  return false;
}

}  // namespace

/// Springs that reach a breakpoint together with others and go back switch nothing: they are left out.
std::string switching_detail(const statics::System& system, const continuation::Hit& hit,
                             const Piece& before, const Piece& after) {
  std::string text;
  for (std::size_t k = 0; k < hit.switches.size(); ++k) {
    const statics::Switch& s = system.switches[static_cast<std::size_t>(hit.switches[k])];
    const model::CompiledSpring& law = law_of(system, s);
    const std::size_t from = segment_in(system, s, before), to = segment_in(system, s, after);
    if (from == to || is_named_before(system, hit.switches, k)) continue;
    const double k_from = law.stiffness(from, s.breakpoint);
    const double k_to = law.stiffness(to, s.breakpoint);
    const bool was_flat = k_from == 0 && law.is_straight(from);
    const bool gets_flat = k_to == 0 && law.is_straight(to);
    const char* word = was_flat && !gets_flat   ? "becomes active"
                       : !was_flat && gets_flat ? "is released"
                       : k_to > k_from          ? "gets stiffer"
                                                : "gets softer";
    text += (text.empty() ? "spring " : ", spring ") + name_of(system, s) + " " + word +
            " (segment " + std::to_string(from) + " to " + std::to_string(to) + ")";
  }
  return text;
}

std::string piece_text(const statics::System& system, const Piece& piece) {
  std::string text;
  for (const statics::CoordinateSpring& spring : system.springs)
    if (!spring.law.breakpoints.empty())
      text += (text.empty() ? "" : ".") + std::to_string(segment_of(spring, piece));
  for (const statics::PointShape& shape : system.shapes)
    if (!shape.law.breakpoints.empty())
      text += (text.empty() ? "" : ".") + std::to_string(segment_of(shape, piece));
  return text;
}

}  // namespace springfold::analysis
