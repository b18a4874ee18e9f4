#include "law_formula.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>

#include "characters.hpp"
#include "formula.hpp"

namespace springfold::io {
namespace {

using Operation = model::FormulaStep::Operation;

constexpr std::size_t longest_law = 1000, deepest_formula = 100;

/// A part of the text: with the variable a step of the formula, without it still text.
struct Part {
  std::size_t begin = 0, end = 0;  ///< in the text
  std::optional<std::size_t> step{};
};

const std::map<std::string, Operation, std::less<>>& smooth_functions() {
  static const std::map<std::string, Operation, std::less<>> functions{
      {"sin", Operation::sin},     {"cos", Operation::cos},     {"tan", Operation::tan},
      {"asin", Operation::asin},   {"acos", Operation::acos},   {"atan", Operation::atan},
      {"sinh", Operation::sinh},   {"cosh", Operation::cosh},   {"tanh", Operation::tanh},
      {"asinh", Operation::asinh}, {"acosh", Operation::acosh}, {"atanh", Operation::atanh},
      {"exp", Operation::exp},     {"ln", Operation::log},      {"log", Operation::log},
      {"sqrt", Operation::sqrt}};
  return functions;
}

/// By recursive descent. Precedence as in all formulas of a case: ?: || && comparisons + - * / unary minus ^.
class Parser {
 public:
  Parser(const std::string& text, const std::string& variable) : text_{text}, variable_{variable} {}

  LawFormula run() {
    if (text_.size() > longest_law) {
      fail("longer than " + std::to_string(longest_law) + " characters");
    } else {
      const Part whole = conditional();
      skip_blanks();
      if (at_ < text_.size()) fail(unexpected());
      if (ok() && !whole.step) {
        skip_blanks();
        step_of(whole);
      }
    }
    if (!ok()) result_.formula.steps.clear();
    return std::move(result_);
  }

 private:
  bool ok() const { return result_.problem.empty(); }
  void fail(const std::string& problem) {
    if (ok()) result_.problem = problem;
    at_ = text_.size();
  }
  std::string unexpected() {
    skip_blanks();
    if (at_ >= text_.size()) return "it ends too early";
    if (at_ > 0 && text_[at_ - 1] == '*' && text_[at_] == '*') return power_is_written;
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_word(text_[at_]) && is_word(text_[end])) ++end;
    return "unexpected \"" + text_.substr(at_, end - at_) + "\"" +
           (is_word(text_[at_]) || text_[at_] == '(' ? "; a product needs *" : "");
  }
  void fail_with_kink(const std::string& what) {
    fail(what + " of " + variable_ +
         " has a jump or a kink, need a smooth law; laws that switch are one_sided, stops, gap, "
         "power, piecewise_linear and tables");
  }

  static bool is_word(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '.';
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (std::string_view{text_}.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }

  std::size_t add(Operation operation, std::size_t a = 0, std::size_t b = 0, double number = 0) {
    result_.formula.steps.push_back({operation, a, b, number});
    return result_.formula.steps.size() - 1;
  }
  std::size_t step_of(const Part& part) {
    if (part.step) return *part.step;
    const std::size_t step = add(Operation::number);
    result_.numbers.emplace_back(step, text_.substr(part.begin, part.end - part.begin));
    return step;
  }
  Part joined(Operation operation, const Part& a, const Part& b) {
    Part part{a.begin, b.end};
    if (!a.step && !b.step) return part;
    const std::size_t first = step_of(a), second = step_of(b);
    part.step = add(operation, first, second);
    return part;
  }

  Part conditional() {
    if (++depth_ > deepest_formula)
      fail("more than " + std::to_string(deepest_formula) + " parentheses deep");
    Part part = compared(0);
    if (take("?")) {
      const Part yes = conditional();
      if (!take(":")) fail(unexpected());
      const Part no = conditional();
      if (part.step || yes.step || no.step) fail_with_kink("the choice ? :");
      part.end = no.end;
    }
    --depth_;
    return part;
  }

  /// ||, &&, comparisons: each level binds more tightly than the one before it.
  Part compared(std::size_t level) {
    static const std::vector<std::vector<std::string>> levels{
        {"||"}, {"&&"}, {"<=", ">=", "==", "!=", "<", ">"}};
    if (level == levels.size()) return sum();
    Part part = compared(level + 1);
    for (bool more = ok(); more;) {
      more = false;
      for (const std::string& token : levels[level]) {
        if (!take(token)) continue;
        const Part right = compared(level + 1);
        if (part.step || right.step) fail_with_kink("a comparison");
        part.end = right.end;
        more = ok();
        break;
      }
    }
    return part;
  }

  Part sum() {
    Part part = product();
    while (ok()) {
      if (take("+"))
        part = joined(Operation::add, part, product());
      else if (take("-"))
        part = joined(Operation::subtract, part, product());
      else
        break;
    }
    return part;
  }

  Part product() {
    Part part = signed_power();
    while (ok()) {
      if (take("*"))
        part = joined(Operation::multiply, part, signed_power());
      else if (take("/"))
        part = joined(Operation::divide, part, signed_power());
      else
        break;
    }
    return part;
  }

  Part signed_power() {
    skip_blanks();
    const std::size_t begin = at_;
    if (take("-")) {
      if (++depth_ > deepest_formula) fail("too many signs");
      Part part = signed_power();
      --depth_;
      part.begin = begin;
      if (part.step) part.step = add(Operation::negate, *part.step);
      return part;
    }
    if (take("+")) return signed_power();
    const Part base = operand();
    if (!take("^")) return base;
    if (++depth_ > deepest_formula) fail("too many powers");
    const Part exponent = signed_power();
    --depth_;
    return joined(Operation::power, base, exponent);
  }

  Part operand() {
    skip_blanks();
    const std::size_t begin = at_;
    if (take("(")) {
      Part part = conditional();
      if (!take(")")) fail(at_ < text_.size() ? unexpected() : "a closing parenthesis is missing");
      part.begin = begin;
      part.end = at_;
      return part;
    }
    if (at_ >= text_.size() || !is_word(text_[at_])) {
      fail(unexpected());
      return {};
    }
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    while (at_ < text_.size() && is_word(text_[at_]) && text_[at_] != '.') ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '(') return call(name, begin);
    const std::size_t end = begin + name.size();
    if (name == variable_) return {begin, end, add(Operation::variable)};
    return {begin, end, {}};
  }

