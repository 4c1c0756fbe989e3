// How models and the instances of a scene are stored on the GPU. All tiers use this code; only the contents
// of their chunks differ.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <vector>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/gl/character/budget.h"
#include "sdk/src/gl/character/light_texture.h"
#include "sdk/src/gl/character/tier.h"
#include "sdk/src/gl/object.h"
#include "shaders/character/layout.h"

namespace nook::gl {

// Tables that never change are packed and uploaded in pieces, so that a call with a Budget can stop between
// two pieces. A piece takes some ten microseconds.
struct TableShape {
  const char* label;
  std::uint64_t elements;
  std::uint32_t element_bytes;
};

class TableUpload {
 public:
  // Sends the next piece of a table to `buffer`, and creates the buffer for the first piece.
  // write(first, count, out) must write elements. Returns whether the table is complete; the next call then
  // begins another table. Throws Failure, and then the next call repeats the piece. It is
  // Failure(UNSUPPORTED) if the buffer is too large to be bound by this OpenGL.
  template <class Write>
  bool send(Device& device, Buffer& buffer, const TableShape& shape, Write&& write) {
    begin(device, buffer, shape);
    const std::uint64_t left = shape.elements - next_;
    const auto count =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(left, piece_bytes / shape.element_bytes));
    if (count > 0) {
      alignas(16) std::array<std::byte, piece_bytes> piece;
      write(static_cast<std::uint32_t>(next_), count, piece.data());
      send_piece(device, buffer, shape, count, piece.data());
    }
    if (next_ < shape.elements) return false;
    next_ = 0;
    return true;
  }

 private:
  static constexpr std::size_t piece_bytes = 1 << 14;
  void begin(Device& device, Buffer& buffer, const TableShape& shape) const;
  void send_piece(const Device& device, const Buffer& buffer, const TableShape& shape, std::uint32_t count,
                  const void* piece);
  std::uint64_t next_ = 0;  // element
};

struct ModelData {
  explicit ModelData(Ref<const LoadedModel> loaded) : model(std::move(loaded)) {}

  std::uint32_t file_vertices() const {
    return static_cast<std::uint32_t>(model->model.file_to_welded.size());
  }
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(model->model.vertex_count()); }
  std::uint32_t key_points() const { return static_cast<std::uint32_t>(model->model.key_points.size()); }
  std::uint32_t bones() const { return static_cast<std::uint32_t>(model->model.bone_count()); }

  Ref<const LoadedModel> model;
  std::uint32_t users = 0;   // number of chunks that use the model, and of scenes that upload it
  std::uint32_t number = 0;  // identifies the model among the tier's models; starts at 1
};

// Returns the tier's copy of a model, which may not be uploaded yet. Creates it if it does not exist. Throws
// std::bad_alloc.
template <class Model>
Model& known_model(List<Model>& models, const Ref<const LoadedModel>& loaded) {
  std::uint32_t last = 0;
  for (Model& known : models) {
    if (known.model.get() == loaded.get()) return known;
    last = std::max(last, known.number);
  }
  Model& made = models.emplace_back(loaded);
  made.number = last + 1;
  return made;
}
// Returns the tier's copy of a model, and uploads what is missing. Throws Failure.
template <class Model>
Model& model_data(Device& device, List<Model>& models, const Ref<const LoadedModel>& loaded) {
  Model& model = known_model(models, loaded);
  while (!model.is_uploaded()) model.upload_piece(device);
  return model;
}

// Releases models that no chunk uses any more.
template <class Model>
void drop_unused(List<Model>& models) {
  models.remove_if([](const Model& model) { return model.users == 0; });
}

// Removes elements one by one as long as there is time.
template <class Element, class Unused>
void drop_within(List<Element>& elements, const Budget& budget, const Unused& is_unused) {
  for (auto at = elements.begin(); at != elements.end();) {
    const auto next = std::next(at);
    if (is_unused(*at)) {
      elements.erase(at);
      if (!budget.is_left()) return;
    }
    at = next;
  }
}

// Keeps a model while a scene uploads it.
class ModelUse {
 public:
  ModelUse() = default;
  ModelUse(const ModelUse&) = delete;
  ModelUse& operator=(const ModelUse&) = delete;
  ~ModelUse() { set(nullptr); }
  void set(ModelData* model) noexcept {
    if (model) ++model->users;
    if (model_) --model_->users;
    model_ = model;
  }
  ModelData* get() const noexcept { return model_; }

