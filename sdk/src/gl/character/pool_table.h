// The table on the GPU that tells a host's shaders where the AO of each instance of a pool is.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

// The public header documents the layout, because the host's shaders read it.
struct PoolEntry {
  GLuint buffer = 0;  // 0: far, or no instance
  std::uint32_t first = 0;
  std::uint32_t generation = 0;
  std::uint32_t level = 0;
  bool operator==(const PoolEntry&) const = default;
};
static_assert(sizeof(PoolEntry) == 4 * sizeof(std::uint32_t));

class PoolTable {
 public:
  explicit PoolTable(Memory* memory) : written_(memory) {}

  // False until the host asks for the table.
  bool is_used() const { return buffer_.name() != 0; }
  GLuint name() const { return buffer_.name(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(written_.size()); }

  // Makes room for at least `entries` entries. A new buffer replaces a smaller one and keeps its entries.
  // Throws Failure or std::bad_alloc, and then nothing has changed.
  void make(Device& device, std::size_t entries, std::size_t wanted);
  // Writes the entries that differ from the entries in the buffer. entry_of(i) returns entry i.
  template <class EntryOf>
  void write(const Device& device, std::size_t entries, const EntryOf& entry_of) noexcept {
    std::size_t begin = 0, end = 0;  // the changed range that is not sent yet
    for (std::size_t i = 0; i < entries; ++i) {
      const PoolEntry entry = entry_of(i);
      if (entry == written_[i]) continue;
      written_[i] = entry;
      // One call that also writes a few unchanged entries is cheaper than two calls.
      if (begin != end && i - end > max_gap) {
        send(device, begin, end);
        begin = end;
      }
      if (begin == end) begin = i;
      end = i + 1;
    }
    if (begin != end) send(device, begin, end);
  }

 private:
  static constexpr std::size_t max_gap = 16;
  void send(const Device& device, std::size_t begin, std::size_t end) const noexcept;

  Buffer buffer_;
  Vector<PoolEntry> written_;
};

}  // namespace nook::gl
