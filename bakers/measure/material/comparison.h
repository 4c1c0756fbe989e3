// Methods beside each other: one row of the paper's Table I.
#pragma once

#include <optional>
#include <string>

#include "bakers/material/compression.h"

namespace nook::bake::material {

struct MethodRow {
  std::string method;  // "PCA", "N-SVD", "CTA", "K-CTA"
  std::uint32_t mixture = 1;
  std::size_t bytes =
      0;  // half floats and indices, view maps apart; with the VOTF of distances where there is one
  double se_db = 0, psnr_db = 0;
  std::optional<std::size_t> error_texels_binary, error_texels_distance;
  // In views that the fit has not seen.
  std::optional<double> se_db_unseen;
  std::optional<std::size_t> error_texels_unseen;
  double seconds = 0;  // of the BTF and of one VOTF
  int iterations = 0;  // of the BTF
};

// Compresses and measures what is left after rounding to half floats. `material`, where given, receives it
// with the VOTF of settings.visibility; without it no view maps are made.
MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings,
                         const StageProgress& progress = {}, nook::material::Material* material = nullptr);

// A material that is there already.
MethodRow measure_material(const RawMaterial& raw, const nook::material::Material& material);

// As many bytes of principal components as the BTF of another row takes.
MethodRow measure_pca(const RawMaterial& raw, std::size_t bytes, std::uint64_t seed);

const char* method_name(Method method);

}  // namespace nook::bake::material
