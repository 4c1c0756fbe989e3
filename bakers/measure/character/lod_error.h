// Transfers the AO of the full mesh's bake to meshes with less detail, and compares it with ray tracing of
// these meshes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/vertex_fits.h"
#include "bakers/measure/character/character_error.h"

namespace nook::measure {

// The mesh with about `share` of its triangles. meshoptimizer collapses edges without moving vertices. The
// share is larger if further collapses would change the topology. welded_vertex gives the full mesh's vertex
// for each vertex.
struct LodMesh {
  bake::SkinnedMesh mesh;
  std::vector<std::uint32_t> welded_vertex;
};
LodMesh simplified(const bake::SkinnedMesh& mesh, double share);

struct LodRow {
  std::size_t triangles = 0, vertices = 0;
  CharacterEvaluation nearest;    // each vertex takes the AO of the baked vertex at the same position
  CharacterEvaluation resampled;  // nook_model_resample
  CharacterEvaluation refitted;   // `nook bake lod`
};

// Traces the truth on the mesh with less detail and that mesh's normals. Fits the field `refitted` to the
// training poses. Throws Failure: BAD_FILE (a model without rest positions), CANCELLED.
LodRow measure_lod(const LodMesh& lod, const CharacterModel& model, std::span<const bake::Pose> training,
                   const bake::RefitSettings& refit, std::span<const bake::Pose> measured, std::uint32_t rays,
                   std::uint64_t seed, const bake::Progress& progress = {});

}  // namespace nook::measure
