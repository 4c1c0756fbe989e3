// The standard containers, with an allocator that uses a Memory. A container of containers passes its Memory
// on to its elements.
#pragma once

#include <cstddef>
#include <limits>
#include <list>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sdk/src/core/memory.h"

namespace nook {

// Assignment and swap do not change a container's allocator. Move construction takes over the allocator of
// the source. A copy uses default_memory(), so that the copy can outlive the Memory of the original.
template <class T>
class Allocator {
 public:
  using value_type = T;

  Allocator() noexcept : memory_(default_memory()) {}
  // Implicit, so that you can construct a container from a pointer.
  Allocator(Memory* memory) noexcept : memory_(memory) {}
  template <class U>
  Allocator(const Allocator<U>& other) noexcept : memory_(other.memory()) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(memory_->allocate(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* first, std::size_t count) noexcept {
    memory_->deallocate(first, count * sizeof(T), alignof(T));
  }
  // If the element's constructor takes an allocator as its last argument, passes this allocator. Otherwise
  // constructs the element without an allocator.
  template <class U, class... Arguments>
  requires(std::uses_allocator<U, Allocator<U>>::value) void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)..., Allocator<U>(memory_));
  }
  Allocator select_on_container_copy_construction() const noexcept { return {}; }

  Memory* memory() const noexcept { return memory_; }
  template <class U>
  bool operator==(const Allocator<U>& other) const noexcept {
    return memory_ == other.memory();
  }

 private:
  Memory* memory_;
};

template <class T>
using Vector = std::vector<T, Allocator<T>>;
template <class T>
using List = std::list<T, Allocator<T>>;
using String = std::basic_string<char, std::char_traits<char>, Allocator<char>>;

}  // namespace nook
