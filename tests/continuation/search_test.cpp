// Searches for all solutions at one lambda, on problems whose solutions are known in closed form.
#include "springfold/continuation/search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "problems.hpp"
#include "von_mises.hpp"

namespace springfold::continuation {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SearchOptions box(const Vector& low, const Vector& high) { return {.low = low, .high = high}; }

SearchOptions box(double half, Index n) {
  return box(Vector::Constant(n, -half), Vector::Constant(n, half));
}

void expect_solved(ProblemView problem, double lambda, const SearchResult& result) {
  ASSERT_EQ(result.solutions.size(), result.pieces.size());
  ASSERT_EQ(result.solutions.size(), result.notes.size());
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    Vector F;
    ASSERT_TRUE(problem.residual(result.solutions[i], lambda, result.pieces[i], F));
    const double scale = std::max(1.0, result.solutions[i].lpNorm<Eigen::Infinity>());
    EXPECT_LE(F.lpNorm<Eigen::Infinity>(), 1e-12 * scale);
  }
}

bool has(const SearchResult& result, const Vector& x, double tolerance = 1e-10) {
  return std::any_of(result.solutions.begin(), result.solutions.end(), [&](const Vector& solution) {
    return (solution - x).lpNorm<Eigen::Infinity>() <= tolerance;
  });
}

void expect_exactly(const SearchResult& result, const std::vector<Vector>& expected) {
  EXPECT_EQ(result.solutions.size(), expected.size());
  for (const Vector& x : expected) EXPECT_TRUE(has(result, x)) << x.transpose();
}

/// (x + 2)(x + 0.5)(x - 0.1)(x - 1)(x - 3) = lambda.
ScalarProblem quintic() {
  static const std::vector<double> roots{-2, -0.5, 0.1, 1, 3};
  return {[](double x, double l) {
            double product = 1;
            for (const double root : roots) product *= x - root;
            return product - l;
          },
          [](double x, double) {
            double sum = 0;
            for (std::size_t i = 0; i < roots.size(); ++i) {
              double product = 1;
              for (std::size_t j = 0; j < roots.size(); ++j)
                if (j != i) product *= x - roots[j];
              sum += product;
            }
            return sum;
          },
          [](double, double) { return -1.0; }};
}

TEST(Search, FindsAllRealRootsOfAPolynomialInOrder) {
  const SearchResult result = search_at(quintic(), 0, {}, box(4, 1));
  expect_solved(quintic(), 0, result);
  ASSERT_EQ(result.solutions.size(), 5u);
  const std::vector<double> roots{-2, -0.5, 0.1, 1, 3};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(result.solutions[i][0], roots[i], 1e-12);
  EXPECT_EQ(result.starts_used, 64);
  EXPECT_EQ(result.dead_ends, 64);
  EXPECT_FALSE(result.limit_reached);
  EXPECT_THAT(result.notes, Each(std::string{}));
}

TEST(Search, OfOneStartGoesOnToFurtherRootsByDeflation) {
  SearchOptions options = box(4, 1);
  options.starts = 1;
  const SearchResult result = search_at(quintic(), 0, {}, options);
  EXPECT_GE(result.solutions.size(), 2u) << "Newton's method alone finds one from one start";
}

TEST(Search, DoesNotListKnownSolutionsAgain) {
  const std::vector<Vector> known{Vector::Constant(1, 0.1), Vector::Constant(1, -2)};
  const SearchResult result = search_at(quintic(), 0, known, box(4, 1));
  expect_exactly(result,
                 {Vector::Constant(1, -0.5), Vector::Constant(1, 1), Vector::Constant(1, 3)});
}

TEST(Search, SaysWhenItStopsAtTheLargestNumberOfSolutions) {
  SearchOptions options = box(4, 1);
  options.maximum_solutions = 3;
  const SearchResult result = search_at(quintic(), 0, {}, options);
  EXPECT_EQ(result.solutions.size(), 3u);
  EXPECT_TRUE(result.limit_reached);
}

