// One visitor of a std::variant from several functions.
#pragma once

namespace springfold {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;  // clang 14 deduces nothing for aggregates by itself

}  // namespace springfold
