#include <algorithm>
#include <cmath>
#include <numbers>

#include "family.hpp"

namespace springfold::known_answers {
namespace {

using std::numbers::pi;

Vector scalar(double value) { return Vector::Constant(1, value); }

/// One unknown: F, F_x, F_lambda from one function.
template <class Function>
Base one_unknown(Function f) {
  return {1, [f](const Vector& z, double lambda, Vector& F, Matrix& H, Vector& F_lambda) {
            double value = 0, slope = 0, rate = 0;
            f(z[0], lambda, value, slope, rate);
            F = scalar(value);
            H = Matrix::Constant(1, 1, slope);
            F_lambda = scalar(rate);
            return true;
          }};
}

double polynomial(const std::vector<double>& c, double x) {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 0;) value = value * x + c[i];
  return value;
}

std::vector<double> times_root(const std::vector<double>& c, double root) {
  std::vector<double> product(c.size() + 1, 0.0);
  for (std::size_t i = 0; i < c.size(); ++i) {
    product[i + 1] += c[i];
    product[i] -= root * c[i];
  }
  return product;
}

/// Real roots of a cubic-like function on an interval by scanning and bisection.
template <class Function>
std::vector<double> roots(Function f, double low, double high) {
  std::vector<double> found;
  constexpr int pieces = 20000;
  double a = low, fa = f(a);
  for (int i = 1; i <= pieces; ++i) {
    double b = low + (high - low) * i / pieces;
    const double fb = f(b);
    if ((fa < 0) != (fb < 0)) {
      double l = a, r = b;
      for (int k = 0; k < 200; ++k) {
        const double m = 0.5 * (l + r);
        ((f(m) < 0) == (fa < 0) ? l : r) = m;
      }
      found.push_back(0.5 * (l + r));
    }
    a = b;
    fa = fb;
  }
  return found;
}

/// Springs of stiffness k and free length l0 from points on a circle of radius a to the point z.
Base springs_to_point(std::vector<Vector> anchors, double k, double l0, Vector load) {
  const Index n = load.size();
  return {n, [=](const Vector& z, double lambda, Vector& F, Matrix& H, Vector& F_lambda) {
            F = lambda * load;
            H = Matrix::Zero(n, n);
            F_lambda = load;
            for (const Vector& anchor : anchors) {
              const Vector d = z - anchor;
              const double l = d.norm();
              if (!(l > 0)) return false;
              F += k * (1 - l0 / l) * d;
              H += k * (1 - l0 / l) * Matrix::Identity(n, n) +
                   k * l0 / (l * l * l) * d * d.transpose();
            }
            return true;
          }};
}

}  // namespace

Draw fold_ladder(std::mt19937_64& random) {
  Draw draw{.family = "fold ladder"};
  const int count = 1 + static_cast<int>(random() % 4);
  std::vector<double> places;
  while (static_cast<int>(places.size()) < count) places.push_back(uniform(random, -1, 1));
  std::sort(places.begin(), places.end());
  if (count > 1 && random() % 3 == 0)  // a close pair
    places[1] = places[0] + log_uniform(random, 1e-4, 1e-1);
  std::vector<double> slope{log_uniform(random, 0.5, 3) * (random() % 2 ? 1 : -1)};
  std::vector<int> multiplicity;
  for (const double a : places) {
    multiplicity.push_back(random() % 6 == 0 ? 2 : 1);
    for (int m = 0; m < multiplicity.back(); ++m) slope = times_root(slope, a);
  }
  std::vector<double> p{0};
  for (std::size_t i = 0; i < slope.size(); ++i) p.push_back(slope[i] / static_cast<double>(i + 1));
  draw.base = one_unknown([p, slope](double x, double lambda, double& F, double& F_x, double& F_l) {
    F = polynomial(p, x) - lambda;
    F_x = polynomial(slope, x);
    F_l = -1;
  });
  for (std::size_t i = 0; i < places.size(); ++i) {
    const AnswerKind kind = multiplicity[i] == 1 ? AnswerKind::fold : AnswerKind::touch;
    draw.answers.push_back({kind, polynomial(p, places[i]), scalar(places[i])});
    for (std::size_t j = 0; j < i; ++j)
      draw.gap = std::min(draw.gap, std::abs(places[i] - places[j]));
  }
  draw.z_low = -1.5, draw.z_high = 1.5;
  draw.z_start = scalar(uniform(random, -1.4, -1.1));
  draw.lambda_start = polynomial(p, draw.z_start[0]);
  draw.lambda_low = -1e9, draw.lambda_high = 1e9;
  draw.size = 3;
  return draw;
}

