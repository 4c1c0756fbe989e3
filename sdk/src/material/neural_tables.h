// Holds the textures and weights of a neural material, and decodes it on the CPU. shaders/material/neural has
// the same functions.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/footprint.h"
#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/neural.h"

namespace nook::material {

struct NeuralTables {
  explicit NeuralTables(Memory* memory = default_memory()) : features(memory), weights(memory) {}

  NeuralShape shape;
  // Layers of four channels each: first the features, then the offset's features. Values are 127 times the
  // features, as integers from -127 to 127. A texel of a smaller mipmap level is the mean over its area.
  ImageSize size;
  Vector<std::int8_t> features;
  Vector<float> weights;  // empty: the material is a clustered tensor
  // Lower limits of z. A lower view or light is raised to the height of the lowest sampled one.
  float lowest_view_z = 1, lowest_light_z = 1;

  bool is_used() const { return !weights.empty(); }
  // The number of decoded values of a pixel. These values are the sums of the first layer without the light,
  // then the view, and a 0.
  std::uint32_t decoded_count() const { return shape.units + 4; }
};

NeuralTables make_neural_tables(const Neural& neural, std::span<const Vec3> views,
                                std::span<const Vec3> lights, Memory* memory);

// Computes the decoded_count() values of a pixel, from one place or from the mean features of several places.
// The height is computed separately for each place.
void decode_neural(const NeuralTables& tables, const ImagePlace& place, Vec3 view, std::span<float> decoded);
void decode_neural_places(const NeuralTables& tables, const Fetches& at, Vec3 view, std::span<float> decoded);

// Returns the radiance for a light above the horizon as RGB, at least 0. `decoded` is the output of
// decode_neural.
Vec3 neural_radiance(const NeuralTables& tables, std::span<const float> decoded, Vec3 light);

}  // namespace nook::material
