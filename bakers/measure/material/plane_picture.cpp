#include "bakers/measure/material/plane_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/material/reflectance.h"

namespace nook::measure {
namespace {

using bake::Colour;
using bake::Picture;
using nook::material::MaterialTables;
using nook::synthesis::Cell;
using nook::synthesis::Coordinates;

constexpr std::uint32_t gap_px = 8;
constexpr Colour ground{0.05f, 0.05f, 0.055f};

Vec3 tilted(float degrees, float azimuth_degrees) {
  constexpr float radians = std::numbers::pi_v<float> / 180;
  const float tilt = degrees * radians, azimuth = azimuth_degrees * radians;
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

// Returns the radiance at the centre of a texel under a light of irradiance pi. Where the material is open,
// the ground is visible.
Colour radiance_of(const MaterialTables& tables, Cell cell) {
  const nook::material::Sample sample{(float(cell.x) + 0.5f) / float(tables.btf.width),
                                      (float(cell.y) + 0.5f) / float(tables.btf.height), 0, tilted(20, 30),
                                      tilted(45, 150)};
  const nook::material::Radiance r = evaluate_btf(tables, sample);
  const float alpha = visibility_of(tables.visibility, tables.mapping, evaluate_votf(tables, sample));
  const Colour lit{r.red, r.green, r.blue};
  Colour out;
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = alpha * std::numbers::pi_v<float> * lit[i] + (1 - alpha) * ground[i];
  return out;
}

// Writes a panel of side x side texels, starting at the given column of the picture. v points up.
template <class ColourAt>
void draw_panel(Picture& picture, std::uint32_t side, std::uint32_t left, const ColourAt& colour) {
  tbb::parallel_for(std::uint32_t{0}, side, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const Colour c = colour(x, y);
      std::uint8_t* const out =
          &picture.rgb[3 * (std::size_t(side - 1 - y) * std::size_t(picture.width) + left + x)];
      for (std::size_t i = 0; i < 3; ++i)
        out[i] = std::uint8_t(std::lround(255 * std::pow(std::clamp(c[i], 0.0f, 1.0f), 1 / 2.2f)));
    }
  });
}

}  // namespace

Picture plane_sheet(const MaterialTables& tables, const Coordinates& coordinates, const TilePart& part) {
  const std::uint32_t side = coordinates.side;
  Picture picture{int(3 * side + 2 * gap_px), int(side), {}};
  picture.rgb.assign(3 * std::size_t(picture.width) * side, 255);
  draw_panel(picture, side, 0, [&](std::uint32_t x, std::uint32_t y) {
    return radiance_of(tables,
                       {std::uint16_t(part.x + x % part.width), std::uint16_t(part.y + y % part.height)});
  });
  const auto cell = [&](std::uint32_t x, std::uint32_t y) {
    return coordinates.cells[std::size_t(y) * side + x];
  };
  draw_panel(picture, side, side + gap_px,
             [&](std::uint32_t x, std::uint32_t y) { return radiance_of(tables, cell(x, y)); });
  draw_panel(picture, side, 2 * (side + gap_px), [&](std::uint32_t x, std::uint32_t y) {
    return Colour{float(cell(x, y).x) / float(coordinates.width),
                  float(cell(x, y).y) / float(coordinates.height), 0.2f};
  });
  return picture;
}

}  // namespace nook::measure