Draw strands(std::mt19937_64& random) {
  Draw draw{.family = "strands"};
  const double d = log_uniform(random, 1e-6, 1e-1), H = uniform(random, -1, 1);
  const double w = log_uniform(random, 0.05, 1);
  const double strand = std::floor(uniform(random, -3, 4)) * d;
  draw.base = one_unknown([=](double x, double lambda, double& F, double& F_x, double& F_l) {
    const double t = std::tanh(lambda / w), angle = pi * (x - H * t) / d;
    F = d / pi * std::sin(angle);
    F_x = std::cos(angle);
    F_l = -std::cos(angle) * H * (1 - t * t) / w;
  });
  draw.lambda_start = uniform(random, -0.9, -0.5);
  draw.z_start = scalar(H * std::tanh(draw.lambda_start / w) + strand);
  draw.lambda_low = -1, draw.lambda_high = 1;
  draw.size = 2;
  draw.gap = d / draw.size;
  draw.on_curve = [=](const Vector& z, double lambda) {
    return std::abs(z[0] - H * std::tanh(lambda / w) - strand) < 0.5 * d;
  };
  return draw;
}

Draw pitchfork(std::mt19937_64& random) {
  Draw draw{.family = "pitchfork"};
  const double l0 = uniform(random, -0.5, 0.5);
  const int kind = static_cast<int>(random() % 3);  // perfect, main branch, detached branch
  const double eta = kind == 0 ? 0 : log_uniform(random, 1e-6, 1e-1) * (random() % 2 ? 1 : -1);
  draw.base = one_unknown([=](double x, double lambda, double& F, double& F_x, double& F_l) {
    F = x * x * x - (lambda - l0) * x + eta;
    F_x = 3 * x * x - (lambda - l0);
    F_l = -x;
  });
  draw.lambda_low = l0 - 1, draw.lambda_high = l0 + 1;
  draw.size = 2;
  const double fold = std::cbrt(eta / 2);
  const auto curve = [=](double x) { return l0 + x * x + eta / x; };  // lambda(x) for eta != 0
  if (kind == 0) {
    draw.z_start = scalar(0);
    draw.lambda_start = l0 - uniform(random, 0.5, 0.9);
    draw.answers.push_back({AnswerKind::branch_point, l0, scalar(0)});
  } else {
    draw.gap = std::abs(fold);
    // The main branch has x of the sign of -eta, the detached one that of eta.
    const double sign = (kind == 1) == (eta > 0) ? -1 : 1;
    draw.z_start = scalar(sign * uniform(random, 0.8, 0.95));
    draw.lambda_start = curve(draw.z_start[0]);
    if (kind == 2) draw.answers.push_back({AnswerKind::fold, l0 + 3 * fold * fold, scalar(fold)});
  }
  draw.on_curve = [=](const Vector& z, double) {
    return kind == 0 ? std::abs(z[0]) < 1e-9
                     : (z[0] > 0) == ((kind == 1) == (eta > 0) ? false : true);
  };
  return draw;
}

