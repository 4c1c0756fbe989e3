// Compresses a raw material by N-SVD, CTA or K-CTA, or by a neural network whose VOTF uses K-CTA.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/material/compression_settings.h"
#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::material {

// Returns false to stop. stage is the name of the current step.
using StageProgress = std::function<bool(const char* stage, std::size_t done, std::size_t total)>;

// Both functions throw Failure(NOOK_ERROR_CANCELLED) when progress returns false. The same seed gives the
// same bits on any number of threads.
struct CompressedBtf {
  std::vector<float> light_basis;  // like Material::light_basis
  nook::material::ClusteredTensor tensor;
  int iterations = 0;
};
CompressedBtf compress_btf(const RawMaterial& raw, const CompressionSettings& settings,
                           const StageProgress& progress = {});

// values: view x width x height, a mask or distances.
nook::material::ClusteredTensor compress_votf(const RawMaterial& raw, const std::vector<float>& values,
                                              const CompressionSettings& settings,
                                              const StageProgress& progress = {});

// Returns the VOTF's values in a form: the mask, or its signed distances.
std::vector<float> votf_values(const RawMaterial& raw, nook::material::VisibilityForm form);

// A relief, and the raw material whose images lie on the relief. raw is empty if the relief moves no texels.
struct MovedMaterial {
  nook::material::Relief relief;
  RawMaterial raw;

  const RawMaterial& or_still(const RawMaterial& still) const { return relief.moves() ? raw : still; }
};
MovedMaterial move_views(const RawMaterial& raw, ReliefSource source, const StageProgress& progress = {});

// Compresses BTF, VOTF and directions as a whole. Without a mask in raw there is no VOTF. Numbers are not yet
// rounded: quantise() in sdk's material/material_file.h rounds them.
nook::material::Material compress(const RawMaterial& raw, const CompressionSettings& settings,
                                  const StageProgress& progress = {});

// The same for views that move_views() has moved already. Ignores settings.relief.
nook::material::Material compress_moved(const RawMaterial& raw, const MovedMaterial& moved,
                                        const CompressionSettings& settings,
                                        const StageProgress& progress = {});

// Sets the rounding of the cores of an unrounded material, so that it adds a hundredth to the squared error
// of the compression: 0.04 dB.
void set_core_rounding(const RawMaterial& raw, nook::material::Material& material);

// Chooses ranks as in section 6 of the paper, for light, view, x, y, and x, y of the VOTF. In each mode
// alone, it takes the smallest multiple of 4 whose squared error stays below a share of the squared norm. If
// the material has a relief, pass what move_views() returns as raw.
CompressionSettings ranks_by_threshold(const RawMaterial& raw, double share, CompressionSettings settings);

}  // namespace nook::bake::material
