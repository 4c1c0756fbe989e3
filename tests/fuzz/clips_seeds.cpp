#include "sdk/src/character/clip_set.h"
#include "tests/character/clip_sample.h"
#include "tests/fuzz/clips_model.h"
#include "tests/fuzz/seeds.h"

namespace nook::test {

std::vector<Seed> seeds() {
  std::vector<Seed> made;
  for (const std::uint32_t modes : {4u, 8u, 12u})
    made.push_back({"clips_" + std::to_string(made.size()) + ".nook",
                    write_clip_set(sample_clips(clips_model(), modes, modes).set)});
  return made;
}

}  // namespace nook::test
