// Rows of sliding bodies between springs that switch: their energy is strictly convex, and under a load on the last one
// they follow one path of straight pieces, which linear algebra gives (a linear complementarity problem per switching).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "cases/number_text.hpp"

namespace springfold::io {

using Real = long double;

/// Between two bodies, or the ground (-1) and one: breaks of its elongation, and the stiffness before, between and
/// behind them.
struct RowSpring {
  int from = -1, to = 0;
  std::vector<double> breaks{};
  std::vector<Real> stiffness{};
  std::string law{};
};

struct Row {
  int bodies = 1;
  double unit = 1;  ///< distance of the bodies
  std::vector<RowSpring> springs{};
};

struct Switching {
  Real lambda = 0, last = 0;  ///< the load, and how far the last body has moved
  std::set<std::string> names{};
  std::vector<Real> x{};
};

inline std::string spring_name(std::size_t k) { return "b" + std::to_string(k); }

inline Real elongation(const RowSpring& s, const std::vector<Real>& x) {
  return x[static_cast<std::size_t>(s.to)] -
         (s.from >= 0 ? x[static_cast<std::size_t>(s.from)] : Real{0});
}

/// Displacements for a load `sign` on the last body, with every spring as stiff as its segment says. Elimination
/// without pivots of a diagonally dominant matrix, exact to a few units of rounding in every entry.
inline std::vector<Real> row_rates(const Row& row, const std::vector<std::size_t>& segments,
                                   int sign) {
  const auto n = static_cast<std::size_t>(row.bodies);
  std::vector<std::vector<Real>> A(n, std::vector<Real>(n + 1, 0));
  A[n - 1][n] = sign;
  for (std::size_t k = 0; k < row.springs.size(); ++k) {
    const RowSpring& s = row.springs[k];
    const Real stiff = s.stiffness[segments[k]];
    const auto j = static_cast<std::size_t>(s.to);
    A[j][j] += stiff;
    if (s.from < 0) continue;
    const auto i = static_cast<std::size_t>(s.from);
    A[i][i] += stiff;
    A[i][j] -= stiff;
    A[j][i] -= stiff;
  }
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t r = c + 1; r < n; ++r)
      for (std::size_t q = n + 1; q-- > c;) A[r][q] -= A[r][c] / A[c][c] * A[c][q];
  std::vector<Real> x(n);
  for (std::size_t c = n; c-- > 0;) {
    x[c] = A[c][n];
    for (std::size_t q = c + 1; q < n; ++q) x[c] -= A[c][q] * x[q];
    x[c] /= A[c][c];
  }
  return x;
}

/// The path to one side: what switches at the start is told by its first segments.
struct RowPath {
  std::vector<std::size_t> first{};
  std::vector<Switching> switchings{};
};

inline bool is_on(Real elongation, double at, double unit) {
  return std::abs(elongation - static_cast<Real>(at)) <= Real{1e-16} * static_cast<Real>(unit);
}

/// The segments that springs on their breaks enter, and the rates there.
inline std::vector<Real> leave(const Row& row, const std::vector<Real>& x, int sign,
                               std::vector<std::size_t>& segments) {
  std::vector<std::size_t> resting;
  segments.assign(row.springs.size(), 0);
  for (std::size_t k = 0; k < row.springs.size(); ++k)
    for (const double at : row.springs[k].breaks) {
      const Real e = elongation(row.springs[k], x);
      if (is_on(e, at, row.unit))
        resting.push_back(k);
      else
        segments[k] += e > static_cast<Real>(at);
    }
  const std::vector<std::size_t> base = segments;
  for (unsigned pattern = 0; pattern < (1u << resting.size()); ++pattern) {
    for (std::size_t i = 0; i < resting.size(); ++i)
      segments[resting[i]] = base[resting[i]] + ((pattern >> i) & 1u);
    std::vector<Real> rates = row_rates(row, segments, sign);
    bool fits = true;
    for (std::size_t i = 0; i < resting.size(); ++i) {
      const Real rate = elongation(row.springs[resting[i]], rates);
      fits = fits && (((pattern >> i) & 1u) ? rate >= 0 : rate <= 0);
    }
    if (fits) return rates;
  }
  return {};
}

