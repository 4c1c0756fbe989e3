// Transfers the AO of the full mesh's bake to meshes with less detail, and compares it with ray tracing of
// these meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/vertex_fits.h"
#include "bakers/measure/character/character_error.h"

namespace nook::measure {

// The mesh, reduced to about the fraction `share` of its triangles. meshoptimizer collapses edges without
// moving vertices. It stops earlier, at a larger share, if further collapses would change the topology. For
// each vertex, welded_vertex is the index of the same vertex in the full mesh.
struct LodMesh {
  bake::SkinnedMesh mesh;
  std::vector<std::uint32_t> welded_vertex;
};
LodMesh simplified(const bake::SkinnedMesh& mesh, double share);

struct LodRow {
  std::size_t triangles = 0, vertices = 0;
  CharacterEvaluation nearest;    // each vertex uses the AO of the baked vertex at the same position
  CharacterEvaluation resampled;  // the result of nook_model_resample
  CharacterEvaluation refitted;   // the result of `nook bake lod`
};

// Traces the reference AO on the mesh with less detail, with the normals of that mesh. The model for
// `refitted` is fitted to the training poses. Throws Failure: BAD_FILE (a model without rest positions),
// CANCELLED.
LodRow measure_lod(const LodMesh& lod, const CharacterModel& model, std::span<const bake::Pose> training,
                   const bake::RefitSettings& refit, std::span<const bake::Pose> measured, std::uint32_t rays,
                   std::uint64_t seed, const bake::Progress& progress = {});

}  // namespace nook::measure
