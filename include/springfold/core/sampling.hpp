// Places and directions in which functions are sampled, by formula.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace springfold {

/// The k-th share of an interval, k = 1, 2, ...: multiples of the golden ratio without their whole parts. They fill it
/// evenly and fall nowhere where symmetric problems have their special points.
inline double uneven_share(int k) {
  const double turns = k * std::numbers::phi;
  return turns - std::floor(turns);
}

template <int count>
std::array<double, count> uneven_shares() {
  std::array<double, count> shares{};
  for (int k = 0; k < count; ++k) shares[static_cast<std::size_t>(k)] = uneven_share(k + 1);
  return shares;
}

/// Shares symmetric about the middle that crowd towards both ends of an interval, none of them an end.
template <int count>
std::array<double, count> shares_towards_ends() {
  const auto crowd = [](double t) { return std::pow(std::sin(std::numbers::pi / 2 * t), 2); };
  std::array<double, count> shares{};
  for (int k = 0; k < count; ++k)
    shares[static_cast<std::size_t>(k)] = crowd(crowd((k + 1.0) / (count + 1)));
  return shares;
}

/// 10^from, ..., 10^to, from <= to <= 0.
template <int from, int to>
constexpr std::array<double, to - from + 1> decades() {
  std::array<double, to - from + 1> powers{};
  double ten = 1;
  for (int k = 0; k <= -from; ++k, ten *= 10)
    if (k >= -to) powers[static_cast<std::size_t>(-from - k)] = 1 / ten;
  return powers;
}

/// 1, 1 / sqrt(10), 1 / 10, ...: windows that become narrower.
template <int count>
std::array<double, count> half_decades() {
  std::array<double, count> shares{};
  double ten = 1;
  for (double& share : shares) {
    share = 1 / std::sqrt(ten);
    ten *= 10;
  }
  return shares;
}

/// Entry of a fixed vector without symmetry, one of many: a wave whose length changes along it, so that neither smooth
/// nor rough vectors are orthogonal to it.
inline double irregular(std::ptrdiff_t entry, std::ptrdiff_t vector) {
  const auto i = static_cast<double>(entry + 1), k = static_cast<double>(vector + 1);
  return std::cos(std::numbers::phi * i * i + std::numbers::sqrt2 * i * k + k);
}

}  // namespace springfold
