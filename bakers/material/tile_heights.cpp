#include "bakers/material/tile_heights.h"

#include <algorithm>
#include <cmath>

#include "bakers/material/periodic_tile.h"
#include "bakers/tensor/blocks.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

using Eigen::Index;
using tensor::Matrix;

// Sums over views, from which the variance of the values is computed.
struct Spread {
  double sum = 0, squares = 0;
  int count = 0;
};

constexpr int height_levels = 49;
constexpr float largest_height = 0.24f;  // tiles, on either side of the plane

float level_height(float level) {
  return largest_height * (2 * level / (height_levels - 1) - 1);
}

// Returns the variance, over views, of the colours that would be seen at a texel if it had this height.
float disagreement(const RawMaterial& raw, std::size_t texel, float height) {
  // Leaves out views beyond 53 degrees from the normal. They see too few points that other views see too.
  constexpr float lowest_view = 0.6f;
  const float x = (float(texel / raw.height) + 0.5f) / float(raw.width),
              y = (float(texel % raw.height) + 0.5f) / float(raw.height);
  const std::size_t stride = std::max<std::size_t>(raw.lights.size() / 8, 1);
  double total = 0;
  std::vector<Taps> taps;
  std::vector<std::size_t> seen;
  for (std::size_t v = 0; v < raw.views.size(); ++v) {
    const Vec3 view = raw.views[v];
    if (view.z < lowest_view) continue;
    seen.push_back(v);
    taps.push_back(
        taps_at(raw.width, raw.height, x - view.x / view.z * height, y - view.y / view.z * height));
  }
  for (std::size_t l = 0; l < raw.lights.size(); l += stride)
    for (std::size_t c = 0; c < 3; ++c) {
      Spread spread;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const double value =
            mean_of(taps[i], &raw.btf[((3 * l + c) * raw.views.size() + seen[i]) * raw.texels()]);
        spread.sum += value;
        spread.squares += value * value;
      }
      total += spread.squares - spread.sum * spread.sum / double(std::max<std::size_t>(seen.size(), 1));
    }
  return float(total);
}

}  // namespace

// Finds the best of the height levels for each texel. A parabola through this level and its neighbours then
// gives the minimum between levels.
std::vector<float> heights_of_views(const RawMaterial& raw, const ReliefProgress& progress) {
  constexpr std::size_t texels_at_once = 512;  // number of texels between two calls of progress
  const std::size_t texels = raw.texels();
  std::vector<float> heights(texels);
  Matrix cost(height_levels, Index(texels));
  for (std::size_t start = 0; start < texels; start += texels_at_once) {
    if (progress && !progress(start, texels)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
    tensor::for_each_block(std::min(texels_at_once, texels - start), 16, [&](std::size_t a, std::size_t b) {
      for (std::size_t t = start + a; t < start + b; ++t)
        for (int level = 0; level < height_levels; ++level)
          cost(level, Index(t)) = disagreement(raw, t, level_height(float(level)));
    });
  }
  for (std::size_t t = 0; t < texels; ++t) {
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(height_levels);
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t x = (t / raw.height + raw.width + i / 3 - 1) % raw.width,
                        y = (t % raw.height + raw.height + i % 3 - 1) % raw.height;
      sum += cost.col(Index(x * raw.height + y));
    }
    Index best = 0;
    sum.minCoeff(&best);
    float level = float(best);
    if (best > 0 && best + 1 < height_levels) {
      const float bend = sum[best - 1] - 2 * sum[best] + sum[best + 1];
      if (bend > 0) level += 0.5f * (sum[best - 1] - sum[best + 1]) / bend;
    }
    heights[t] = level_height(level);
  }
  return heights;
}

float height_at(const HeightMap& map, float x, float y) {
  return mean_of(taps_at(map.width, map.height, x, y), map.heights.data());
}

HeightRange range_of(const HeightMap& map) {
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  return {*low, *high};
}

// Returns the number of steps for a march over the whole range of heights. A step is at most half a texel
// along the map.
int steps_of(const HeightMap& map, Vec3 direction, float depth) {
  const float along = depth * std::hypot(direction.x, direction.y) / direction.z;
  return std::clamp(int(2 * along * float(std::max(map.width, map.height))) + 4, 4, 256);
}

float first_height(const HeightMap& map, HeightRange range, float x, float y, Vec3 view) {
  const float depth = range.high - range.low, slope_x = view.x / view.z, slope_y = view.y / view.z;
  const int steps = steps_of(map, view, depth);
  float above_z = range.high,
        above = range.high - height_at(map, x + slope_x * above_z, y + slope_y * above_z);
  for (int i = 1; i <= steps && above > 0; ++i) {
    const float z = range.high - depth * float(i) / float(steps);
    const float over = z - height_at(map, x + slope_x * z, y + slope_y * z);
    if (over <= 0) return above_z + (z - above_z) * above / (above - over);
    above_z = z;
    above = over;
  }
  return above_z;
}

}  // namespace nook::bake::material
