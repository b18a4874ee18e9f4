// What special points mean, in the words of the HTML page.
#include <string>

#include "report_data.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// What a turn of the load, or of what drives the mechanism, does to it.
std::string turn_words(EventKind kind, const Passage& passage, bool is_load) {
  if (!passage.before || !passage.behind) return "";
  const Stability a = *passage.before, b = *passage.behind;
  if (a == Stability::unknown || b == Stability::unknown)
    return " Whether the mechanism snaps beyond it is not known.";
  if (loses_hold(kind, a, b, is_load)) return " Beyond it the mechanism snaps.";
  if (loses_hold(kind, b, a, is_load))
    return " From here on the mechanism stands; where it comes back to this point it snaps.";
  if (a == b && a == Stability::stable) return " The mechanism is stable on both sides.";
  if (!stands(a, is_load) && !stands(b, is_load))
    return " The mechanism is unstable on both sides: it does not come here by itself.";
  if (a != b && (a == Stability::stable || b == Stability::stable))
    return " Under dead load the mechanism would snap; as it is driven it goes on.";
  return " As it is driven the mechanism goes on; under dead load it is unstable on both sides.";
}

std::string change_words(const Passage& passage, bool is_load) {
  if (!passage.before || !passage.behind) return "The stability changes here.";
  const Stability a = *passage.before, b = *passage.behind;
  if (!is_load && stands(a, is_load) && stands(b, is_load))
    return "The stability under dead load changes here; as it is driven the mechanism goes on.";
  const bool changes_driven = is_load && a != b && !stands(a, is_load) && !stands(b, is_load);
  if (changes_driven)
    return "The mechanism is unstable under the load on both sides; whether it would stand if its "
           "way were driven changes here.";
  if (stands(a, is_load) || stands(b, is_load)) return "The stability changes here.";
  return "The number of unstable modes changes here; the mechanism is unstable on both sides.";
}

}  // namespace

std::string explanation_of(EventKind kind, const Passage& passage, bool is_load) {
  switch (kind) {
    case EventKind::limit_point:
      return "The load, or what drives the mechanism, has an extremum here." +
             turn_words(kind, passage, is_load) +
             " The motion along the branch is the mode in which it buckles.";
    case EventKind::branch_point:
      return "Branches cross here: the mechanism may leave the one that it follows.";
    case EventKind::switching:
      return "A one-sided spring begins or ceases to act here: the stiffness jumps.";
    case EventKind::corner_limit_point:
      return "A spring switches here and the driven quantity turns back at once." +
             turn_words(kind, passage, is_load);
    case EventKind::branching_kink:
      return "A spring switches here and there is more than one way on.";
    case EventKind::kinematic_singularity:
      return "The closure of a chain loses rank here.";
    case EventKind::touch:
      return "An eigenvalue of the stiffness touches zero here without changing sign.";
    case EventKind::family:
      return "A continuum of equilibria begins here.";
    case EventKind::user_value:
      return "A value that the case asks for.";
    case EventKind::end_of_range:
      return "The branch ends here: a limit of the study, or where tracing stopped.";
    case EventKind::stability_change:
      return change_words(passage, is_load);
    case EventKind::unresolved:
      return "Something happens here that could not be resolved.";
    case EventKind::cusp:
      return "Two limit points merge here.";
    case EventKind::isola_centre:
      return "A closed branch shrinks to a point here.";
    case EventKind::crossing:
      return "Two branches cross here.";
    case EventKind::hilltop:
      return "A branch point lies on a limit point here.";
    case EventKind::branch_points_merge:
      return "A pair of branch points is born here.";
    case EventKind::more_modes:
      return "Another mode buckles at the same load here.";
    case EventKind::fold_meets_activation:
      return "A limit point or branch point reaches the threshold of a spring here.";
    case EventKind::corner_loses_reversal:
      return "Beyond this corner the load no longer turns back.";
    case EventKind::touches_activation:
      return "The path touches the threshold of a spring here.";
    case EventKind::two_activations:
      return "Two springs switch at the same point here.";
    case EventKind::bends_other_way:
      return "The branch that leaves here bends the other way from here on: a branch point that "
             "was supercritical is subcritical, or the reverse.";
    case EventKind::parameter_turns:
      return "The second parameter turns back here.";
    case EventKind::extremum:
      return "The critical value is stationary here.";
    case EventKind::jump:
      return "The first critical load of the path jumps here: another point comes first behind it.";
    case EventKind::threshold:
      return "The value that the study looks for.";
  }
  return "";
}

}  // namespace springfold::io
