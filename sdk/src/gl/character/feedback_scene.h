// A scene as the transform-feedback tier keeps it: AO of its instances, and pages that carry shadows at key
// points to the GPU.
#pragma once

#include "sdk/src/gl/character/feedback_model.h"
#include "sdk/src/gl/character/placed_scene.h"
#include "sdk/src/gl/texel_table.h"

namespace nook::gl {

struct FeedbackChunk : ChunkData {
  using Model = FeedbackModel;
  FeedbackChunk(Device& device, FeedbackModel& for_model, std::uint32_t instance_capacity)
      : ChunkData(device, for_model, instance_capacity), model(&for_model) {}

  FeedbackModel* model;
};

struct FeedbackScene : PlacedScene<FeedbackChunk> {
  FeedbackScene(Device& device, const Scene& of)
      : PlacedScene(of, device.memory), shadows(device.memory), colours(device.memory) {}

  // Makes all buffers for the places that were given. Throws Failure.
  void make_buffers(Device& device);
  // The AO in this place is due.
  bool waits(const FeedbackChunk& chunk, std::uint32_t place) const {
    const std::uint32_t slot = chunk.slots[place];
    return slot != FeedbackChunk::empty && !placements[slot].evaluated;
  }

  // Pages, which are filled several times in an update, each with as many whole instances as fit.
  TexelTable shadows;  // one texel for each key point
  TexelTable colours;  // two, by channel; none before the first light

 private:
  void make_shadow_page(Device& device);
  void make_light_buffers(Device& device);
  void make_colour_page(Device& device);
};

}  // namespace nook::gl
