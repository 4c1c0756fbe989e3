// Measures baked clips, and the live model in the same poses, against ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

struct ClipStudy {
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
  std::size_t max_poses = 200;  // for each row; poses are picked at even intervals
  std::vector<float> distances_m{0.75f, 1.5f};
  std::size_t max_pairs = 24;  // for each distance; pairs are picked at even intervals
};

struct ClipErrors {
  double mse = 0, mse_visible = 0;
};

struct ClipErrorRow {
  std::string at;        // "frames", "half_way", "neighbour"
  float distance_m = 0;  // distance of the neighbour, for rows with one
  std::size_t poses = 0;
  double visible_share = 0, noise_floor_mse = 0;
  ClipErrors clips, live, unlinked;  // unlinked: like clips, but without the neighbour's darkening
  // The darkening by the neighbour, averaged over the vertices: with clips, with the live model, and ray
  // traced.
  double darkening = 0, darkening_live = 0, darkening_traced = 0;
};

// The set must have been baked from this character and this model. Throws Failure(NOOK_ERROR_CANCELLED).
std::vector<ClipErrorRow> measure_clips(const bake::ImportedCharacter& character, const CharacterModel& model,
                                        const ClipSet& set, const ClipStudy& study,
                                        const bake::Progress& progress);

}  // namespace nook::measure