Draw two_mode(std::mt19937_64& random) {
  Draw draw{.family = "two mode"};
  const double m1 = uniform(random, -0.5, 0.5);
  const int spread = static_cast<int>(random() % 3);
  const double m2 = spread == 0   ? m1
                    : spread == 1 ? m1 + log_uniform(random, 1e-3, 1e-1)
                                  : uniform(random, -0.5, 0.5);
  const double a = uniform(random, 0.5, 2), b = uniform(random, -2, 3), c = uniform(random, 0.5, 2);
  draw.base = {2, [=](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_lambda) {
                 const double x = z[0], y = z[1];
                 F = Vector{{(m1 - l) * x + a * x * x * x + b * x * y * y,
                             (m2 - l) * y + c * y * y * y + b * x * x * y}};
                 H = Matrix{{m1 - l + 3 * a * x * x + b * y * y, 2 * b * x * y},
                            {2 * b * x * y, m2 - l + 3 * c * y * y + b * x * x}};
                 F_lambda = -z;
                 return true;
               }};
  draw.lambda_low = -1.5, draw.lambda_high = 1.5;
  draw.size = 3;
  if (random() % 2) {  // trivial branch
    draw.z_start = Vector::Zero(2);
    draw.lambda_start = -1.2;
    if (m1 == m2) {
      draw.answers.push_back({AnswerKind::branch_point, m1, Vector::Zero(2), 2});
    } else {
      draw.gap = std::abs(m2 - m1) / draw.size;
      for (const double m : {m1, m2})
        draw.answers.push_back({AnswerKind::branch_point, m, Vector::Zero(2)});
    }
    return draw;
  }
  // X branch, through its own branch point on the trivial branch.
  const double x = std::sqrt((1.2 - m1) / a);
  draw.z_start = Vector{{x, 0.0}};
  draw.lambda_start = m1 + a * x * x;
  draw.answers.push_back({AnswerKind::branch_point, m1, Vector::Zero(2), m1 == m2 ? 2 : 1});
  const double secondary = (a * m2 - b * m1) / (a - b);
  if (m1 != m2 && secondary > m1 && secondary < draw.lambda_high) {
    const double xs = std::sqrt((secondary - m1) / a);
    draw.gap = std::min(draw.gap, xs / draw.size);
    for (const double sign : {1.0, -1.0})
      draw.answers.push_back({AnswerKind::branch_point, secondary, Vector{{sign * xs, 0.0}}});
  }
  return draw;
}

Draw n_pod_dome(std::mt19937_64& random) {
  Draw draw{.family = "n-pod dome"};
  const int N = 3 + static_cast<int>(random() % 5);
  const double k = log_uniform(random, 0.5, 2), R = 1, z0 = uniform(random, 0.5, 3);
  const double L0 = std::hypot(R, z0);
  std::vector<Vector> anchors;
  for (int i = 0; i < N; ++i)
    anchors.push_back(Vector{{R * std::cos(2 * pi * i / N), R * std::sin(2 * pi * i / N), 0.0}});
  draw.base = springs_to_point(anchors, k, L0, Vector{{0.0, 0.0, 1.0}});
  draw.z_start = Vector{{0.0, 0.0, z0}};
  draw.lambda_low = -1e9, draw.lambda_high = 1e9;
  draw.size = 2 * z0;
  const auto load = [=](double z) { return N * k * z * (L0 / std::hypot(R, z) - 1); };
  const double L_fold = std::cbrt(L0 * R * R), z_fold = std::sqrt(L_fold * L_fold - R * R);
  std::vector<std::pair<double, int>> places{{z_fold, 0}};
  for (const double L :
       roots([=](double l) { return l * l * l - L0 * l * l + L0 * R * R / 2; }, R, L0))
    places.push_back({std::sqrt(L * L - R * R), 2});
  for (const auto& [z, multiplicity] : places)
    for (const double sign : {1.0, -1.0})
      draw.answers.push_back({multiplicity ? AnswerKind::branch_point : AnswerKind::fold,
                              load(sign * z), Vector{{0.0, 0.0, sign * z}},
                              std::max(1, multiplicity)});
  return draw;
}

