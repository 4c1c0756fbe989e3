// A character model as the compute tier keeps it: what does not change while it lives.
#pragma once

#include <algorithm>
#include <array>

#include "sdk/src/gl/character/model_data.h"
#include "sdk/src/gl/character/tier.h"

namespace nook::gl {

// Where one level of detail lies in the arrays of its model; level 0 is full detail.
struct LevelRange {
  std::uint32_t first_sphere = 0, spheres = 0;
  std::uint32_t first_key_point = 0, key_points = 0;  // those that are evaluated
};

struct ComputeModel : ModelData {
  // Throws Failure: UNSUPPORTED if the model is beyond this OpenGL.
  ComputeModel(Device& device, Ref<const LoadedModel> loaded);

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(model->model.levels.size()) + 1; }
  // Returns the level, or the coarsest one if the model has fewer levels.
  const LevelRange& level(std::uint32_t index) const { return levels[std::min(index, level_count() - 1)]; }
  // Returns the number of spheres of all levels.
  std::uint32_t spheres() const {
    return levels[level_count() - 1].first_sphere + levels[level_count() - 1].spheres;
  }
  // Places for shadows that an instance has: one for each key point, and behind them one for each key point
  // that a coarser level evaluates.
  std::uint32_t shadows() const;
  std::uint32_t influence_pairs() const { return (model->model.influences + 1) / 2; }
  // Bytes of one instance, with a light, in any buffer that is bound as one piece: the largest.
  std::uint64_t largest_share() const;

  std::array<LevelRange, CharacterModel::max_levels + 1> levels;

  // Shader storage, laid out as the shaders say.
  Buffer spheres_rest;
  Buffer key_points_rest;
  Buffer linear;
  Buffer spread;  // from the evaluated key points of coarser levels to all; none without such levels
};

// The sizes of the buffers of a model and of its instances.
ModelMemory compute_memory(const LoadedModel& model);

}  // namespace nook::gl
