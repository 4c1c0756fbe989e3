#include "bakers/material/meso_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

struct Builtin {
  MesoParameters parameters;
  MesoSurface (*make)(const MesoParameters&);
};

const std::array<Builtin, 3>& builtins() {
  static const std::array<Builtin, 3> all{
      Builtin{{"fiber", 10, 0.04f, 0.16f, 0.06f, 1, 1}, make_fiber},
      Builtin{{"roughhole", 2, 0.18f, 0.12f, 0.03f, 1, 1}, make_rough_hole},
      Builtin{{"weave", 4, 0.1f, 0.09f, 0.12f, 1, 1}, make_weave}};
  return all;
}

const Builtin& builtin(std::string_view name) {
  std::string known;
  for (const Builtin& b : builtins()) {
    if (b.parameters.name == name) return b;
    known += (known.empty() ? "" : ", ") + b.parameters.name;
  }
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there is no meso-structure '%.60s'; use one of %s",
                std::string(name).c_str(), known.c_str());
}

}  // namespace

std::vector<std::string_view> meso_names() {
  std::vector<std::string_view> names;
  for (const Builtin& b : builtins()) names.push_back(b.parameters.name);
  return names;
}

MesoParameters meso_parameters(std::string_view name) {
  return builtin(name).parameters;
}

MesoSurface make_meso_surface(const MesoParameters& p) {
  const Builtin& b = builtin(p.name);
  const auto check = [&](bool fine, const char* what, double got, const char* range) {
    if (!fine)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s of %s is %g; it must be %s", what, p.name.c_str(), got,
                    range);
  };
  check(p.count >= 1 && p.count <= 1000, "the count", p.count, "1 to 1000");
  check(p.radius > 0 && p.radius <= 0.5f, "the radius", double(p.radius), "above 0 and at most 0.5 tiles");
  check(p.thickness > 0 && p.thickness <= 1, "the thickness", double(p.thickness),
        "above 0 and at most 1 tile");
  check(p.roughness >= 0 && p.roughness <= 0.5f, "the roughness", double(p.roughness), "0 to 0.5");
  check(p.detail >= 0.1f && p.detail <= 4, "the detail", double(p.detail), "0.1 to 4");
  return b.make(p);
}

namespace {

constexpr float most_height = 0.5f, most_width = 2;  // tiles

struct Range {
  float low = INFINITY, high = -INFINITY;
  void add(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  float length() const { return high - low; }
  float middle() const { return low + (high - low) / 2; }
};

struct Bounds {
  Range x, y, z;
};

Bounds bounds_of(const std::vector<Vec3>& positions) {
  Bounds bounds;
  for (const Vec3 p : positions) {
    bounds.x.add(p.x);
    bounds.y.add(p.y);
    bounds.z.add(p.z);
  }
  return bounds;
}

void check_bounds(const Bounds& b) {
  // The condition is negated, so that a NaN is rejected too.
  if (!(b.z.length() > 0 && b.z.length() <= most_height))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the mesh is %g tiles high, need above 0 and at most %g; change the side of the tile",
                  double(b.z.length()), double(most_height));
  if (!(b.x.length() <= most_width && b.y.length() <= most_width))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the mesh is %g x %g tiles wide, need at most %g; change the side of the tile",
                  double(b.x.length()), double(b.y.length()), double(most_width));
}

// A vertex can have only one colour, but triangles of different surfaces can share vertices. Each vertex gets
// the colour of its last triangle.
std::vector<Vec3> colours_of(const StaticScene& scene) {
  std::vector<Vec3> colours(scene.position.size());
  for (std::size_t t = 0; t < scene.triangle.size(); ++t)
    for (const std::uint32_t vertex : scene.triangle[t])
      colours[vertex] = scene.surface[scene.triangle_surface[t]].base_colour;
  return colours;
}

// A position on the torus, in steps of 1e-5 tiles.
using Place = std::array<long, 3>;
Place place_of(Vec3 p) {
  constexpr double steps = 1e5;
  const auto on_circle = [](float x) {
    const long at = std::lround((double(x) - std::floor(double(x))) * steps);
    return at == long(steps) ? 0 : at;
  };
  return {on_circle(p.x), on_circle(p.y), std::lround(double(p.z) * steps)};
}

// Adds to each vertex normal the normals of the vertices at the same place in other tiles. Otherwise, a
// surface that continues in the next tile would show an edge. Leaves out normals that differ by more than 60
// degrees, because they belong to other faces.
void join_across_border(MesoSurface& surface) {
  std::map<Place, std::vector<std::size_t>> vertices_at;
  for (std::size_t v = 0; v < surface.position.size(); ++v)
    vertices_at[place_of(surface.position[v])].push_back(v);
  const std::vector<Vec3> own = surface.normal;
  for (const auto& [place, vertices] : vertices_at)
    for (const std::size_t v : vertices) {
      Vec3 sum = own[v];
      for (const std::size_t other : vertices)
        if (length(surface.position[other] - surface.position[v]) > 0.5f && dot(own[v], own[other]) > 0.5f)
          sum += own[other];
      surface.normal[v] = normalised(sum);
    }
}

}  // namespace

MesoSurface tile_of_scene(const StaticScene& scene, float side_m) {
  if (!(side_m > 0 && std::isfinite(side_m)))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the side of the tile is %g metres, need a number above 0",
                  double(side_m));
  MesoSurface surface;
  for (const Vec3 p : scene.position) surface.position.push_back({p.x / side_m, -p.z / side_m, p.y / side_m});
  const Bounds bounds = bounds_of(surface.position);
  check_bounds(bounds);
  // Moves the mesh by whole tiles into the middle tile, so that the copies on all sides are equally far away.
  const Vec3 shift{-std::floor(bounds.x.middle()), -std::floor(bounds.y.middle()), -bounds.z.middle()};
  for (Vec3& p : surface.position) p += shift;
  surface.triangle = scene.triangle;
  vertex_normals(surface.triangle, surface.position, surface.normal);
  join_across_border(surface);
  surface.albedo = colours_of(scene);
  return surface;
}

}  // namespace nook::bake::material
