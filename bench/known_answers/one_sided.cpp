// A spring and others that act on one side only: lambda = k0 x + sum k_i s_i max(0, s_i (x - d_i)).
#include <algorithm>
#include <cmath>

#include "families.hpp"
#include "one_unknown.hpp"

namespace springfold::known_answers {
namespace {

struct OneSided {
  double k0 = 1;
  std::vector<double> d{}, s{}, k{};  ///< threshold, acting side, stiffness

  bool acts(std::size_t i, const Piece& piece) const { return (piece[i] > 0) == (s[i] > 0); }
  double force(double x, const Piece& piece) const {
    double value = k0 * x;
    for (std::size_t i = 0; i < d.size(); ++i)
      if (acts(i, piece)) value += k[i] * (x - d[i]);
    return value;
  }
  double slope(const Piece& piece) const {
    double value = k0;
    for (std::size_t i = 0; i < d.size(); ++i)
      if (acts(i, piece)) value += k[i];
    return value;
  }
};

Piece piece_at(const OneSided& springs, double x) {
  Piece piece;
  for (const double d : springs.d) piece.push_back(x > d ? 1 : -1);
  return piece;
}

/// One to four places with one to five switches each, some of them close.
OneSided random_springs(Random& random) {
  OneSided springs{.k0 = log_uniform(random, 0.3, 3) * sign(random)};
  const int places = 1 + choice(random, 4);
  double d = uniform(random, -0.9, 0.9);
  for (int i = 0; i < places; ++i) {
    const int together = choice(random, 3) == 0 ? 2 + choice(random, 4) : 1;
    for (int j = 0; j < together; ++j) {
      springs.d.push_back(d);
      springs.s.push_back(sign(random));
      springs.k.push_back(log_uniform(random, 0.3, 3) * sign(random));
    }
    d = choice(random, 2) ? d + 3 * closeness(random) : uniform(random, -0.9, 0.9);
  }
  return springs;
}

/// Slopes between the places, from left to right.
struct Slopes {
  std::vector<double> places{}, left{}, right{};
};

Slopes slopes_of(const OneSided& springs) {
  Slopes slopes{.places = springs.d};
  std::sort(slopes.places.begin(), slopes.places.end());
  slopes.places.erase(std::unique(slopes.places.begin(), slopes.places.end()), slopes.places.end());
  for (const double d : slopes.places) {
    slopes.right.push_back(springs.slope(piece_at(springs, std::nextafter(d, 2.0))));
    slopes.left.push_back(springs.slope(piece_at(springs, d)));
  }
  return slopes;
}

/// No slope so small that its sign, and with it the label, would be a matter of rounding.
bool clear(const Slopes& slopes) {
  const auto small = [](double v) { return std::abs(v) < 0.05; };
  return std::none_of(slopes.left.begin(), slopes.left.end(), small) &&
         std::none_of(slopes.right.begin(), slopes.right.end(), small);
}

Base base_of(const OneSided& springs) {
  return {1,
          [=](const Vector& z, double lambda, const Piece& piece, Vector& F, Matrix& H,
              Vector& F_lambda) {
            F = scalar(springs.force(z[0], piece) - lambda);
            H = Matrix::Constant(1, 1, springs.slope(piece));
            F_lambda = scalar(-1);
            return true;
          },
          springs.d};
}

}  // namespace

Draw one_sided(Random& random) {
  OneSided springs = random_springs(random);
  Slopes slopes = slopes_of(springs);
  while (!clear(slopes)) {
    springs = random_springs(random);
    slopes = slopes_of(springs);
  }
  Draw draw{.family = "one-sided", .base = base_of(springs)};
  const auto force = [=](double x) { return springs.force(x, piece_at(springs, x)); };
  double extent = 0;
  for (std::size_t i = 0; i < slopes.places.size(); ++i) {
    const double d = slopes.places[i];
    const bool turns = slopes.left[i] * slopes.right[i] < 0;
    const auto count = std::count(springs.d.begin(), springs.d.end(), d);
    draw.answers.push_back({turns ? AnswerKind::corner : AnswerKind::kink, force(d), scalar(d),
                            static_cast<int>(count)});
    extent = std::max(extent, std::abs(force(d)));
  }
  limit_unknown(draw, 0, -1.5, 1.5);
  draw.z_start = scalar(uniform(random, -1.4, -1.1));
  draw.lambda_start = force(draw.z_start[0]);
  draw.size = std::max(3.0, 2 * std::max({extent, std::abs(force(-1.5)), std::abs(force(1.5))}));
  draw.parameter = [](const Vector& z, double) { return z[0]; };
  complete(draw);
  return draw;
}

}  // namespace springfold::known_answers
