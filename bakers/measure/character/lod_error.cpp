#include "bakers/measure/character/lod_error.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/host_vertices.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr std::uint32_t unused = UINT32_MAX;

std::vector<std::uint32_t> simplified_indices(const SkinnedMesh& mesh, double share) {
  std::vector<std::uint32_t> indices;
  for (const auto& t : mesh.triangle) indices.insert(indices.end(), t.begin(), t.end());
  const auto target = std::size_t(share * double(mesh.triangle.size())) * 3;
  // An error of 1 is the size of the whole mesh, so the simplification ends only when the requested share of
  // triangles is reached.
  constexpr float any_error = 1;
  std::vector<std::uint32_t> kept(indices.size());
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &mesh.position[0].x,
                               mesh.vertex_count(), sizeof(Vec3), target, any_error, 0, nullptr));
  return kept;
}

// Returns a copy of the model with only the given welded vertices.
CharacterModel picked(const CharacterModel& model, std::span<const std::uint32_t> welded) {
  CharacterModel out = model;
  out.influence.clear();
  out.alpha.clear();
  out.blend.clear();
  out.bias.clear();
  out.static_ao.clear();
  out.occluded.clear();
  for (const std::uint32_t v : welded) {
    for (std::size_t s = std::size_t(v) * model.influences; s < (std::size_t(v) + 1) * model.influences;
         ++s) {
      out.influence.push_back(model.influence[s]);
      out.alpha.push_back(model.alpha[s]);
      out.blend.push_back(model.blend[s]);
    }
    out.bias.push_back(model.bias[v]);
    if (!model.static_ao.empty()) out.static_ao.push_back(model.static_ao[v]);
    if (!model.occluded.empty()) out.occluded.push_back(model.occluded[v]);
  }
  return out;
}

CharacterModel resampled_for(const SkinnedMesh& mesh, const CharacterModel& model) {
  std::vector<Vec3> normals;
  vertex_normals(mesh.triangle, mesh.position, normals);
  HostVertices host;
  host.count = std::uint32_t(mesh.vertex_count());
  host.position = {&mesh.position[0].x, sizeof(Vec3)};
  host.normal = {&normals[0].x, sizeof(Vec3)};
  host.in_rest_space = true;
  return resampled(model, host, default_memory());
}

}  // namespace

LodMesh simplified(const SkinnedMesh& mesh, double share) {
  const std::vector<std::uint32_t> indices = simplified_indices(mesh, share);
  LodMesh lod;
  lod.mesh.bones = mesh.bones;
  std::vector<std::uint32_t> vertex_of(mesh.vertex_count(), unused);
  for (std::size_t t = 0; t < indices.size(); t += 3) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t welded = indices[t + c];
      if (vertex_of[welded] == unused) {
        vertex_of[welded] = std::uint32_t(lod.welded_vertex.size());
        lod.welded_vertex.push_back(welded);
        lod.mesh.position.push_back(mesh.position[welded]);
        lod.mesh.weights.push_back(mesh.weights[welded]);
        lod.mesh.file_to_welded.push_back(vertex_of[welded]);
      }
      triangle[c] = vertex_of[welded];
    }
    lod.mesh.triangle.push_back(triangle);
  }
  lod.mesh.primitives = {{"lod", 0, std::uint32_t(lod.welded_vertex.size())}};
  return lod;
}

LodRow measure_lod(const LodMesh& lod, const CharacterModel& model, std::span<const Pose> training,
                   const RefitSettings& refit, std::span<const Pose> measured, std::uint32_t rays,
                   std::uint64_t seed, const Progress& progress) {
  if (model.rest.position.empty() || model.bind.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the model has no rest positions; bake it again");
  LodRow row;
  row.triangles = lod.mesh.triangle.size();
  row.vertices = lod.mesh.vertex_count();
  const AoTargets truth = trace_character_ao(lod.mesh, measured, rays, seed, progress);
  const auto score = [&](const CharacterModel& form) {
    return score_character(lod.mesh, form, measured, truth);
  };
  row.nearest = score(picked(model, lod.welded_vertex));
  row.resampled = score(resampled_for(lod.mesh, model));
  row.refitted = score(refit_vertices(model, lod.mesh, training, refit, progress));
  return row;
}

}  // namespace nook::measure
