#include "structures.hpp"

#include <cmath>
#include <cstdio>

namespace springfold::guyed {
namespace {

using known_answers::choice;
using known_answers::log_uniform;
using known_answers::uniform;

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + number(values[i]);
  return text + "]";
}

/// The tilt of every link or storey, from the sway: (w_i - w_(i-1)) / length_i.
Matrix tilts(const std::vector<double>& lengths) {
  const auto n = static_cast<Index>(lengths.size());
  Matrix B = Matrix::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    B(i, i) = 1 / lengths[static_cast<std::size_t>(i)];
    if (i > 0) B(i, i - 1) = -B(i, i);
  }
  return B;
}

/// Twice the sinking of the top of links 1 to `count`.
Matrix sinking(const std::vector<double>& lengths, Index count) {
  const Matrix B = tilts(lengths);
  Matrix G = Matrix::Zero(B.rows(), B.rows());
  for (Index i = 0; i < count; ++i)
    G += lengths[static_cast<std::size_t>(i)] * B.row(i).transpose() * B.row(i);
  return G;
}

/// Of springs between neighbouring links.
Matrix bending(const std::vector<double>& lengths, const std::vector<double>& stiffnesses) {
  Matrix B = tilts(lengths);
  for (Index i = B.rows() - 1; i > 0; --i) B.row(i) -= B.row(i - 1).eval();
  return B.transpose() * Eigen::Map<const Vector>(stiffnesses.data(), B.rows()).asDiagonal() * B;
}

/// The same matrix for each of two directions, w = (x1, y1, x2, y2, ...).
Matrix in_both(const Matrix& x, const Matrix& y) {
  const Index n = x.rows();
  Matrix both = Matrix::Zero(2 * n, 2 * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      both(2 * i, 2 * j) = x(i, j);
      both(2 * i + 1, 2 * j + 1) = y(i, j);
    }
  return both;
}

std::vector<double> some(int count, double low, double high, Random& random) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(log_uniform(random, low, high));
  return values;
}

std::string node(int i) { return "n" + std::to_string(i); }
std::string below(int i) { return i == 1 ? "base" : node(i - 1); }

Bare column(bool hinges_give, Random& random) {
  const int n = 1 + choice(random, 4);
  const auto l = some(n, 0.5, 1.5, random);
  const auto c = hinges_give ? some(n, 0.05, 2, random) : std::vector<double>(l.size(), 0.0);
  Bare bare{.family = "column",
            .loaded = node(n),
            .direction = "[0, -1, 0]",
            .springs = bending(l, c),
            .load = sinking(l, n)};
  double height = 0;
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i - 1);
    height += l[k];
    bare.text +=
        "[[body]]\nname = \"" + node(i) +
        "\"\ntask_space = \"planar\"\npose = " + list({0, height, 0}) +
        "\n[[chain]]\nname = \"link" + std::to_string(i) + "\"\nfrom = \"" + below(i) +
        "\"\nto = \"" + node(i) +
        "\"\nelements = [{ joint = \"revolute\", axis = \"z\", role = \"preloaded\", spring = { "
        "law = \"linear\", stiffness = " +
        number(c[k]) + " } }, { rigid = " + list({0, l[k]}) + " }]\n";
    bare.sways.push_back({node(i) + ".x", 0});
    bare.corners.push_back({node(i), "[0, 0]", 0, height, {i - 1}, sinking(l, i)});
  }
  return bare;
}

Bare column_in_space(bool hinges_give, Random& random) {
  const int n = 1 + choice(random, 3);
  const auto l = some(n, 0.5, 1.5, random);
  const auto none = std::vector<double>(l.size(), 0.0);
  const auto cx = hinges_give ? some(n, 0.05, 2, random) : none;
  const auto cy = hinges_give ? some(n, 0.05, 2, random) : none;
  const Matrix G = sinking(l, n);
  Bare bare{.family = "column in space",
            .loaded = node(n),
            .direction = "[0, 0, -1, 0, 0, 0]",
            .horizontals = 2,
            .springs = in_both(bending(l, cy), bending(l, cx)),
            .load = in_both(G, G)};
  double height = 0;
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i - 1);
    height += l[k];
    bare.text +=
        "[[body]]\nname = \"" + node(i) +
        "\"\ntask_space = \"spatial\"\npose = " + list({0, 0, height, 0, 0, 0}) +
        "\n[[chain]]\nname = \"link" + std::to_string(i) + "\"\nfrom = \"" + below(i) +
        "\"\nto = \"" + node(i) +
        "\"\nelements = [{ joint = \"universal\", axes = [\"x\", \"y\"], role = \"preloaded\", "
        "spring = [{ law = \"linear\", stiffness = " +
        number(cx[k]) + " }, { law = \"linear\", stiffness = " + number(cy[k]) +
        " }] }, { rigid = " + list({0, 0, l[k]}) + " }]\n";
    bare.sways.push_back({node(i) + ".x", 0});
    bare.sways.push_back({node(i) + ".y", 0});
    const Matrix Gi = sinking(l, i);
    bare.corners.push_back(
        {node(i), "[0, 0, 0]", 0, height, {2 * i - 2, 2 * i - 1}, in_both(Gi, Gi)});
  }
  return bare;
}

/// A leg of a frame between two beams, with a spring at its foot.
std::string leg(const std::string& name, int storey, const std::vector<double>& foot, double length,
                double head, double stiffness) {
  return "[[chain]]\nname = \"" + name + std::to_string(storey) + "\"\nfrom = \"" + below(storey) +
         "\"\nfrom_at = " + list(foot) + "\nto = \"" + node(storey) +
         "\"\nto_at = " + list({head, 0}) +
         "\nelements = [{ joint = \"revolute\", axis = \"z\", role = \"preloaded\", spring = { law "
         "= "
         "\"linear\", stiffness = " +
         number(stiffness) + " } }, { rigid = " + list({0, length}) +
         " }, { joint = \"revolute\", axis = \"z\" }]\n";
}

