#include "formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <numbers>
#include <set>

#include "characters.hpp"
#include "problems.hpp"
#include "unit_text.hpp"

namespace springfold::io {
namespace {

constexpr std::size_t longest_formula = 1000;

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names{
      "sin",  "cos",   "tan",   "asin",  "acos", "atan", "atan2", "sinh", "cosh",
      "tanh", "asinh", "acosh", "atanh", "exp",  "ln",   "log",   "log2", "log10",
      "sqrt", "abs",   "sign",  "rint",  "min",  "max",  "sum",   "avg"};
  return names;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The end of the number that begins at `at`: "2", "0.5", ".5e-3".
std::size_t end_of_number(std::string_view text, std::size_t at) {
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  if (at >= text.size() || (text[at] != 'e' && text[at] != 'E')) return at;
  std::size_t digits = at + 1;
  if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
  if (digits >= text.size() || !is_digit(text[digits])) return at;
  while (digits < text.size() && is_digit(text[digits])) ++digits;
  return digits;
}

struct FormulaWord {
  std::string name{};
  bool called = false;  ///< an opening parenthesis follows
};

std::vector<FormulaWord> words_of(std::string_view text) {
  std::vector<FormulaWord> words;
  for (std::size_t at = 0; at < text.size();) {
    if (is_digit(text[at]) || text[at] == '.') {
      at = std::max(end_of_number(text, at), at + 1);
    } else if (is_letter(text[at])) {
      const std::size_t begin = at;
      while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]))) ++at;
      std::size_t next = at;
      while (next < text.size() && is_blank(text[next])) ++next;
      words.push_back(
          {std::string{text.substr(begin, at - begin)}, next < text.size() && text[next] == '('});
    } else {
      ++at;
    }
  }
  return words;
}

/// muParser assigns with a single '='; a formula of a case file only computes.
bool has_assignment(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    if (doubled) {
      ++i;
      continue;
    }
    const char before = i > 0 ? text[i - 1] : ' ';
    if (before != '<' && before != '>' && before != '!') return true;
  }
  return false;
}

/// What is wrong with a word, or nothing.
std::string problem_of(const FormulaWord& word, const std::vector<std::string>& variables) {
  const bool is_function = contains(function_names(), word.name);
  if (word.called && is_function) return {};
  if (word.called) {
    if (contains(variables, word.name) || is_formula_word(word.name))
      return "\"" + word.name + "\" is no function; a product needs *";
    if (word.name == "pow") return std::string{"no function \"pow\"; "} + power_is_written;
    return "no function \"" + word.name + "\"" + suggestion(word.name, function_names());
  }
  if (is_function) return "the function \"" + word.name + "\" needs its argument in parentheses";
  if (contains(variables, word.name) || is_formula_word(word.name)) return {};
  std::string hint = suggestion(word.name, variables);
  if (hint.empty()) hint = "; the case has no [parameters]";
  return "no parameter \"" + word.name + "\"" + hint;
}

std::string reason_of(const mu::Parser::exception_type& error) {
  switch (error.GetCode()) {
    case mu::ecUNEXPECTED_EOF:
    case mu::ecINTERNAL_ERROR:
      return "it ends too early";
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    case mu::ecUNEXPECTED_PARENS:
      return "unexpected parenthesis \"" + error.GetToken() + "\"";
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_FUN:
      return "unexpected \"" + error.GetToken() + "\"; a product needs *";
    case mu::ecTOO_FEW_PARAMS:
      return "too few arguments for \"" + error.GetToken() + "\"";
    case mu::ecTOO_MANY_PARAMS:
      return "too many arguments for \"" + error.GetToken() + "\"";
    default:
      break;
  }
  std::string token = error.GetToken();
  while (!token.empty() && is_blank(token.back())) token.pop_back();
  return token.empty() ? "it is not complete" : "unexpected \"" + token + "\"";
}

}  // namespace

