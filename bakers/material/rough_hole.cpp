// RoughHole is a plate of rough stone with holes through the whole plate. The holes have uneven outlines and
// rounded rims.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>

#include "bakers/material/meso_surface.h"
#include "bakers/material/periodic_tile.h"
#include "bakers/raytrace/random.h"

namespace nook::bake::material {
namespace {

// Extracts the zero surface of a periodic function by marching tetrahedra.

struct IsoGrid {
  std::uint32_t cells = 64;   // along a tile's side
  std::uint32_t layers = 16;  // cells between bottom and top
  float bottom = -0.1f, top = 0.1f;
};

// Splits a cube into six tetrahedra around its main diagonal. The corner (x, y, z) has the index x + 2 y + 4
// z. The triangles on the faces of neighbouring cubes match.
constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                  {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Marching {
 public:
  Marching(const std::function<float(Vec3)>& field, const IsoGrid& grid) : grid_(grid) {
    const std::size_t side = grid.cells;
    value_.resize(side * side * (grid.layers + 1));
    tbb::parallel_for(std::uint32_t{0}, grid.layers + 1, [&](std::uint32_t z) {
      for (std::uint32_t y = 0; y < grid.cells; ++y)
        for (std::uint32_t x = 0; x < grid.cells; ++x)
          value_[(z * side + y) * side + x] = field(point(x, y, z));
    });
  }

  void run(MesoSurface& surface) {
    for (std::uint32_t z = 0; z < grid_.layers; ++z)
      for (std::uint32_t y = 0; y < grid_.cells; ++y)
        for (std::uint32_t x = 0; x < grid_.cells; ++x)
          for (const auto& corners : tetrahedra) march(x, y, z, corners, surface);
  }

 private:
  struct Corner {
    std::uint64_t id;
    Vec3 position;
    float value;
  };

  Vec3 point(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return {float(x) / float(grid_.cells), float(y) / float(grid_.cells),
            grid_.bottom + (grid_.top - grid_.bottom) * float(z) / float(grid_.layers)};
  }

  Corner corner(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const std::uint32_t n = grid_.cells;
    // Corners after the last cell have the values of the first corners, but positions in the next tile.
    return {(std::uint64_t(z) * (n + 1) + y) * (n + 1) + x, point(x, y, z),
            value_[(std::size_t(z) * n + y % n) * n + x % n]};
  }

  std::uint32_t edge_vertex(const Corner& a, const Corner& b, MesoSurface& surface) {
    const std::uint64_t key = std::min(a.id, b.id) << 32 | std::max(a.id, b.id);
    const auto [entry, fresh] = vertex_.try_emplace(key, std::uint32_t(surface.position.size()));
    if (fresh) {
      const Corner &low = a.id < b.id ? a : b, &high = a.id < b.id ? b : a;
      const float t = low.value / (low.value - high.value);
      surface.position.push_back(low.position + (high.position - low.position) * t);
    }
    return entry->second;
  }

  void march(std::uint32_t x, std::uint32_t y, std::uint32_t z, const int (&corners)[4],
             MesoSurface& surface) {
    Corner inside[4], outside[4];
    int in = 0, out = 0;
    for (const int c : corners) {
      const Corner k =
          corner(x + std::uint32_t(c & 1), y + std::uint32_t(c >> 1 & 1), z + std::uint32_t(c >> 2));
      (k.value > 0 ? inside[in++] : outside[out++]) = k;
    }
    if (in == 0 || out == 0) return;
    if (in == 2) {
      const std::uint32_t a = edge_vertex(inside[0], outside[0], surface),
                          b = edge_vertex(inside[0], outside[1], surface);
      const std::uint32_t c = edge_vertex(inside[1], outside[1], surface),
                          d = edge_vertex(inside[1], outside[0], surface);
      add({a, b, c}, inside[0].position, surface);
      add({a, c, d}, inside[0].position, surface);
      return;
    }
    const Corner* apex = in == 1 ? &inside[0] : &outside[0];
    const Corner* base = in == 1 ? outside : inside;
    const std::uint32_t a = edge_vertex(*apex, base[0], surface), b = edge_vertex(*apex, base[1], surface);
    add({a, b, edge_vertex(*apex, base[2], surface)}, inside[0].position, surface);
  }

  // Adds the triangle, oriented so that the inner point is behind it.
  void add(std::array<std::uint32_t, 3> t, Vec3 inner, MesoSurface& surface) const {
    const Vec3 a = surface.position[t[0]];
    const Vec3 normal = cross(surface.position[t[1]] - a, surface.position[t[2]] - a);
    if (dot(normal, inner - a) > 0) std::swap(t[1], t[2]);
    surface.triangle.push_back(t);
  }

  IsoGrid grid_;
  std::vector<float> value_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_;
};

// `field` must be positive inside the solid and negative at the bottom and the top. It must have the period 1
// along x and y. The normals come from its gradient. `albedo` is evaluated at each vertex. In the result,
// each vertex on a side of the tile has a counterpart on the opposite side.
MesoSurface extract_isosurface(const std::function<float(Vec3)>& field,
                               const std::function<Vec3(Vec3)>& albedo, const IsoGrid& grid) {
  MesoSurface surface;
  Marching(field, grid).run(surface);
  surface.normal.resize(surface.position.size());
  surface.albedo.resize(surface.position.size());
  const float step = 0.25f / float(grid.cells);
  tbb::parallel_for(std::size_t{0}, surface.position.size(), [&](std::size_t i) {
    const Vec3 p = surface.position[i];
    const auto slope = [&](Vec3 d) { return field(p - d) - field(p + d); };
    surface.normal[i] = normalised({slope({step, 0, 0}), slope({0, step, 0}), slope({0, 0, step})});
    surface.albedo[i] = albedo(p);
  });
  return surface;
}

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
  // Positive inside the stone. Inside, the field is the depth below the plate's surface or the distance to
  // the hole's wall, whichever is smaller. At the rim of a hole, a quarter circle joins both.
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
  // Noise of three octaves reaches 1.75 times its amplitude, so the grid must be higher than the plate. One
  // more cell keeps the field negative at the bottom and the top.
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
