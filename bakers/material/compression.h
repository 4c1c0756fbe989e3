// Compresses a raw material by N-SVD, CTA or K-CTA, or by a neural network whose VOTF uses K-CTA.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/material/compression_settings.h"
#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::material {

// `stage` is the name of the current step. Return false to stop.
using StageProgress = std::function<bool(const char* stage, std::size_t done, std::size_t total)>;

// compress_btf and compress_votf throw Failure(NOOK_ERROR_CANCELLED) when `progress` returns false. The same
// seed gives the same bits on any number of threads.
struct CompressedBtf {
  std::vector<float> light_basis;  // like Material::light_basis
  nook::material::ClusteredTensor tensor;
  int iterations = 0;
};
CompressedBtf compress_btf(const RawMaterial& raw, const CompressionSettings& settings,
                           const StageProgress& progress = {});

// `values` are view x width x height, either a mask or distances.
nook::material::ClusteredTensor compress_votf(const RawMaterial& raw, const std::vector<float>& values,
                                              const CompressionSettings& settings,
                                              const StageProgress& progress = {});

// Returns the values that the VOTF is fitted to, in the given form: the mask, or its signed distances.
std::vector<float> votf_values(const RawMaterial& raw, nook::material::VisibilityForm form);

// A relief, and the raw material with its images moved onto the relief. `raw` is empty if the relief moves no
// texels.
struct MovedMaterial {
  nook::material::Relief relief;
  RawMaterial raw;

  const RawMaterial& or_still(const RawMaterial& still) const { return relief.moves() ? raw : still; }
};
MovedMaterial move_views(const RawMaterial& raw, ReliefSource source, const StageProgress& progress = {});

// Compresses BTF, VOTF and directions. If `raw` has no mask, the result has no VOTF. Numbers are not rounded;
// quantise() in sdk's material/material_file.h rounds them later.
nook::material::Material compress(const RawMaterial& raw, const CompressionSettings& settings,
                                  const StageProgress& progress = {});

// Like compress(), for views that move_views() has already moved. Ignores settings.relief.
nook::material::Material compress_moved(const RawMaterial& raw, const MovedMaterial& moved,
                                        const CompressionSettings& settings,
                                        const StageProgress& progress = {});

// Sets the rounding of the cores of an unrounded material. The rounding adds 1 % to the squared error of the
// compression, which is 0.04 dB.
void set_core_rounding(const RawMaterial& raw, nook::material::Material& material);

// Chooses the ranks for light, view, x and y, and for x and y of the VOTF, as in section 6 of the paper. Each
// mode is treated separately: its rank is the smallest multiple of 4 with a squared error below `share` of
// the squared norm. If the material has a relief, pass the result of move_views() as `raw`.
CompressionSettings ranks_by_threshold(const RawMaterial& raw, double share, CompressionSettings settings);

}  // namespace nook::bake::material
