// F, evaluated together with its derivatives and alone.
#include "path_problems.hpp"

namespace springfold::analysis {
namespace {

TEST(EquationsOfAPath, GiveTheSameNumbersWithDerivativesAndWithout) {
  for (const bool held : {false, true})
    for (const model::SpringLaw& knee : {linear(0.05), one_sided(0.05, 0.8)}) {
      const PathProblem problem = problem_of(knee, held);
      Vector y = Vector::Constant(problem.size(), 0.05), F, F_alone, b;
      Matrix A;
      for (int k = 0; k < 5; ++k) {
        y[k] += 0.1;
        const Piece piece = piece_at(problem, y);
        ASSERT_TRUE(problem.equations(y, 0.3, piece, F, A, b));
        ASSERT_TRUE(problem.residual(y, 0.3, piece, F_alone));
        EXPECT_EQ(F, F_alone);
        EXPECT_GT(F.norm(), 0);
      }
    }
}

}  // namespace
}  // namespace springfold::analysis