TEST(Search, GivesTheSameBytesForTheSameSeed) {
  const VonMises truss{};
  const SearchResult a = search_at(truss, 0.05, {}, box(2, 2));
  const SearchResult b = search_at(truss, 0.05, {}, box(2, 2));
  EXPECT_EQ(a.solutions, b.solutions);
  EXPECT_EQ(a.dead_ends, b.dead_ends);
}

/// V = (m1 - l) x^2 / 2 + (m2 - l) y^2 / 2 + (a x^4 + 2 b x^2 y^2 + c y^4) / 4.
struct CoupledModes {
  double m1 = 1, m2 = 1.3, a = 1, b = 0.4, c = 0.8;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& u, double l, Vector& F) const {
    const double x = u[0], y = u[1];
    F = Vector{{x * (m1 - l + a * x * x + b * y * y), y * (m2 - l + b * x * x + c * y * y)}};
    return true;
  }
  bool derivatives(const Vector& u, double l, Matrix& dF_dx, Vector& dF_dlambda) const {
    const double x = u[0], y = u[1];
    dF_dx = Matrix{{m1 - l + 3 * a * x * x + b * y * y, 2 * b * x * y},
                   {2 * b * x * y, m2 - l + b * x * x + 3 * c * y * y}};
    dF_dlambda = -u;
    return true;
  }
};

TEST(Search, FindsTrivialSingleAndMixedModes) {
  const CoupledModes modes{};
  const double l = 2.5, D = modes.a * modes.c - modes.b * modes.b;
  const double X = std::sqrt((l - modes.m1) / modes.a), Y = std::sqrt((l - modes.m2) / modes.c);
  // a X^2 + b Y^2 = l - m1, b X^2 + c Y^2 = l - m2
  const double x = std::sqrt((modes.c * (l - modes.m1) - modes.b * (l - modes.m2)) / D);
  const double y = std::sqrt((modes.a * (l - modes.m2) - modes.b * (l - modes.m1)) / D);
  const SearchResult result = search_at(modes, l, {}, box(3, 2));
  expect_solved(modes, l, result);
  expect_exactly(result,
                 {Vector{{0, 0}}, Vector{{X, 0}}, Vector{{-X, 0}}, Vector{{0, Y}}, Vector{{0, -Y}},
                  Vector{{x, y}}, Vector{{x, -y}}, Vector{{-x, y}}, Vector{{-x, -y}}});
}

TEST(Search, FindsOnlyTheTrivialStateBeforeTheFirstBranchPoint) {
  expect_exactly(search_at(CoupledModes{}, 0.9, {}, box(3, 2)), {Vector{{0, 0}}});
}

TEST(Search, FindsTheDetachedBranchOfAnImperfectPitchfork) {
  // x^3 - (lambda - 1) x + eta = 0: two more solutions beyond lambda = 1 + 3 (eta/2)^(2/3).
  const double eta = 0.02, fold = 1 + 3 * std::pow(eta / 2, 2.0 / 3);
  const ScalarProblem imperfect{[=](double x, double l) { return x * x * x - (l - 1) * x + eta; },
                                [](double x, double l) { return 3 * x * x - (l - 1); },
                                [](double x, double) { return -x; }};
  const SearchResult before = search_at(imperfect, fold - 1e-3, {}, box(2, 1));
  ASSERT_EQ(before.solutions.size(), 1u);
  EXPECT_LT(before.solutions[0][0], 0);
  for (const double beyond : {1e-3, 0.1, 1.0}) {
    const double l = fold + beyond;
    const SearchResult main = search_at(imperfect, l, {}, box(2, 1));
    ASSERT_EQ(main.solutions.size(), 3u) << "lambda = fold + " << beyond;
    const SearchResult rest = search_at(imperfect, l, {main.solutions[0]}, box(2, 1));
    expect_exactly(rest, {main.solutions[1], main.solutions[2]});
    EXPECT_GT(rest.solutions[0][0], 0) << "both on the detached branch";
  }
}

