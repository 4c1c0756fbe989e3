#include "sdk/src/gl/character/pool_table.h"

#include <utility>

namespace nook::gl {

void PoolTable::make(Device& device, std::size_t entries, std::size_t wanted) {
  if (is_used() && entries <= written_.size()) return;
  // A plain copy would have another allocator, and then the move below would allocate.
  Vector<PoolEntry> larger(written_, written_.get_allocator());
  larger.resize(wanted);
  buffer_ =
      Buffer(device, "nook: pool table", larger.size() * sizeof(PoolEntry), larger.data(), GL_DYNAMIC_DRAW);
  written_ = std::move(larger);
}

void PoolTable::send(const Device& device, std::size_t begin, std::size_t end) const noexcept {
  device.gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  device.gl.BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(begin * sizeof(PoolEntry)),
                          static_cast<GLsizeiptr>((end - begin) * sizeof(PoolEntry)),
                          written_.data() + begin);
}

}  // namespace nook::gl
