// A character of the usual size for benchmarks: random numbers in a body's proportions, 65 bones, 130 proxy
// spheres, 500 key points, 7,400 welded and 8,700 file vertices, all of their seven entries in use.
#pragma once

#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/memory.h"
#include "tests/bench/skinning.h"

namespace nook::bench {

CharacterModel sample_model();
// Small turns and shifts of each bone; different for each seed.
std::vector<Mat3x4> sample_pose(std::size_t bones, unsigned seed);

// Its file vertices as skinning reads them.
struct SampleSkin {
  AlignedArray<float> rest;
  AlignedArray<std::uint8_t> bone;
  AlignedArray<float> weight;
  SkinnedVertices view;
};
SampleSkin sample_skin(const CharacterModel& model);

}  // namespace nook::bench
