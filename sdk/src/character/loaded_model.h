// A model in the form that the runtime uses. It is immutable, can be shared, and contains values that are
// computed once from the model's data.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/character/linear_layer.h"
#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels_rest.h"
#include "sdk/src/character/sphere_groups.h"
#include "sdk/src/character/sphere_tree.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/ref.h"

namespace nook {

// Spheres and evaluated key points of one level of detail in the layout of the pose kernels.
struct LoadedLevel {
  LoadedLevel(const CharacterModel& subset, Memory* memory)
      : rest_spheres(subset, memory), rest_key_points(subset, memory) {}

  RestSpheres rest_spheres;
  RestKeyPoints rest_key_points;
};

struct LoadedModel : RefCounted {
  // The model must have passed check_model.
  LoadedModel(CharacterModel loaded, Memory* memory);

  const CharacterModel model;  // its key points are sorted by with_near_key_points_together
  const RestSpheres rest_spheres;
  const RestKeyPoints rest_key_points;
  const LinearLayer linear;
  const SphereGroups groups;         // groups of the spheres of full detail
  const SphereTree sphere_tree;      // tree of the spheres of full detail
  const Vector<LoadedLevel> levels;  // one for each of model.levels; full detail is not included

  // A run of consecutive file vertices that read their AO from one chunk of slots of the linear layer. Their
  // slots, relative to the first slot of the chunk, are slot_in_chunk[first_entry...first_entry + vertices].
  struct FileRun {
    std::uint32_t first_vertex = 0, vertices = 0, first_entry = 0;
  };
  // Chunk c consists of the runs file_run[run_begin[c]] up to but not including file_run[run_begin[c + 1]],
  // in ascending order. Chunks are the windows of linear_layer_order, whose vertices are consecutive in most
  // files.
  static constexpr std::uint32_t slot_chunk = linear_window_vertices;
  AlignedArray<std::uint32_t> run_begin;
  AlignedArray<FileRun> file_run;
  AlignedArray<std::uint16_t> slot_in_chunk;
  AlignedArray<float>
      open_without_bias;  // 1 for each slot; replaces LinearView::open_bias if self-shadow is off

  // For each bone, a sphere in rest space that contains all key points that the bone moves, and all proxy
  // spheres of the bone. The radius is < 0 if there are none. If you transform each sphere by its bone, the
  // spheres together bound the posed character. This holds because a blended key point lies between the
  // points to which each of its bones alone would move it.
  struct BoneBound {
    Vec3 centre;
    float radius = -1;
  };
  AlignedArray<BoneBound> bone_bounds;
  float max_alpha_sum = 0;    // the largest sum of alpha that any vertex has; an error of 1 in all shadows
                              // changes AO by at most this value
  float caster_strength = 0;  // square metres; the sum of caster_weight * radius^2 over the spheres, at the
                              // level with the largest sum
};

// Renumbers the key points of a model so that each group of key_point_group key points lies close together. A
// whole group can then use the same tree node for a far part of the body. The model's results stay the same.
// The model must have passed check_model.
CharacterModel with_near_key_points_together(CharacterModel model, Memory* memory);

}  // namespace nook
