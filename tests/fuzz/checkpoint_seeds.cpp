#include "bakers/nnao/training.h"
#include "tests/fuzz/checkpoint_recipe.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {

// A training of a few steps. The paper's form would take 190 kB, too much for a corpus.
std::vector<Seed> seeds() {
  using namespace bake::nnao;
  TrainingState state(parameter_count(NetworkForm::horizon));
  for (std::size_t i = 0; i < state.parameter.size(); ++i) state.parameter[i] = float(i % 17) / 16 - 0.5f;
  std::vector<Seed> made{{"checkpoint_0.nook", write_checkpoint(state, checkpoint_recipe)}};
  for (const float slope : {0.25f, -0.5f}) {
    const std::vector<float> gradient(state.parameter.size(), slope);
    state.adam.step(state.parameter, gradient, 1e-3f);
  }
  state.epochs_done = 3;
  made.push_back({"checkpoint_1.nook", write_checkpoint(state, checkpoint_recipe)});
  return made;
}

}  // namespace nook::test
