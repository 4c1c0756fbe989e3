// A Box owns one object, which has its own allocation, or is empty.
#pragma once

#include <utility>

#include "sdk/src/core/memory.h"

namespace nook {

template <class T>
class Box {
 public:
  Box() = default;
  // Throws std::bad_alloc.
  template <class... Arguments>
  static Box make(Memory* memory, Arguments&&... arguments) {
    Box box;
    box.memory_ = memory;
    void* const place = memory->allocate(sizeof(T), alignof(T));
    try {
      box.object_ = ::new (place) T(std::forward<Arguments>(arguments)...);
    } catch (...) {
      memory->deallocate(place, sizeof(T), alignof(T));
      throw;
    }
    return box;
  }
  Box(Box&& other) noexcept { swap(other); }
  Box& operator=(Box&& other) noexcept {
    Box old(std::move(other));
    swap(old);
    return *this;
  }
  ~Box() {
    if (!object_) return;
    object_->~T();
    memory_->deallocate(object_, sizeof(T), alignof(T));
  }

  explicit operator bool() const { return object_ != nullptr; }
  T& operator*() { return *object_; }
  const T& operator*() const { return *object_; }
  T* operator->() { return object_; }
  const T* operator->() const { return object_; }

 private:
  void swap(Box& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(object_, other.object_);
  }

  Memory* memory_ = nullptr;
  T* object_ = nullptr;
};

}  // namespace nook
