#include "bakers/import/morph_targets.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/accessor.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

std::vector<double> default_morph_weights(const tinygltf::Mesh& mesh, const tinygltf::Node& node) {
  const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
  const bool all_zero = std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; });
  return all_zero ? std::vector<double>() : weights;
}

void add_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                       const std::vector<double>& weights, const std::string& what,
                       std::vector<float>& position) {
  if (weights.size() > primitive.targets.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s has %zu morph targets and %zu default weights for them",
                  what.c_str(), primitive.targets.size(), weights.size());
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const std::string target = what + " morph target " + std::to_string(t);
    if (!std::isfinite(weights[t]))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has a default weight that is not finite", target.c_str());
    const auto accessor = primitive.targets[t].find("POSITION");
    if (weights[t] == 0 || accessor == primitive.targets[t].end()) continue;
    const std::size_t count = element_count(model, accessor->second, target);
    if (count != position.size() / 3)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s moves %zu vertices (primitive has %zu)", target.c_str(), count,
                    position.size() / 3);
    const Floats moved = read_floats(model, accessor->second, 3, target);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += static_cast<float>(weights[t] * static_cast<double>(moved.value[i]));
  }
}

}  // namespace nook::bake
