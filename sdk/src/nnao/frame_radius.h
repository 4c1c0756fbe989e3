// The radius of a frame as the host gives it, and as the stages use it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace nook::nnao {

// The values are those of nook_nnao_radius_kind.
enum class RadiusKind { metres = 0, screen = 1, scene = 2 };

struct GivenRadius {
  RadiusKind kind = RadiusKind::metres;
  float radius = 0;         // metres, or a share
  float scene_size = 0;     // metres
  float max_radius_px = 0;  // 0: the default
};

struct FrameRadius {
  // Metres. A radius in pixels is that of geometry at every distance: the limit in pixels alone counts.
  float metres = 0;
  float max_px = 0;  // at least 1
  bool in_pixels = false;
};

// No radius in metres is as large; its product with the pixels of a metre may be infinite.
inline constexpr float endless_radius = 1e30f;

inline FrameRadius frame_radius(const GivenRadius& given, float height_px) {
  const bool in_pixels = given.kind == RadiusKind::screen;
  const float limit = given.max_radius_px > 0 ? given.max_radius_px : (in_pixels ? 1.0f : 0.25f) * height_px;
  if (in_pixels) return {endless_radius, std::max(std::min(given.radius * height_px, limit), 1.0f), true};
  const float metres = given.kind == RadiusKind::scene ? given.radius * given.scene_size : given.radius;
  return {metres, std::max(limit, 1.0f), false};
}

}  // namespace nook::nnao
