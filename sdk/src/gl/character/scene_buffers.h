// A scene on the GPU: instances of one model live side by side in chunks, whose buffers stay below what
// OpenGL guarantees.
#pragma once

#include <array>
#include <list>
#include <memory_resource>
#include <vector>

#include "sdk/src/character/scene.h"
#include "sdk/src/gl/character/model_buffers.h"

namespace nook::gl {

using ModelList = std::pmr::list<ModelBuffers>;

struct Chunk {
  Chunk(Device& device, ModelBuffers& for_model, std::uint32_t instance_capacity,
        std::pmr::memory_resource* memory);
  Chunk(const Chunk&) = delete;
  Chunk& operator=(const Chunk&) = delete;
  ~Chunk() { --model->users; }

  static constexpr std::uint32_t empty = UINT32_MAX;

  ModelBuffers* model;
  std::uint32_t capacity;
  std::pmr::vector<std::uint32_t> slots;  // of each place: the scene's slot that lives there, or `empty`
  std::uint32_t living = 0;
  std::uint32_t first_free = 0;    // no place before it is empty
  Buffer ao;                       // capacity * file vertices
  Buffer shadows;                  // tier 43: capacity * ModelBuffers::shadows, two floats each
  Buffer directional_ao;           // capacity * file vertices * 3; none before the first light
  Buffer colours;                  // tier 43, the same: eight floats for each of `shadows`
  std::uint32_t first_sphere = 0;  // tier 43: of place 0, in SceneBuffers::spheres

  // Tier 43, of the update in progress; offsets in bytes into SceneBuffers::stream.
  struct Frame {
    // Instances that are evaluated come first, level by level; of the others only the spheres are needed.
    std::array<std::uint32_t, CharacterModel::max_levels + 1> due_at_level{};
    std::uint32_t due = 0;
    std::uint32_t lit = 0;       // of these, those with a light
    std::uint32_t selected = 0;  // all of them
    std::uint64_t records = 0, bones = 0, casters = 0;
    std::uint64_t caster_bytes = 0;
  } frame;
};

// Where an instance of the scene lives; indexed by the scene's slot.
struct Placement {
  nook_instance_id id = 0;
  Chunk* chunk = nullptr;
  std::uint32_t place = 0;
  static constexpr std::uint32_t no_light = UINT32_MAX;
  bool evaluated = false;                      // the AO in the chunk is of some update
  bool lit = false;                            // the last update saw a light
  std::uint32_t first_light_texel = no_light;  // in SceneBuffers::lights, of the last update
  std::uint64_t evaluated_frame = 0;           // tier 43
  std::uint64_t transformed_revision = 0;      // tier 43: pose whose spheres the GPU has
};

struct SceneBuffers {
  SceneBuffers(Device& device, std::pmr::memory_resource* memory);

  std::pmr::list<Chunk> chunks;
  std::pmr::vector<Placement> placements;
  std::uint64_t structure_revision = 0;  // of the scene that the placements show; 0: none
  bool prepared = false;

  // Of instances with a light; none before the first.
  Buffer lights;
  Object light_texture;

  // Tier 43.
  Buffer stream;          // poses and casters of one update
  Buffer spheres;         // of every place of every chunk
  Buffer caster_weights;  // the same

  // Tier 33.
  Buffer page;  // shadows at key points, as many whole instances as fit in a texture buffer
  Object page_texture;
  Buffer colour_page;  // the same by channel; none before the first light
  Object colour_page_texture;
};

// Gives every instance a place and makes all buffers. Instances that had one keep it. Throws Failure; what
// was made until then stays, and the next call goes on.
void prepare(Device& device, ModelList& models, SceneBuffers& buffers, const Scene& scene);

// Models that no chunk uses any more.
void drop_unused(ModelList& models);

}  // namespace nook::gl
