// F and its derivatives, evaluated together and apart.
#include "path_problems.hpp"

namespace springfold::analysis {
namespace {

TEST(EquationsOfAPath, AreTheSameNumbersTogetherAndApart) {
  for (const bool held : {false, true})
    for (const model::SpringLaw& knee : {linear(0.05), one_sided(0.05, 0.8)}) {
      const PathProblem problem = problem_of(knee, held);
      Vector y = Vector::Constant(problem.size(), 0.05), F, F_apart, b, b_apart;
      Matrix A, A_apart;
      for (int k = 0; k < 5; ++k) {
        y[k] += 0.1;
        const Piece piece = piece_at(problem, y);
        ASSERT_TRUE(problem.equations(y, 0.3, piece, F, A, b));
        ASSERT_TRUE(problem.residual(y, 0.3, piece, F_apart));
        ASSERT_TRUE(problem.derivatives(y, 0.3, piece, A_apart, b_apart));
        EXPECT_EQ(F, F_apart);
        EXPECT_EQ(A, A_apart);
        EXPECT_EQ(b, b_apart);
      }
    }
}

}  // namespace
}  // namespace springfold::analysis
