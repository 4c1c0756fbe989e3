// The common part of the tiers' copies of a character model: the model and its sizes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <list>
#include <vector>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/core/containers.h"
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
  std::uint32_t users = 0;  // chunks of instances
};

// A buffer that holds `data` for good. Throws Failure: UNSUPPORTED if this OpenGL binds no piece so large.
Buffer static_buffer(Device& device, const char* label, const void* data, std::uint64_t bytes);
template <class T>
Buffer static_buffer(Device& device, const char* label, const Vector<T>& data) {
  return static_buffer(device, label, data.data(), data.size() * sizeof(T));
}

// The tier's copy of a model, made at its first use. Throws Failure.
template <class Model>
Model& model_data(Device& device, List<Model>& models, const Ref<const LoadedModel>& loaded) {
  for (Model& known : models)
    if (known.model.get() == loaded.get()) return known;
  return models.emplace_back(device, loaded);
}

// Models that no chunk uses any more.
template <class Model>
void drop_unused(List<Model>& models) {
  models.remove_if([](const Model& model) { return model.users == 0; });
}

}  // namespace nook::gl
