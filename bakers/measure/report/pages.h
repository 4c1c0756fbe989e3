// Makes the parts of the page for each kind of file. page.h puts the parts together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/import/surface_mesh.h"
#include "bakers/material/raw_material.h"
#include "bakers/measure/character/character_report.h"
#include "bakers/measure/report/page.h"
#include "bakers/raytrace/environment.h"
#include "sdk/src/material/material.h"
#include "sdk/src/nnao/recording.h"
#include "sdk/src/probe/probe.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::report {

// The page of a character model.
struct BodySettings {
  std::uint32_t rays = 128;  // per vertex and pose
  std::uint64_t seed = 1;
  std::size_t samples_per_clip = 0;      // 0: as many as max_rays allows, at least 2 and at most 20
  std::uint64_t max_rays = 400'000'000;  // over all poses; the default takes a minute and a half on two cores
};

// Shows poses from the clips that were not part of the bake, or from all clips if the bake used all. If the
// file has no clips, shows the poses of the bake. Throws Failure(CANCELLED).
PageParts body_parts(const measure::BakedCharacter& baked, const BodySettings& settings,
                     const measure::StageProgress& progress);

// The page of a recorded frame of the screen-space pass.
PageParts frame_parts(const nook::nnao::Recording& recording);

// `bytes` is the content of the file. `raw` is the raw material that the file was compressed from. If it is
// null, the page has no comparison.
PageParts material_parts(std::span<const std::byte> bytes, const nook::material::Material& material,
                         const bake::material::RawMaterial* raw);

// `map` is the map that a single probe was baked from. If it is null, the page has no comparison. Pass null
// for a grid.
PageParts probe_parts(const probe::Probes& probes, const bake::Environment* map);

// `mesh` must be the mesh that the transfer was baked from. Throws Failure(BAD_FILE) if it is another mesh.
PageParts transfer_parts(std::size_t bytes, const transfer::Transfer& transfer,
                         const bake::SurfaceMesh& mesh);

}  // namespace nook::report
