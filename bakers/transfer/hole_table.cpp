#include "bakers/transfer/hole_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/material/parabolic.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/material/spatial_modes.h"

namespace nook::bake::transfer {
namespace {

using nook::material::level_size;
using nook::material::MaterialTables;

constexpr std::uint32_t view_side = 24;  // cells of about 5 degrees, finer than the views of materials

std::size_t level_offset(const HoleTable& table, std::uint32_t level) {
  std::size_t offset = 0;
  for (std::uint32_t l = 0; l < level; ++l)
    offset += std::size_t(level_size(table.width, l)) * level_size(table.height, l);
  return offset;
}

// Two neighbouring texels of a tile that repeats.
struct Between {
  std::uint32_t low, high;
  float t;
};
Between repeated(float at, std::uint32_t size) {
  const float place = (at - std::floor(at)) * float(size) - 0.5f, low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low + float(size)) % size;
  return {first, (first + 1) % size, place - low};
}

template <class Number>
float bilinear(const Number* image, std::uint32_t width, std::uint32_t height, float u, float v) {
  const Between x = repeated(u, width), y = repeated(v, height);
  const auto row = [&](std::uint32_t at) {
    const float low = float(image[std::size_t(at) * width + x.low]),
                high = float(image[std::size_t(at) * width + x.high]);
    return low + (high - low) * x.t;
  };
  const float low = row(y.low), high = row(y.high);
  return low + (high - low) * y.t;
}

// The mean visibility of each texel. Values are linear between texels and the mapping is not, so that a texel
// needs points of its own between its neighbours.
void fill_finest(const MaterialTables& tables, Vec3 view, std::vector<float>& values,
                 std::vector<float>& cover) {
  constexpr std::uint32_t points = 4;  // along a side
  const std::uint32_t width = tables.votf.width, height = tables.votf.height;
  const auto at = [](std::uint32_t i, std::uint32_t size) { return (float(i) + 0.5f) / float(size); };
  nook::material::Sample sample;
  sample.view = view;
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      sample.u = at(x, width);
      sample.v = at(y, height);
      values[std::size_t(y) * width + x] = nook::material::evaluate_votf(tables, sample);
    }
  std::fill(cover.begin(), cover.end(), 0.0f);
  for (std::uint32_t y = 0; y < points * height; ++y)
    for (std::uint32_t x = 0; x < points * width; ++x)
      cover[std::size_t(y / points) * width + x / points] +=
          nook::material::visibility_of(
              tables.visibility, tables.mapping,
              bilinear(values.data(), width, height, at(x, points * width), at(y, points * height))) /
          float(points * points);
}

}  // namespace

std::size_t HoleTable::cell_bytes() const {
  return level_offset(*this, levels);
}

float HoleTable::cover_at(float u, float v, float level, Vec3 view) const {
  const auto nearest = std::uint32_t(std::lround(std::clamp(level, 0.0f, float(levels - 1))));
  const std::size_t cell = nook::material::cell_of(view, side);
  return bilinear(&cover[cell * cell_bytes() + level_offset(*this, nearest)], level_size(width, nearest),
                  level_size(height, nearest), u, v) *
         (1 / 255.0f);
}

HoleTable make_hole_table(const MaterialTables& tables) {
  if (tables.visibility == nook::material::VisibilityForm::none)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the material has no VOTF, so that it has no holes; bake it with one, or leave it out");
  HoleTable table;
  table.votf_hash = tables.votf_hash;
  table.side = view_side;
  table.width = tables.votf.width;
  table.height = tables.votf.height;
  table.levels = tables.votf.levels;
  table.cover.resize(table.cell_bytes() * view_side * view_side);
  tbb::parallel_for(0u, view_side * view_side, [&](std::uint32_t cell) {
    const Vec3 view = nook::material::from_parabolic(
        nook::material::cell_centre(cell % view_side, cell / view_side, view_side));
    std::vector<float> image(std::size_t(table.width) * table.height), other(image.size());
    fill_finest(tables, view, other, image);
    std::uint8_t* out = &table.cover[cell * table.cell_bytes()];
    for (std::uint32_t level = 0; level < table.levels; ++level) {
      const std::uint32_t w = level_size(table.width, level), h = level_size(table.height, level);
      for (std::size_t i = 0; i < std::size_t(w) * h; ++i)
        *out++ = std::uint8_t(std::lround(255 * std::clamp(image[i], 0.0f, 1.0f)));
      if (level + 1 == table.levels) break;
      nook::material::halve(image, w, h, other);
      std::swap(image, other);
    }
  });
  return table;
}

}  // namespace nook::bake::transfer
