// Converts the radius of a frame from the host's settings to the values that the stages use.
#pragma once

#include <algorithm>
#include <cstdint>

namespace nook::nnao {

// The values match nook_nnao_radius_kind.
enum class RadiusKind { metres = 0, screen = 1, scene = 2 };

struct GivenRadius {
  RadiusKind kind = RadiusKind::metres;
  float radius = 0;         // metres, or a fraction, depending on the kind
  float scene_size = 0;     // metres
  float max_radius_px = 0;  // 0: the default
  float min_radius_px = 0;  // 0: none
};

struct FrameRadius {
  // The radius in metres. If the host sets the radius as a fraction of the screen, the radius covers the same
  // number of pixels at every distance. Then `metres` is endless_radius, and max_px holds the radius.
  float metres = 0;
  float max_px = 0;  // at least 1
  bool in_pixels = false;
  float min_px = 0;  // at most max_px; 0: none
};

// This value is larger than every radius in metres that a host can set. If it is converted to pixels, the
// result may be infinite.
inline constexpr float endless_radius = 1e30f;

inline FrameRadius frame_radius(const GivenRadius& given, float height_px) {
  const bool in_pixels = given.kind == RadiusKind::screen;
  const float limit = given.max_radius_px > 0 ? given.max_radius_px : (in_pixels ? 1.0f : 0.25f) * height_px;
  if (in_pixels) return {endless_radius, std::max(std::min(given.radius * height_px, limit), 1.0f), true};
  const float metres = given.kind == RadiusKind::scene ? given.radius * given.scene_size : given.radius;
  const float max_px = std::max(limit, 1.0f);
  return {metres, max_px, false, std::min(given.min_radius_px, max_px)};
}

// The darkness (1 - AO) is multiplied by a factor that depends on the depth: per_metre * depth + offset,
// clamped to [0, 1].
struct DistanceFade {
  float per_metre = 0, offset = 1;
  float share(float depth) const { return std::clamp(per_metre * depth + offset, 0.0f, 1.0f); }
};

// AO fades out between the depths `begin` and `end`. If end is 0, it does not fade.
inline DistanceFade distance_fade(float begin, float end) {
  if (!(end > begin)) return {};
  return {-1 / (end - begin), end / (end - begin)};
}

}  // namespace nook::nnao
