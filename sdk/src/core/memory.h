// The host's allocator as a memory resource, which every container of the library uses.
#pragma once

#include <nook/nook.h>

#include <memory_resource>
#include <new>

namespace nook {

class HostMemory final : public std::pmr::memory_resource {
 public:
  // If both functions are null, memory comes from the global operator new.
  explicit HostMemory(const nook_allocator& allocator) noexcept : allocator_(allocator) {}

  const nook_allocator& allocator() const noexcept { return allocator_; }

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    void* memory = allocator_.allocate ? allocator_.allocate(allocator_.user, size, alignment)
                                       : ::operator new(size, std::align_val_t(alignment), std::nothrow);
    if (!memory) throw std::bad_alloc();
    return memory;
  }
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override {
    if (allocator_.release)
      allocator_.release(allocator_.user, memory, size, alignment);
    else
      ::operator delete(memory, std::align_val_t(alignment));
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  nook_allocator allocator_;
};

}  // namespace nook
