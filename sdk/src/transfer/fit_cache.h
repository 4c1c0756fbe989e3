// The factored Gram matrices of a context, one for each number of lobes that it has projected light to.
#pragma once

#include <atomic>
#include <cstdint>

#include "sdk/src/core/memory.h"

namespace nook::transfer {

class LobeFit;

// Any thread may ask at any time. Nothing is made until the first call, and nothing is freed before the
// cache.
class FitCache {
 public:
  explicit FitCache(Memory* memory) noexcept : memory_(memory) {}
  ~FitCache();
  FitCache(const FitCache&) = delete;
  FitCache& operator=(const FitCache&) = delete;

  // Makes the fit on the first call for a number of lobes. Two threads that both are the first both make it,
  // and one of the two results is dropped: a lock would need threads, which some builds do not have.
  const LobeFit& of(std::uint32_t lobes);

 private:
  struct Entry;
  const LobeFit* find(const Entry* from, const Entry* end, std::uint32_t lobes) const;
  void drop(Entry* entry) noexcept;

  Memory* memory_;
  std::atomic<Entry*> first_{nullptr};
};

}  // namespace nook::transfer