/// Storeys of two legs and a rigid beam, loaded somewhere on the uppermost beam. In the lowest storey the right leg may
/// be shorter or longer: its foot stands higher or deeper.
Bare frame(bool hinges_give, Random& random) {
  const int n = 1 + choice(random, 3);
  const double width = uniform(random, 0.6, 2), share = uniform(random, 0.1, 0.9);
  const auto left = some(n, 0.5, 1.5, random);
  auto right = left;
  right[0] = uniform(random, 0.7, 1.4) * left[0];
  const auto stiff =
      hinges_give ? some(2 * n, 0.05, 2, random) : std::vector<double>(2 * left.size(), 0.0);
  const double to_left = -share * width, to_right = (1 - share) * width;
  Bare bare{.family = "frame", .loaded = node(n), .direction = "[0, -1, 0]"};
  bare.springs = Matrix::Zero(n, n);
  bare.load = (1 - share) * sinking(left, n) + share * sinking(right, n);
  double height = 0;
  for (int i = 1; i <= n; ++i) {
    const auto k = static_cast<std::size_t>(i - 1);
    const Vector tilt_left = tilts(left).row(i - 1), tilt_right = tilts(right).row(i - 1);
    bare.springs += stiff[2 * k] * tilt_left * tilt_left.transpose() +
                    stiff[2 * k + 1] * tilt_right * tilt_right.transpose();
    height += left[k];
    const double x = share * width;
    const std::vector<double> foot_left =
        i == 1 ? std::vector<double>{0, 0} : std::vector<double>{to_left, 0};
    const std::vector<double> foot_right =
        i == 1 ? std::vector<double>{width, left[0] - right[0]} : std::vector<double>{to_right, 0};
    bare.text += "[[body]]\nname = \"" + node(i) +
                 "\"\ntask_space = \"planar\"\npose = " + list({x, height, 0}) + "\n" +
                 leg("left", i, foot_left, left[k], to_left, stiff[2 * k]) +
                 leg("right", i, foot_right, right[k], to_right, stiff[2 * k + 1]);
    bare.sways.push_back({node(i) + ".x", x});
    bare.corners.push_back({node(i), list({to_left, 0}), 0, height, {i - 1}, sinking(left, i)});
    bare.corners.push_back(
        {node(i), list({to_right, 0}), width, height, {i - 1}, sinking(right, i)});
  }
  return bare;
}

/// Of the cable's free length: the stretch taken from its length.
double threshold(const Attached& cable) { return cable.cable.length - cable.cable.stretch; }

std::string anchor_of(const Bare& bare, const Attached& cable) {
  std::vector<double> at(cable.reach.data(), cable.reach.data() + cable.reach.size());
  at.front() += cable.corner->across;
  at.back() += cable.corner->height;
  if (bare.horizontals == 2) return list({at[0], at[1], at[2]});
  return list({at[0], at[1]});
}

}  // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

Bare random_bare(bool hinges_give, Random& random) {
  switch (choice(random, 3)) {
    case 0:
      return column(hinges_give, random);
    case 1:
      return column_in_space(hinges_give, random);
    default:
      return frame(hinges_give, random);
  }
}

Attached attach(const Bare& bare, std::size_t corner, const Vector& reach, double stiffness,
                double stretch) {
  const Corner& at = bare.corners[corner];
  const double length = reach.norm();
  const Vector d = -reach / length;  // from the anchor to the corner
  const Index n = bare.load.rows(), h = bare.horizontals;
  Cable cable{.rate = Vector::Zero(n),
              .second = -d[h] * at.sinking,
              .stiffness = stiffness,
              .length = length,
              .stretch = stretch * length};
  for (Index i = 0; i < h; ++i) {
    const Index row = at.sway[static_cast<std::size_t>(i)];
    cable.rate[row] = d[i];
    for (Index j = 0; j < h; ++j)
      cable.second(row, at.sway[static_cast<std::size_t>(j)]) +=
          ((i == j ? 1.0 : 0.0) - d[i] * d[j]) / length;
  }
  return {cable, &at, reach};
}

std::string cable_spring(const Bare& bare, const Attached& cable, std::size_t count) {
  return "[[spring]]\nname = \"cable" + std::to_string(count) +
         "\"\nfrom_at = " + anchor_of(bare, cable) + "\nto = \"" + cable.corner->body +
         "\"\nto_at = " + cable.corner->at +
         "\nlaw = { law = \"one_sided\", stiffness = " + number(cable.cable.stiffness) +
         ", from = " + number(threshold(cable)) + " }\n";
}

std::string cable_chain(const Bare& bare, const Attached& cable, std::size_t count) {
  const double angle = std::atan2(cable.reach[0], -cable.reach[1]);
  return "[[chain]]\nname = \"cable" + std::to_string(count) +
         "\"\nfrom_at = " + anchor_of(bare, cable) + "\nto = \"" + cable.corner->body +
         "\"\nto_at = " + cable.corner->at +
         "\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(angle) +
         " }, { joint = \"prismatic\", axis = \"y\", role = \"preloaded\", initial = " +
         number(cable.cable.length) +
         ", spring = { law = \"one_sided\", stiffness = " + number(cable.cable.stiffness) +
         ", from = " + number(threshold(cable)) +
         " } }, { joint = \"revolute\", axis = \"z\", initial = " + number(-angle) + " }]\n";
}

}  // namespace springfold::guyed
