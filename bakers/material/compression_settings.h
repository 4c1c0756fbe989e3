// The settings of a compression, and functions that check whether they are possible for a material.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

enum class Method : std::uint8_t { n_svd, cta, k_cta, neural };

enum class Seeding : std::uint8_t {
  directions,  // clusters of view directions (section 5.1 of the paper, parametric space)
  values,      // k-means of the views' sub-tensors
};

// The source of the relief onto which views are moved; see raw_relief.h.
enum class ReliefSource : std::uint8_t {
  none,
  estimated,  // estimated from the heights at which the views agree
  known,      // from RawMaterial::heights
};

inline constexpr std::uint32_t max_neural_steps = 1000000;

// The default bits of stored numbers.
inline constexpr std::uint32_t default_bits = 8;

struct CompressionSettings {
  Method method = Method::k_cta;
  std::uint32_t rank_light = 16;
  std::uint32_t rank_view = 80;  // for N-SVD, the rank; for CTA and K-CTA, the total over clusters, C times
                                 // the rank of a cluster
  std::uint32_t rank_x = 64, rank_y = 64;
  std::uint32_t votf_rank_x = 80, votf_rank_y = 80;
  std::uint32_t cluster_rank_view = 4;
  std::uint32_t clusters = 0;  // C; 0: rank_view / cluster_rank_view
  std::uint32_t mixture = 3;   // K of K-CTA
  // Number of further fits of the VOTF. Their targets depend only on whether a value is above or below the
  // threshold; see visibility_values.h.
  std::uint32_t votf_refits = 2;
  Seeding seeding = Seeding::directions;
  nook::material::VisibilityForm visibility = nook::material::VisibilityForm::distance;
  std::optional<nook::material::VisibilityMapping> mapping;  // none: default_mapping() below
  std::uint32_t map_side = 64;  // cells of the resampled view maps of K-CTA; 0: none
  double step_penalty = 0;      // penalty of steps in the BTF's view map, see tensor/resample.h; 0: none
  bool is_cta_mapped = false;   // CTA gets view maps too; each cell shows one cluster
  std::uint32_t bits = 16;      // bits of stored numbers, see Material in sdk's material/material.h
  ReliefSource relief = ReliefSource::none;
  // Used only for neural materials. The number of feature channels must be a multiple of 4.
  std::uint32_t neural_channels = 16, neural_steps = 8000;
  std::uint64_t seed = 1;

  std::uint32_t cluster_count() const {
    return clusters ? clusters : std::max(rank_view / cluster_rank_view, 1u);
  }
  // Returns the number of cells along a side of the view maps that the method makes, or 0 for none.
  std::uint32_t made_map_side() const {
    return method == Method::k_cta || (method == Method::cta && is_cta_mapped) ? map_side : 0;
  }
};

// Returns true if a material will have a VOTF. has_mask is true if views pass through the material in places.
inline bool will_have_votf(bool has_mask, const CompressionSettings& s) {
  return has_mask && s.visibility != nook::material::VisibilityForm::none;
}
inline bool has_votf(const RawMaterial& raw, const CompressionSettings& s) {
  return will_have_votf(!raw.mask.empty(), s);
}

// Returns the settings of the VOTF. A neural material compresses it by K-CTA.
inline CompressionSettings votf_settings(CompressionSettings s) {
  if (s.method == Method::neural) s.method = Method::k_cta;
  return s;
}

// Returns the default mapping of equation (26). For masks, it is the paper's mapping, T = 0.5 and W = 1. For
// distances, visibility rises continuously over half a texel from the boundary inwards: T is the value at
// that distance, 0.197 at 96 texels, and W = 1 / T. The paper's mapping for distances, T = 0.05 and W = 12
// (paper_mapping() in sdk), jumps from 0.6 to 1.
nook::material::VisibilityMapping default_mapping(nook::material::VisibilityForm form, std::uint32_t width,
                                                  std::uint32_t height);

// Throws Failure INVALID_ARGUMENT for settings that are invalid for every neural material.
void check_neural(const CompressionSettings& s);

// Checks ranks, clusters and mixture against the material's sizes. Throws Failure(INVALID_ARGUMENT) that
// names the first invalid setting.
void check_settings(const CompressionSettings& settings, const RawMaterial& raw);

// Like the function above, but before a material is traced, when only its sizes and directions are known.
// has_mask is true if its views will have a mask.
void check_settings(const CompressionSettings& settings, const RawMaterial& sizes, bool has_mask);

// Sets the lowest ranks that a threshold can choose for a material of these sizes. With them, you can check
// the other settings before the material is traced.
void set_lowest_ranks(const RawMaterial& sizes, CompressionSettings& settings);

// Sets the ranks of a built-in meso-structure by its name. A smaller version gets the largest ranks that it
// allows. If the name is not in meso_surface.h, returns false and sets nothing.
bool set_builtin_ranks(const RawMaterial& raw, CompressionSettings& settings);

}  // namespace nook::bake::material
