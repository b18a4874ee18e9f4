// The whole branch of one draw, followed from its start both ways.
#pragma once

#include <vector>

#include "embedded.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::known_answers {

/// Two curves leave the start; fewer where the engine refused it.
struct Followed {
  std::vector<continuation::Curve> curves{};
  std::string refusal{};  ///< set: the start was refused, in words
};

Followed follow(const Embedded& problem, const Draw& draw, const Vector& x, double lambda,
                const Piece& piece, const continuation::TraceOptions& options);

/// One direction only.
continuation::Curve follow_ray(const Embedded& problem, const Draw& draw, const Vector& x,
                               double lambda, const continuation::Ray& ray,
                               const continuation::TraceOptions& options);

/// Both ways from the draw's own start.
Followed follow(const Embedded& problem, const Draw& draw,
                const continuation::TraceOptions& options);

/// Ended where the draw says that the curve ends.
inline bool reached_end(const continuation::Curve& curve) {
  return curve.stop == continuation::StopReason::event;
}

/// Everything that was found, for the eye.
void print(const Embedded& problem, const Draw& draw, const Followed& followed, bool whole_log);

}  // namespace springfold::known_answers
