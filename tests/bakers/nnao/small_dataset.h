// A training set that is made in a second.
#pragma once

#include "bakers/nnao/dataset.h"

namespace nook::test {

inline bake::nnao::DatasetSettings small_settings(std::uint64_t seed = 1) {
  bake::nnao::DatasetSettings settings;
  settings.scenes = 2 * bake::nnao::family_count;
  settings.views = settings.scenes;
  settings.points_per_view = 120;
  settings.rays = 64;
  settings.width = 192;
  settings.height = 108;
  settings.seed = seed;
  return settings;
}

inline bake::nnao::Dataset small_dataset(std::uint64_t seed = 1) {
  return bake::nnao::make_dataset(small_settings(seed));
}

}  // namespace nook::test
