// One mutant of the corpus for every number, always the same one.
#pragma once

#include <cstdint>
#include <optional>

#include "corpus.hpp"

namespace springfold::fuzz {

struct Mutant {
  std::filesystem::path of{};  ///< file of the corpus, beside which the mutant has to lie
  std::string text{};
  std::optional<std::string>
      included{};  ///< a mutant of the file that it includes, as "fuzz-include.toml"
};

/// How far from the corpus: `gentle` changes one to three values and keeps what can be run, `wild` does anything.
enum class Strength { gentle, wild };

Mutant mutant(const Corpus& corpus, std::uint64_t seed, std::uint64_t number, Strength strength);

}  // namespace springfold::fuzz
