#include "bakers/measure/material/raw_reflectance.h"

#include <algorithm>
#include <cmath>

#include "bakers/material/raw_material.h"
#include "bakers/material/view_spline.h"
#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/tables.h"

namespace nook::measure {
namespace {

constexpr std::uint32_t view_side = nook::material::default_map_side;

// Two neighbouring texels of a repeating tile, and a position between them.
struct Between {
  std::uint32_t low, high;
  float t;
};
Between repeated(float at, std::uint32_t size) {
  const float place = (at - std::floor(at)) * float(size) - 0.5f, low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low + float(size)) % size;
  return {first, (first + 1) % size, place - low};
}

}  // namespace

RawReflectance::RawReflectance(bake::material::RawMaterial raw)
    : lights_(raw.lights),
      views_(raw.views.size()),
      numbers_(raw.light_rows()),
      view_weights_(bake::material::spline_weights(raw.views, view_side)),
      light_mesh_(lights_) {
  Level first{raw.width, raw.height, std::vector<float>(raw.texels() * views_ * numbers_)};
  for (std::size_t row = 0; row < numbers_; ++row)
    for (std::size_t v = 0; v < views_; ++v)
      for (std::size_t t = 0; t < raw.texels(); ++t)
        first.texels[(t * views_ + v) * numbers_ + row] = raw.btf[(row * views_ + v) * raw.texels() + t];
  raw.btf = {};
  levels_.push_back(std::move(first));
  // We stop at a level whose width or height is odd. If both are powers of two, the shorter side of the last
  // level is one texel long.
  while (levels_.back().width % 2 == 0 && levels_.back().height % 2 == 0) {
    const Level& fine = levels_.back();
    Level coarse{fine.width / 2, fine.height / 2, {}};
    const std::size_t size = views_ * numbers_;
    coarse.texels.resize(std::size_t(coarse.width) * coarse.height * size);
    for (std::uint32_t y = 0; y < coarse.height; ++y)
      for (std::uint32_t x = 0; x < coarse.width; ++x) {
        float* const out = &coarse.texels[(std::size_t(y) * coarse.width + x) * size];
        for (const std::uint32_t corner : {0u, 1u, fine.width, fine.width + 1}) {
          const float* const in = &fine.texels[(std::size_t(2 * y) * fine.width + 2 * x + corner) * size];
          for (std::size_t i = 0; i < size; ++i) out[i] += 0.25f * in[i];
        }
      }
    levels_.push_back(std::move(coarse));
  }
}

void RawReflectance::add(const Level& level, const nook::material::Sample& sample, float share,
                         std::span<float> numbers) const {
  const Between x = repeated(sample.u, level.width), y = repeated(sample.v, level.height);
  const auto cell = Eigen::Index(nook::material::cell_of(sample.view, view_side));
  const auto add_texel = [&](std::uint32_t column, std::uint32_t row, float weight) {
    if (weight == 0) return;
    const float* texel = &level.texels[(std::size_t(row) * level.width + column) * views_ * numbers_];
    for (std::size_t v = 0; v < views_; ++v, texel += numbers_) {
      const float of_view = weight * float(view_weights_(cell, Eigen::Index(v)));
      for (std::size_t i = 0; i < numbers_; ++i) numbers[i] += of_view * texel[i];
    }
  };
  add_texel(x.low, y.low, share * (1 - x.t) * (1 - y.t));
  add_texel(x.high, y.low, share * x.t * (1 - y.t));
  add_texel(x.low, y.high, share * (1 - x.t) * y.t);
  add_texel(x.high, y.high, share * x.t * y.t);
}

void RawReflectance::decode(const nook::material::Sample& sample, std::span<float> numbers) const {
  std::fill(numbers.begin(), numbers.end(), 0.0f);
  const float level = std::clamp(sample.level, 0.0f, float(levels_.size() - 1));
  const auto low = std::size_t(level);
  const float beyond = level - float(low);
  add(levels_[low], sample, 1 - beyond, numbers);
  if (beyond > 0) add(levels_[low + 1], sample, beyond, numbers);
}

Vec3 RawReflectance::radiance(std::span<const float> numbers, Vec3 light) const {
  if (!(light.z > 0)) return {};
  std::size_t hint = 0;
  const nook::material::DirectionMix mix = light_mesh_.locate(nook::material::to_parabolic(light), hint);
  Vec3 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const float* const rgb = &numbers[std::size_t(3) * mix.index[i]];
    sum += Vec3{rgb[0], rgb[1], rgb[2]} * mix.weight[i];
  }
  return sum * nook::material::low_light_share(lights_, mix, light.z);
}

RawReflectance read_raw_reflectance(std::span<const std::byte> bytes) {
  return RawReflectance(bake::material::read_raw_material(bytes));
}

}  // namespace nook::measure
