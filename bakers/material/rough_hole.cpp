// RoughHole: a plate of rough stone with holes right through it, of uneven outlines and rounded rims.
#include <algorithm>
#include <cmath>

#include "bakers/material/isosurface.h"
#include "bakers/material/tile_noise.h"
#include "bakers/raytrace/random.h"

namespace nook::bake::material {
namespace {

struct Hole {
  float x, y, radius;
};

std::vector<Hole> place_holes(const MesoParameters& p) {
  std::vector<Hole> holes;
  Random random(p.seed);
  for (std::uint32_t row = 0; row < p.count; ++row)
    for (std::uint32_t column = 0; column < p.count; ++column) {
      const float jitter = 0.3f / float(p.count);
      holes.push_back({(float(column) + 0.5f) / float(p.count) + jitter * (random.unit() - 0.5f),
                       (float(row) + 0.5f) / float(p.count) + jitter * (random.unit() - 0.5f),
                       p.radius * (0.6f + 0.7f * random.unit())});
    }
  return holes;
}

}  // namespace

MesoSurface make_rough_hole(const MesoParameters& p) {
  const std::vector<Hole> holes = place_holes(p);
  const float half = 0.5f * p.thickness;
  const auto from_rim = [=](Vec3 q) {
    const float ragged = 0.25f * p.radius * tile_fractal_noise({q.x, q.y, 0.5f}, 6, 2, p.seed + 100);
    float nearest = 1;
    for (const Hole& h : holes) {
      const float dx = q.x - h.x - std::round(q.x - h.x), dy = q.y - h.y - std::round(q.y - h.y);
      nearest = std::min(nearest, std::hypot(dx, dy) - h.radius);
    }
    return nearest + ragged;
  };
  // Positive inside. In the hole's wall the distance to the rim takes over from the height, along a quarter
  // circle.
  const auto field = [=](Vec3 q) {
    const float depth = half - std::abs(q.z), wall = from_rim(q), round = 0.5f * half;
    const float corner = std::hypot(std::max(round - depth, 0.0f), std::max(round - wall, 0.0f));
    const float solid = std::max(round, std::min(depth, wall)) - corner;
    return solid + p.roughness * tile_fractal_noise(q, 8, 3, p.seed);
  };
  const auto albedo = [=](Vec3 q) {
    const float patch = 0.5f + 0.5f * tile_fractal_noise(q, 3, 3, p.seed + 50);
    const float grain = 1 + 0.2f * tile_noise(q, 32, p.seed + 70);
    return (Vec3{0.30f, 0.27f, 0.25f} + Vec3{0.34f, 0.24f, 0.14f} * std::clamp(patch, 0.0f, 1.0f)) * grain;
  };
  IsoGrid grid;
  // Noise of three octaves reaches 1.75 amplitudes; one cell more keeps the field negative at both ends.
  grid.top = half + 1.8f * p.roughness;
  grid.cells = std::uint32_t(std::lround(96 * p.detail));
  grid.layers = std::uint32_t(std::ceil(2 * grid.top * float(grid.cells))) + 2;
  grid.top += 1 / float(grid.cells);
  grid.bottom = -grid.top;
  MesoSurface surface = extract_isosurface(field, albedo, grid);
  surface.specular = 0.03f;
  surface.shininess = 16;
  return surface;
}

}  // namespace nook::bake::material
