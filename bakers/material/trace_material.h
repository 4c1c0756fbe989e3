// Ray traces a meso-surface into a BTF and a VOTF.
#pragma once

#include "bakers/material/meso_surface.h"
#include "bakers/material/raw_material.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake::material {

// Directions lie within 85 degrees of the normal: rays near the horizon would cross very many tiles.
inline constexpr float lowest_traced_z = 0.08f;

struct TraceSettings {
  std::uint32_t width = 96, height = 96;  // texels
  std::uint32_t samples = 2;              // a texel's side: samples^2 view rays in it
  std::uint32_t bounces = 2;              // diffuse inter-reflections
  std::uint32_t bounce_rays = 64;         // from each vertex
  std::uint64_t seed = 1;
  bool finds_heights = false;  // RawMaterial::heights too, which a known relief reads
};

// A view ray passes through its texel on the plane z = 0, comes in above the structure and leaves below it.
// The BTF is the mean over the texel's samples that meet the structure, filled from around where none does;
// the mask tells whether half of them or more do. Heights, where settings.finds_heights is set, are the means
// of the highest points over a texel's samples, filled in the same way where nothing lies under any. Progress
// counts views. The same bits on any number of threads. Throws Failure(NOOK_ERROR_CANCELLED) when progress
// returns false, Failure(INVALID_ARGUMENT) for settings or directions that make no sense, or take more than
// 16 GiB.
RawMaterial trace_material(const MesoSurface& surface, std::vector<Vec3> lights, std::vector<Vec3> views,
                           const TraceSettings& settings, const Progress& progress = {});

}  // namespace nook::bake::material
