// Holds a neural material as textures and numbers, and decodes it on the CPU. shaders/material/neural has the
// same functions.
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
  // Layers of four channels: the features', then the offset's. Numbers are integers from -127 to 127, 127
  // times the features. Mipmaps are means over areas of texels.
  ImageSize size;
  Vector<std::int8_t> features;
  Vector<float> weights;  // empty: the material is a clustered tensor
  // Views and lights below all sampled ones are raised to the lowest sampled one.
  float lowest_view_z = 1, lowest_light_z = 1;

  bool is_used() const { return !weights.empty(); }
  // The numbers of a pixel are the sums of the first layer without a light, then the view and 0.
  std::uint32_t decoded_count() const { return shape.units + 4; }
};

NeuralTables make_neural_tables(const Neural& neural, std::span<const Vec3> views,
                                std::span<const Vec3> lights, Memory* memory);

// Computes the decoded_count() numbers of a pixel, for one place or for the mean features of several places.
// Each place has a height of its own.
void decode_neural(const NeuralTables& tables, const ImagePlace& place, Vec3 view, std::span<float> decoded);
void decode_neural_places(const NeuralTables& tables, const Fetches& at, Vec3 view, std::span<float> decoded);

// Returns the radiance for a light above the horizon, from the numbers of decode_neural: RGB, at least 0.
Vec3 neural_radiance(const NeuralTables& tables, std::span<const float> decoded, Vec3 light);

}  // namespace nook::material
