#include "bakers/transfer/surface_holes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

// Two neighbouring texels of a repeating tile.
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

// Computes the mean visibility of each texel. Values are interpolated linearly, but their mapping to
// visibility is not linear, so each texel is sampled at several points.
void fill_finest(const MaterialTables& tables, Vec3 view, std::vector<float>& values,
                 std::vector<float>& cover) {
  constexpr std::uint32_t points = 4;  // sample points per side of a texel
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
                  "the material has no VOTF and therefore no holes; bake the "
                  "material with a VOTF, or leave the material out");
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

namespace {

// The corners of a triangle, and their barycentric weights at the point where a ray hits.
struct Corners {
  std::array<std::uint32_t, 3> vertex;
  std::array<float, 3> weight;
};
Corners corners_of(const SurfaceMesh& mesh, const RayHit& hit) {
  return {mesh.triangle[hit.triangle], {1 - hit.u - hit.v, hit.u, hit.v}};
}

// Returns the triangle's area in texture coordinates divided by its area in space, per square metre.
float density(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& vertex) {
  const Vec3 a = mesh.position[vertex[1]] - mesh.position[vertex[0]],
             b = mesh.position[vertex[2]] - mesh.position[vertex[0]];
  const TexturePoint o = mesh.uv[vertex[0]], p = mesh.uv[vertex[1]], q = mesh.uv[vertex[2]];
  const float area = std::abs((p.u - o.u) * (q.v - o.v) - (q.u - o.u) * (p.v - o.v));
  return area / std::max(length(cross(a, b)), 1e-20f);
}

}  // namespace

nook::transfer::Frame frame_at(const SurfaceMesh& mesh, const RayHit& hit) {
  const Corners at = corners_of(mesh, hit);
  Vec3 normal, tangent;
  for (std::size_t k = 0; k < 3; ++k) {
    normal += mesh.normal[at.vertex[k]] * at.weight[k];
    tangent += mesh.tangent[at.vertex[k]].direction * at.weight[k];
  }
  return nook::transfer::orthonormal_frame(normal, tangent, mesh.tangent[at.vertex[0]].handedness);
}

std::optional<SurfaceHoles> surface_holes(const SurfaceMesh& mesh, const HoleTable* table, float tiles,
                                          std::size_t rays) {
  if (!table) return {};
  // The width of an average cell of the sphere.
  const float spread_rad = std::sqrt(4 * std::numbers::pi_v<float> / float(rays));
  return SurfaceHoles(mesh, *table, tiles, spread_rad);
}

SurfaceHoles::SurfaceHoles(const SurfaceMesh& mesh, const HoleTable& table, float tiles, float spread_rad)
    : mesh_(mesh), table_(table), tiles_(tiles), spread_rad_(spread_rad) {}

float SurfaceHoles::cover(const RayHit& hit, Vec3 direction) const {
  const Corners at = corners_of(mesh_, hit);
  const nook::transfer::Frame frame = frame_at(mesh_, hit);
  Vec3 view{-dot(frame.tangent, direction), -dot(frame.bitangent(), direction),
            -dot(frame.normal, direction)};
  if (view.z < 0) view = -view;
  float u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u += mesh_.uv[at.vertex[k]].u * at.weight[k];
    v += mesh_.uv[at.vertex[k]].v * at.weight[k];
  }
  const float footprint = hit.distance * spread_rad_;
  const float texels = density(mesh_, at.vertex) * tiles_ * tiles_ * float(table_.width * table_.height) *
                       footprint * footprint / std::max(view.z, 0.05f);
  return table_.cover_at(u * tiles_, v * tiles_, 0.5f * std::log2(std::max(texels, 1e-10f)), view);
}

float SurfaceHoles::share_through(const RayScene& scene, Vec3 origin, Vec3 direction) const {
  return walk_surfaces(scene, this, origin, direction, [](const RayHit&, float) {});
}

}  // namespace nook::bake::transfer