 private:
  ModelData* model_ = nullptr;
};

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
  // Without a chunk, ModelData::number of the model whose open AO the view shows. If the instance is pending,
  // pending_key of its model.
  std::uint32_t place = 0;
  Chunk* chunk = nullptr;        // null: the instance is far, in a scene with a pool, or pending
  bool evaluated : 1 = false;    // the AO in the chunk comes from an update
  bool lit : 1 = false;          // the last update saw a light
  bool is_new : 1 = false;       // its place still has the AO of another instance
  bool is_chosen : 1 = false;    // only in a pool: gets a place in this update
  std::uint16_t fading = 0;      // only in streaming mode: updates until the AO has its value
  float distance = 0;            // only in a pool: from the camera
  std::uint32_t generation = 0;  // of the view, in a pool or in streaming mode
  std::uint32_t pose_call = 0;   // the last call of set_poses that named the instance
};

// A longer fade would have steps that the shaders cannot represent.
inline constexpr std::uint32_t max_fade_updates = NOOK_HIDDEN_STEPS;

// The streaming mode of a scene (nook_streaming.h).
struct Streaming {
  bool is_used = false;
  std::uint32_t fade_updates = 0;
  std::uint32_t pending = 0;   // instances without a chunk
  std::size_t next = 0;        // no slot before it is pending
  bool has_new_views = false;  // the next update gives instances another generation
  ModelUse uploading;
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
      : scene(&of), chunks(memory), placements(memory), lights(memory), ones_(memory) {}

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

  // The next functions are for streaming mode.

  void begin_streaming(std::uint32_t fade_updates) noexcept {
    // Instances that have a place keep it, unless a preparation failed after it gave places.
    if (!streaming.is_used && !prepared_) {
      for (Placement<Chunk>& placement : placements) placement = {};
      chunks.clear();
    }
    if (!streaming.is_used) prepared_ = false;
    streaming.is_used = true;
    streaming.fade_updates = fade_updates;
    for (Placement<Chunk>& placement : placements) {
      if (placement.fading <= longest_fade()) continue;
      placement.fading = longest_fade();
      placement.evaluated = false;  // otherwise the AO might stay partly hidden
    }
  }
  // Follows the edits of the scene: frees the places of instances that were removed, and notes new instances
  // as pending. Throws Failure.
  void notice_edits(Device& device) {
    prepared_ = false;
    vacate_removed();
    placements.resize(scene->instances.size());
    lights.resize(scene->instances.size());
    streaming.pending = 0;
    streaming.next = 0;
    streaming.has_new_views = false;
    for (std::size_t slot = 0; slot < placements.size(); ++slot) {
      Placement<Chunk>& placement = placements[slot];
      if (placement.chunk && !placement.is_new) continue;
      const Instance& instance = scene->instances[slot];
      if (instance.id == 0) continue;
      placement.id = instance.id;
      const std::uint32_t key = pending_key(*instance.model);
      if (!placement.chunk && placement.place != key) placement.generation = 0;  // another view
      if (!placement.chunk) placement.place = key;
      streaming.has_new_views |= placement.generation == 0;
      const bool is_lit = instance.light().lobes.size() > 0;
      if (is_lit) lights.make(device);
      need_ones(device, instance.model->model.file_to_welded.size() * (is_lit ? 3 : 1));
      if (!placement.chunk) ++streaming.pending;
    }
    if (streaming.pending == 0) streaming.uploading.set(nullptr);
  }
  // Does the next piece of work for pending instances. Returns false if there is none. `make_chunk(model,
  // instances)` must return a new chunk. Throws Failure.
  template <class MakeChunk>
  bool place_next(Device& device, List<Model>& models, const MakeChunk& make_chunk) {
    if (streaming.pending == 0) return false;
    // Otherwise, new instances in earlier slots might delay a large model for ever.
    if (Model* const model = static_cast<Model*>(streaming.uploading.get()); model && !model->is_uploaded()) {
      model->upload_piece(device);
      return true;
    }
    while (!is_pending(placements[streaming.next])) ++streaming.next;
    const auto slot = static_cast<std::uint32_t>(streaming.next);
    Model& model = known_model(models, scene->instances[slot].model);
    streaming.uploading.set(&model);
    if (!model.is_uploaded()) {
      model.upload_piece(device);
      return true;
    }
    Chunk* chunk = with_room(model);
    if (!chunk) chunk = &make_chunk(model, wanted_room(device, model));
    take_place(*chunk, slot);
    Placement<Chunk>& placement = placements[slot];
    placement.evaluated = false;
    placement.is_new = true;
    placement.fading = longest_fade();
    if (--streaming.pending == 0) streaming.uploading.set(nullptr);
    return true;
  }
  // Releases chunks and models that no instance uses any more, as long as there is time.
  void drop_unused_within(List<Model>& models, const Budget& budget) {
    drop_within(chunks, budget, [](const Chunk& chunk) { return chunk.living == 0; });
    drop_within(models, budget, [](const Model& model) { return model.users == 0; });
  }
  // Returns how much of the AO of an instance is still hidden, in the steps of NOOK_HIDDEN_STEPS.
  std::uint32_t hidden_steps(std::uint32_t slot) const {
    const std::uint32_t fading = placements[slot].fading;
    return fading == 0 ? 0 : std::max(fading * NOOK_HIDDEN_STEPS / streaming.fade_updates, 1u);
  }
  // Lets the next update evaluate all instances that fade in.
  void evaluate_fading() noexcept {
    for (Placement<Chunk>& placement : placements)
      if (placement.fading > 0) placement.evaluated = false;
  }
  // Returns whether an instance in a place has a light, but its chunk has no buffers for lights.
  bool lacks_light_buffers() const noexcept {
    return std::any_of(placements.begin(), placements.end(), [](const Placement<Chunk>& placement) {
      return placement.chunk && placement.lit && placement.chunk->directional_ao.name() == 0;
    });
  }
  // Counts down the fades of instances that this update evaluates, and shows instances their new AO.
  void finish_streamed(Scene& scene_to_change) noexcept {
    streaming.has_new_views = false;
    for (std::size_t slot = 0; slot < placements.size(); ++slot) {
      Placement<Chunk>& placement = placements[slot];
      if (placement.generation == 0 && placement.id) placement.generation = ++scene_to_change.pool.generation;
      if (!(placement.fading || placement.is_new) || !placement.evaluated) continue;
      // The next update must show the whole AO, even if it would not evaluate the instance otherwise.
      if (placement.fading > 0 && --placement.fading == 0) placement.evaluated = false;
      if (!placement.is_new) continue;
      placement.is_new = false;
      placement.generation = ++scene_to_change.pool.generation;
    }
  }
  // Returns the view of an instance, which shows ones until its first update.
  PooledView streamed_view(nook_instance_id instance) const {
    const Placement<Chunk>* const placement = find(instance);
    if (!placement) fail_without_place(instance);
    if (placement->chunk && !placement->is_new)
      return {values(placement->chunk->ao, *placement, 1), placement->generation, true};
    return {ones(instance, 1), placement->generation, false};
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
    if (streaming.is_used && (!placement->chunk || placement->is_new))
      return {ones(instance, 3), lights.texture(), texel};
    return {values(placement->chunk->directional_ao, *placement, 3), lights.texture(), texel};
  }

