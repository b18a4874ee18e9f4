// A curve along which a switch rests, between pieces that pass it in opposite senses, meets another surface: two ways
// lead on behind it, or none.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Gradient of u^2 / 2 - lambda u + k y^2 / 2 + c [u + y - 1/2]^+^2 / 2 with k = 1 for y > 0 and -3/2 for y < 0. Up to
/// u = 1/2 the curve is u = lambda, y = 0. Behind it y = -c / (k + c) (u - 1/2) and u + y - 1/2 has the sign of
/// k / (k + c) (u - 1/2): none of it fits to its side of y = 0 for c = 1; both pieces do for c = -2/5.
struct Resting {
  double c = 1;

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  static double k(const Piece& piece) { return piece[0] > 0 ? 1 : -1.5; }
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    const double pressed = piece[1] > 0 ? c * (x[0] + x[1] - 0.5) : 0;
    F = Vector{{x[0] - lambda + pressed, k(piece) * x[1] + pressed}};
    return true;
  }
  bool derivatives(const Vector&, double, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    dF_dx = Matrix{{1, 0}, {0, k(piece)}};
    if (piece[1] > 0) dF_dx.array() += c;
    dF_dlambda = Vector{{-1, 0}};
    return true;
  }
  static Index switch_count() { return 2; }
  static bool switches(const Vector& x, double, Vector& g) {
    g = Vector{{x[1], x[0] + x[1] - 0.5}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Matrix{{0, 1}, {1, 1}};
    dg_dlambda = Vector::Zero(2);
    return true;
  }
  Diagram diagram() const {
    return trace_diagram(*this, {{.x = Vector::Zero(2), .lambda = 0, .piece = {1, -1}}},
                         {lambda_reaches(-1), lambda_reaches(1)}, {});
  }
};

TEST(TurnUponItself, EndsTheCurveWhereNoWayLeadsOn) {
  const Diagram diagram = Resting{1}.diagram();
  EXPECT_TRUE(diagram.doubts.empty());
  int ends = 0;
  for (const Branch& branch : diagram.branches)
    if (branch.curve.stop == StopReason::turns_upon_itself) {
      ++ends;
      EXPECT_NEAR(branch.curve.hits.back().point.lambda, 0.5, 1e-10);
      EXPECT_TRUE(branch.curve.hits.back().stops);
    }
  EXPECT_EQ(ends, 1);
}

TEST(TurnUponItself, IsNoneWhereBothPiecesLeadOn) {
  const Diagram diagram = Resting{-0.4}.diagram();
  EXPECT_TRUE(diagram.doubts.empty());
  ASSERT_FALSE(diagram.junctions.empty());
  EXPECT_EQ(diagram.junctions.back().ways.size(), 3u);
  // Behind it lambda = u + c k / (k + c) (u - 1/2): u at the end of the range, lambda = 1.
  std::vector<double> ends;
  for (const Branch& branch : diagram.branches)
    if (branch.curve.stop == StopReason::event && branch.curve.hits.back().point.lambda > 0.9)
      ends.push_back(branch.curve.hits.back().point.x[0]);
  std::sort(ends.begin(), ends.end());
  const auto end = [](double k) { return 0.5 + 0.5 / (1 - 0.4 * k / (k - 0.4)); };
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[0], end(-1.5), 1e-10);
  EXPECT_NEAR(ends[1], end(1), 1e-10);
}

}  // namespace
}  // namespace springfold::continuation
