#include "sdk/src/gl/character/feedback_scene.h"

#include "shaders/character/layout.h"

namespace nook::gl {

void FeedbackScene::make_buffers(Device& device) {
  make_shadow_page(device);
  make_light_buffers(device);
}

void FeedbackScene::make_shadow_page(Device& device) {
  std::uint64_t texels = 0, largest = 0;
  for (const FeedbackChunk& chunk : chunks) {
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points();
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points());
  }
  // A million texels, 8 MB, are enough for the cost of a page not to matter. Key points have 16-bit numbers,
  // so that the 65,536 texels of every OpenGL hold at least one instance.
  constexpr std::uint64_t enough = 1 << 20;
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  shadows.reserve(device, GL_RG32F, texels, "nook: shadows");
}

void FeedbackScene::make_light_buffers(Device& device) {
  for (FeedbackChunk& chunk : chunks) {
    if (chunk.directional_ao.name() || !chunk.has_light(*scene)) continue;
    lights.make(device);
    chunk.make_directional_ao(device);
  }
  if (lights.made()) make_colour_page(device);
}

// Shadows and added occlusion by channel, as many instances as fit.
void FeedbackScene::make_colour_page(Device& device) {
  std::uint64_t texels = 0, largest = 0;
  for (const FeedbackChunk& chunk : chunks) {
    if (chunk.directional_ao.name() == 0) continue;
    texels += std::uint64_t{chunk.capacity} * chunk.model->key_points() * NOOK_COLOUR_VEC4S;
    largest = std::max<std::uint64_t>(largest, chunk.model->key_points() * NOOK_COLOUR_VEC4S);
  }
  if (largest > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "a model with a light has %llu key points, a texture buffer of this OpenGL holds %u; use a "
                  "model with fewer key points",
                  static_cast<unsigned long long>(largest / NOOK_COLOUR_VEC4S),
                  device.max_texels / NOOK_COLOUR_VEC4S);
  constexpr std::uint64_t enough = 1 << 19;
  texels = std::max(largest, std::min({texels, std::uint64_t{device.max_texels}, enough}));
  colours.reserve(device, GL_RGBA32F, texels, "nook: colours of shadows");
}

}  // namespace nook::gl
