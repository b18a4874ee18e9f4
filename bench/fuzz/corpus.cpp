#include "corpus.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace springfold::fuzz {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '+' ||
         c == '.';
}

bool looks_like_a_number(const std::string& word) {
  const char c =
      word[word.find_first_not_of("+-") == std::string::npos ? 0 : word.find_first_not_of("+-")];
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || word == "inf" || word == "nan" ||
         word == "-inf" || word == "+inf";
}

/// Behind the text that begins at `at`: one line, or to the end of the file.
std::size_t end_of_text(const std::string& text, std::size_t at) {
  const char quote = text[at];
  for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '\\' && quote == '"')
      ++i;
    else if (text[i] == quote)
      return i + 1;
  }
  return at + 1;
}

bool is_gap(const Token& token) {
  return token.kind == TokenKind::space || token.kind == TokenKind::newline ||
         token.kind == TokenKind::comment;
}

bool is_mark(const Token& token, char c) {
  return token.kind == TokenKind::mark && token.text[0] == c;
}

/// Behind the value that begins at `at`: balanced brackets, or one token.
std::size_t end_of_value(const Tokens& tokens, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < tokens.size(); ++i) {
    if (is_mark(tokens[i], '[') || is_mark(tokens[i], '{')) ++depth;
    if (is_mark(tokens[i], ']') || is_mark(tokens[i], '}')) --depth;
    if (depth <= 0) return i + 1;
  }
  return tokens.size();
}

std::string text_between(const Tokens& tokens, std::size_t first, std::size_t last) {
  std::string text;
  for (std::size_t i = first; i < last; ++i) text += tokens[i].text;
  return text;
}

template <class T>
void keep_once(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

Tokens tokens_of(const std::string& text) {
  Tokens tokens;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    TokenKind kind = TokenKind::mark;
    if (text[i] == '\n') {
      kind = TokenKind::newline;
    } else if (text[i] == ' ' || text[i] == '\t') {
      kind = TokenKind::space;
      while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) ++end;
    } else if (text[i] == '#') {
      kind = TokenKind::comment;
      end = std::min(text.find('\n', i), text.size());
    } else if (text[i] == '"' || text[i] == '\'') {
      kind = TokenKind::text;
      end = end_of_text(text, i);
    } else if (is_word(text[i])) {
      while (end < text.size() && is_word(text[end])) ++end;
      kind = looks_like_a_number(text.substr(i, end - i)) ? TokenKind::number : TokenKind::word;
    }
    tokens.push_back({kind, text.substr(i, end - i)});
    i = end;
  }
  return tokens;
}

std::string text_of(const Tokens& tokens) { return text_between(tokens, 0, tokens.size()); }

std::vector<Pair> pairs_of(const Tokens& tokens) {
  std::vector<Pair> pairs;
  std::size_t line = 0;
  int depth = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].kind == TokenKind::newline && depth == 0) line = i + 1;
    if (is_mark(tokens[i], '[') || is_mark(tokens[i], '{')) ++depth;
    if (is_mark(tokens[i], ']') || is_mark(tokens[i], '}')) depth = std::max(0, depth - 1);
    if (!is_mark(tokens[i], '=')) continue;
    std::size_t key = i;
    while (key > line && (is_mark(tokens[key], '=') || is_gap(tokens[key]))) --key;
    std::size_t first = i + 1;
    while (first < tokens.size() && is_gap(tokens[first])) ++first;
    if (first >= tokens.size()) break;
    pairs.push_back({tokens[key].text, depth == 0 ? line : key, first, end_of_value(tokens, first),
                     depth == 0});
  }
  return pairs;
}

std::vector<std::pair<std::size_t, std::size_t>> blocks_of(const Tokens& tokens) {
  std::vector<std::pair<std::size_t, std::size_t>> blocks;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (!is_mark(tokens[i], '[') || tokens[i - 1].kind != TokenKind::newline) continue;
    blocks.emplace_back(begin, i);
    begin = i;
  }
  blocks.emplace_back(begin, tokens.size());
  return blocks;
}

Corpus read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  Corpus corpus;
  for (const auto& path : paths) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    File file{path.lexically_relative(folder), tokens_of(text.str())};
    for (const Pair& pair : pairs_of(file.tokens)) {
      corpus.keys.push_back(pair.key);
      corpus.values[pair.key].push_back(text_between(file.tokens, pair.first, pair.last));
      if (pair.whole_line)
        corpus.statements.push_back(text_between(file.tokens, pair.line, pair.last) + "\n");
    }
    for (const auto& [first, last] : blocks_of(file.tokens))
      corpus.blocks.push_back(text_between(file.tokens, first, last));
    for (const Token& token : file.tokens)
      if (token.kind == TokenKind::text) corpus.texts.push_back(token.text);
    if (text.str().find("[[study]]") != std::string::npos)
      corpus.runnable.push_back(corpus.files.size());
    corpus.files.push_back(std::move(file));
  }
  keep_once(corpus.keys);
  keep_once(corpus.statements);
  keep_once(corpus.texts);
  for (auto& [key, values] : corpus.values) keep_once(values);
  return corpus;
}

}  // namespace springfold::fuzz
