#include "parameters/degeneracy.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "parameters/freed.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/extended_matrix.hpp"
#include "springfold/parameters/imperfection.hpp"

namespace springfold::continuation {
namespace {

/// Quadratic form of D^2F, contracted with w, on the vectors a and b of (x, lambda).
double form(const Augmented& s, const CurvePoint& p, const Vector& w, const Vector& a,
            const Vector& b) {
  const auto along =
      second_along(s.family(), s.state(p.x), s.lambda(p.x), p.lambda, s.start().piece, w, a);
  return along ? along->dot(b) : not_a_number;
}

/// Where mu turns back on a curve of limit points either the fold is cubic (cusp), or dF/dlambda
/// lies in the range of dF/dx: [dF/dx dF/dlambda] has a kernel of two dimensions, and the sign of
/// the quadratic form there tells whether branches cross or a closed one shrinks to a point.
Degeneracy turn_of_fold(const Augmented& s, const CurvePoint& p) {
  const auto place = s.place(p.x, p.lambda);
  if (!place) return Degeneracy::cusp;
  const Index n = s.n();
  const Vector sizes = jacobi_svd(place->base.A).values;
  const bool is_simple = n < 2 || sizes[n - 2] > poor * sizes[0];
  if (is_simple) {
    const Vector w = place->W.col(0).normalized();
    Vector along = Vector::Zero(n + 1);
    along.head(n) = place->V.col(0).normalized();
    const double bending = std::abs(form(s, p, w, along, along));
    if (!(std::abs(w.dot(place->base.J.col(n))) < bending)) return Degeneracy::cusp;
  }
  // Where another mode vanishes, one pair of borders does not tell the null vectors: they are those of [dF/dx
  // dF/dlambda].
  const Svd svd = jacobi_svd(place->base.J, SingularVectors::thin, SingularVectors::full);
  const Vector w = svd.U.col(n - 1), a = svd.V.col(n), b = svd.V.col(n - 1);
  const double aa = form(s, p, w, a, a), ab = form(s, p, w, a, b), bb = form(s, p, w, b, b);
  return aa * bb - ab * ab > 0 ? Degeneracy::isola_centre : Degeneracy::crossing;
}

/// One more eigenvalue is zero than `known` ones. As many ranks of J = [dF/dx dF/dlambda] lost as before: a limit point
/// on the branch itself.
Degeneracy corank_of(const Matrix& J, Index known) {
  const Index n = J.rows(), lost = known + 1;
  if (n < lost) return Degeneracy::corank_two;
  const Vector values = jacobi_svd(J).values;
  return values[n - lost] > poor * values[0] ? Degeneracy::hilltop : Degeneracy::corank_two;
}

/// Rates of what turns back at a corner, lambda or what the start says, and of the surface along the curve of one side,
/// their product for a unit tangent: zero where one of them turns back; whichever way the curve is walked.
double reversal(const Augmented& s, const CurvePoint& p, const Piece& side) {
  const Vector x = s.state(p.x);
  const double lambda = s.lambda(p.x);
  BaseTerms base;
  if (!base_terms(s.family(), x, lambda, p.lambda, side, base)) return not_a_number;
  const auto h = s.surface_gradient(x, lambda, p.lambda);
  if (!h) return not_a_number;
  const Vector t = jacobi_svd(base.J, SingularVectors::none, SingularVectors::full).V.col(s.n());
  std::optional<double> rate = t[s.n()];
  if (s.start().turns)
    rate = s.start().turns(
        {.x = x, .lambda = lambda, .tangent = {t.head(s.n()), t[s.n()]}, .piece = side}, p.lambda);
  if (!rate) return not_a_number;
  return *rate * h->dot(t) / std::max(smallest_number, h->norm());
}

/// Of a switch that rests: as long as it does, and as long as the mode leaves to its side.
void watch_resting(const Augmented& system, Index j, const std::string& name,
                   std::vector<Watch>& watches) {
  constexpr double zero = TraceOptions{}.simultaneous;
  const auto rests = [&system, j](const CurvePoint& p) {
    const auto at = system.family().at(p.lambda);
    Vector g;
    if (!at || !at->switches(system.state(p.x), system.lambda(p.x), g)) return not_a_number;
    return 1 - std::abs(g[j]) / zero;
  };
  const auto along_mode = [&system, j](const CurvePoint& p) {
    const auto at = system.family().at(p.lambda);
    const auto place = system.place(p.x, p.lambda);
    Matrix dg_dx;
    Vector dg_dlambda;
    if (!at || !place ||
        !at->switch_gradients(system.state(p.x), system.lambda(p.x), dg_dx, dg_dlambda))
      return not_a_number;
    return dg_dx.row(j).dot(place->V.col(0).normalized());
  };
  watches.push_back(
      {Degeneracy::fold_meets_activation, name, rests, EventAction::stop, {}, true, 1});
  if (system.start().corank > 1) return;
  watches.push_back(
      {Degeneracy::fold_meets_activation, name, along_mode, EventAction::stop, {}, true});
  watches.back().noise = root_of_rounding;
}

void watch_surfaces(const Augmented& system, std::vector<Watch>& watches) {
  const auto problem = system.family().at(system.start().mu);
  if (!problem) return;
  const bool on_surface = system.start().kind == CriticalKind::surface;
  const std::vector<Index>& resting = system.start().resting;
  for (Index j = 0; j < problem->switch_count(); ++j) {
    if (on_surface && j == system.start().switching) continue;
    if (std::find(resting.begin(), resting.end(), j) != resting.end()) {
      watch_resting(system, j, problem->switch_name(j), watches);
      continue;
    }
    watches.push_back({on_surface ? Degeneracy::two_switches : Degeneracy::fold_meets_activation,
                       problem->switch_name(j),
                       [&system, j](const CurvePoint& p) {
                         const auto at = system.family().at(p.lambda);
                         Vector g;
                         if (!at || !at->switches(system.state(p.x), system.lambda(p.x), g))
                           return not_a_number;
                         return g[j];
                       },
                       EventAction::stop,
                       {},
                       true,
                       system.start().piece[static_cast<std::size_t>(j)],
                       [&system, j, name = problem->switch_name(j)](const CurvePoint& p) {
                         const auto at = system.family().at(p.lambda);
                         return at ? at->switch_name(j) : name;
                       }});
  }
}

/// Zero where one more eigenvalue of dF/dx vanishes.
double other_eigenvalue(const Augmented& s, const CurvePoint& p) {
  BaseTerms base;
  if (!base_terms(s.family(), s.state(p.x), s.lambda(p.x), p.lambda, s.start().piece, base))
    return not_a_number;
  return signed_least(bordered(base.A, {s.borders().left, s.borders().right}));
}

void watch_bordered(const Augmented& system, std::vector<Watch>& watches) {
  const auto corank = [&system](const CurvePoint& p) {
    BaseTerms base;
    return base_terms(system.family(), system.state(p.x), system.lambda(p.x), p.lambda,
                      system.start().piece, base)
               ? corank_of(base.J, system.borders().left.cols())
               : Degeneracy::corank_two;
  };
  watches.push_back({Degeneracy::corank_two, "",
                     [&system](const CurvePoint& p) { return other_eigenvalue(system, p); },
                     EventAction::record, corank, true});
}

/// Columns with a row of zeros at `place`.
Matrix with_zero_row(const Matrix& columns, Index place) {
  Matrix longer = Matrix::Zero(columns.rows() + 1, columns.cols());
  longer.topRows(place) = columns.topRows(place);
  longer.bottomRows(columns.rows() - place) = columns.bottomRows(columns.rows() - place);
  return longer;
}

/// On a curve of branch points: where the force has an extremum along the branch one more eigenvalue of the equations
/// with the coordinate free vanishes. With the borders of dF/dx their determinant is that of dF/dx, bordered, times the
/// force's rate along the branch.
void watch_hilltop_of_force(const Augmented& system, std::vector<Watch>& watches) {
  const Freed& of = system.start().freed;
  const auto freed = std::make_shared<FreedFamily>(system.family(), of);
  const Matrix left = with_zero_row(system.borders().left, of.place),
               right = with_zero_row(system.borders().right, of.place);
  const auto at = [&system, freed](const CurvePoint& p, BaseTerms& base) {
    const Vector x = system.state(p.x);
    const double lambda = system.lambda(p.x);
    const auto force = freed->force(x, lambda, p.lambda, system.start().piece);
    return force && base_terms(freed->family(), freed_unknowns(system.start().freed, x, lambda),
                               *force, p.lambda, system.start().piece, base);
  };
  watches.push_back(
      {Degeneracy::hilltop, of_the_force,
       [at, left, right](const CurvePoint& p) {
         BaseTerms base;
         return at(p, base) ? signed_least(bordered(base.A, {left, right})) : not_a_number;
       },
       EventAction::record,
       [at, known = left.cols()](const CurvePoint& p) {
         BaseTerms base;
         return at(p, base) ? corank_of(base.J, known) : Degeneracy::hilltop;
       },
       true});
  // Where units are equal the force is extremal at their branch point all along.
  watches.back().noise = function_noise;
}

/// The equations reduced to the modes at a point of the curve.
std::optional<ReducedForm> form_at(const Augmented& s, const CurvePoint& p) {
  CriticalStart at = s.start();
  at.x = s.state(p.x);
  at.lambda = s.lambda(p.x);
  at.mu = p.lambda;
  return reduced_form(s.family(), at, {Vector::Zero(s.n()), 1});
}

/// The cubic term of a symmetric branch point, with the borders' signs of the modes: where it changes sign, the branch
/// that leaves bends the other way. Where another eigenvalue of dF/dx vanishes the term has a pole if its mode takes
/// part: times that eigenvalue it is regular. If the mode takes no part, what vanishes there is known as the other
/// mode.
double bend_of_branch(const Augmented& s, const CurvePoint& p) {
  const auto form = form_at(s, p);
  if (!form || form->by_lambda.size() != 1) return not_a_number;
  const double signs =
      form->W.col(0).dot(s.borders().left.col(0)) * form->V.col(0).dot(s.borders().right.col(0));
  const double cubic = signs < 0 ? -form->cubic[0](0, 0) : form->cubic[0](0, 0);
  // Zero to rounding of the terms that it is made of all along: it has no zeros to be found.
  const double noise =
      between_samples * function_noise * std::max(1.0, std::abs(form->mixed(0, 0) * s.lambda(p.x)));
  return (std::abs(cubic) < noise ? noise : cubic) * other_eigenvalue(s, p);
}

void watch_bend(const Augmented& system, const CurvePoint& start, std::vector<Watch>& watches) {
  const auto form = form_at(system, start);
  if (!form || !is_symmetric_point(*form)) return;
  watches.push_back({Degeneracy::bends_other_way,
                     "",
                     [&system](const CurvePoint& p) { return bend_of_branch(system, p); },
                     EventAction::record,
                     {}});
}

void watch_corner(const Augmented& system, std::vector<Watch>& watches) {
  const auto add = [&](Degeneracy kind, const Piece& side) {
    watches.push_back({kind,
                       "",
                       [&system, side](const CurvePoint& p) { return reversal(system, p, side); },
                       EventAction::record,
                       {}});
    watches.back().noise = function_noise;
  };
  add(Degeneracy::fold_meets_activation, system.start().piece);
  add(Degeneracy::corner_loses_reversal, system.start().behind);
}

}  // namespace

CriticalPoint critical_point(const CurvePoint& p, Index n) {
  return {.s = p.s,
          .x = p.x.head(n),
          .lambda = p.x[n],
          .mu = p.lambda,
          .dx = p.tangent.dx.head(n),
          .dlambda = p.tangent.dx[n],
          .dmu = p.tangent.dlambda};
}

std::vector<Watch> watches_of(const Augmented& system, const std::vector<CriticalEvent>& events) {
  std::vector<Watch> watches;
  const CriticalKind kind = system.start().kind;
  std::function<Degeneracy(const CurvePoint&)> refine;
  if (kind == CriticalKind::limit_point)
    refine = [&system](const CurvePoint& p) { return turn_of_fold(system, p); };
  // A rate may be zero to rounding all along, or come to zero and keep its sign: at a cusp the whole tangent turns,
  // where either lambda or the parameter may be monotone.
  watches.push_back({turn_of(kind), "", [](const CurvePoint& p) { return p.tangent.dlambda; },
                     EventAction::record, refine});
  watches.back().noise = function_noise;
  const Index n = system.n();
  watches.push_back(
      {Degeneracy::extremum,
       "",
       [place = system.place_of_lambda()](const CurvePoint& p) { return p.tangent.dx[place]; },
       EventAction::record,
       {}});
  watches.back().noise = function_noise;
  if (kind == CriticalKind::limit_point || kind == CriticalKind::branch_point)
    watch_bordered(system, watches);
  if (kind == CriticalKind::branch_point && system.start().freed.at)
    watch_hilltop_of_force(system, watches);
  if (kind == CriticalKind::branch_point && system.start().corank == 1) {
    const CurvePoint start{.x = system.start_unknowns(), .lambda = system.start().mu};
    watch_bend(system, start, watches);
  }
  if (kind == CriticalKind::surface) watch_corner(system, watches);
  watch_surfaces(system, watches);
  for (const CriticalEvent& event : events) {
    watches.push_back(
        {Degeneracy::user,
         event.name,
         [&event, n](const CurvePoint& p) { return event.value(critical_point(p, n)); },
         event.action,
         {},
         event.of_place,
         event.inside});
    watches.back().tag = event.tag;
  }
  return watches;
}

Degeneracy turn_of(CriticalKind kind) {
  switch (kind) {
    case CriticalKind::limit_point:
      return Degeneracy::cusp;
    case CriticalKind::branch_point:
      return Degeneracy::branch_points_merge;
    case CriticalKind::surface:
      return Degeneracy::touches_surface;
    case CriticalKind::zero:
      return Degeneracy::turn;
  }
  return Degeneracy::turn;
}

std::string_view to_string(Degeneracy kind) {
  switch (kind) {
    case Degeneracy::cusp:
      return "cusp";
    case Degeneracy::isola_centre:
      return "isola centre";
    case Degeneracy::crossing:
      return "crossing of branches";
    case Degeneracy::hilltop:
      return "hilltop";
    case Degeneracy::branch_points_merge:
      return "a pair of branch points is born";
    case Degeneracy::corank_two:
      return "another mode vanishes at the same load";
    case Degeneracy::fold_meets_activation:
      return "fold meets activation";
    case Degeneracy::corner_loses_reversal:
      return "corner loses its reversal";
    case Degeneracy::touches_surface:
      return "the path touches the activation";
    case Degeneracy::two_switches:
      return "two activations at once";
    case Degeneracy::bends_other_way:
      return "the branch that leaves bends the other way: supercritical before, subcritical "
             "behind, or the reverse";
    case Degeneracy::turn:
      return "the parameter turns back";
    case Degeneracy::extremum:
      return "extremum of lambda";
    case Degeneracy::user:
      return "marked value";
  }
  return "";
}

}  // namespace springfold::continuation