  const Scene* scene;
  List<Chunk> chunks;
  Vector<Placement<Chunk>> placements;
  LightTexture lights;
  Streaming streaming;

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
  // Returns a number that differs for most models.
  static std::uint32_t pending_key(const LoadedModel& model) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&model) >> 4);
  }
  std::uint16_t longest_fade() const {
    return static_cast<std::uint16_t>(streaming.fade_updates > 0 ? streaming.fade_updates - 1 : 0);
  }
  static bool is_pending(const Placement<Chunk>& placement) { return placement.id && !placement.chunk; }

  Chunk* with_room(const Model& model) noexcept {
    for (Chunk& chunk : chunks)
      if (chunk.model == &model && chunk.living < chunk.capacity) return &chunk;
    return nullptr;
  }
  // Returns the capacity of a new chunk for the pending instances of a model, and for half as many as live.
  std::uint32_t wanted_room(const Device& device, const Model& model) const {
    std::uint32_t living = 0, pending = 0;
    for (const Chunk& chunk : chunks)
      if (chunk.model == &model) living += chunk.living;
    for (const Placement<Chunk>& placement : placements)
      pending += is_pending(placement) && placement.place == pending_key(*model.model);
    return std::min(std::max({pending, living / 2, 1u}), max_in_chunk(device, model.largest_share()));
  }

  // Makes a buffer of at least so many ones. The earlier buffers stay, because views show them.
  void need_ones(Device& device, std::uint64_t floats) {
    const std::uint64_t most = ones_.empty() ? 0 : ones_.back().bytes() / sizeof(float);
    if (floats > most) ones_.push_back(open_buffer(device, "nook: ones", std::max(floats, 2 * most)));
  }
  VertexValues ones(nook_instance_id instance, std::uint32_t channels) const {
    const auto vertices =
        static_cast<std::uint32_t>(instance_of(*scene, instance).model->model.file_to_welded.size());
    VertexValues values{0, 0, vertices, channels};
    for (const Buffer& buffer : ones_)
      if (buffer.bytes() >= values.bytes()) {
        values.buffer = buffer.name();
        return values;
      }
    fail_without_place(instance);
  }

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
    if (chunk && chunk->living == 0 && !scene->pool.is_used() && !streaming.is_used)
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

  List<Buffer> ones_;                     // for pending instances, from the smallest to the largest
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
