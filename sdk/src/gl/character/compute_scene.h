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
  Buffer colours;                  // eight floats for each of `shadows`; none before the first light
  std::uint32_t first_sphere = 0;  // of place 0, in ComputeScene::spheres

  // The pose whose spheres the GPU has, by place.
  struct Pose {
    nook_instance_id instance = 0;
    std::uint64_t revision = 0;
    bool operator==(const Pose&) const = default;
  };
  Vector<Pose> transformed;

  // Of the update in progress; offsets in bytes into ComputeScene::stream.
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

struct ComputeScene : PlacedScene<ComputeChunk> {
  ComputeScene(Device& device, const Scene& of);

  // Makes all buffers for the places that were given. Throws Failure.
  void make_buffers(Device& device);

  Buffer stream;          // poses and casters of one update
  Buffer spheres;         // of every place of every chunk
  Buffer caster_weights;  // the same

 private:
  void make_sphere_buffers(Device& device);
  void make_light_buffers(Device& device);
};

// Returns the present pose of an instance.
inline ComputeChunk::Pose pose_of(const Instance& instance) {
  return {instance.id, instance.input.pose_revision};
}

}  // namespace nook::gl
