// A model for another mesh of the same body, such as a level of detail: its vertices take their weights from
// the baked vertices round them.
#pragma once

#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/character/vertex_candidates.h"
#include "sdk/src/core/memory.h"

namespace nook {

struct FarVertex {
  std::uint32_t vertex = 0;  // of the host
  float distance = 0;        // to the nearest vertex of the model that faces the same way, host's unit
};

// The host's vertex that is farthest from the model's. The model has a rest surface and bind data, and the
// host has vertices.
FarVertex farthest_vertex(const CharacterModel& model, const HostVertices& host, Memory* memory);

// A model with one welded vertex for each vertex of the host. The linear layer is linear in its weights, so
// that the mean of the weights of baked vertices gives the mean of their AO in every pose: a vertex takes
// that of the three baked vertices nearest to it that face the same way. The largest
// CharacterModel::max_influences weights are kept, and their sum stays.
CharacterModel resampled(const CharacterModel& model, const HostVertices& host, Memory* memory);

}  // namespace nook
