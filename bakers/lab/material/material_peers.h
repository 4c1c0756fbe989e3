// Fits the methods that a compressed material competes with to the same raw material, and returns rows of the
// report of `nook-lab evaluate material`.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/material/material_report.h"

namespace nook::lab {

using bake::material::CompressionSettings;
using bake::material::MethodRow;
using bake::material::RawMaterial;
using measure::MaterialFile;
using measure::MethodProgress;

// Compresses, and measures the error after rounding. If `material` is given, it receives the result with the
// VOTF of settings.visibility and with view maps. Otherwise, they are counted but not made.
MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings,
                         const bake::material::StageProgress& progress = {},
                         nook::material::Material* material = nullptr);

// Replaces the BTF in another material's file by as many principal components as its bytes hold. The VOTF and
// the rest of the file stay and are counted.
MethodRow measure_pca(const RawMaterial& raw, std::span<const std::byte> file, std::uint64_t seed);

// Fits the maps of a physically based material with parallax to the raw one, and measures them in `unseen` if
// it is not null. Relief shadows take a march for each light.
MethodRow measure_pbr(const RawMaterial& raw, const RawMaterial* unseen, bool has_shadows);

// Fits a neural material of one of two sizes to the same tile.
enum class NeuralSize {
  small,   // about 14 bytes per texel
  filling  // the bytes of a whole file; VOTF and directions stay as in measure_pca
};
MethodRow measure_neural(const RawMaterial& raw, const RawMaterial* unseen, std::span<const std::byte> file,
                         NeuralSize size, std::uint64_t seed,
                         const bake::material::StageProgress& progress = {});

// n-svd, cta, k-cta-2, k-cta-3, k-cta-4, n-svd-filled, pca, pbr, neural.
std::vector<std::string> material_baseline_names();
// All but neural, which takes minutes.
std::vector<std::string> material_peer_names();

struct BaselineRequest {
  std::vector<std::string> names;       // from material_baseline_names
  const RawMaterial* unseen = nullptr;  // views or lights that no fit has used; null: none
  // Measure jumps as the view moves. CTA then has view maps of the file's size, like K-CTA.
  bool jumps = false;
  std::uint32_t votf_refits = 2;  // for the new fits
  MethodProgress progress;
  // Receives each material after its measurement, and its row, for pictures. May be empty.
  std::function<void(const std::string& name, const nook::material::Material& material, const MethodRow& row)>
      keep;
};

// Compresses the raw material again by each named method, at the ranks of the file. n-svd-filled and PCA take
// as many bytes as the whole file.
nlohmann::ordered_json material_baseline_rows(const RawMaterial& raw, const MaterialFile& file,
                                              std::uint64_t seed, const BaselineRequest& request);

// CTA and K-CTA with K = 3, with first clusters by directions and by values.
nlohmann::ordered_json seeding_rows(const RawMaterial& raw, const CompressionSettings& settings,
                                    const MethodProgress& progress);

}  // namespace nook::lab
