// What was found on one draw against what is there.
#pragma once

#include <string>
#include <vector>

#include "follow.hpp"

namespace springfold::known_answers {

enum class Outcome {
  found,        ///< right place, kind and multiplicity
  missed,       ///< passed over in silence
  mislabelled,  ///< right place, other kind or multiplicity
  cluster,      ///< within an unresolved interval with the right total multiplicity
  miscounted,   ///< within one with another total
  refused,      ///< beyond the point where the trace gave up, or in an interval not allowed for
};

/// One answer, or one false event (which takes the separation of the answer nearest to it).
struct Judged {
  double separation = 1;
  Outcome outcome = Outcome::missed;
  double place_error = 0;  ///< if found; relative to max(1, size)
  double rounding = 0;     ///< what rounding alone explains of it
};

struct Verdict {
  long number = 0;  ///< of the draw
  std::string family{};
  double gap = 1, separation = 1;
  std::vector<Judged> answers{};
  std::vector<double> false_events{};  ///< separations
  bool blurred = false;                ///< answers that double precision cannot tell apart
  bool jumped = false;                 ///< a point stands on another branch, or the curve went back
  bool wrong_index = false;
  bool refused = false;
};

/// Events closer together than this share of the size may be answered by one unresolved interval.
constexpr double may_be_cluster = 1e-4;

/// Index and branch at every stored point: sets `jumped` and `wrong_index`.
void check_points(const Embedded& problem, const Draw& draw, const continuation::Curve& curve,
                  Verdict& verdict);

/// How far rounding of dF/dq moves the place where its eigenvalue is zero, measured in z: the eigenvalue is taken as
/// linear between the place and the stored points around it, at a touch as quadratic. An error e of dF/dq moves a
/// double zero by the square root of e.
double place_rounding(const Embedded& problem, const continuation::Hit& hit,
                      const continuation::Curve& curve);

Verdict judge(const Embedded& problem, const Draw& draw, const Followed& followed);

}  // namespace springfold::known_answers
