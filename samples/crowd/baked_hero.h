// A character's model: read from a file, found in the cache, or baked here with the draft preset.
#pragma once

#include <filesystem>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

struct BakeRequest {
  std::uint64_t source_hash = 0;  // of the character's file
  std::filesystem::path cache;
  float gamma = 0;  // exponent of the shadow norm; 0: the preset's
  bool quiet = false;
};

// The bytes of the .nook file. Shows progress while it bakes.
std::vector<unsigned char> cached_model(const Hero& hero, const BakeRequest& request);

// Makes the built-in character and leaves its .glb in the cache for other tools.
std::vector<unsigned char> built_in_glb(const std::filesystem::path& cache);

}  // namespace crowd
