#include "sdk/src/transfer/fit_cache.h"

#include <new>

#include "sdk/src/transfer/lobe_fit.h"

namespace nook::transfer {

struct FitCache::Entry {
  Entry(std::uint32_t lobes, Memory* memory) : fit(lobes, memory) {}

  const LobeFit fit;
  Entry* next = nullptr;
};

FitCache::~FitCache() {
  for (Entry* entry = first_.load(); entry;) {
    Entry* const next = entry->next;
    drop(entry);
    entry = next;
  }
}

void FitCache::drop(Entry* entry) noexcept {
  entry->~Entry();
  memory_->deallocate(entry, sizeof(Entry), alignof(Entry));
}

const LobeFit* FitCache::find(const Entry* from, const Entry* end, std::uint32_t lobes) const {
  for (const Entry* entry = from; entry != end; entry = entry->next)
    if (entry->fit.lobes() == lobes) return &entry->fit;
  return nullptr;
}

const LobeFit& FitCache::of(std::uint32_t lobes) {
  Entry* first = first_.load(std::memory_order_acquire);
  if (const LobeFit* const known = find(first, nullptr, lobes)) return *known;
  void* const place = memory_->allocate(sizeof(Entry), alignof(Entry));
  Entry* made = nullptr;
  try {
    made = new (place) Entry(lobes, memory_);
  } catch (...) {
    memory_->deallocate(place, sizeof(Entry), alignof(Entry));
    throw;
  }
  made->next = first;
  while (!first_.compare_exchange_weak(made->next, made, std::memory_order_acq_rel)) {
    // Others have put entries in front of those that were searched.
    if (const LobeFit* const known = find(made->next, first, lobes)) {
      drop(made);
      return *known;
    }
    first = made->next;
  }
  return made->fit;
}

}  // namespace nook::transfer
