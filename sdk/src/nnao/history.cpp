#include "sdk/src/nnao/history.h"

#include <algorithm>
#include <cmath>

namespace nook::nnao {
namespace {

float wrapped(float x) {
  return x - std::floor(x);
}

// Returns how much depth changes from one pixel to the next along both axes. On each axis, it uses the
// neighbour whose depth differs less.
float flat_steps(const View& view, int x, int y, float depth) {
  const auto step = [&](int aside, int up) {
    return std::min(std::abs(depth_near(view, x - aside, y - up) - depth),
                    std::abs(depth_near(view, x + aside, y + up) - depth));
  };
  return step(1, 0) + step(0, 1);
}

struct Range {
  float low = 0, high = 1;
};

// Returns the range to which the mean of earlier frames is clamped. It is the mean of all connected pixels,
// plus and minus twice their standard deviation, limited to a range around the pixel's own AO.
Range likely_range(const PresentAo& present, int x, int y) {
  const View& view = present.view;
  const std::size_t own = view.at(std::uint32_t(x), std::uint32_t(y));
  const std::uint8_t bits = present.edges[own];
  const std::array<float, 4> weights{float(bits >> 6) / 3, float(bits >> 4 & 3) / 3, float(bits >> 2 & 3) / 3,
                                     float(bits & 3) / 3};
  constexpr int aside[] = {-1, 1, 0, 0}, up[] = {0, 0, -1, 1};
  float sum = present.ao[own], squares = sum * sum, total = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto column = std::uint32_t(std::clamp(x + aside[i], 0, int(view.width) - 1)),
               row = std::uint32_t(std::clamp(y + up[i], 0, int(view.height) - 1));
    const float ao = present.ao[view.at(column, row)];
    sum += weights[i] * ao;
    squares += weights[i] * ao * ao;
    total += weights[i];
  }
  const float mean = sum / total, deviation = std::sqrt(std::max(squares / total - mean * mean, 0.0f));
  const float reach = std::max(2 * deviation, 0.06f);
  const float noise = noise_reach(present.taps), centre = present.ao[own];
  return {std::max(mean - reach, centre - noise), std::min(mean + reach, centre + noise)};
}

// A position in the previous frame's image, in pixels. Pixel centres have integer coordinates.
struct Place {
  float x = 0, y = 0;
};

Place earlier_place(const PresentAo& present, const History& history, std::uint32_t x, std::uint32_t y,
                    Vec3 earlier) {
  if (!present.motion.empty()) {
    const std::size_t at = 2 * present.view.at(x, y);
    return {float(x) - present.motion[at], float(y) - present.motion[at + 1]};
  }
  const float extent = history.rays.orthographic ? 1 : -earlier.z;
  return {(earlier.x / extent - history.rays.x_offset) / history.rays.x_scale - 0.5f,
          (earlier.y / extent - history.rays.y_offset) / history.rays.y_scale - 0.5f};
}

// Interpolates the history at a position. Of the four pixels around the position, uses only the pixels that
// show the same surface.
MeanAo earlier_mean(const History& history, Place place, float depth, float tolerance) {
  const float base_x = std::floor(place.x), base_y = std::floor(place.y);
  MeanAo mean{0, 0};
  float total = 0;
  for (const int up : {0, 1})
    for (const int aside : {0, 1}) {
      const float column = base_x + float(aside), row = base_y + float(up);
      if (!(column >= 0 && column < float(history.width) && row >= 0 && row < float(history.height)))
        continue;
      const std::size_t at = std::size_t(row) * history.width + std::size_t(column);
      const float stored = std::isfinite(history.depth[at]) ? history.depth[at] : sky_depth;
      if (!(std::abs(stored - depth) < tolerance) || history.frames[at] == 0) continue;
      const float share_x = place.x - base_x, share_y = place.y - base_y;
      const float weight = (aside ? share_x : 1 - share_x) * (up ? share_y : 1 - share_y);
      mean.ao += weight * history.ao[at];
      mean.frames += weight * history.frames[at];
      total += weight;
    }
  if (total <= 0.05f) return {0, 0};
  return {mean.ao / total, mean.frames / total};
}

}  // namespace

TapNoise noise_of_frame(TapNoise noise, std::uint32_t frame) {
  const TapNoise step = frame_noise_step(frame);
  return {wrapped(noise.rotation + step.rotation), wrapped(noise.offset + step.offset)};
}

MeanAo accumulated(const PresentAo& present, const History& history, std::uint32_t x, std::uint32_t y,
                   std::uint32_t max_frames) {
  const View& view = present.view;
  if (!view.has_surface(x, y)) return {1, 0};
  const float depth = view.depth[view.at(x, y)], ao = present.ao[view.at(x, y)];
  MeanAo mean{0, 0};
  if (max_frames > 1) {
    const Vec3 earlier = transform_point(history.earlier_from_view,
                                         view_position(view.rays, float(x) + 0.5f, float(y) + 0.5f, depth));
    const Place place = earlier_place(present, history, x, y, earlier);
    const float tolerance = flat_steps(view, int(x), int(y), depth) + 2 * present.tolerance + 0.002f * depth;
    const bool inside = place.x > -1 && place.x < float(history.width) && place.y > -1 &&
                        place.y < float(history.height);  // false for NaN
    if (inside) mean = earlier_mean(history, place, -earlier.z, tolerance);
  }
  const float frames = std::min(std::floor(mean.frames + 0.5f) + 1, float(max_frames));
  const Range range = likely_range(present, int(x), int(y));
  const float kept = std::clamp(mean.ao, range.low, range.high);
  return {std::clamp(kept + (ao - kept) / frames, 0.0f, 1.0f), frames};
}

}  // namespace nook::nnao
