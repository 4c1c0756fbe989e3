// How the transform-feedback tier stores characters on the GPU: models, which do not change, and scenes.
#pragma once

#include "sdk/src/gl/character/placed_scene.h"
#include "sdk/src/gl/character/tier.h"
#include "sdk/src/gl/texel_table.h"

namespace nook::gl {

struct FeedbackModel : ModelData {
  explicit FeedbackModel(Ref<const LoadedModel> loaded) : ModelData(std::move(loaded)) {}

  bool is_uploaded() const { return is_uploaded_; }
  // Throws Failure, with UNSUPPORTED if the model exceeds the limits of this OpenGL.
  void upload_piece(Device& device);

  std::uint32_t attribute_bytes() const;  // of a vertex
  std::uint32_t influence_quads() const { return (model->model.influences + 3) / 4; }
  // Returns how many bytes of one buffer an instance with a light needs at most. Only counts buffers of a
  // chunk that are bound as a whole.
  std::uint64_t largest_share() const { return std::uint64_t{file_vertices()} * 3 * sizeof(float); }

  // Attributes of welded vertices, and the map from file order as an index buffer.
  Buffer attributes;
  Buffer indices;
  Object vertex_array;

 private:
  void describe_vertices(Device& device);
  bool has_attributes_ = false, is_uploaded_ = false;
  TableUpload upload_;
};

// Returns the sizes of the buffers of a model and of its instances. Pass true for `indexed` if draws use
// indices.
ModelMemory feedback_memory(const LoadedModel& model, bool indexed);

// A scene in the transform-feedback tier: the AO of its instances, and pages that carry shadows at key points
// to the GPU.

struct FeedbackChunk : ChunkData {
  using Model = FeedbackModel;
  FeedbackChunk(Device& device, FeedbackModel& for_model, std::uint32_t instance_capacity)
      : ChunkData(device, for_model, instance_capacity), model(&for_model) {}

  FeedbackModel* model;
};

struct FeedbackScene : PlacedScene<FeedbackChunk> {
  FeedbackScene(Device& device, const Scene& of)
      : PlacedScene(of, device.memory), shadows(device.memory), colours(device.memory) {}

  // Creates the buffers for all places that place_all has assigned to instances. Throws Failure.
  void make_buffers(Device& device);
  // Returns whether an update can evaluate an instance in streaming mode.
  bool is_ready(std::uint32_t slot) const { return placements[slot].chunk; }
  // Creates buffers for chunks with a light that have none. Throws Failure.
  void make_light_buffers(Device& device);
  // Follows the edits of a scene in streaming mode. Throws Failure.
  void follow_edits(Device& device);
  // Uploads what pending instances need, as long as there is time. Throws Failure.
  void place_within(Device& device, List<FeedbackModel>& models, const Budget& budget);
  // Returns whether the AO in this place is due.
  bool waits(const FeedbackChunk& chunk, std::uint32_t place) const {
    const std::uint32_t slot = chunk.slots[place];
    return slot != FeedbackChunk::empty && !placements[slot].evaluated;
  }

  // Pages are filled several times in an update, each time with as many whole instances as fit.
  TexelTable shadows;  // one texel for each key point
  TexelTable colours;  // two texels for each key point, with the values of each channel; created for the
                       // first light

 private:
  void make_shadow_page(Device& device);
  void make_colour_page(Device& device);
};

}  // namespace nook::gl