TEST(Search, FindsTheEquilibriaOfTheVonMisesTrussWithinItsSnapRange) {
  // A shallow truss does not sway: three upright equilibria between its limit loads.
  const VonMises truss{};
  const double load = 0.5 * truss.upright_load(truss.height_at_limit_point());
  const SearchResult result = search_at(truss, load, {}, box(1.5, 2));
  expect_solved(truss, load, result);
  int upright = 0;
  for (const Vector& u : result.solutions) {
    if (std::abs(u[0]) > 1e-10) {
      EXPECT_TRUE(has(result, Vector{{-u[0], u[1]}})) << "mirror image of " << u.transpose();
      continue;
    }
    EXPECT_NEAR(truss.upright_load(u[1]), load, 1e-11);
    ++upright;
  }
  EXPECT_EQ(upright, 3);
}

TEST(Search, FindsTheSwayedEquilibriaOfASteepTruss) {
  // The sway branch leaves the upright one at L^3 - L0 L^2 + L0 a^2 = 0, downwards in load.
  const VonMises steep{.a = 0.4};
  double L = steep.L0;  // the larger root, by Newton's method from above
  for (int i = 0; i < 50; ++i)
    L -= (L * L * (L - steep.L0) + steep.L0 * steep.a * steep.a) / (L * (3 * L - 2 * steep.L0));
  const double sway = steep.upright_load(std::sqrt(L * L - steep.a * steep.a));
  const auto swayed = [&](double load) {
    const SearchResult result = search_at(steep, load, {}, box(1.5, 2));
    expect_solved(steep, load, result);
    int count = 0;
    for (const Vector& u : result.solutions) {
      if (std::abs(u[0]) < 1e-10) continue;
      EXPECT_TRUE(has(result, Vector{{-u[0], u[1]}})) << "mirror image of " << u.transpose();
      ++count;
    }
    return count;
  };
  EXPECT_EQ(swayed(0.9 * sway), 2);
  EXPECT_EQ(swayed(0.6 * sway), 2);
  EXPECT_EQ(swayed(1.1 * sway), 0);
}

/// n rigid links (length 1) on torsion springs (stiffness 1), lambda on top: gradient of
/// 1/2 sum (t_i - t_{i-1})^2 - lambda sum (1 - cos t_i), t_0 = 0.
struct Column {
  Index n = 2;
  Index size() const { return n; }
  static bool symmetric() { return true; }
  bool residual(const Vector& t, double l, Vector& F) const {
    F.resize(n);
    for (Index i = 0; i < n; ++i) {
      F[i] = t[i] - (i > 0 ? t[i - 1] : 0) - l * std::sin(t[i]);
      if (i + 1 < n) F[i] -= t[i + 1] - t[i];
    }
    return true;
  }
  bool derivatives(const Vector& t, double l, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      dF_dx(i, i) = (i + 1 < n ? 2 : 1) - l * std::cos(t[i]);
      if (i > 0) dF_dx(i, i - 1) = dF_dx(i - 1, i) = -1;
    }
    dF_dlambda = -t.array().sin();
    return true;
  }
  double buckling_load(Index j) const {
    const double n_links = static_cast<double>(n), mode = static_cast<double>(j);
    const double s = std::sin((2 * mode - 1) * std::numbers::pi / (4 * n_links + 2));
    return 4 * s * s;
  }
};

TEST(Search, FindsThePairOfEveryBuckledModeOfAColumn) {
  // Just beyond load j there are 2 j + 1 solutions: straight, and a mirrored pair for each mode.
  for (const Index n : {2, 3}) {
    const Column column{n};
    for (Index j = 1; j <= n; ++j) {
      const double load = 1.02 * column.buckling_load(j);
      const SearchResult result = search_at(column, load, {}, box(3, n));
      expect_solved(column, load, result);
      EXPECT_TRUE(has(result, Vector::Zero(n)));
      EXPECT_GE(result.solutions.size(), static_cast<std::size_t>(2 * j + 1)) << n << " links";
      for (const Vector& t : result.solutions) EXPECT_TRUE(has(result, -t)) << t.transpose();
    }
  }
}

