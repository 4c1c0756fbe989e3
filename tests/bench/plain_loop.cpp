#include "tests/bench/plain_loop.h"

#include <cmath>

namespace nook::bench {
namespace {

template <int twice_gamma>
void loop(const SphereSoa& spheres, const KeyPointSoa& points, float* sum) {
  for (std::uint32_t k = 0; k < points.padded_count; ++k) {
    const float px = points.x[k], py = points.y[k], pz = points.z[k];
    const float nx = points.nx[k], ny = points.ny[k], nz = points.nz[k];
    float total = sum[k];
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const float dx = spheres.x[i] - px, dy = spheres.y[i] - py, dz = spheres.z[i] - pz;
      const float inverse = spheres.inverse_radius[i];
      const float xi = (dx * nx + dy * ny + dz * nz) * inverse;
      const float delta2 = (dx * dx + dy * dy + dz * dz) * inverse * inverse;
      const float s = 0.5f * (xi + std::sqrt(xi * xi + 1));
      const float t = 1 / std::sqrt(delta2 + nook_kernel_core);
      const float y = s * t * t * t;
      total += twice_gamma == 2 ? y : twice_gamma == 3 ? y * std::sqrt(y) : y * y;
    }
    sum[k] = total;
  }
}

}  // namespace

void plain_norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, float* sum) {
  if (gamma == 1)
    loop<2>(spheres, points, sum);
  else if (gamma == 1.5f)
    loop<3>(spheres, points, sum);
  else
    loop<4>(spheres, points, sum);
}

}  // namespace nook::bench
