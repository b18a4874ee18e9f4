#include "asking.hpp"

#include "springfold/continuation/interrupted.hpp"

namespace springfold::analysis {

bool Asking::step(int points, double s) const {
  points_ = points;
  s_ = s;
  return ask(Clock::now());
}

bool Asking::goes_on() const {
  constexpr std::chrono::milliseconds between_questions{20};
  if (stopped_) return false;
  if (!observer_) return true;
  const auto now = Clock::now();
  return now - asked_ < between_questions || ask(now);
}

bool Asking::has_a_moment() const {
  constexpr std::chrono::milliseconds moment{250};
  return goes_on() || Clock::now() - *stopped_ < moment;
}

bool Asking::ask(Clock::time_point now) const {
  asked_ = now;
  if (!stopped_ && observer_ && !observer_(points_, s_)) stopped_ = now;
  return !stopped_;
}

void AskedProblem::go_on() const {
  if (!asking_.goes_on()) throw continuation::Interrupted{};
}

}  // namespace springfold::analysis
