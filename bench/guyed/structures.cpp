#include "structures.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

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

/// The place of a corner that moves with coordinates of its own, and sinks by w' S w / 2.
Corner corner_of(const std::string& body, const std::string& at,
                 const std::vector<double>& position, const std::vector<Index>& sway,
                 const Matrix& S) {
  Corner corner{
      .body = body,
      .at = at,
      .place = Eigen::Map<const Vector>(position.data(), static_cast<Index>(position.size()))};
  corner.moves = Matrix::Zero(static_cast<Index>(sway.size()), S.rows());
  for (std::size_t i = 0; i < sway.size(); ++i) corner.moves(static_cast<Index>(i), sway[i]) = 1;
  corner.bends.resize(position.size());
  corner.bends.back() = -S;
  return corner;
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
    bare.corners.push_back(corner_of(node(i), "[0, 0]", {0, height}, {i - 1}, sinking(l, i)));
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
        corner_of(node(i), "[0, 0, 0]", {0, 0, height}, {2 * i - 2, 2 * i - 1}, in_both(Gi, Gi)));
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
    bare.corners.push_back(
        corner_of(node(i), list({to_left, 0}), {0, height}, {i - 1}, sinking(left, i)));
    bare.corners.push_back(
        corner_of(node(i), list({to_right, 0}), {width, height}, {i - 1}, sinking(right, i)));
  }
  return bare;
}

/// Of the cable's free length: the stretch taken from its length.
double threshold(const Attached& cable) { return cable.cable.length - cable.cable.stretch; }

std::string anchor_of(const Attached& cable) {
  const Vector at = cable.corner->place + cable.reach;
  return list({at.data(), at.data() + at.size()});
}

/// Three feet around the middle of a platform, which lies between them.
Matrix feet_around(Random& random) {
  Matrix feet(2, 3);
  for (Index i = 0; i < 3; ++i) {
    const double angle =
        2 * std::numbers::pi / 3 * (static_cast<double>(i) + uniform(random, -0.2, 0.2));
    feet.col(i) << std::cos(angle), std::sin(angle);
    feet.col(i) *= uniform(random, 0.5, 1.2);
  }
  return feet;
}

/// Shares of a load in the middle that the three legs carry.
Vector shares_of(const Matrix& feet) {
  Eigen::Matrix3d A;
  A << feet, Eigen::RowVector3d::Ones();
  return A.inverse() * Eigen::Vector3d(0, 0, 1);
}

/// How a point of a platform moves with its x, y and rotation about the vertical.
Matrix moves_of(const Vector& at, Index storey, Index coordinates) {
  Matrix D = Matrix::Zero(2, coordinates);
  D.block(0, 3 * storey, 2, 3) << 1, 0, -at[1], 0, 1, at[0];
  return D;
}

