// Ray traces a meso-surface into a BTF and a VOTF.
#pragma once

#include "bakers/material/meso_surface.h"
#include "bakers/material/raw_material.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake::material {

// Directions must lie within 85 degrees of the normal. Flatter rays would cross very many tiles.
inline constexpr float lowest_traced_z = 0.08f;

struct TraceSettings {
  std::uint32_t width = 96, height = 96;  // texels
  std::uint32_t samples = 2;              // per side of a texel, so a texel gets samples^2 view rays
  std::uint32_t bounces = 2;              // diffuse inter-reflections
  std::uint32_t bounce_rays = 64;         // per vertex
  std::uint64_t seed = 1;
  bool finds_heights = false;  // also finds RawMaterial::heights, which a known relief needs
};

// A view ray passes through its texel on the plane z = 0. It starts above the structure and ends below it.
// The BTF is the mean over those samples of the texel that meet the structure. If no sample meets it, the BTF
// is filled from neighbours. The mask is set if at least half of the samples meet the structure. With
// settings.finds_heights, the height of a texel is the mean of the highest points at its samples. Missing
// heights are filled in the same way.
//
// `progress` counts views. Any number of threads gives the same bits. Throws Failure(NOOK_ERROR_CANCELLED)
// when `progress` returns false. Throws Failure(INVALID_ARGUMENT) for invalid settings or directions, or if
// more than 16 GiB would be needed.
RawMaterial trace_material(const MesoSurface& surface, std::vector<Vec3> lights, std::vector<Vec3> views,
                           const TraceSettings& settings, const Progress& progress = {});

}  // namespace nook::bake::material
