#include "sdk/src/gl/character/compute_scene.h"

namespace nook::gl {

ComputeChunk::ComputeChunk(Device& device, ComputeModel& for_model, std::uint32_t instance_capacity)
    : ChunkData(device, for_model, instance_capacity),
      model(&for_model),
      shadows(device, "nook: shadows", std::uint64_t{capacity} * for_model.shadows() * 2 * sizeof(float),
              nullptr, GL_DYNAMIC_COPY),
      transformed(capacity, device.memory) {}

ComputeScene::ComputeScene(Device& device, const Scene& of)
    : PlacedScene(of, device.memory),
      stream(device, "nook: poses and casters", 4096, nullptr, GL_STREAM_DRAW) {}

void ComputeScene::make_buffers(Device& device) {
  make_sphere_buffers(device);
  make_light_buffers(device);
}

// World-space spheres of all chunks in a row, since any instance may be a caster of any other.
void ComputeScene::make_sphere_buffers(Device& device) {
  std::uint64_t count = 0;
  bool moved = false;
  for (ComputeChunk& chunk : chunks) {
    moved |= chunk.first_sphere != count;
    chunk.first_sphere = static_cast<std::uint32_t>(count);
    count += std::uint64_t{chunk.capacity} * chunk.model->spheres();
  }
  constexpr std::uint64_t bytes_each = NOOK_SPHERE_VEC4S * 4 * sizeof(float);
  if (count * bytes_each > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the scene has %llu proxy spheres, this OpenGL allows %llu; remove instances or use two scenes",
        static_cast<unsigned long long>(count),
        static_cast<unsigned long long>(device.max_piece_bytes / bytes_each));
  const bool grown = count * bytes_each > spheres.bytes();
  if (grown) spheres = Buffer(device, "nook: spheres", count * bytes_each, nullptr, GL_DYNAMIC_COPY);
  if (grown || moved)
    for (ComputeChunk& chunk : chunks)
      std::fill(chunk.transformed.begin(), chunk.transformed.end(), ComputeChunk::Pose{});
}

void ComputeScene::make_light_buffers(Device& device) {
  for (ComputeChunk& chunk : chunks) {
    if (chunk.directional_ao.name() || !chunk.has_light(*scene)) continue;
    lights.make(device);
    chunk.colours =
        Buffer(device, "nook: colours of shadows",
               std::uint64_t{chunk.capacity} * chunk.model->shadows() * NOOK_COLOUR_VEC4S * 4 * sizeof(float),
               nullptr, GL_DYNAMIC_COPY);
    chunk.make_directional_ao(device);
  }
}

}  // namespace nook::gl
