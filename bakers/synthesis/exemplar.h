// An exemplar: the material from which a plane is synthesised. This file contains the looks of its texels,
// their blurred versions, and the vectors that each level of the synthesis compares.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bakers/tensor/tensor.h"

namespace nook::bake::synthesis {

// The looks of an exemplar's texels: values that describe how each texel looks.

// A texel of an exemplar, or the offset between two texels.
struct Texel {
  std::int32_t x = 0, y = 0;
  bool operator==(const Texel&) const = default;
};
constexpr Texel operator+(Texel a, Texel b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Texel operator-(Texel a, Texel b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Texel operator*(Texel a, std::int32_t s) {
  return {a.x * s, a.y * s};
}

// Returns i modulo size. The result is never negative.
constexpr std::int32_t wrapped(std::int32_t i, std::int32_t size) {
  const std::int32_t rest = i % size;
  return rest < 0 ? rest + size : rest;
}
// Mirrors i at both ends of a row. Does not repeat the texels at the ends.
constexpr std::int32_t mirrored(std::int32_t i, std::int32_t size) {
  if (size == 1) return 0;
  const std::int32_t at = wrapped(i, 2 * size - 2);
  return at < size ? at : 2 * size - 2 - at;
}

// The shape of an exemplar. A tiling exemplar repeats beyond its border; any other exemplar is mirrored
// there.
struct ExemplarShape {
  std::int32_t width = 0, height = 0;
  bool is_tiling = true;
  // Width of the border of an exemplar that does not tile, in texels. A plane does not show border texels,
  // because we do not know their surroundings.
  std::int32_t margin = 0;

  Texel inside(Texel t) const {
    return is_tiling ? Texel{wrapped(t.x, width), wrapped(t.y, height)}
                     : Texel{mirrored(t.x, width), mirrored(t.y, height)};
  }
  bool holds(Texel t) const { return t.x >= 0 && t.x < width && t.y >= 0 && t.y < height; }
  // Returns the nearest texel that a plane may show.
  Texel shown(Texel t) const {
    if (is_tiling) return inside(t);
    return {std::clamp(t.x, margin, width - 1 - margin), std::clamp(t.y, margin, height - 1 - margin)};
  }
  bool is_shown(Texel t) const { return is_tiling || shown(t) == t; }
  // Returns the texel's row in matrices. The texel must be inside the exemplar.
  Eigen::Index row(Texel t) const { return Eigen::Index(t.y) * width + t.x; }
  Eigen::Index texels() const { return Eigen::Index(width) * height; }
};

struct Exemplar {
  ExemplarShape shape;
  tensor::Matrix values;  // one row per texel, y * width + x
};

// The Gaussian stack of an exemplar: increasingly blurred versions with the same number of texels.

// Returns levels + 1 versions. The first one is the exemplar. Each further version is the previous one,
// filtered along both axes with (1, 4, 6, 4, 1) / 16 at a spacing of 1, 2, 4, ... texels.
std::vector<tensor::Matrix> gaussian_stack(const Exemplar& exemplar, std::uint32_t levels);

// Appearance vectors: short vectors that describe the surroundings of an exemplar's texels.

inline constexpr std::uint32_t appearance_channels = 8;

// The window of a texel is 5 x 5 texels of `values`, `spacing` texels apart. Projects each window onto the
// leading principal components of all windows. Returns one row per texel.
tensor::Matrix appearance_vectors(const tensor::Matrix& values, const ExemplarShape& shape,
                                  std::int32_t spacing);

// Balances small details with large shapes.

// Divides each channel by the square root of its standard deviation, and scales the result to the original
// total variance. Without this, the principal components of a material with holes would mostly describe the
// holes, and all other details would be lost in the synthesis.
Exemplar balanced(const Exemplar& exemplar);

}  // namespace nook::bake::synthesis
