// Case files as tokens, and what the mutations take from other files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace springfold::fuzz {

enum class TokenKind { space, newline, comment, word, number, text, mark };

struct Token {
  TokenKind kind = TokenKind::space;
  std::string text{};
};

using Tokens = std::vector<Token>;

/// All of the text, in tokens; whatever is not understood becomes marks of one byte.
Tokens tokens_of(const std::string& text);
std::string text_of(const Tokens& tokens);

/// `key = value` within a file: the value is the tokens [first, last).
struct Pair {
  std::string key{};
  std::size_t line = 0;  ///< token where the statement begins
  std::size_t first = 0, last = 0;
  bool whole_line = false;  ///< a statement of its own, not an entry of { }
};

std::vector<Pair> pairs_of(const Tokens& tokens);

/// Blocks of lines that begin with a [header] or [[header]], the part before the first one included.
std::vector<std::pair<std::size_t, std::size_t>> blocks_of(const Tokens& tokens);

struct File {
  std::filesystem::path path{};  ///< below the corpus' folder
  Tokens tokens{};
};

struct Corpus {
  std::vector<File> files{};
  std::vector<std::size_t> runnable{};                       ///< those that hold studies
  std::map<std::string, std::vector<std::string>> values{};  ///< of each key, as they are written
  std::vector<std::string> keys{}, statements{}, blocks{}, texts{};
};

/// All .toml files below the folder, in the order of their names.
Corpus read_corpus(const std::filesystem::path& folder);

}  // namespace springfold::fuzz
