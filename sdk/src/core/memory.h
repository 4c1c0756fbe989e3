// The interface through which the library allocates all of its memory, with implementations for the host's
// allocator and for the global operator new. std::pmr is not used, because some standard libraries do not
// have it: libc++ before version 16, and therefore Emscripten 3.1 and macOS before 14.
#pragma once

#include <nook/nook.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>

namespace nook {

class Memory {
 public:
  // Throws std::bad_alloc if no memory is left. `alignment` must be a power of two.
  void* allocate(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
    return do_allocate(bytes, alignment);
  }
  // Pass the same `bytes` and `alignment` as to allocate.
  void deallocate(void* memory, std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
    do_deallocate(memory, bytes, alignment);
  }

 protected:
  ~Memory() = default;

 private:
  virtual void* do_allocate(std::size_t bytes, std::size_t alignment) = 0;
  virtual void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) = 0;
};

class HostMemory final : public Memory {
 public:
  // If both functions are null, memory comes from the global operator new.
  explicit HostMemory(const nook_allocator& allocator) noexcept : allocator_(allocator) {}

  const nook_allocator& allocator() const noexcept { return allocator_; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* memory = allocator_.allocate ? allocator_.allocate(allocator_.user, bytes, alignment)
                                       : ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
    if (!memory) throw std::bad_alloc();
    return memory;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    if (allocator_.release)
      allocator_.release(allocator_.user, memory, bytes, alignment);
    else
      ::operator delete(memory, std::align_val_t(alignment));
  }

  nook_allocator allocator_;
};

// Counts the bytes that one object allocates from another memory.
class MeteredMemory final : public Memory {
 public:
  explicit MeteredMemory(Memory* source) noexcept : source_(source) {}
  MeteredMemory(const MeteredMemory&) = delete;
  MeteredMemory& operator=(const MeteredMemory&) = delete;

  std::uint64_t bytes() const noexcept { return bytes_.load(std::memory_order_relaxed); }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* memory = source_->allocate(bytes, alignment);
    bytes_.fetch_add(bytes, std::memory_order_relaxed);
    return memory;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    bytes_.fetch_sub(bytes, std::memory_order_relaxed);
    source_->deallocate(memory, bytes, alignment);
  }

  Memory* source_;
  std::atomic<std::uint64_t> bytes_{0};
};

// Returns a Memory that uses the global operator new, for code without a host, such as bakers and tests.
inline Memory* default_memory() noexcept {
  static HostMemory memory{nook_allocator{}};
  return &memory;
}

}  // namespace nook
