// The character of fuzzed clips.
#pragma once

#include "tests/character/model_sample.h"

namespace nook::test {

inline CharacterModel clips_model() {
  CharacterModel model = sample_model(2, {2, 2, 3, 5, 2, 3});
  Numbers numbers(5);
  add_world_casters(model, numbers);
  return model;
}

}  // namespace nook::test
