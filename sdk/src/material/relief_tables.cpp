#include "sdk/src/material/relief_tables.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/floats.h"
#include "sdk/src/material/filtering.h"
#include "sdk/src/material/spatial_modes.h"

namespace nook::material {
namespace {

TexturePlace moved(TexturePlace at, TexturePlace along, float times) {
  return {at.u + times * along.u, at.v + times * along.v};
}

float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

// Returns the height at a place. 0 is the lowest plane, 1 the highest.
float share_on_level(const ReliefTables& relief, TexturePlace at, std::uint32_t level) {
  std::size_t first = 0;
  for (std::uint32_t l = 0; l < level; ++l)
    first += std::size_t(level_size(relief.width, l)) * level_size(relief.height, l);
  const std::uint32_t w = level_size(relief.width, level), h = level_size(relief.height, level);
  const Between x = repeated(at.u, w), y = repeated(at.v, h);
  const auto texel = [&](std::uint32_t column, std::uint32_t row) {
    return from_half(relief.heights[first + std::size_t(row) * w + column]);
  };
  return mix(mix(texel(x.low, y.low), texel(x.high, y.low), x.t),
             mix(texel(x.low, y.high), texel(x.high, y.high), x.t), y.t);
}

float share_at(const ReliefTables& relief, TexturePlace at, float level) {
  const float clamped = std::clamp(level, 0.0f, float(relief.levels - 1));
  const auto low = static_cast<std::uint32_t>(clamped);
  const float fine = share_on_level(relief, at, low);
  if (clamped == float(low)) return fine;
  return mix(fine, share_on_level(relief, at, low + 1), clamped - float(low));
}

}  // namespace

ReliefTables make_relief_tables(const Relief& relief, std::uint32_t width, std::uint32_t height,
                                Memory* memory) {
  ReliefTables tables(memory);
  if (!relief.moves()) return tables;
  tables.low = relief.low;
  tables.high = relief.high;
  tables.max_slope = relief.max_slope;
  tables.steps = relief.steps;
  if (relief.levels.empty()) return tables;
  tables.width = width;
  tables.height = height;
  tables.levels = level_count(width, height);
  Vector<float> image(memory), other(memory);
  image.assign(relief.levels.begin(), relief.levels.end());
  other.resize(image.size());
  for (std::uint32_t level = 0; level < tables.levels; ++level) {
    const std::uint32_t w = level_size(width, level), h = level_size(height, level);
    for (std::size_t i = 0; i < std::size_t(w) * h; ++i) tables.heights.push_back(to_half(image[i] / 255));
    if (level + 1 == tables.levels) break;
    halve(image, w, h, other);
    std::swap(image, other);
  }
  return tables;
}

TexturePlace relief_slope(const ReliefTables& relief, Vec3 view) {
  constexpr float least = 1e-6f;
  const float across = std::sqrt(view.x * view.x + view.y * view.y);
  const float scale = view.z * relief.max_slope > across ? 1 / std::max(view.z, least)
                                                         : relief.max_slope / std::max(across, least);
  return {view.x * scale, view.y * scale};
}

TexturePlace relief_place(const ReliefTables& relief, TexturePlace at, float level, Vec3 view) {
  if (!relief.moves()) return at;
  const TexturePlace slope = relief_slope(relief, view);
  const TexturePlace lowest = moved(at, slope, relief.low), rise = moved({}, slope, relief.high - relief.low);
  float above_share = 1;
  if (relief.steps == 0) return moved(lowest, rise, above_share);
  float above = 1 - share_at(relief, moved(lowest, rise, 1), level);
  for (std::uint32_t i = 1; i <= relief.steps && above > 0; ++i) {
    const float share = 1 - float(i) / float(relief.steps);
    const float over = share - share_at(relief, moved(lowest, rise, share), level);
    if (over <= 0) return moved(lowest, rise, above_share + (share - above_share) * above / (above - over));
    above_share = share;
    above = over;
  }
  return moved(lowest, rise, above_share);
}

}  // namespace nook::material
