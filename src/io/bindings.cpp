#include "bindings.hpp"

#include <algorithm>
#include <cstdint>

#include "characters.hpp"
#include "formula.hpp"
#include "problems.hpp"

namespace springfold::io {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// Length of the name or number at the begin of `text`.
std::size_t word_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (is_letter(text[n]) || is_digit(text[n]))) ++n;
  return n;
}

/// "2", "0.5e-3": digits, a point, an exponent.
std::size_t number_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (is_digit(text[n]) || text[n] == '.')) ++n;
  if (n == text.size() || (text[n] != 'e' && text[n] != 'E')) return n;
  std::size_t end = n + 1;
  if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
  if (end == text.size() || !is_digit(text[end])) return n;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end;
}

/// Whole-number arithmetic by recursive descent. Values stay far from overflow.
class Arithmetic {
 public:
  Arithmetic(std::string_view text, const Bindings& bindings) : text_{text}, bindings_{bindings} {}

  std::optional<std::int64_t> value() {
    const std::int64_t sum = read_sum();
    skip();
    if (failed_ || at_ != text_.size()) return std::nullopt;
    return sum;
  }
  const std::string& unknown() const { return unknown_; }

 private:
  static constexpr std::int64_t largest = 1'000'000'000;
  static constexpr int deepest = 30;

  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::int64_t bounded(std::int64_t value) {
    failed_ = failed_ || value > largest || value < -largest;
    return failed_ ? 0 : value;
  }

  std::int64_t read_sum() {
    std::int64_t sum = read_product();
    while (!failed_) {
      if (take('+'))
        sum = bounded(sum + read_product());
      else if (take('-'))
        sum = bounded(sum - read_product());
      else
        break;
    }
    return sum;
  }

  std::int64_t read_product() {
    std::int64_t product = read_factor();
    while (!failed_) {
      if (take('*')) {
        product = bounded(product * read_factor());
      } else if (take('%')) {
        const std::int64_t by = read_factor();
        failed_ = failed_ || by <= 0;
        product = failed_ ? 0 : ((product % by) + by) % by;
      } else {
        break;
      }
    }
    return product;
  }

  std::int64_t read_factor() {
    if (++depth_ > deepest) failed_ = true;
    std::int64_t value = 0;
    if (failed_) {
      value = 0;
    } else if (take('-')) {
      value = -read_factor();
    } else if (take('(')) {
      value = read_sum();
      failed_ = failed_ || !take(')');
    } else {
      value = read_word();
    }
    --depth_;
    return value;
  }

  std::int64_t read_word() {
    skip();
    const std::string_view word = text_.substr(at_, word_length(text_.substr(at_)));
    at_ += word.size();
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_digit) && word.size() <= 9)
      return std::stol(std::string{word});
    const Binding* binding = bindings_.find(word);
    if (binding == nullptr && is_identifier(word)) unknown_ = word;
    failed_ = failed_ || binding == nullptr || !binding->whole;
    return failed_ ? 0 : bounded(*binding->whole);
  }

  std::string_view text_;
  const Bindings& bindings_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
  std::string unknown_{};
};

std::vector<std::string> names_of(const Bindings& bindings) {
  std::vector<std::string> names;
  for (const Binding& binding : bindings.list) names.push_back(binding.name);
  return names;
}

/// Calls seen(word, binding) for every piece of a formula; the binding is null where it is no bound name.
template <typename Seen>
void for_words(std::string_view text, const Bindings& bindings, const Seen& seen) {
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    const bool name = is_letter(rest.front());
    std::size_t length = name ? word_length(rest) : number_length(rest);
    length = std::max<std::size_t>(length, 1);
    const std::string_view word = rest.substr(0, length);
    const std::size_t next = rest.find_first_not_of(' ', length);
    const bool calls = next != std::string_view::npos && rest[next] == '(';
    seen(word, name && !calls ? bindings.find(word) : nullptr);
    at += length;
  }
}

}  // namespace

const Binding* Bindings::find(std::string_view name) const {
  const auto found =
      std::find_if(list.rbegin(), list.rend(), [name](const Binding& b) { return b.name == name; });
  return found == list.rend() ? nullptr : &*found;
}

bool mentions(std::string_view text, std::string_view name) {
  while (!text.empty()) {
    const std::size_t length =
        is_letter(text.front()) ? word_length(text) : std::max<std::size_t>(number_length(text), 1);
    if (text.substr(0, length) == name) return true;
    text.remove_prefix(length);
  }
  return false;
}

std::string with_bindings(const std::string& formula, const Bindings& bindings) {
  std::string result;
  for_words(formula, bindings, [&result](std::string_view word, const Binding* binding) {
    result += binding ? "(" + binding->text + ")" : std::string{word};
  });
  return result;
}

std::vector<WrittenPart> written_parts(const Node& node) {
  if (node.parts) return *node.parts;
  std::vector<WrittenPart> parts;
  if (!node.bindings) return parts;
  for_words(node.text, *node.bindings, [&parts](std::string_view, const Binding* binding) {
    if (binding) parts.insert(parts.end(), binding->parts.begin(), binding->parts.end());
  });
  return parts;
}

FilledText filled(const std::string& text, const Bindings& bindings) {
  FilledText result;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '}') return {text, "a '}' without its '{'"};
    if (text[at] != '{') {
      result.text += text[at++];
      continue;
    }
    const std::size_t end = text.find('}', at);
    if (end == std::string::npos) return {text, "a '{' without its '}'"};
    const std::string_view inner = trimmed(std::string_view{text}.substr(at + 1, end - at - 1));
    at = end + 1;
    if (const Binding* binding = bindings.find(inner)) {
      result.text += binding->text;
      continue;
    }
    Arithmetic arithmetic{inner, bindings};
    if (const auto value = arithmetic.value()) {
      result.text += std::to_string(*value);
      continue;
    }
    if (!arithmetic.unknown().empty())
      return {text, "\"" + arithmetic.unknown() + "\" in { } is no index here" +
                        suggestion(arithmetic.unknown(), names_of(bindings))};
    return {text, "cannot read {" + std::string{inner} +
                      "}, need whole numbers and indices with + - * % and parentheses"};
  }
  return result;
}

}  // namespace springfold::io
