// The page of each kind of file: the parts of it that page.h puts together.
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
  std::uint32_t rays = 128;  // for each vertex and pose
  std::uint64_t seed = 1;
  std::size_t samples_per_clip = 0;      // 0: as many as max_rays allows, 2 to 20
  std::uint64_t max_rays = 400'000'000;  // of all poses together; a minute and a half on two cores
};

// Poses of the clips that the bake has not seen, or of all of them; of a file without clips those of the
// bake. Throws Failure(CANCELLED).
PageParts body_parts(const measure::BakedCharacter& baked, const BodySettings& settings,
                     const measure::StageProgress& progress);

// The page of a recorded frame of the screen-space pass.
PageParts frame_parts(const nook::nnao::Recording& recording);

// The page of a compressed material. bytes: the file. raw: what it was compressed from; null: it is not
// compared.
PageParts material_parts(std::span<const std::byte> bytes, const nook::material::Material& material,
                         const bake::material::RawMaterial* raw);

// The page of a light probe or a grid of probes. map: what a single probe was baked from; null: it is not
// compared. A grid takes none.
PageParts probe_parts(const probe::Probes& probes, const bake::Environment* map);

// The page of baked radiance transfer. mesh: what it was baked from. Throws Failure(BAD_FILE) for another
// one.
PageParts transfer_parts(std::size_t bytes, const transfer::Transfer& transfer,
                         const bake::SurfaceMesh& mesh);

}  // namespace nook::report
