// A character model on the GPU: what does not change while it lives.
#pragma once

#include <algorithm>
#include <array>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

// Where one level of detail lies in the arrays of its model; level 0 is full detail.
struct LevelRange {
  std::uint32_t first_sphere = 0, spheres = 0;
  std::uint32_t first_key_point = 0, key_points = 0;  // those that are evaluated
};

struct ModelBuffers {
  // Throws Failure: UNSUPPORTED if the model is beyond this OpenGL.
  ModelBuffers(Device& device, Ref<const LoadedModel> loaded);

  std::uint32_t file_vertices() const {
    return static_cast<std::uint32_t>(model->model.file_to_welded.size());
  }
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(model->model.vertex_count()); }
  std::uint32_t key_points() const { return static_cast<std::uint32_t>(model->model.key_points.size()); }
  // Of all levels together.
  std::uint32_t spheres() const {
    return levels[level_count() - 1].first_sphere + levels[level_count() - 1].spheres;
  }
  std::uint32_t level_count() const { return static_cast<std::uint32_t>(model->model.levels.size()) + 1; }
  // The level, or the coarsest there is if that is finer.
  const LevelRange& level(std::uint32_t wanted) const { return levels[std::min(wanted, level_count() - 1)]; }
  // Places for shadows that an instance has: one for each key point, and behind them one for each key point
  // that a coarser level evaluates.
  std::uint32_t shadows() const;
  std::uint32_t bones() const { return static_cast<std::uint32_t>(model->model.bone_count()); }
  std::uint32_t influence_pairs() const { return (model->model.influences + 1) / 2; }
  std::uint32_t influence_quads() const { return (model->model.influences + 3) / 4; }

  Ref<const LoadedModel> model;
  std::array<LevelRange, CharacterModel::max_levels + 1> levels;
  std::uint32_t users = 0;  // chunks of instances

  // Tier 43: shader storage, laid out as the shaders say.
  Buffer spheres_rest;
  Buffer key_points_rest;
  Buffer linear;
  Buffer spread;  // from the evaluated key points of coarser levels to all; none without such levels

  // Tier 33: attributes of welded vertices, and the map from file order as an index buffer.
  Buffer attributes;
  Buffer indices;
  Object vertex_array;
};

}  // namespace nook::gl