bool is_identifier(std::string_view name) {
  if (name.empty() || !is_letter(name.front())) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

bool is_formula_word(std::string_view name) {
  return name == "pi" || name == "deg" || contains(function_names(), name);
}

struct FormulaBook::State {
  struct Formula {
    mu::Parser parser;
    std::vector<std::size_t> used{};
  };
  std::vector<std::string> variables{};
  std::vector<double> slots{};  ///< where the compiled formulas look for their variables
  std::deque<Formula> formulas{};
  std::map<std::string, FormulaId> known{};
  std::mutex busy{};  ///< slots and the parsers' stacks are shared by all callers

  /// Prepares `formula`; returns what is wrong with `text`, or nothing.
  std::string compile(Formula& formula, const std::string& text,
                      const std::set<std::string>& names);
};

std::string FormulaBook::State::compile(Formula& formula, const std::string& text,
                                        const std::set<std::string>& names) {
  try {
    formula.parser.ClearConst();  // muParser's own _pi has 13 digits only
    formula.parser.DefineConst("pi", std::numbers::pi);
    formula.parser.DefineConst("deg", std::numbers::pi / 180);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (!names.contains(variables[i])) continue;
      formula.parser.DefineVar(variables[i], &slots[i]);
      formula.used.push_back(i);
    }
    formula.parser.SetExpr(text);
    formula.parser.Eval();
    return formula.parser.GetNumResults() == 1 ? "" : "unexpected \",\"; need one value";
  } catch (const mu::Parser::exception_type& error) {
    return reason_of(error);
  }
}

FormulaBook::FormulaBook(std::vector<std::string> variables) : state_{std::make_unique<State>()} {
  state_->slots.assign(variables.size(), 1.0);
  state_->variables = std::move(variables);
}
FormulaBook::FormulaBook(FormulaBook&&) noexcept = default;
FormulaBook& FormulaBook::operator=(FormulaBook&&) noexcept = default;
FormulaBook::~FormulaBook() = default;

const std::vector<std::string>& FormulaBook::variables() const { return state_->variables; }

FormulaBook::Added FormulaBook::add(const std::string& text) {
  State& state = *state_;
  if (const auto known = state.known.find(text); known != state.known.end())
    return {known->second, {}};
  if (text.size() > longest_formula)
    return {{}, "longer than " + std::to_string(longest_formula) + " characters"};
  if (std::all_of(text.begin(), text.end(), is_blank)) return {{}, "it is empty"};
  if (!unit_problem(text, {}).empty()) {
    std::vector<std::string> known = state.variables;
    known.insert(known.end(), function_names().begin(), function_names().end());
    known.emplace_back("pi");
    if (std::string problem = unit_problem(text, known); !problem.empty()) return {{}, problem};
  }
  for (const char c : text)
    if (c < 0x20 || c > 0x7e || c == '"' || c == '\'')
      return {{}, "formulas have letters, digits and + - * / ^ ( ) , . < > = ! & | ? : only"};
  if (text.find("**") != std::string::npos) return {{}, power_is_written};
  if (has_assignment(text)) return {{}, "\"=\" has no meaning here"};

  std::set<std::string> names;
  for (const FormulaWord& word : words_of(text)) {
    if (std::string problem = problem_of(word, state.variables); !problem.empty())
      return {{}, problem};
    names.insert(word.name);
  }
  const FormulaId id = state.formulas.size();
  State::Formula& formula = state.formulas.emplace_back();
  const std::string problem = state.compile(formula, text, names);
  if (!problem.empty()) {
    state.formulas.pop_back();
    return {{}, problem};
  }
  state.known.emplace(text, id);
  return {id, {}};
}

const std::vector<std::size_t>& FormulaBook::variables_of(FormulaId id) const {
  return state_->formulas[id].used;
}

double FormulaBook::value(FormulaId id, const std::vector<double>& variables) const {
  const std::scoped_lock lock{state_->busy};
  const State::Formula& formula = state_->formulas[id];
  for (const std::size_t i : formula.used) state_->slots[i] = variables[i];
  return formula.parser.Eval();
}

}  // namespace springfold::io
