#include "bakers/raytrace/suns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nook::bake {
namespace {

double mean_luminance(const Environment& environment, double limit) {
  double sum = 0;
  for (std::uint32_t row = 0; row < environment.height(); ++row) {
    double of_row = 0;
    for (std::uint32_t column = 0; column < environment.width(); ++column)
      of_row += std::min(
          double(luminance(environment.texel(std::size_t(row) * environment.width() + column))), limit);
    sum += of_row * environment.solid_angle(row);
  }
  return sum / (4 * std::numbers::pi);
}

// Light of a group of texels.
struct Gathered {
  Vec3 irradiance, direction;
  double solid_angle = 0;
};

// Takes the texel and all that touch it out of `sun`.
Gathered gather(const Environment& environment, float limit, std::size_t first, std::vector<bool>& sun) {
  const std::size_t width = environment.width(), height = environment.height();
  Gathered gathered;
  std::vector<std::size_t> open{first};
  sun[first] = false;
  while (!open.empty()) {
    const std::size_t at = open.back(), row = at / width, column = at % width;
    open.pop_back();
    const Vec3 light = environment.texel(at) - without_sun(environment.texel(at), limit);
    const double solid_angle = environment.solid_angle(std::uint32_t(row));
    gathered.irradiance += light * float(solid_angle);
    gathered.direction += environment.direction(std::uint32_t(column), std::uint32_t(row), 0.5f, 0.5f) *
                          float(double(luminance(light)) * solid_angle);
    gathered.solid_angle += solid_angle;
    for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, height - 1); ++r)
      for (const std::size_t c : {(column + width - 1) % width, column, (column + 1) % width}) {
        if (!sun[r * width + c]) continue;
        sun[r * width + c] = false;
        open.push_back(r * width + c);
      }
  }
  return gathered;
}

}  // namespace

float sun_limit(const Environment& environment) {
  // Each round takes away light that was above the limit; it ends with the suns outside the mean, or with no
  // light at all where all of it is sun.
  double limit = sun_ratio * mean_luminance(environment, INFINITY);
  for (int round = 0; round < 32; ++round) {
    const double next = sun_ratio * mean_luminance(environment, limit);
    if (next > 0.999 * limit) return float(next);
    limit = next;
  }
  return float(limit);
}

Environment without_suns(const Environment& environment) {
  const float limit = sun_limit(environment);
  std::vector<float> rgb;
  rgb.reserve(environment.rgb().size());
  for (std::size_t i = 0; i < environment.texel_count(); ++i) {
    const Vec3 sky = without_sun(environment.texel(i), limit);
    rgb.insert(rgb.end(), {sky.x, sky.y, sky.z});
  }
  return Environment(environment.width(), environment.height(), std::move(rgb));
}

std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count) {
  const float limit = sun_limit(environment);
  std::vector<bool> sun(environment.texel_count());
  for (std::size_t i = 0; i < sun.size(); ++i) sun[i] = luminance(environment.texel(i)) > limit;
  std::vector<Sun> suns;
  for (std::size_t i = 0; i < sun.size(); ++i) {
    if (!sun[i]) continue;
    const Gathered group = gather(environment, limit, i, sun);
    suns.push_back({normalised(group.direction), group.irradiance, group.solid_angle});
  }
  std::stable_sort(suns.begin(), suns.end(), [](const Sun& a, const Sun& b) {
    return luminance(a.irradiance) > luminance(b.irradiance);
  });
  suns.resize(std::min(suns.size(), max_count));
  return suns;
}

}  // namespace nook::bake
