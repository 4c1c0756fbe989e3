#include "sdk/src/gl/character/scene_buffers.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/character/scene_lights.h"

namespace nook::gl {
namespace {

// The most that one instance, with a light, needs of any buffer that is bound as one piece.
std::uint64_t largest_share(const ModelBuffers& model) {
  const std::uint64_t shares[] = {std::uint64_t{model.file_vertices()} * 3 * sizeof(float),
                                  std::uint64_t{model.shadows()} * 8 * sizeof(float),
                                  std::uint64_t{model.bones()} * sizeof(Mat3x4)};
  return *std::max_element(std::begin(shares), std::end(shares));
}

// What OpenGL guarantees for one dimension of a dispatch.
constexpr std::uint64_t max_groups = 65535;

std::uint32_t most_in_chunk(const Device& device, const ModelBuffers& model) {
  const std::uint64_t most = std::min(device.max_piece_bytes / largest_share(model), max_groups);
  if (most == 0)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "one instance needs %llu bytes in one buffer, this OpenGL allows %llu; use a smaller model",
                  static_cast<unsigned long long>(largest_share(model)),
                  static_cast<unsigned long long>(device.max_piece_bytes));
  return static_cast<std::uint32_t>(most);
}

ModelBuffers& buffers_of(Device& device, ModelList& models, const Ref<const LoadedModel>& model) {
  for (ModelBuffers& known : models)
    if (known.model.get() == model.get()) return known;
  return models.emplace_back(device, model);
}

void vacate(SceneBuffers& buffers, Placement& placement) {
  Chunk& chunk = *placement.chunk;
  chunk.slots[placement.place] = Chunk::empty;
  chunk.first_free = std::min(chunk.first_free, placement.place);
  --chunk.living;
  placement = {};
  if (chunk.living == 0) buffers.chunks.remove_if([&](const Chunk& c) { return &c == &chunk; });
}

void vacate_removed(SceneBuffers& buffers, const Scene& scene) {
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot) {
    Placement& placement = buffers.placements[slot];
    const bool same = slot < scene.instances.size() && scene.instances[slot].id == placement.id;
    if (placement.id && !same) vacate(buffers, placement);
  }
}

// A chunk of the model with room, or a new one for all instances of the model that still wait, with room to
// grow by half once there are others.
Chunk& chunk_with_room(Device& device, ModelList& models, SceneBuffers& buffers, const Scene& scene,
                       const LoadedModel* model) {
  std::uint32_t living = 0;
  for (Chunk& chunk : buffers.chunks) {
    if (chunk.model->model.get() != model) continue;
    if (chunk.living < chunk.capacity) return chunk;
    living += chunk.living;
  }
  std::uint32_t waiting = 0;
  for (std::size_t slot = 0; slot < scene.instances.size(); ++slot)
    waiting += scene.instances[slot].id && !buffers.placements[slot].id &&
               scene.instances[slot].model.get() == model;
  ModelBuffers& shared = buffers_of(device, models, Ref<const LoadedModel>::share(model));
  const std::uint32_t wanted = std::max(waiting, living / 2);
  return buffers.chunks.emplace_back(device, shared, std::min(wanted, most_in_chunk(device, shared)),
                                     device.memory);
}

void place_new(Device& device, ModelList& models, SceneBuffers& buffers, const Scene& scene) {
  for (std::uint32_t slot = 0; slot < scene.instances.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    Placement& placement = buffers.placements[slot];
    if (instance.id == 0 || placement.id) continue;
    Chunk& chunk = chunk_with_room(device, models, buffers, scene, instance.model.get());
    while (chunk.slots[chunk.first_free] != Chunk::empty) ++chunk.first_free;
    placement = {};
    placement.id = instance.id;
    placement.chunk = &chunk;
    placement.place = chunk.first_free++;
    chunk.slots[placement.place] = slot;
    ++chunk.living;
  }
}