  Part number() {
    const std::size_t begin = at_;
    const auto digits = [this] {
      while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) ++at_;
    };
    digits();
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      std::size_t next = at_ + 1;
      if (next < text_.size() && (text_[next] == '+' || text_[next] == '-')) ++next;
      if (next < text_.size() && is_digit(text_[next])) {
        at_ = next;
        digits();
      }
    }
    return {begin, at_, {}};
  }

  Part call(const std::string& name, std::size_t begin) {
    take("(");
    std::vector<Part> arguments{conditional()};
    while (ok() && take(",")) arguments.push_back(conditional());
    if (!take(")")) fail(at_ < text_.size() ? unexpected() : "a closing parenthesis is missing");
    Part part{begin, at_};
    const bool varies = std::any_of(arguments.begin(), arguments.end(),
                                    [](const Part& argument) { return argument.step.has_value(); });
    if (ok() && varies) part.step = function(name, arguments);
    return part;
  }

  std::size_t function(const std::string& name, const std::vector<Part>& arguments) {
    static const std::vector<std::string> kinked{"abs", "sign", "rint", "min", "max"};
    if (name == variable_) fail("\"" + name + "\" is no function; a product needs *");
    if (std::find(kinked.begin(), kinked.end(), name) != kinked.end()) fail_with_kink(name);
    std::vector<std::size_t> steps;
    for (const Part& argument : arguments) steps.push_back(step_of(argument));
    if (name == "sum" || name == "avg") {
      std::size_t total = steps[0];
      for (std::size_t i = 1; i < steps.size(); ++i) total = add(Operation::add, total, steps[i]);
      if (name == "sum") return total;
      const auto count = static_cast<double>(steps.size());
      return add(Operation::divide, total, add(Operation::number, 0, 0, count));
    }
    const std::size_t needed = name == "atan2" ? 2 : 1;
    if (steps.size() != needed && name != "pow")
      fail((steps.size() < needed ? "too few arguments for \"" : "too many arguments for \"") +
           name + "\"");
    if (!ok()) return 0;
    if (name == "atan2") return add(Operation::atan2, steps[0], steps[1]);
    if (name == "log2" || name == "log10") {
      const double base = name == "log2" ? std::numbers::ln2 : std::numbers::ln10;
      const std::size_t natural = add(Operation::log, steps[0]);
      return add(Operation::divide, natural, add(Operation::number, 0, 0, base));
    }
    const auto found = smooth_functions().find(name);
    if (found != smooth_functions().end()) return add(found->second, steps[0]);
    fail("no function \"" + name + "\"" +
         (name == "pow" ? std::string{"; "} + power_is_written : ""));
    return 0;
  }

  const std::string& text_;
  const std::string& variable_;
  std::size_t at_ = 0, depth_ = 0;
  LawFormula result_{};
};

}  // namespace

LawFormula read_law_formula(const std::string& text, const std::string& variable) {
  return Parser{text, variable}.run();
}

}  // namespace springfold::io
