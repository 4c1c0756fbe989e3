// The second candidate of each texel for k-coherence (X. Tong and others: Synthesis of bidirectional texture
// functions on arbitrary surfaces, 2002).
#pragma once

#include <functional>
#include <vector>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// Returns false to stop. Worker threads do not call it.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns for each texel the one whose surroundings, the appearance vectors of its four diagonal neighbours
// at the spacing, are the most like its own, among those that are at least a twentieth of the exemplar's
// shorter side away from it and that a plane may show. An exemplar of more than 16,384 texels offers a part
// of them, evenly spread.
std::vector<Texel> similar_texels(const tensor::Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing);

}  // namespace nook::bake::synthesis
