// How models and the instances of a scene are stored on the GPU. All tiers use this code; only the contents
// of their chunks differ.
#pragma once

#include <algorithm>
#include <cstdint>
#include <list>
#include <vector>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/gl/character/light_texture.h"
#include "sdk/src/gl/character/tier.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

struct ModelData {
  explicit ModelData(Ref<const LoadedModel> loaded) : model(std::move(loaded)) {}

  std::uint32_t file_vertices() const {
    return static_cast<std::uint32_t>(model->model.file_to_welded.size());
  }
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(model->model.vertex_count()); }
  std::uint32_t key_points() const { return static_cast<std::uint32_t>(model->model.key_points.size()); }
  std::uint32_t bones() const { return static_cast<std::uint32_t>(model->model.bone_count()); }

  Ref<const LoadedModel> model;
  std::uint32_t users = 0;   // number of chunks that use the model
  std::uint32_t number = 0;  // identifies the model among the tier's models; starts at 1
};

// Creates a buffer whose data never change. Throws Failure, with UNSUPPORTED if the buffer is too large to be
// bound by this OpenGL.
Buffer static_buffer(Device& device, const char* label, const void* data, std::uint64_t bytes);
template <class T>
Buffer static_buffer(Device& device, const char* label, const Vector<T>& data) {
  return static_buffer(device, label, data.data(), data.size() * sizeof(T));
}

// Returns the tier's copy of a model. Creates it if it does not exist yet. Throws Failure.
template <class Model>
Model& model_data(Device& device, List<Model>& models, const Ref<const LoadedModel>& loaded) {
  std::uint32_t last = 0;
  for (Model& known : models) {
    if (known.model.get() == loaded.get()) return known;
    last = std::max(last, known.number);
  }
  Model& made = models.emplace_back(device, loaded);
  made.number = last + 1;
  return made;
}

// Releases models that no chunk uses any more.
template <class Model>
void drop_unused(List<Model>& models) {
  models.remove_if([](const Model& model) { return model.users == 0; });
}

// The instances of a model are stored next to each other in chunks. The buffers of a chunk stay below the
// size that OpenGL guarantees.

// The part of a chunk that all tiers share: its instances and their results for the host. Each tier derives
// its own Chunk from it. A Chunk must have a member `Model* model` and a constructor with the parameters
// (device, model, capacity).
struct ChunkData {
  // Initially, all AO is 1, which is fully open. Throws Failure.
  ChunkData(Device& device, ModelData& model, std::uint32_t instance_capacity);
  ChunkData(const ChunkData&) = delete;
  ChunkData& operator=(const ChunkData&) = delete;
  ~ChunkData() { --data.users; }

  // Throws Failure.
  void make_directional_ao(Device& device);
  bool has_light(const Scene& scene) const;

  static constexpr std::uint32_t empty = UINT32_MAX;

  ModelData& data;
  std::uint32_t capacity;
  Vector<std::uint32_t> slots;  // for each place, the slot of the scene's instance that is stored there, or
                                // `empty`
  std::uint32_t living = 0;
  std::uint32_t first_free = 0;  // no place before it is empty
  Buffer ao;                     // capacity * file vertices
  Buffer directional_ao;         // capacity * file vertices * 3 floats; created for the first light
};

// Creates a buffer for AO. Until the first update, its AO is 1, which means fully open. Throws Failure.
Buffer open_buffer(Device& device, const char* label, std::uint64_t floats);

// Returns how many instances fit in one chunk if each takes at most `share` bytes of a buffer. Throws Failure
// if none fits.
std::uint32_t max_in_chunk(const Device& device, std::uint64_t share);

// The chunk and place of an instance of the scene. Arrays of placements are indexed by the scene's slot.
template <class Chunk>
struct Placement {
  nook_instance_id id = 0;
  std::uint32_t place = 0;  // without a chunk: ModelData::number of the model whose open AO the view shows
  Chunk* chunk = nullptr;   // null: the instance is far, in a scene with a pool
  bool evaluated = false;   // the AO in the chunk comes from an update
  bool lit = false;         // the last update saw a light
  // Only in a scene with a pool (compute_pool.cpp).
  bool is_chosen = false;        // gets a place in this update
  bool is_new = false;           // its place still has the AO of another instance
  float distance = 0;            // from the camera
  std::uint32_t generation = 0;  // PooledView::generation
  std::uint32_t pose_call = 0;   // the last call of set_poses that named the instance
};