/// A pendulum with its weight at the side: sin t = lambda, twice round the circle.
struct Pendulum {
  double period = 0;
  static Index size() { return 1; }
  static bool residual(const Vector& t, double l, Vector& F) {
    F = Vector::Constant(1, std::sin(t[0]) - l);
    return true;
  }
  static bool derivatives(const Vector& t, double, Matrix& dF_dx, Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, std::cos(t[0]));
    dF_dlambda = Vector::Constant(1, -1);
    return true;
  }
  Vector periods() const { return Vector::Constant(1, period); }
};

TEST(Search, TakesSolutionsThatDifferByAPeriodForOne) {
  using std::numbers::pi;
  const double l = 0.5;
  const SearchResult round = search_at(Pendulum{2 * pi}, l, {}, box(10, 1));
  expect_exactly(round, {Vector::Constant(1, pi / 6), Vector::Constant(1, 5 * pi / 6)});
  EXPECT_GT(search_at(Pendulum{0}, l, {}, box(10, 1)).solutions.size(), 4u);
  const std::vector<Vector> known{Vector::Constant(1, pi / 6 + 4 * pi)};
  expect_exactly(search_at(Pendulum{2 * pi}, l, known, box(10, 1)),
                 {Vector::Constant(1, 5 * pi / 6)});
}

TEST(Search, FindsOneSolutionOnEachPieceOfABrokenLine) {
  // Slopes 1, -2, 1.5 with corners at 0 and 0.5: x = lambda, -lambda/2, (lambda + 1.75)/1.5.
  const PiecewiseLine line{1, {{-3, 0, 1}, {3.5, 0.5, 1}}};
  const double l = -0.4;
  const SearchResult result = search_at(line, l, {}, box(2, 1));
  expect_solved(line, l, result);
  expect_exactly(result, {Vector::Constant(1, l), Vector::Constant(1, -l / 2),
                          Vector::Constant(1, (l + 1.75) / 1.5)});
  EXPECT_THAT(result.pieces, ElementsAre(Piece{-1, -1}, Piece{1, -1}, Piece{1, 1}));
  EXPECT_EQ(search_at(line, 0.4, {}, box(2, 1)).solutions.size(), 1u);
}

TEST(Search, NotesASolutionOnASwitchingSurface) {
  const PiecewiseLine line{1, {{2, 0.5, 1}}};
  const SearchResult result = search_at(line, 0.5, {}, box(2, 1));
  ASSERT_EQ(result.solutions.size(), 1u);
  EXPECT_NEAR(result.solutions[0][0], 0.5, 1e-12);
  EXPECT_THAT(result.notes[0], HasSubstr("stop 1"));
}

TEST(Search, NotesThatALimitPointIsLessExactAndListsItOnce) {
  // lambda = x^3 - 3 x at lambda = 2: a double root at -1 and a simple one at 2.
  const SearchResult result = search_at(cusp(3), 2, {}, box(4, 1));
  ASSERT_EQ(result.solutions.size(), 2u);
  EXPECT_NEAR(result.solutions[0][0], -1, 1e-5);
  EXPECT_THAT(result.notes[0], HasSubstr("nearly singular"));
  EXPECT_NEAR(result.solutions[1][0], 2, 1e-12);
  EXPECT_THAT(result.notes[1], IsEmpty());
}

TEST(Search, SaysWhatIsWrongWithItsOptions) {
  EXPECT_THAT(problems_in(box(1, 2), 2), IsEmpty());
  EXPECT_THAT(problems_in(box(1, 2), 3), ElementsAre(HasSubstr("unknowns")));
  SearchOptions options = box(Vector{{0, 1}}, Vector{{1, 0}});
  options.starts = 0;
  EXPECT_THAT(problems_in(options, 2), ElementsAre(HasSubstr("low <= high"), HasSubstr("starts")));
}

}  // namespace
}  // namespace springfold::continuation