std::string space_leg(int storey, Index number_of_leg, const Vector& at, double length, double cx,
                      double cy) {
  const std::string foot = list({at[0], at[1], 0});
  return "[[chain]]\nname = \"leg" + std::to_string(storey) + std::to_string(number_of_leg + 1) +
         "\"\nfrom = \"" + below(storey) + "\"\nfrom_at = " + foot + "\nto = \"" + node(storey) +
         "\"\nto_at = " + foot +
         "\nelements = [{ joint = \"universal\", axes = [\"x\", \"y\"], role = \"preloaded\", "
         "spring = "
         "[{ law = \"linear\", stiffness = " +
         number(cx) + " }, { law = \"linear\", stiffness = " + number(cy) +
         " }] }, { rigid = " + list({0, 0, length}) + " }, { joint = \"spherical\" }]\n";
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

Bare random_space_frame(bool hinges_give, Random& random) {
  const int storeys = 1 + choice(random, 2);
  const auto n = static_cast<Index>(3 * storeys);
  const Matrix feet = feet_around(random);
  const Vector shares = shares_of(feet);
  const auto l = some(storeys, 0.5, 1.5, random);
  Bare bare{.family = "frame in space",
            .loaded = node(storeys),
            .direction = "[0, 0, -1, 0, 0, 0]",
            .horizontals = 2,
            .springs = Matrix::Zero(n, n),
            .load = Matrix::Zero(n, n)};
  std::vector<Matrix> sinks(3, Matrix::Zero(n, n));  // of the heads of the three legs, so far
  double height = 0;
  for (int k = 1; k <= storeys; ++k) {
    const double length = l[static_cast<std::size_t>(k - 1)];
    height += length;
    bare.text += "[[body]]\nname = \"" + node(k) +
                 "\"\ntask_space = \"spatial\"\npose = " + list({0, 0, height, 0, 0, 0}) + "\n";
    for (const char* quantity : {".x", ".y", ".rz"}) bare.sways.push_back({node(k) + quantity, 0});
    for (Index i = 0; i < 3; ++i) {
      const Vector at = feet.col(i);
      Matrix D = moves_of(at, k - 1, n);
      Corner corner{.body = node(k), .at = list({at[0], at[1], 0}), .moves = D};
      if (k > 1) D -= moves_of(at, k - 2, n);
      const auto c = hinges_give ? some(2, 0.05, 2, random) : std::vector<double>{0, 0};
      bare.text += space_leg(k, i, at, length, c[0], c[1]);
      bare.springs +=
          (c[1] * D.row(0).transpose() * D.row(0) + c[0] * D.row(1).transpose() * D.row(1)) /
          (length * length);
      sinks[static_cast<std::size_t>(i)] += D.transpose() * D / length;
      corner.place = Eigen::Vector3d(at[0], at[1], height);
      const Matrix turn = moves_of(Eigen::Vector2d(0, -1), k - 1, n).row(0) -
                          moves_of(Eigen::Vector2d(0, 0), k - 1, n).row(0);
      corner.bends = {-at[0] * turn.transpose() * turn, -at[1] * turn.transpose() * turn,
                      -sinks[static_cast<std::size_t>(i)]};
      bare.corners.push_back(std::move(corner));
    }
  }
  for (Index i = 0; i < 3; ++i) bare.load += shares[i] * sinks[static_cast<std::size_t>(i)];
  return bare;
}

Attached attach(const Bare& bare, std::size_t corner, const Vector& reach, double stiffness,
                double stretch) {
  const Corner& at = bare.corners[corner];
  const double length = reach.norm();
  const Vector d = -reach / length;  // from the anchor to the corner
  const Index n = bare.load.rows(), h = bare.horizontals;
  const Matrix across = Matrix::Identity(h, h) - d.head(h) * d.head(h).transpose();
  Cable cable{.rate = at.moves.transpose() * d.head(h),
              .second = at.moves.transpose() * across * at.moves / length,
              .stiffness = stiffness,
              .length = length,
              .stretch = stretch * length};
  for (Index i = 0; i <= h; ++i)
    if (const Matrix& bend = at.bends[static_cast<std::size_t>(i)]; bend.rows() == n)
      cable.second += d[i] * bend;
  return {cable, &at, reach};
}

std::string cable_spring(const Attached& cable, std::size_t count) {
  return "[[spring]]\nname = \"cable" + std::to_string(count) +
         "\"\nfrom_at = " + anchor_of(cable) + "\nto = \"" + cable.corner->body +
         "\"\nto_at = " + cable.corner->at +
         "\nlaw = { law = \"one_sided\", stiffness = " + number(cable.cable.stiffness) +
         ", from = " + number(threshold(cable)) + " }\n";
}

std::string cable_chain(const Attached& cable, std::size_t count) {
  const double angle = std::atan2(cable.reach[0], -cable.reach[1]);
  return "[[chain]]\nname = \"cable" + std::to_string(count) + "\"\nfrom_at = " + anchor_of(cable) +
         "\nto = \"" + cable.corner->body + "\"\nto_at = " + cable.corner->at +
         "\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(angle) +
         " }, { joint = \"prismatic\", axis = \"y\", role = \"preloaded\", initial = " +
         number(cable.cable.length) +
         ", spring = { law = \"one_sided\", stiffness = " + number(cable.cable.stiffness) +
         ", from = " + number(threshold(cable)) +
         " } }, { joint = \"revolute\", axis = \"z\", initial = " + number(-angle) + " }]\n";
}

}  // namespace springfold::guyed