// Copies values to `out`, and waits for the GPU. Throws Failure.
void read_buffer(const Device& device, const VertexValues& values, float* out);

[[noreturn]] void fail_without_place(nook_instance_id instance);
[[noreturn]] void fail_without_light(nook_instance_id instance);

template <class ChunkType>
class PlacedScene {
 public:
  using Chunk = ChunkType;
  using Model = typename Chunk::Model;

  PlacedScene(const Scene& of, Memory* memory)
      : scene(&of), chunks(memory), placements(memory), lights(memory) {}

  // True if the structure of the scene has changed since places were assigned.
  bool outdated() const { return !prepared_ || structure_revision_ != scene->structure_revision; }

  // Assigns a place to every instance that does not have one yet. Throws Failure.
  void place_all(Device& device, List<Model>& models) {
    prepared_ = false;
    vacate_removed();
    placements.resize(scene->instances.size());
    lights.resize(scene->instances.size());
    if (scene->pool.is_used())
      place_far(device, models);
    else
      for (std::uint32_t slot = 0; slot < scene->instances.size(); ++slot)
        if (scene->instances[slot].id && !placements[slot].id) place_new(device, models, slot);
    drop_unused(models);
  }
  // Call it after all other steps of the preparation.
  void finish() {
    structure_revision_ = scene->structure_revision;
    prepared_ = true;
  }

  // Marks instances that got a light after the last update as due. Call it before you decide which instances
  // are due.
  void notice_lights() noexcept {
    for (std::size_t slot = 0; slot < placements.size(); ++slot) {
      const bool lit = scene->instances[slot].light().count > 0;
      if (lit && !placements[slot].lit) placements[slot].evaluated = false;
      placements[slot].lit = lit;
    }
  }

  VertexValues place(nook_instance_id instance) const {
    const Placement<Chunk>* placement = find(instance);
    if (!placement) fail_without_place(instance);
    return values(placement->chunk->ao, *placement, 1);
  }
  LightPlace light_place(nook_instance_id instance) const {
    const Placement<Chunk>* placement = find(instance);
    // If `lit` is false, the texel may belong to an earlier instance in the same slot.
    const std::uint32_t texel =
        placement && placement->lit ? lights.first_texel(slot_of(*placement)) : LightTexture::no_light;
    if (texel == LightTexture::no_light) fail_without_light(instance);
    return {values(placement->chunk->directional_ao, *placement, 3), lights.texture(), texel};
  }

  const Scene* scene;
  List<Chunk> chunks;
  Vector<Placement<Chunk>> placements;
  LightTexture lights;

 protected:
  // Puts the instance in `slot` into a chunk that has room.
  void take_place(Chunk& chunk, std::uint32_t slot) noexcept {
    while (chunk.slots[chunk.first_free] != Chunk::empty) ++chunk.first_free;
    placements[slot].chunk = &chunk;
    placements[slot].place = chunk.first_free++;
    chunk.slots[placements[slot].place] = slot;
    ++chunk.living;
  }
  void leave_place(Placement<Chunk>& placement) noexcept {
    Chunk& chunk = *placement.chunk;
    chunk.slots[placement.place] = Chunk::empty;
    chunk.first_free = std::min(chunk.first_free, placement.place);
    --chunk.living;
    placement.chunk = nullptr;
    placement.place = chunk.data.number;
  }
  const Placement<Chunk>* find(nook_instance_id instance) const {
    const auto slot = static_cast<std::size_t>(&instance_of(*scene, instance) - scene->instances.data());
    return slot < placements.size() && placements[slot].id == instance ? &placements[slot] : nullptr;
  }
  static VertexValues values(const Buffer& buffer, const Placement<Chunk>& placement,
                             std::uint32_t channels) {
    VertexValues values{buffer.name(), 0, placement.chunk->model->file_vertices(), channels};
    values.offset = placement.place * values.bytes();
    return values;
  }

 private:
  std::size_t slot_of(const Placement<Chunk>& placement) const {
    return static_cast<std::size_t>(&placement - placements.data());
  }