// World-space spheres of all chunks in a row, since any instance may be a caster of any other.
void make_sphere_buffers(Device& device, SceneBuffers& buffers) {
  std::uint64_t count = 0;
  bool moved = false;
  for (Chunk& chunk : buffers.chunks) {
    moved |= chunk.first_sphere != count;
    chunk.first_sphere = static_cast<std::uint32_t>(count);
    count += std::uint64_t{chunk.capacity} * chunk.model->spheres();
  }
  constexpr std::uint64_t bytes_each = 4 * sizeof(float);
  if (count * bytes_each > device.max_piece_bytes)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "the scene has %llu proxy spheres, this OpenGL allows %llu; remove instances or use two scenes",
        static_cast<unsigned long long>(count),
        static_cast<unsigned long long>(device.max_piece_bytes / bytes_each));
  const bool grown = count * bytes_each > buffers.spheres.bytes();
  if (grown) {
    buffers.spheres = Buffer(device, "nook: spheres", count * bytes_each, nullptr, GL_DYNAMIC_COPY);
    buffers.caster_weights =
        Buffer(device, "nook: caster weights", count * sizeof(float), nullptr, GL_DYNAMIC_COPY);
  }
  if (grown || moved)
    for (Placement& placement : buffers.placements) placement.transformed_revision = 0;
}

void make_page(Device& device, SceneBuffers& buffers) {
  std::uint64_t texels = 0, largest = 0;
  for (const Chunk& chunk : buffers.chunks) {
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points();
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points());
  }
  // A million texels, 8 MB, are enough for the cost of a page not to matter. Key points have 16-bit numbers,
  // so that the 65,536 texels of every OpenGL hold at least one instance.
  constexpr std::uint64_t enough = 1 << 20;
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  constexpr std::uint64_t bytes_each = 2 * sizeof(float);
  if (texels * bytes_each <= buffers.page.bytes()) return;
  buffers.page = Buffer(device, "nook: shadows", texels * bytes_each, nullptr, GL_STREAM_DRAW);
  if (buffers.page_texture.name() == 0) buffers.page_texture = Object::make(device, Object::Kind::texture);
  device.gl.ActiveTexture(GL_TEXTURE0);
  device.gl.BindTexture(GL_TEXTURE_BUFFER, buffers.page_texture.name());
  device.gl.TexBuffer(GL_TEXTURE_BUFFER, GL_RG32F, buffers.page.name());
  device.label(GL_TEXTURE, buffers.page_texture.name(), "nook: shadows");
}

Buffer ao_buffer(Device& device, const ModelBuffers& model, std::uint32_t capacity) {
  const std::uint64_t bytes = std::uint64_t{capacity} * model.file_vertices() * sizeof(float);
  Buffer buffer(device, "nook: AO", bytes, nullptr, GL_DYNAMIC_COPY, BufferUse::ao);
  auto* const values = static_cast<float*>(buffer.begin_write(bytes));
  std::fill_n(values, bytes / sizeof(float), 1.0f);
  buffer.end_write();
  return buffer;
}

}  // namespace

Chunk::Chunk(Device& device, ModelBuffers& for_model, std::uint32_t instance_capacity,
             std::pmr::memory_resource* memory)
    : model(&for_model), capacity(instance_capacity), slots(instance_capacity, empty, memory) {
  ao = ao_buffer(device, for_model, capacity);
  if (device.gl.tier == 43)
    shadows =
        Buffer(device, "nook: shadows", std::uint64_t{capacity} * for_model.shadows() * 2 * sizeof(float),
               nullptr, GL_DYNAMIC_COPY);
  ++model->users;
}

SceneBuffers::SceneBuffers(Device& device, std::pmr::memory_resource* memory)
    : chunks(memory), placements(memory) {
  if (device.gl.tier == 43) stream = Buffer(device, "nook: poses and casters", 4096, nullptr, GL_STREAM_DRAW);
}

void prepare(Device& device, ModelList& models, SceneBuffers& buffers, const Scene& scene) {
  if (buffers.prepared && buffers.structure_revision == scene.structure_revision) return;
  device.report_host_errors();
  buffers.prepared = false;
  vacate_removed(buffers, scene);
  buffers.placements.resize(scene.instances.size());
  place_new(device, models, buffers, scene);
  drop_unused(models);
  if (device.gl.tier == 43)
    make_sphere_buffers(device, buffers);
  else
    make_page(device, buffers);
  make_light_buffers(device, buffers, scene);
  device.check("preparing a scene");
  buffers.structure_revision = scene.structure_revision;
  buffers.prepared = true;
}

void drop_unused(ModelList& models) {
  models.remove_if([](const ModelBuffers& model) { return model.users == 0; });
}

}  // namespace nook::gl
