#include "sdk/src/gl/character/placed_scene.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {

void TableUpload::begin(Device& device, Buffer& buffer, const TableShape& shape) const {
  if (next_ > 0) return;
  const std::uint64_t bytes = shape.elements * shape.element_bytes;
  if (bytes > device.max_piece_bytes)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "a model needs %llu bytes in one buffer, but this OpenGL allows %llu; use a model with "
                  "fewer vertices",
                  static_cast<unsigned long long>(bytes),
                  static_cast<unsigned long long>(device.max_piece_bytes));
  buffer = Buffer(device, shape.label, bytes, nullptr, GL_STATIC_DRAW);
}

void TableUpload::send_piece(const Device& device, const Buffer& buffer, const TableShape& shape,
                             std::uint32_t count, const void* piece) {
  device.gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  device.gl.BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(next_ * shape.element_bytes),
                          static_cast<GLsizeiptr>(std::uint64_t{count} * shape.element_bytes), piece);
  next_ += count;
}

namespace {

// The number of groups that OpenGL guarantees in each dimension of a dispatch.
constexpr std::uint64_t max_groups = 65535;

}  // namespace

Buffer open_buffer(Device& device, const char* label, std::uint64_t floats) {
  const std::uint64_t bytes = floats * sizeof(float);
  Buffer buffer(device, label, bytes, nullptr, GL_DYNAMIC_COPY, BufferUse::ao);
  std::array<float, 4096> ones;
  ones.fill(1);
  std::uint64_t done = std::min<std::uint64_t>(bytes, sizeof ones);
  device.gl.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(done), ones.data());
  // The rest are copies on the GPU, so that the CPU's time does not depend on the size.
  while (done < bytes) {
    const std::uint64_t more = std::min(done, bytes - done);
    device.gl.CopyBufferSubData(GL_ARRAY_BUFFER, GL_ARRAY_BUFFER, 0, static_cast<GLintptr>(done),
                                static_cast<GLsizeiptr>(more));
    done += more;
  }
  return buffer;
}

ChunkData::ChunkData(Device& device, ModelData& model, std::uint32_t instance_capacity)
    : data(model),
      capacity(instance_capacity),
      slots(instance_capacity, empty, device.memory),
      ao(open_buffer(device, "nook: AO", std::uint64_t{capacity} * model.file_vertices())) {
  ++data.users;
}

void ChunkData::make_directional_ao(Device& device) {
  directional_ao =
      open_buffer(device, "nook: directional AO", std::uint64_t{capacity} * data.file_vertices() * 3);
}

bool ChunkData::has_light(const Scene& scene) const {
  return std::any_of(slots.begin(), slots.end(), [&](std::uint32_t slot) {
    return slot != empty && scene.instances[slot].light().lobes.size() > 0;
  });
}

std::uint32_t max_in_chunk(const Device& device, std::uint64_t share) {
  const std::uint64_t max = std::min(device.max_piece_bytes / share, max_groups);
  if (max == 0)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "one instance needs %llu bytes in one buffer, but this OpenGL allows %llu; use a smaller model",
        static_cast<unsigned long long>(share), static_cast<unsigned long long>(device.max_piece_bytes));
  return static_cast<std::uint32_t>(max);
}

void read_buffer(const Device& device, const VertexValues& values, float* out) {
  device.report_host_errors();
  read_buffer_bytes(device, values.buffer, values.offset, values.bytes(), out);
  device.check(values.channels == 1 ? "reading AO" : "reading directional AO");
}

void fail_without_place(nook_instance_id instance) {
  throw Failure(NOOK_ERROR_INVALID_HANDLE,
                "instance %u has no AO buffer yet; call nook_gl_scene_prepare or nook_gl_scene_update",
                instance);
}

void fail_without_light(nook_instance_id instance) {
  throw Failure(
      NOOK_ERROR_INVALID_HANDLE,
      "the last update had no light for instance %u; call nook_scene_set_light, then nook_gl_scene_update",
      instance);
}

}  // namespace nook::gl
