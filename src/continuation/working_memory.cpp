#include "working_memory.hpp"

#include <algorithm>

namespace springfold::continuation {

std::shared_ptr<WorkingMemory> working_memory() { return std::make_shared<WorkingMemory>(); }

Place* place_at(ProblemView problem, WorkingMemory& memory, const Vector& x, double lambda,
                const Piece& piece) {
  const auto known = std::find_if(memory.places.begin(), memory.places.end(), [&](const Place& p) {
    return p.lambda == lambda && p.x == x && p.piece == piece;
  });
  if (known != memory.places.end()) return &*known;
  Place& place = memory.places[memory.oldest];
  place.lambda = std::numeric_limits<double>::quiet_NaN();
  if (!linearise(problem, x, lambda, piece, place.at)) return nullptr;
  memory.oldest = (memory.oldest + 1) % memory.places.size();
  place.x = x;
  place.lambda = lambda;
  place.piece = piece;
  place.factors.begin(place.at, problem.symmetric());
  return &place;
}

}  // namespace springfold::continuation
