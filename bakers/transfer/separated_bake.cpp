#include "bakers/transfer/separated_bake.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/transfer/inter_reflections.h"
#include "bakers/transfer/vertex_loop.h"
#include "bakers/transfer/visible_directions.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/transfer_check.h"

namespace nook::bake::transfer {
namespace {

using nook::transfer::CubeCells;
using nook::transfer::Transfer;

// A lobe counts as 0 if less than this share of it is above the vertex's horizon.
constexpr float dark = 1e-4f;

// The memory that one thread reuses for all its vertices.
struct Workspace {
  std::vector<VisibleDirection> visible;
  std::vector<float> seen, whole;  // one value per lobe
};

// The geometry that the vertices can see.
struct Sight {
  const RayScene& scene;
  const SurfaceHoles* holes;
  const CubeCells& cells;
};

void bake_vertex(const Sight& sight, Vec3 origin, Vec3 normal, const LobesOfDirections& lobes,
                 Workspace& work, std::span<std::uint8_t> shares) {
  const CubeCells& cells = sight.cells;
  const auto gather = [&](std::uint32_t direction, float cosine, std::vector<float>& sums) {
    for (std::uint32_t k = lobes.begin[direction]; k < lobes.begin[direction + 1]; ++k)
      sums[lobes.lobe[k]] += cosine * lobes.weight[k];
  };
  work.visible.clear();
  work.seen.assign(shares.size(), 0);
  work.whole.assign(shares.size(), 0);
  visible_directions(sight.scene, origin, normal, cells.direction, sight.holes, work.visible);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const float cosine = dot(normal, cells.direction[i]);
    if (cosine > 0) gather(i, cosine, work.whole);
  }
  for (const auto& [i, share] : work.visible) gather(i, dot(normal, cells.direction[i]) * share, work.seen);
  for (std::size_t j = 0; j < shares.size(); ++j)
    shares[j] = work.whole[j] < dark * lobes.integral
                    ? std::uint8_t(0)
                    : std::uint8_t(std::lround(255 * std::min(work.seen[j] / work.whole[j], 1.0f)));
}

template <class Number>
void need_unit(Vec3 v, const char* what, Number index) {
  if (!(std::abs(length(v) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the %s of vertex %zu is not of unit length (got %g %g %g); normalise it", what,
                  std::size_t(index), double(v.x), double(v.y), double(v.z));
}

}  // namespace

void check_bake(const SurfaceMesh& mesh, const BakeSettings& settings) {
  nook::transfer::check_lobes(settings.lobes, NOOK_ERROR_INVALID_ARGUMENT);
  if (settings.side < 8 || settings.side > max_ray_side)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the number of rays along a side of the cube around a vertex is out of range (got %u, need 8 to %u)",
        settings.side, max_ray_side);
  if (settings.bounces > nook::transfer::max_bounces)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of bounces is out of range (got %u, need 0 to %u)",
                  settings.bounces, nook::transfer::max_bounces);
  if (!(settings.tiles >= 0.01f && settings.tiles <= 1000))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of tiles is out of range (got %g, need 0.01 to 1000)", double(settings.tiles));
  const std::size_t count = mesh.position.size();
  if (count == 0 || count > nook::transfer::max_vertices)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of vertices is out of range (got %zu, need 1 to %u)", count,
                  nook::transfer::max_vertices);
  if (mesh.normal.size() != count || mesh.tangent.size() != count || mesh.uv.size() != count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the mesh has %zu positions, %zu normals, %zu tangents and %zu texture coordinates (need "
                  "the same number)",
                  count, mesh.normal.size(), mesh.tangent.size(), mesh.uv.size());
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p = mesh.position[v];
    if (!is_place(p))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "vertex %zu is out of range (got %g %g %g, need finite metres up to 1e6)", v, double(p.x),
                    double(p.y), double(p.z));
    need_unit(mesh.normal[v], "normal", v);
    need_unit(mesh.tangent[v].direction, "tangent", v);
    if (!std::isfinite(mesh.uv[v].u) || !std::isfinite(mesh.uv[v].v))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the texture coordinates of vertex %zu are not finite", v);
  }
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
    for (const std::uint32_t i : mesh.triangle[t])
      if (i >= count)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "triangle %zu refers to vertex %u, but the mesh has only %zu", t, i, count);
}

nook::transfer::Frame frame_of(const SurfaceMesh& mesh, std::size_t vertex) {
  return nook::transfer::orthonormal_frame(mesh.normal[vertex], mesh.tangent[vertex].direction,
                                           mesh.tangent[vertex].handedness);
}

nook::transfer::MeshHashes hashes_of(const SurfaceMesh& mesh) {
  std::vector<float> position, normal, tangent, uv;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = mesh.position[v], n = mesh.normal[v], t = mesh.tangent[v].direction;
    position.insert(position.end(), {p.x, p.y, p.z});
    normal.insert(normal.end(), {n.x, n.y, n.z});
    tangent.insert(tangent.end(), {t.x, t.y, t.z, mesh.tangent[v].handedness});
    uv.insert(uv.end(), {mesh.uv[v].u, mesh.uv[v].v});
  }
  return {nook::transfer::hash_floats(position), nook::transfer::hash_floats(normal),
          nook::transfer::hash_floats(tangent), nook::transfer::hash_floats(uv)};
}

Transfer bake_transfer(const SurfaceMesh& mesh, const BakeSettings& settings, const Progress& progress) {
  check_bake(mesh, settings);
  const std::size_t count = mesh.position.size();
  const CubeCells cells(settings.side);
  const LobesOfDirections lobes = lobes_of(cells, settings.lobes);
  const RayScene scene({mesh.position, mesh.triangle});
  const float offset = ray_origin_offset(mesh.position);
  const auto holes = surface_holes(mesh, settings.holes.get(), settings.tiles, cells.size());

  Transfer transfer;
  transfer.lobes = settings.lobes;
  transfer.hashes = hashes_of(mesh);
  transfer.shares.resize(count * settings.lobes);
  for (std::size_t v = 0; v < count; ++v) transfer.frames.push_back(pack(frame_of(mesh, v)));
  if (settings.holes) transfer.votf_hash = settings.holes->votf_hash;

  VertexLoop loop(count * (1 + settings.bounces), progress);
  const Sight sight{scene, holes ? &*holes : nullptr, cells};
  std::vector<IrradianceBands> received(settings.bounces > 0 ? count : 0);
  loop.run<Workspace>(count, [&](std::size_t v, Workspace& work) {
    bake_vertex(sight, mesh.position[v] + mesh.normal[v] * offset, mesh.normal[v], lobes, work,
                std::span(transfer.shares).subspan(v * settings.lobes, settings.lobes));
    if (!received.empty()) received[v] = direct_irradiance(mesh.normal[v], cells, work.visible);
  });
  reflect({mesh, scene, offset, cells, sight.holes}, settings.bounces, loop, std::move(received), transfer);
  return transfer;
}

}  // namespace nook::bake::transfer
