// Intrusive reference counts for the objects behind the public handles. A reference keeps an object and its
// memory alive, so the host may destroy handles in any order.
#pragma once

#include <atomic>
#include <utility>

#include "sdk/src/core/memory.h"

namespace nook {

class RefCounted {
 public:
  RefCounted(const RefCounted&) = delete;
  RefCounted& operator=(const RefCounted&) = delete;

  void retain() const noexcept { count_.fetch_add(1, std::memory_order_relaxed); }
  void release() const noexcept {
    if (count_.fetch_sub(1, std::memory_order_acq_rel) == 1) const_cast<RefCounted*>(this)->destroy();
  }

 protected:
  RefCounted() = default;  // the count starts at 1 for the creator's reference
  virtual ~RefCounted() = default;

 private:
  virtual void destroy() noexcept = 0;

  mutable std::atomic<int> count_{1};
};

template <class T>
class Ref {
 public:
  Ref() = default;
  // Takes over a reference from the caller, without incrementing the count.
  static Ref adopt(T* object) noexcept {
    Ref ref;
    ref.object_ = object;
    return ref;
  }
  static Ref share(T* object) noexcept {
    if (object) object->retain();
    return adopt(object);
  }
  Ref(const Ref& other) noexcept : object_(other.object_) {
    if (object_) object_->retain();
  }
  Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  template <class U>
  Ref(Ref<U> other) noexcept : object_(other.detach()) {}
  Ref& operator=(Ref other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Ref() {
    if (object_) object_->release();
  }

  T* get() const noexcept { return object_; }
  T* operator->() const noexcept { return object_; }
  T& operator*() const noexcept { return *object_; }
  explicit operator bool() const noexcept { return object_ != nullptr; }
  T* detach() noexcept { return std::exchange(object_, nullptr); }

 private:
  T* object_ = nullptr;
};

// Creates an object in `memory`. If `owner` is not null, it is referenced until the object is destroyed, so
// that it can keep `memory` alive.
template <class T>
class Owned final : public T {
 public:
  template <class... Arguments>
  static Ref<T> make(Memory* memory, Ref<const RefCounted> owner, Arguments&&... arguments) {
    void* place = memory->allocate(sizeof(Owned), alignof(Owned));
    try {
      return Ref<T>::adopt(new (place)
                               Owned(memory, std::move(owner), std::forward<Arguments>(arguments)...));
    } catch (...) {
      memory->deallocate(place, sizeof(Owned), alignof(Owned));
      throw;
    }
  }

 private:
  template <class... Arguments>
  Owned(Memory* memory, Ref<const RefCounted> owner, Arguments&&... arguments)
      : T(std::forward<Arguments>(arguments)...), memory_(memory), owner_(std::move(owner)) {}

  void destroy() noexcept override {
    const Ref<const RefCounted> owner = std::move(owner_);
    Memory* memory = memory_;
    this->~Owned();
    memory->deallocate(this, sizeof(Owned), alignof(Owned));
  }

  Memory* memory_;
  Ref<const RefCounted> owner_;
};

}  // namespace nook
