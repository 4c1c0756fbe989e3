// A scene as the transform-feedback tier keeps it: AO of its instances, and pages that carry shadows at key
// points to the GPU.
#pragma once

#include "sdk/src/gl/character/feedback_model.h"
#include "sdk/src/gl/character/placed_scene.h"

namespace nook::gl {

struct FeedbackChunk : ChunkData {
  using Model = FeedbackModel;
  FeedbackChunk(Device& device, FeedbackModel& for_model, std::uint32_t instance_capacity)
      : ChunkData(device, for_model, instance_capacity), model(&for_model) {}

  FeedbackModel* model;
};

// A texture buffer that is filled several times in an update: as many whole instances as fit.
struct Page {
  Buffer buffer;
  Object texture;
};

struct FeedbackScene : PlacedScene<FeedbackChunk> {
  FeedbackScene(Device& device, const Scene& of) : PlacedScene(of, device.memory) {}

  // Makes all buffers for the places that were given. Throws Failure.
  void make_buffers(Device& device);
  // The AO in this place is due.
  bool waits(const FeedbackChunk& chunk, std::uint32_t place) const {
    const std::uint32_t slot = chunk.slots[place];
    return slot != FeedbackChunk::empty && !placements[slot].evaluated;
  }

  Page shadows;  // two floats for each key point
  Page colours;  // eight floats, by channel; empty before the first light

 private:
  void make_shadow_page(Device& device);
  void make_light_buffers(Device& device);
  void make_colour_page(Device& device);
};

}  // namespace nook::gl
