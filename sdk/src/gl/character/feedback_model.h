// A character model as the transform-feedback tier keeps it: what does not change while it lives.
#pragma once

#include "sdk/src/gl/character/model_data.h"
#include "sdk/src/gl/character/tier.h"

namespace nook::gl {

struct FeedbackModel : ModelData {
  // Throws Failure: UNSUPPORTED if the model is beyond this OpenGL.
  FeedbackModel(Device& device, Ref<const LoadedModel> loaded);

  std::uint32_t influence_quads() const { return (model->model.influences + 3) / 4; }
  // Bytes of one instance, with a light, in any buffer that is bound as one piece: the largest.
  std::uint64_t largest_share() const { return std::uint64_t{file_vertices()} * 3 * sizeof(float); }

  // Attributes of welded vertices, and the map from file order as an index buffer.
  Buffer attributes;
  Buffer indices;
  Object vertex_array;
};

// The sizes of the buffers of a model and of its instances; indexed: draws have indices.
ModelMemory feedback_memory(const LoadedModel& model, bool indexed);

}  // namespace nook::gl