/// @param most  how far a body may move
inline RowPath row_path(const Row& row, int sign, Real most_load, Real most) {
  RowPath path;
  std::vector<Real> x(static_cast<std::size_t>(row.bodies), 0);
  Real load = 0;
  std::vector<std::size_t> before, segments;
  while (true) {
    const std::vector<Real> rates = leave(row, x, sign, segments);
    if (before.empty()) path.first = segments;
    Switching at{sign * load, x.back(), {}, x};
    for (std::size_t k = 0; k < before.size(); ++k)
      if (before[k] != segments[k]) at.names.insert(spring_name(k));
    if (!at.names.empty()) path.switchings.push_back(at);
    before = segments;
    Real way = most_load - load, end = way;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (rates[i] != 0)
        end = way = std::min(way, (most - (rates[i] > 0 ? x[i] : -x[i])) / std::abs(rates[i]));
    for (const RowSpring& s : row.springs)
      for (const double at_break : s.breaks) {
        const Real e = elongation(s, x), rate = elongation(s, rates);
        if (rate == 0 || is_on(e, at_break, row.unit)) continue;
        const Real there = (static_cast<Real>(at_break) - e) / rate;
        if (there > 0) way = std::min(way, there);
      }
    if (way >= end) return path;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += way * rates[i];
    load += way;
  }
}

/// Springs that hardly take part in what moves: in roots of energy less than 1e-11 of the largest share. Rounding may
/// hide them.
inline std::set<std::string> idle_springs(const Row& row, const std::vector<std::size_t>& segments,
                                          int sign) {
  const std::vector<Real> rates = row_rates(row, segments, sign);
  std::vector<Real> stiff(rates.size(), 0);
  for (std::size_t k = 0; k < row.springs.size(); ++k) {
    const RowSpring& s = row.springs[k];
    stiff[static_cast<std::size_t>(s.to)] += s.stiffness[segments[k]];
    if (s.from >= 0) stiff[static_cast<std::size_t>(s.from)] += s.stiffness[segments[k]];
  }
  Real top = 0;
  for (std::size_t i = 0; i < rates.size(); ++i)
    top = std::max(top, std::sqrt(stiff[i]) * std::abs(rates[i]));
  std::set<std::string> names;
  for (std::size_t k = 0; k < row.springs.size(); ++k) {
    const RowSpring& s = row.springs[k];
    Real own = stiff[static_cast<std::size_t>(s.to)];
    if (s.from >= 0) own = std::min(own, stiff[static_cast<std::size_t>(s.from)]);
    if (std::sqrt(own) * std::abs(elongation(s, rates)) < Real{1e-11} * top)
      names.insert(spring_name(k));
  }
  return names;
}

inline std::string row_text(const Row& row, double most_load, int depth = 0) {
  const auto numbered = [](int i) { return "n" + std::to_string(i); };
  std::string text = row.unit > 1 ? "[units]\nlength = \"mm\"\n" : "", ranges;
  for (int i = 0; i < row.bodies; ++i) {
    text += "[[node]]\nname = \"" + numbered(i) + "\"\nat = [" + number((i + 1) * row.unit) +
            ", 0]\nfixed = [\"y\"]\n";
    ranges += ", " + numbered(i) + ".x = [" + number((i + 0.4) * row.unit) + ", " +
              number((i + 1.6) * row.unit) + "]";
  }
  text += "[[node]]\nname = \"g\"\nat = [0, 0]\nfixed = true\n";
  for (std::size_t k = 0; k < row.springs.size(); ++k) {
    const RowSpring& s = row.springs[k];
    text += "[[bar]]\nname = \"" + spring_name(k) + "\"\nfrom = \"" +
            (s.from < 0 ? "g" : numbered(s.from)) + "\"\nto = \"" + numbered(s.to) +
            "\"\nlaw = { " + s.law + " }\n";
  }
  return text + "[[study]]\nname = \"p\"\ncontrol = \"load\"\nbody = \"" +
         numbered(row.bodies - 1) +
         "\"\ndirection = [1, 0]\nbranches = { depth = " + std::to_string(depth) +
         " }\nuntil = { lambda = [" + number(-most_load) + ", " + number(most_load) + "]" + ranges +
         " }\n";
}

}  // namespace springfold::io
