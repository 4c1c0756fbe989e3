// From a raw material to a compressed one, by N-SVD, CTA or K-CTA, or by a neural network whose VOTF is that
// of K-CTA.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/clustered_fit.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

enum class Method : std::uint8_t { n_svd, cta, k_cta, neural };

enum class Seeding : std::uint8_t {
  directions,  // clusters of view directions: the parametric space of the paper's 5.1
  values,      // k-means of the views' sub-tensors
};

// Where the relief comes from on which views are moved; see relief.h.
enum class ReliefSource : std::uint8_t {
  none,
  estimated,  // from what the views agree on
  known,      // from RawMaterial::heights
};

inline constexpr std::uint32_t max_neural_steps = 1000000;

// The form of numbers of a bake that sets none.
inline constexpr std::uint32_t default_bits = 8;

struct CompressionSettings {
  Method method = Method::k_cta;
  std::uint32_t rank_light = 16;
  std::uint32_t rank_view = 80;  // of N-SVD; of CTA and K-CTA in total, C times that of a cluster
  std::uint32_t rank_x = 64, rank_y = 64;
  std::uint32_t votf_rank_x = 80, votf_rank_y = 80;
  std::uint32_t cluster_rank_view = 4;
  std::uint32_t clusters = 0;  // C; 0: rank_view / cluster_rank_view
  std::uint32_t mixture = 3;   // K of K-CTA
  // Fits of the VOTF after the first, to targets that count the sides of values; see visibility_margin.h.
  std::uint32_t votf_refits = 2;
  Seeding seeding = Seeding::directions;
  nook::material::VisibilityForm visibility = nook::material::VisibilityForm::distance;
  std::optional<nook::material::VisibilityMapping> mapping;  // none: default_mapping() below
  std::uint32_t map_side = 64;  // cells of the resampled view maps of K-CTA; 0: none
  double step_penalty = 0;      // of the steps in the BTF's view map, see tensor/resample.h; 0: none
  bool is_cta_mapped = false;   // CTA has view maps as well, whose cells show one cluster each
  std::uint32_t bits = 16;      // form of the numbers, see Material in sdk's material/material.h
  ReliefSource relief = ReliefSource::none;
  // Of a neural material: channels of its features, a multiple of 4, and steps of its training.
  std::uint32_t neural_channels = 16, neural_steps = 8000;
  std::uint64_t seed = 1;

  std::uint32_t cluster_count() const {
    return clusters ? clusters : std::max(rank_view / cluster_rank_view, 1u);
  }
  // Cells along a side of the view maps that the method makes; 0: none.
  std::uint32_t made_map_side() const {
    return method == Method::k_cta || (method == Method::cta && is_cta_mapped) ? map_side : 0;
  }
};

// Returns whether a material will have a VOTF: views that pass through it have a mask.
inline bool will_have_votf(bool has_mask, const CompressionSettings& s) {
  return has_mask && s.visibility != nook::material::VisibilityForm::none;
}
inline bool has_votf(const RawMaterial& raw, const CompressionSettings& s) {
  return will_have_votf(!raw.mask.empty(), s);
}

// Returns the settings of the VOTF, which a neural material has by K-CTA.
inline CompressionSettings votf_settings(CompressionSettings s) {
  if (s.method == Method::neural) s.method = Method::k_cta;
  return s;
}

// Returns false to stop. stage names what goes on.
using StageProgress = std::function<bool(const char* stage, std::size_t done, std::size_t total)>;

// Returns the default mapping of (26). Masks have the paper's, T = 0.5 and W = 1. For distances, visibility
// rises continuously over half a texel inwards from the boundary: T is the value of that distance, 0.197 at
// 96 texels, and W = 1 / T. The paper's T = 0.05 and W = 12, sdk's paper_mapping(), jump from 0.6 to 1.
nook::material::VisibilityMapping default_mapping(nook::material::VisibilityForm form, std::uint32_t width,
                                                  std::uint32_t height);

// Throws Failure INVALID_ARGUMENT for settings that no neural material has, whatever its data are.
void check_neural(const CompressionSettings& s);

// Ranks, clusters and mixture against the material's sizes; throws Failure(INVALID_ARGUMENT) that names the
// first that does not fit.
void check_settings(const CompressionSettings& settings, const RawMaterial& raw);

// The same before a material is traced, of which only the sizes and directions are there. has_mask: its views
// will have a mask.
void check_settings(const CompressionSettings& settings, const RawMaterial& sizes, bool has_mask);

// Sets the lowest ranks that a threshold chooses for a material of these sizes, to check the other settings
// before the threshold has values to choose by.
void set_lowest_ranks(const RawMaterial& sizes, CompressionSettings& settings);

// Both throw Failure(NOOK_ERROR_CANCELLED) when progress returns false. The same bits for the same seed on
// any number of threads.
struct CompressedBtf {
  std::vector<float> light_basis;  // as Material::light_basis
  nook::material::ClusteredTensor tensor;
  int iterations = 0;
};
CompressedBtf compress_btf(const RawMaterial& raw, const CompressionSettings& settings,
                           const StageProgress& progress = {});

// values: view x width x height, a mask or distances.
nook::material::ClusteredTensor compress_votf(const RawMaterial& raw, const std::vector<float>& values,
                                              const CompressionSettings& settings,
                                              const StageProgress& progress = {});

// The VOTF's values in a form: the mask, or its signed distances.
std::vector<float> votf_values(const RawMaterial& raw, nook::material::VisibilityForm form);

// A relief, and the raw material with its images on it; without one that moves texels raw is empty.
struct MovedMaterial {
  nook::material::Relief relief;
  RawMaterial raw;

  const RawMaterial& or_still(const RawMaterial& still) const { return relief.moves() ? raw : still; }
};
MovedMaterial move_views(const RawMaterial& raw, ReliefSource source, const StageProgress& progress = {});

// Both, and the directions, as a whole; without a mask in raw there is no VOTF. Numbers are not yet rounded:
// quantise() in sdk's material/material_file.h does.
nook::material::Material compress(const RawMaterial& raw, const CompressionSettings& settings,
                                  const StageProgress& progress = {});

// The same of views that move_views() has moved already; settings.relief is not read.
nook::material::Material compress_moved(const RawMaterial& raw, const MovedMaterial& moved,
                                        const CompressionSettings& settings,
                                        const StageProgress& progress = {});

// Sets the rounding of the cores of a material that is not rounded yet, so that it adds a hundredth to the
// squared error of the compression: 0.04 dB.
void set_core_rounding(const RawMaterial& raw, nook::material::Material& material);

// Chooses ranks as in section 6 of the paper, for light, view, x, y, and x, y of the VOTF: in each mode alone
// the smallest multiple of 4 at which the squared error stays below a share of the squared norm. Of a
// material with a relief, raw is what move_views() returns.
CompressionSettings ranks_by_threshold(const RawMaterial& raw, double share, CompressionSettings settings);

}  // namespace nook::bake::material
