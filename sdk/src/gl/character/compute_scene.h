// A scene as the compute tier keeps it: spheres, shadows and AO of its instances, and what the CPU sends for
// one update.
#pragma once

#include <array>

#include "sdk/src/gl/character/compute_model.h"
#include "sdk/src/gl/character/placed_scene.h"
#include "shaders/character/layout.h"

namespace nook::gl {

struct ComputeChunk : ChunkData {
  using Model = ComputeModel;
  ComputeChunk(Device& device, ComputeModel& for_model, std::uint32_t instance_capacity);

  ComputeModel* model;
  Buffer shadows;                  // capacity * ComputeModel::shadows, two floats each
  Buffer colours;                  // two vec4 for each of `shadows`; none before the first light
  std::uint32_t first_sphere = 0;  // of place 0, in ComputeScene::spheres

  // The pose whose spheres the GPU has, by place.
  struct Pose {
    nook_instance_id instance = 0;
    std::uint64_t revision = 0;
    bool operator==(const Pose&) const = default;
  };
  Vector<Pose> transformed;

  // The CPU's inputs of the current update.
  struct Frame {
    // Instances that are evaluated come first, level by level; of the others only the spheres are needed.
    std::array<std::uint32_t, CharacterModel::max_levels + 1> due_at_level{};
    std::uint32_t due = 0;
    std::uint32_t lit = 0;                // of these, those with a light
    std::uint32_t selected = 0;           // all of them
    std::uint64_t offset = 0, bytes = 0;  // of the chunk's piece of ComputeScene::stream
    // Elements of 16 bytes from the start of the piece, which begins with the records.
    std::uint32_t bones = 0, casters = 0, lights = 0;
  } frame;
};

struct ComputeScene : PlacedScene<ComputeChunk> {
  ComputeScene(Device& device, const Scene& of);

  // Makes all buffers for the places that were given. Throws Failure.
  void make_buffers(Device& device);

  Buffer stream;   // what one update sends, a piece for each chunk
  Buffer spheres;  // of every place of every chunk

 private:
  void make_sphere_buffers(Device& device);
  void make_light_buffers(Device& device);
};

// Returns the present pose of an instance.
inline ComputeChunk::Pose pose_of(const Instance& instance) {
  return {instance.id, instance.input.pose_revision};
}

}  // namespace nook::gl
