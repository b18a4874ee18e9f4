#include "round_ticks.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "text.hpp"

namespace springfold::io {
namespace {

constexpr double tick_rounding = 1e-9;  // of a step: a tick at the very end of the range counts
constexpr int tick_digits = 12;

/// Multiples of the step in the range.
std::vector<double> multiples(const PlotRange& range, double step) {
  const double first = std::ceil(range.first / step - tick_rounding);
  const double last = std::floor(range.second / step + tick_rounding);
  std::vector<double> values;
  for (double n = first; n <= last; ++n) values.push_back(n * step);
  return values;
}

/// How many there would be; of very fine steps no list is made.
double tick_count(const PlotRange& range, double step) {
  return std::floor(range.second / step + tick_rounding) -
         std::ceil(range.first / step - tick_rounding) + 1;
}

std::vector<double> even_ticks(const PlotRange& range, std::size_t most) {
  double power = std::pow(10, std::floor(std::log10(range.second - range.first)) - 1);
  for (;; power *= 10)
    for (const double factor : {1.0, 2.0, 5.0})
      if (tick_count(range, factor * power) <= static_cast<double>(most))
        return multiples(range, factor * power);
}

/// Powers of ten, not more than `most` of them.
std::vector<double> decades(const PlotRange& range, std::size_t most) {
  const PlotRange exponents{std::log10(range.first), std::log10(range.second)};
  std::vector<double> values;
  double step = 1;
  while (tick_count(exponents, step) > static_cast<double>(most)) ++step;
  for (const double exponent : multiples(exponents, step)) values.push_back(std::pow(10, exponent));
  return values;
}

/// 1, 2 and 5 times powers of ten: of ranges that are wide and have hardly a power of ten. None where they are too
/// many.
std::vector<double> thirds_of_decades(const PlotRange& range, std::size_t most) {
  constexpr double wide =
      10;  // times the least value: even steps would leave half of the axis empty
  std::vector<double> values;
  if (range.second < wide * range.first) return values;
  const double last = std::floor(std::log10(range.second) + tick_rounding);
  for (double n = std::floor(std::log10(range.first)); n <= last; ++n)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10, n);
      const double room = tick_rounding * value;
      if (value >= range.first - room && value <= range.second + room) values.push_back(value);
    }
  if (values.size() > most) values.clear();
  return values;
}

std::string tick_text(double value) {
  const std::string text = rounded(value, tick_digits);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return decimal(value);
}

}  // namespace

std::vector<std::string> round_ticks(const PlotRange& range, bool is_log, std::size_t most) {
  std::vector<double> values;
  if (is_log) values = decades(range, most);
  if (is_log && values.size() < 2) values = thirds_of_decades(range, most);
  if (values.size() < 2) values = even_ticks(range, most);
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const double value : values) texts.push_back(tick_text(value));
  if (texts.size() < 2) texts = {decimal(range.first), decimal(range.second)};
  return texts;
}

}  // namespace springfold::io
