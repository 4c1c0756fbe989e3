// The host memory that an instance of a model takes in a scene.
#pragma once

#include <cstdint>

#include "sdk/src/character/loaded_model.h"

namespace nook {

// Bytes of an instance without light and without links.
std::uint64_t instance_bytes(const LoadedModel& model);
// What a light adds.
std::uint64_t light_bytes(const LoadedModel& model);

}  // namespace nook