  void vacate_removed() {
    for (std::size_t slot = 0; slot < placements.size(); ++slot) {
      const Chunk* const chunk = placements[slot].chunk;
      const bool same = slot < scene->instances.size() && scene->instances[slot].id == placements[slot].id &&
                        (!chunk || scene->instances[slot].model.get() == chunk->model->model.get());
      if (placements[slot].id && !same) vacate(placements[slot]);
    }
  }
  void vacate(Placement<Chunk>& placement) {
    Chunk* const chunk = placement.chunk;
    if (chunk) leave_place(placement);
    placement = {};
    if (chunk && chunk->living == 0 && !scene->pool.is_used())
      chunks.remove_if([&](const Chunk& c) { return &c == chunk; });
  }

  void place_new(Device& device, List<Model>& models, std::uint32_t slot) {
    Chunk& chunk = chunk_with_room(device, models, scene->instances[slot].model);
    placements[slot] = {};
    placements[slot].id = scene->instances[slot].id;
    take_place(chunk, slot);
  }
  // Makes room for the near instances of each model. New instances start far, without a place.
  void place_far(Device& device, List<Model>& models) {
    const Vector<PoolShare> shares = pool_shares(*scene, device.memory);
    chunks.remove_if([&](const Chunk& chunk) {
      return std::none_of(shares.begin(), shares.end(), [&](const PoolShare& share) {
        return share.model.get() == chunk.model->model.get();
      });
    });
    for (const PoolShare& share : shares) {
      std::uint32_t room = 0;
      for (const Chunk& chunk : chunks)
        if (chunk.model->model.get() == share.model.get()) room += chunk.capacity;
      if (room >= share.places) continue;
      Model& shared = model_data(device, models, share.model);
      // If the host adds instances one by one, the room grows by half each time it is full.
      const std::uint32_t wanted = std::min(std::max(share.places, room + room / 2), scene->pool.places);
      const std::uint32_t most = max_in_chunk(device, shared.largest_share());
      for (; room < wanted; room += chunks.back().capacity)
        chunks.emplace_back(device, shared, std::min(wanted - room, most));
    }
    for (std::uint32_t slot = 0; slot < scene->instances.size(); ++slot) {
      Placement<Chunk>& placement = placements[slot];
      placement.id = scene->instances[slot].id;
      if (!placement.id || placement.chunk) continue;
      const std::uint32_t number = model_data(device, models, scene->instances[slot].model).number;
      if (placement.place != number) placement.generation = 0;  // the view has changed
      placement.place = number;
    }
  }
  // Returns a chunk of the model that has a free place. If there is none, creates a chunk for all instances
  // of the model that have no place yet. If the model already has chunks, the new chunk is larger, so that
  // the number of instances can grow by half.
  Chunk& chunk_with_room(Device& device, List<Model>& models, const Ref<const LoadedModel>& model) {
    std::uint32_t living = 0, waiting = 0;
    for (Chunk& chunk : chunks) {
      if (chunk.model->model.get() != model.get()) continue;
      if (chunk.living < chunk.capacity) return chunk;
      living += chunk.living;
    }
    for (std::size_t slot = 0; slot < scene->instances.size(); ++slot)
      waiting += scene->instances[slot].id && !placements[slot].id &&
                 scene->instances[slot].model.get() == model.get();
    Model& shared = model_data(device, models, model);
    const std::uint32_t wanted = std::max(waiting, living / 2);
    return chunks.emplace_back(device, shared,
                               std::min(wanted, max_in_chunk(device, shared.largest_share())));
  }

  std::uint64_t structure_revision_ = 0;  // revision of the scene's structure for which the places were
                                          // assigned
  bool prepared_ = false;
};

// Returns the tier's data for a scene, or NULL if the tier has no data for it yet.
template <class Placed>
Placed* placed_scene(List<Placed>& scenes, const Scene& scene) {
  for (Placed& known : scenes)
    if (known.scene == &scene) return &known;
  return nullptr;
}
template <class Placed>
const Placed* placed_scene(const List<Placed>& scenes, const Scene& scene) {
  for (const Placed& known : scenes)
    if (known.scene == &scene) return &known;
  return nullptr;
}

}  // namespace nook::gl
