// What special points mean, in the words of the HTML page.
#include "report_data.hpp"

namespace springfold::io {

std::string explanation_of(analysis::EventKind kind) {
  using analysis::EventKind;
  switch (kind) {
    case EventKind::limit_point:
      return "The load, or what drives the mechanism, has an extremum here: beyond it the "
             "mechanism snaps. "
             "The motion along the branch is the mode in which it buckles.";
    case EventKind::branch_point:
      return "Branches cross here: the mechanism may leave the one that it follows.";
    case EventKind::switching:
      return "A one-sided spring begins or ceases to act here: the stiffness jumps.";
    case EventKind::corner_limit_point:
      return "A spring switches here and the driven quantity turns back at once.";
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
      return "The stability under dead load changes here; as it is driven the mechanism goes on.";
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
