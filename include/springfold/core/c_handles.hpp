// Objects of C libraries that report a want of memory by a null pointer or a flag.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace springfold {

/// Owns what a C library made. @param free  called with the pointer
template <class T, class Free>
auto owned(T* pointer, Free free) {
  return std::unique_ptr<std::remove_pointer_t<T*>, Free>(pointer, free);
}

/// What could not be made for want of memory; many libraries would go on with nothing.
/// @throws std::bad_alloc
template <class T>
T* made(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc{};
  return pointer;
}

/// Calls that prepare, and fail (with a negative flag) for want of memory only.
/// @throws std::bad_alloc
inline void prepared(int flag) {
  if (flag < 0) throw std::bad_alloc{};
}

/// SUNDIALS does not look whether there is memory for a context, so there must be.
/// @throws std::bad_alloc
inline void require_room_for_context() {
  constexpr std::size_t context = std::size_t{1} << 16U;
  ::operator delete(::operator new(context));
}

}  // namespace springfold
