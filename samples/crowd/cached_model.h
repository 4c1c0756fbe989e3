// The models of characters that this program bakes, kept in a folder.
#pragma once

#include <filesystem>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

struct ModelRequest {
  std::filesystem::path cache;
  float gamma = 0;  // exponent of the norm that adds up shadows; 0 takes the preset's
  bool quiet = false;
};

// The bytes of the hero's .nook file, from the cache. If the cache has none, this bakes one with the draft
// preset and shows the progress.
std::vector<unsigned char> cached_model(const Hero& hero, const ModelRequest& request);

}  // namespace crowd