Draw von_mises_sway(std::mt19937_64& random) {
  Draw draw{.family = "von Mises with sway"};
  const double a = 1, h = uniform(random, 0.5, 4), k = log_uniform(random, 0.5, 2);
  const double L0 = std::hypot(a, h);
  draw.base = springs_to_point({Vector{{-a, 0.0}}, Vector{{a, 0.0}}}, k, L0, Vector{{0.0, 1.0}});
  draw.z_start = Vector{{0.0, h}};
  draw.lambda_low = -1e9, draw.lambda_high = 1e9;
  draw.size = 2 * h;
  const auto load = [=](double y) { return 2 * k * y * (L0 / std::hypot(a, y) - 1); };
  std::vector<std::pair<double, AnswerKind>> places;
  const double L_fold = std::cbrt(L0 * a * a);
  places.push_back({std::sqrt(L_fold * L_fold - a * a), AnswerKind::fold});
  for (const double L : roots([=](double l) { return l * l * l - L0 * l * l + L0 * a * a; }, a, L0))
    places.push_back({std::sqrt(L * L - a * a), AnswerKind::branch_point});
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      draw.gap = std::min(draw.gap, std::abs(places[i].first - places[j].first) / draw.size);
    for (const double sign : {1.0, -1.0})
      draw.answers.push_back(
          {places[i].second, load(sign * places[i].first), Vector{{0.0, sign * places[i].first}}});
  }
  return draw;
}

Draw link_column(std::mt19937_64& random) {
  Draw draw{.family = "link column"};
  const Index n = 1 + static_cast<Index>(random() % 8);
  const double k = log_uniform(random, 0.5, 2), L = 1.0 / static_cast<double>(n);
  draw.base = {n, [=](const Vector& t, double P, Vector& F, Matrix& H, Vector& F_lambda) {
                 F = Vector::Zero(n);
                 H = Matrix::Zero(n, n);
                 F_lambda = Vector::Zero(n);
                 for (Index i = 0; i < n; ++i) {
                   F[i] += k * (t[i] - (i > 0 ? t[i - 1] : 0.0));
                   H(i, i) += k;
                   if (i > 0) {
                     F[i - 1] -= k * (t[i] - t[i - 1]);
                     H(i - 1, i - 1) += k;
                     H(i, i - 1) -= k;
                     H(i - 1, i) -= k;
                   }
                   F[i] -= P * L * std::sin(t[i]);
                   H(i, i) -= P * L * std::cos(t[i]);
                   F_lambda[i] = -L * std::sin(t[i]);
                 }
                 return true;
               }};
  draw.z_start = Vector::Zero(n);
  draw.lambda_start = 0;
  draw.lambda_low = -0.1 * k / L, draw.lambda_high = 4.2 * k / L;
  draw.size = 4 * k / L;
  for (Index j = 1; j <= n; ++j) {
    const double s =
        std::sin((2.0 * static_cast<double>(j) - 1) * pi / (4.0 * static_cast<double>(n) + 2));
    draw.answers.push_back({AnswerKind::branch_point, 4 * s * s * k / L, Vector::Zero(n)});
  }
  for (std::size_t i = 1; i < draw.answers.size(); ++i)
    draw.gap =
        std::min(draw.gap, (draw.answers[i].lambda - draw.answers[i - 1].lambda) / draw.size);
  return draw;
}

Draw trammel(std::mt19937_64& random) {
  Draw draw{.family = "trammel"};
  const double k = log_uniform(random, 0.5, 2), c0 = uniform(random, 0.05, 0.95);
  draw.base = one_unknown([=](double t, double P, double& F, double& F_t, double& F_P) {
    F = k * (std::cos(t) - c0) * std::sin(t) - P * std::cos(t);
    F_t = k * (std::cos(2 * t) - c0 * std::cos(t)) + P * std::sin(t);
    F_P = -std::cos(t);
  });
  draw.z_start = scalar(std::acos(c0));
  draw.lambda_start = 0;
  draw.lambda_low = -20 * k, draw.lambda_high = 20 * k;
  draw.size = 3;
  const double fold = std::acos(std::cbrt(c0));
  for (const double sign : {1.0, -1.0})
    draw.answers.push_back(
        {AnswerKind::fold, sign * k * (std::cos(fold) - c0) * std::tan(fold), scalar(sign * fold)});
  draw.gap = 2 * fold / draw.size;
  return draw;
}

}  // namespace springfold::known_answers
