#include "mutate.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace springfold::fuzz {
namespace {

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t number)
      : engine_(seed * 0x9E3779B97F4A7C15ull + number) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(engine_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class List>
  const auto& of(const List& list) {
    return list[below(list.size())];
  }

 private:
  std::mt19937_64 engine_;
};

constexpr std::array numbers{"0",
                             "-0.0",
                             "1",
                             "-1",
                             "2",
                             "3",
                             "0.5",
                             "1e-300",
                             "1e300",
                             "1e-12",
                             "1e-6",
                             "1e6",
                             "1e12",
                             "-1e-9",
                             "inf",
                             "-inf",
                             "nan",
                             "5e-324",
                             "1.7976931348623157e308",
                             "100000",
                             "2147483647",
                             "2147483648",
                             "4294967296",
                             "9223372036854775807",
                             "-9223372036854775808",
                             "3.141592653589793",
                             "1.5707963267948966",
                             "0.1",
                             "12",
                             "1000"};

constexpr std::array texts{
    R"_("")_",          R"_("`id`")_",       R"_("$(id)")_",    R"_("a\nb")_",
    R"_("\u0000")_",    R"_("\u001b[31m")_", R"_("{/=20 x}")_", R"_("@a")_",
    R"_("../../x")_",   R"_("/dev/null")_",  R"_("%s%n")_",     R"_("\\")_",
    R"_("'")_",         R"_("\"")_",         R"_("a b")_",      R"_("x_y^z")_",
    R"_("1/0")_",       R"_("sqrt(-1)")_",   R"_("K*L^2")_",    R"_("((((((1))))))")_",
    R"_("if(1,2,3)")_", R"_("pi")_",         R"_("-")_",        R"_("é€𝄞")_"};

constexpr std::array values{"[]",         "{}",         "[[]]",      "true",
                            "false",      "[0]",        "[0, 0]",    "[1, 1, 1]",
                            "[1, \"a\"]", "1979-05-27", "{ a = 1 }", "[[1, 0], [0, 1]]"};

/// Near the number, or one of the usual troublemakers.
std::string other_number(const std::string& number, bool gentle, Random& random) {
  const double value = std::strtod(number.c_str(), nullptr);
  constexpr std::array factors{-1.0, 0.0, 0.5, 0.9, 1.0000001, 1.1, 2.0, 3.0, 10.0, 0.1, 1e-3, 1e3};
  const std::size_t way = random.below(gentle ? 8 : 16);
  if (way > 5) return random.of(numbers);
  const double changed = way == 5 ? value + 1 : value * random.of(factors);
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", changed);
  return text;
}

void replace(Tokens& tokens, std::size_t first, std::size_t last, const std::string& text) {
  const Tokens other = tokens_of(text);
  const auto begin = tokens.begin() + static_cast<std::ptrdiff_t>(first);
  const auto at = tokens.erase(begin, tokens.begin() + static_cast<std::ptrdiff_t>(last));
  tokens.insert(at, other.begin(), other.end());
}

std::vector<std::size_t> places_of(const Tokens& tokens, TokenKind kind) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].kind == kind) places.push_back(i);
  return places;
}

void change_number(Tokens& tokens, bool gentle, Random& random) {
  const auto places = places_of(tokens, TokenKind::number);
  if (places.empty()) return;
  Token& token = tokens[random.of(places)];
  token.text = other_number(token.text, gentle, random);
}

void change_text(const Corpus& corpus, Tokens& tokens, Random& random) {
  const auto places = places_of(tokens, TokenKind::text);
  if (places.empty()) return;
  tokens[random.of(places)].text = random.one_in(2) ? random.of(texts) : random.of(corpus.texts);
}

/// Another value of the same key, from anywhere.
void change_value(const Corpus& corpus, Tokens& tokens, bool gentle, Random& random) {
  const auto pairs = pairs_of(tokens);
  if (pairs.empty()) return;
  const Pair& pair = random.of(pairs);
  const auto known = corpus.values.find(pair.key);
  if (known != corpus.values.end() && (gentle || !random.one_in(4)))
    replace(tokens, pair.first, pair.last, random.of(known->second));
  else
    replace(tokens, pair.first, pair.last, random.of(values));
}

void change_pairs(const Corpus& corpus, Tokens& tokens, Random& random) {
  const auto pairs = pairs_of(tokens);
  if (pairs.empty()) return;
  const Pair& pair = random.of(pairs);
  switch (random.below(4)) {
    case 0:  // gone
      replace(tokens, pair.line, pair.last, "");
      break;
    case 1:  // twice
      if (pair.whole_line) {
        const Tokens copy(tokens.begin() + static_cast<std::ptrdiff_t>(pair.line),
                          tokens.begin() + static_cast<std::ptrdiff_t>(pair.last));
        replace(tokens, pair.line, pair.line, text_of(copy) + "\n");
      }
      break;
    case 2:  // another key
      replace(tokens, pair.line, pair.first, random.of(corpus.keys) + " = ");
      break;
    default:  // one more
      if (pair.whole_line) replace(tokens, pair.line, pair.line, random.of(corpus.statements));
  }
}

