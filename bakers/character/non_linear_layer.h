// The non-linear layer of the model and its gradient (Le et al. 2019, slides 13 to 20). The forward pass
// computes the shadow at every key point from bone matrices. The backward pass computes the gradient of the
// parameters. Each call handles one pose. Callers parallelise over poses.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/character/kernel.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// The structure of the layer. The fit does not change it.
struct LayerStructure {
  Kernel kernel;
  std::vector<std::uint16_t> sphere_bone;
  std::vector<std::array<std::uint16_t, KeyPoint::max_bones>> key_point_bone;

  std::size_t sphere_count() const { return sphere_bone.size(); }
  std::size_t key_point_count() const { return key_point_bone.size(); }
  // Returns the number of key points, padded to whole SIMD vectors.
  std::size_t padded_count() const { return (key_point_count() + 15) / 16 * 16; }

  // All parameters are in one flat vector without constraints, so that any optimiser can be used:
  //   4 for each sphere: centre (rest space, metres), log radius;
  //   11 for each key point: position, normal (any length), 4 roots of bone weights (weight = root^2 / sum of
  //   root^2), root of the saturation. At a root of 0 the saturation has no slope and stays 0.
  static constexpr std::size_t sphere_parameters = 4, key_point_parameters = 11;
  std::size_t sphere_offset(std::size_t h) const { return sphere_parameters * h; }
  std::size_t key_point_offset(std::size_t k) const {
    return sphere_parameters * sphere_count() + key_point_parameters * k;
  }
  std::size_t saturation_offset(std::size_t k) const { return key_point_offset(k) + 10; }
  std::size_t parameter_count() const { return key_point_offset(key_point_count()); }
};

// Scratch memory of one evaluation; reused between poses by one thread at a time.
class LayerWorkspace {
 public:
  explicit LayerWorkspace(const LayerStructure& structure);

 private:
  friend class NonLinearLayer;
  std::vector<float> sphere_;        // 5 arrays: x, y, z, radius, inverse radius
  std::vector<float> key_;           // position x y z, normal x y z
  std::vector<float> sum_;           // sum of y^gamma
  std::vector<float> gradient_key_;  // same layout as key_
  std::vector<float> gradient_sum_;
};

class NonLinearLayer {
 public:
  explicit NonLinearLayer(const LayerStructure& structure) : structure_(structure) {}

  // Writes padded_count() values to `shadow`, with a distance of `stride` values between them. The workspace
  // keeps the intermediate values that backward needs.
  void forward(std::span<const Mat3x4> bones, std::span<const float> parameters, LayerWorkspace& workspace,
               float* shadow, std::size_t stride = 1) const;

  // Adds d(loss)/d(parameters) to `gradient`, given d(loss)/d(shadow). Call forward() with the same arguments
  // first.
  void backward(std::span<const Mat3x4> bones, std::span<const float> parameters, LayerWorkspace& workspace,
                const float* gradient_shadow, std::size_t stride, std::span<float> gradient) const;

 private:
  // The part of backward() that goes from shadows to sums and saturations.
  void backward_response(std::span<const float> parameters, LayerWorkspace& workspace,
                         const float* gradient_shadow, std::size_t stride, std::span<float> gradient) const;

  const LayerStructure& structure_;
};

}  // namespace nook::bake
