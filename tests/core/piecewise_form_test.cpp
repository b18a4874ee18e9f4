// Quadratic forms on cones: closed forms in one and two unknowns, and sampling in more.
#include "springfold/core/piecewise_form.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace springfold {
namespace {

PiecewiseForm two_opposite(double base, double right, double left) {
  return {Matrix::Constant(1, 1, base), Matrix{{1}, {-1}}, Vector{{right, left}}};
}

TEST(PiecewiseForm, TwoOppositeSpringsHoldWhatNoneHoldsAlone) {
  const FormJudgement j = judge(two_opposite(-0.4, 1, 0.5));
  EXPECT_EQ(j.verdict, Definiteness::positive) << "1 - 0.4 to the right, 0.5 - 0.4 to the left";
  EXPECT_EQ(j.fewest, 0);
  EXPECT_EQ(j.most, 0) << "both springs, or none, act nowhere";
}

TEST(PiecewiseForm, OneWeakSideIsEnoughToLoseStability) {
  const FormJudgement j = judge(two_opposite(-0.6, 1, 0.5));
  EXPECT_EQ(j.verdict, Definiteness::not_positive);
  EXPECT_EQ(j.fewest, 0);
  EXPECT_EQ(j.most, 1);
}

TEST(PiecewiseForm, AtTheCriticalLoadItIsUndecided) {
  EXPECT_EQ(judge(two_opposite(-0.5, 1, 0.5)).verdict, Definiteness::undecided);
}

TEST(PiecewiseForm, AnIndefinitePieceMayBePositiveOnItsCone) {
  // x^2 + 4 x y + y^2 is negative only where x and y have opposite signs; there springs act.
  const PiecewiseForm form{Matrix{{1, 2}, {2, 1}}, Matrix{{1, -0.2}, {-0.2, 1}}, Vector{{9, 9}}};
  const FormJudgement j = judge(form);
  EXPECT_EQ(j.verdict, Definiteness::positive);
  EXPECT_EQ(j.most, 1) << "the piece without springs is indefinite, yet has an interior";
}

TEST(PiecewiseForm, AgreesWithSampling) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int positive = 0, negative = 0;
  for (int draw = 0; draw < 300; ++draw) {
    const Index r = 1 + draw % 4, k = 1 + draw % 5;
    PiecewiseForm form{Matrix(r, r), Matrix(k, r), Vector(k)};
    for (Index i = 0; i < r; ++i)
      for (Index j = 0; j < r; ++j) form.H(i, j) = normal(random);
    form.H = (0.5 * (form.H + form.H.transpose()) + 0.7 * Matrix::Identity(r, r)).eval();
    for (Index i = 0; i < k; ++i) {
      for (Index j = 0; j < r; ++j) form.directions(i, j) = normal(random);
      form.jumps[i] = 3 * std::abs(normal(random));
    }
    double least = HUGE_VAL;
    for (int i = 0; i < 4000; ++i) {
      Vector v(r);
      for (Index j = 0; j < r; ++j) v[j] = normal(random);
      v.normalize();
      const Vector y = (form.directions * v).cwiseMax(0);
      least = std::min(least, v.dot(form.H * v) + form.jumps.dot(y.cwiseAbs2()));
    }
    const FormJudgement j = judge(form);
    const bool is_positive = j.verdict == Definiteness::positive;
    EXPECT_TRUE(!is_positive || least > 0) << draw;
    EXPECT_TRUE(least >= 0 || j.verdict == Definiteness::not_positive) << draw;
    EXPECT_TRUE(least < 0.05 || is_positive) << draw;
    (j.verdict == Definiteness::positive ? positive : negative) += 1;
  }
  EXPECT_GT(positive, 30);
  EXPECT_GT(negative, 30);
}

TEST(PiecewiseForm, IsCondensedFromAMatrixWithConstraints) {
  // Two one-sided springs on one lever: y_1 = q, y_2 = -2 q, with multipliers and V = q^2 s / 2.
  const double s = -0.3, k1 = 1, k2 = 0.2;
  Matrix M = Matrix::Zero(5, 5);  // q, y_1, y_2, two multipliers
  M(0, 0) = s;
  M(1, 1) = k1;  // spring 1 acts, spring 2 does not
  const auto tie = [&](Index row, Index column, double a) { M(row, column) = M(column, row) = a; };
  tie(3, 1, 1);
  tie(3, 0, -1);
  tie(4, 2, 1);
  tie(4, 0, 2);
  const Matrix G = M.inverse().block(1, 1, 2, 2);
  const auto condensed = condensed_form(G, 2, Vector{{k1, k2}}, Vector{{1, -1}});
  ASSERT_TRUE(condensed);
  EXPECT_EQ(condensed->across, 2) << "the multipliers";
  ASSERT_EQ(condensed->form.H.rows(), 1) << "the lever has one degree of freedom";
  const Vector v = condensed->form.directions.row(0).transpose();
  EXPECT_NEAR(condensed->form.H(0, 0) / (v[0] * v[0]), s, 1e-12);
  EXPECT_EQ(judge(condensed->form).verdict, Definiteness::positive) << "s + k1 and s + 4 k2";
}

TEST(Cones, AreEmptyLikeTheirRowsSay) {
  EXPECT_TRUE(inside_cone(Matrix{{1, 0}, {0, 1}}));
  EXPECT_FALSE(inside_cone(Matrix{{1, 0}, {-1, 0}}));
  EXPECT_FALSE(inside_cone(Matrix{{1, 0}, {-1, 1}, {-1, -1}}));
  EXPECT_TRUE(is_subspace(Matrix{{1, 0}, {-1, 0}}));
  EXPECT_TRUE(is_subspace(Matrix{{1, 0}, {-1, 1}, {-1, -1}}));
  EXPECT_FALSE(is_subspace(Matrix{{1, 0}, {-1, 0}, {0, 1}})) << "a ray";
}

}  // namespace
}  // namespace springfold
