#include "sdk/src/material/footprint.h"

#include <algorithm>
#include <cmath>

namespace nook::material {
namespace {

// The footprint of a pixel as an ellipse, in texels. It has the squared lengths of both axes and the
// direction of the longer axis, which is not normalised.
struct Ellipse {
  float longer2, shorter2, x, y;
};

// Computes the eigenvalues and the first eigenvector of J J^T. The columns of J are the pixel's derivatives.
Ellipse ellipse_of(float dx_x, float dx_y, float dy_x, float dy_y) {
  const float xx = dx_x * dx_x + dy_x * dy_x, yy = dx_y * dx_y + dy_y * dy_y, xy = dx_x * dx_y + dy_x * dy_y;
  const float mean = 0.5f * (xx + yy), half = 0.5f * (xx - yy), from_mean = std::sqrt(half * half + xy * xy);
  const bool is_along_x = half >= 0;
  return {mean + from_mean, mean - from_mean, is_along_x ? from_mean + half : xy,
          is_along_x ? xy : from_mean - half};
}

}  // namespace

Fetches fetches_along(const PixelSides& pixel, std::uint32_t width, std::uint32_t height,
                      std::uint32_t count) {
  constexpr float widest2 = 1e18f, least2 = 1e-30f, least_direction = 1e-12f, coarsest_level = 30;
  const float w = float(width), h = float(height);
  const Ellipse e = ellipse_of(pixel.dx.u * w, pixel.dx.v * h, pixel.dy.u * w, pixel.dy.v * h);
  Fetches out;
  out.count = std::clamp(count, 1u, max_fetches);
  out.place.fill({pixel.middle.u, pixel.middle.v, coarsest_level});
  if (!(e.longer2 < widest2)) return out;
  const float fetches = float(out.count), side2 = std::max(e.shorter2, e.longer2 / (fetches * fetches)),
              level = 0.5f * std::log2(std::max(side2, least2));
  const float reach = 0.5f * (std::sqrt(e.longer2) - std::sqrt(side2)),
              direction = std::sqrt(e.x * e.x + e.y * e.y),
              scale = direction > least_direction ? reach / direction : 0.0f;
  const float u = e.x * scale / w, v = e.y * scale / h;
  for (std::uint32_t i = 0; i < out.count; ++i) {
    const float at = out.count > 1 ? 2 * float(i) / (fetches - 1) - 1 : 0.0f;
    out.place[i] = {pixel.middle.u + at * u, pixel.middle.v + at * v, level};
  }
  return out;
}

}  // namespace nook::material
