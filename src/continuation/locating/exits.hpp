// All branches that leave a singular point. Private to the engine.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "continuation/points/step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// A branch that leaves a special point.
struct Exit {
  Direction tangent{};  ///< limit direction at the special point, unit in the metric, outward
  double accuracy = 0;  ///< of `tangent`, estimated; beyond 1e-3 the result is not `complete`
  CurvePoint start{};   ///< a point of the branch a small distance away: residual at tolerance, its
                        ///< own unit tangent oriented outward, inertia counted; s is the distance
  std::optional<CurvePoint> beyond{};  ///< set where the start was brought in: where it was found
};

struct Exits {
  std::vector<Exit> exits{};
  bool complete = true;  ///< false: some may be missing or wrong; `why` says what went wrong
  std::string why{};
  bool of_quadratic =
      false;  ///< close modes: their branches are told from each other by quadratic terms
};

/// Is this point of a branch near enough to the singular point, of whose branch it has the limit
/// direction `tangent`? Say, before the next switching surface.
using NearEnough = std::function<bool(const CurvePoint& start, const Direction& tangent)>;

/// All branches of one piece that leave a located singular point u0 = (x, lambda). With the right
/// and left kernels N (n + 1 x k + 1) and L (n x k) of J0 = [dF/dx dF/dlambda] the equations are
/// reduced to k in k + 1 unknowns (Lyapunov and Schmidt; Golubitsky and Schaeffer 1985, chapter VII),
///
///     (I - L L^T) F(u0 + N c + w) = 0,   N^T w = 0   =>   w(c),
///     g(c) = L^T F(u0 + N c + w(c)) = 0,
///
/// and the branches are the zeros of g on small spheres |c| = rho. They are searched for at finite
/// radius, whatever the order of contact: on a circle for k = 1; on the sphere, and along the azimuth
/// with the lambda-like component eliminated, for k = 2. Neighbouring radii must show the same
/// branches, and as many must enter the sphere as leave it (degree); otherwise `complete` is false.
/// So it is for k > 2, where nothing is searched. A search by samples: no proof.
///
/// The tangents are exact (about 1e-10) where the quadratic terms of g determine them, and extrapolated in rho
/// elsewhere: to about 1e-6, or 1e-4 where only terms of high order tell the branches apart. Switches of at.piece are
/// not considered. Starts are brought in by halves until `near_enough` holds for them, to 1e-9 of max(1, |u0|) at most;
/// the search itself does not depend on it: F of one piece is smooth beyond its surfaces.
/// @param at  the singular point (x, lambda, piece), located to about 1e-10
/// @param corank  k = dim ker J0 - 1; 0 at a regular point, which has its two directions
Exits exits_at(const Walker& walker, const CurvePoint& at, int corank,
               const NearEnough& near_enough = {});

/// All branches that leave a simple branch point beside which one other mode vanishes: those that cross the sphere of
/// the radius `told_apart` around it, by the reduced equations of both modes, as they do two and four times as far out.
/// Not complete where a third mode vanishes, or nearly, so near.
Exits exits_of_close_modes(const Walker& walker, const CurvePoint& at,
                           const NearEnough& near_enough = {});

/// How many modes vanish along the curve within a distance of a singular point, its own among them? By what the matrix
/// makes of them a little way back along the point's tangent; 0 where it is not defined.
Index modes_within(const Walker& walker, const CurvePoint& at, double within);

/// Corank of [dF/dx dF/dlambda] at a point: how many of its singular values are below the share, which is as good as
/// the point is known, and separated from the others by a gap, after rows and columns have been divided by their sizes.
/// Sizes are those of the matrix here or a hundredth of its change within a tenth, whichever is larger: here all of it
/// may vanish. -1 outside the domain.
int corank_of(const Walker& walker, const CurvePoint& at, double share = poor);

}  // namespace springfold::continuation
