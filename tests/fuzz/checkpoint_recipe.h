// The settings that the checkpoints of the corpus belong to: a checkpoint of others is refused by its
// fingerprint.
#pragma once

namespace nook::test {

inline constexpr const char* checkpoint_recipe = "{\"seed\": 1}";

}  // namespace nook::test
