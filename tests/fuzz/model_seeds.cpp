#include "sdk/src/character/model_file.h"
#include "tests/character/model_sample.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {

std::vector<Seed> seeds() {
  CharacterModel levels = sample_model(3, {3, 4, 6, 12, 3, 8});
  CharacterLevel level;
  level.spheres = {levels.spheres[0], levels.spheres[2]};
  level.evaluated = {0, 2, 5};
  level.source = {0, 0, 1, 1, 2, 2};
  level.scale = {1, 0.9f, 1, 1.1f, 0.8f, 1};
  level.offset = {0, 0.01f, 0, -0.01f, 0.02f, 0};
  level.error_rms = 0.02f;
  levels.levels.push_back(level);
  Numbers numbers(5);
  add_world_casters(levels, numbers);
  CharacterModel bent = sample_model(6, {3, 4, 6, 14, 3, 4});
  add_occluded(bent, numbers);
  CharacterModel paper = sample_model(4, {2, 3, 5, 9, 1, 2});
  paper.kernel.form = KernelForm(1);
  paper.kernel.gamma = 2;
  const CharacterModel models[] = {sample_model(1),
                                   sample_model(2, {2, 2, 3, 5, 2, 3}),
                                   single_model({0, 1, 0}, 0.5f),
                                   levels,
                                   paper,
                                   bent};
  std::vector<Seed> made;
  for (const CharacterModel& model : models)
    made.push_back({"model_" + std::to_string(made.size()) + ".nook", write_character_model(model)});
  return made;
}

}  // namespace nook::test
