// Scenes for tests: poses, instances and their AO in a line each.
#pragma once

#include <memory>
#include <vector>

#include "sdk/src/character/scene.h"
#include "tests/character/model_sample.h"

namespace nook::test {

inline Ref<const LoadedModel> load(CharacterModel model) {
  Memory* memory = default_memory();
  return Owned<LoadedModel>::make(memory, Ref<const RefCounted>(), std::move(model), memory);
}

inline Scene make_scene(const SceneSettings& settings = {}, const Parallel& parallel = {}) {
  return Scene(settings, parallel, default_memory());
}

// Every bone alike: turned about the y axis by `turn` radians, scaled, then moved.
inline std::vector<Mat3x4> stiff_pose(const CharacterModel& model, Vec3 move, float turn = 0,
                                      float scale = 1) {
  const float c = scale * std::cos(turn), s = scale * std::sin(turn);
  return std::vector<Mat3x4>(model.bone_count(),
                             Mat3x4{{c, 0, s, move.x, 0, scale, 0, move.y, -s, 0, c, move.z}});
}

inline std::vector<float> ao_of(const Scene& scene, nook_instance_id id) {
  const Instance& instance = instance_of(scene, id);
  std::vector<float> ao(instance.model->model.file_to_welded.size(), -1.0f);
  read_ao(scene, instance, ao.data(), sizeof(float));
  return ao;
}

inline nook_instance_id place(Scene& scene, const Ref<const LoadedModel>& model, Vec3 at, float turn = 0,
                              float scale = 1) {
  const nook_instance_id id = add_instance(scene, model);
  set_pose(scene, id, stiff_pose(model->model, at, turn, scale));
  return id;
}

inline float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = a.size() == b.size() ? 0.0f : INFINITY;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace nook::test