void change_blocks(const Corpus& corpus, Tokens& tokens, Random& random) {
  const auto blocks = blocks_of(tokens);
  if (blocks.empty()) return;
  const auto [first, last] = random.of(blocks);
  const Tokens copy(tokens.begin() + static_cast<std::ptrdiff_t>(first),
                    tokens.begin() + static_cast<std::ptrdiff_t>(last));
  switch (random.below(4)) {
    case 0:
      replace(tokens, first, last, "");
      break;
    case 1:
      replace(tokens, first, first, text_of(copy));
      break;
    case 2:
      replace(tokens, last, last, "\n" + random.of(corpus.blocks));
      break;
    default: {  // elsewhere
      replace(tokens, first, last, "");
      const auto left = blocks_of(tokens);
      const std::size_t at = left.empty() ? 0 : random.of(left).first;
      replace(tokens, at, at, text_of(copy));
    }
  }
}

/// One element of a list more or less, or another order.
void change_list(Tokens& tokens, Random& random) {
  std::vector<std::size_t> commas;
  for (std::size_t i = 0; i < tokens.size(); ++i)
    if (tokens[i].kind == TokenKind::mark && tokens[i].text == ",") commas.push_back(i);
  if (commas.empty()) return;
  const std::size_t at = random.of(commas);
  std::size_t next = at + 1;
  while (next < tokens.size() && tokens[next].kind == TokenKind::space) ++next;
  if (next >= tokens.size()) return;
  if (random.one_in(2))
    replace(tokens, at, next + 1, "");
  else
    replace(tokens, at, at, ", " + tokens[next].text);
}

void change_bytes(std::string& text, Random& random) {
  for (std::size_t k = 0, n = 1 + random.below(4); k < n && !text.empty(); ++k) {
    const std::size_t at = random.below(text.size());
    const char byte = static_cast<char>(random.below(256));
    switch (random.below(4)) {
      case 0:
        text[at] = byte;
        break;
      case 1:
        text.insert(at, 1 + random.below(3), byte);
        break;
      case 2:
        text.erase(at, 1 + random.below(16));
        break;
      default:
        text.insert(at, text.substr(random.below(text.size()), random.below(64)));
    }
  }
  if (random.one_in(8)) text.resize(random.below(text.size() + 1));
  if (random.one_in(64))
    text.insert(random.below(text.size() + 1), 5000, "[{\"(#"[random.below(5)]);
}

Tokens changed(const Corpus& corpus, Tokens tokens, Strength strength, Random& random) {
  const bool gentle = strength == Strength::gentle;
  for (std::size_t k = 0, n = 1 + random.below(gentle ? 3 : 6); k < n && !tokens.empty(); ++k) {
    switch (random.below(gentle ? 5 : 10)) {
      case 0:
      case 1:
      case 2:
        change_number(tokens, gentle, random);
        break;
      case 3:
      case 4:
        change_value(corpus, tokens, gentle, random);
        break;
      case 5:
        change_text(corpus, tokens, random);
        break;
      case 6:
        change_list(tokens, random);
        break;
      case 7:
        change_blocks(corpus, tokens, random);
        break;
      default:
        change_pairs(corpus, tokens, random);
    }
  }
  return tokens;
}

/// The file beside `of` that its first include names; nothing if there is none.
const File* included_by(const Corpus& corpus, const File& of, Pair& at) {
  for (const Pair& pair : pairs_of(of.tokens)) {
    if (pair.key != "include") continue;
    std::string name = of.tokens[pair.first].text;
    name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
    at = pair;
    for (const File& file : corpus.files)
      if (file.path == of.path.parent_path() / name) return &file;
  }
  return nullptr;
}

}  // namespace

Mutant mutant(const Corpus& corpus, std::uint64_t seed, std::uint64_t number, Strength strength) {
  Random random(seed, number);
  const File& file = strength == Strength::gentle ? corpus.files[random.of(corpus.runnable)]
                                                  : random.of(corpus.files);
  Mutant result{.of = file.path};
  Tokens tokens = file.tokens;
  Pair include;
  const File* other = included_by(corpus, file, include);
  if (other != nullptr && random.one_in(2)) {
    result.included = text_of(changed(corpus, other->tokens, strength, random));
    replace(tokens, include.first, include.last, "\"fuzz-include.toml\"");
  } else {
    tokens = changed(corpus, std::move(tokens), strength, random);
  }
  result.text = text_of(tokens);
  if (strength == Strength::wild && random.one_in(5)) change_bytes(result.text, random);
  return result;
}

}  // namespace springfold::fuzz
