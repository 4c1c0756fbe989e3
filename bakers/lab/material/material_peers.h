// Fits other methods to the raw material of a compressed material, for comparison. Returns rows for the
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

// Compresses the raw material and measures the error after rounding. If `material` is not null, it receives
// the compressed material, with a VOTF in the form settings.visibility and with view maps. If it is null,
// view maps are not always computed. Their size and the size of the VOTF are counted in any case.
MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings,
                         const bake::material::StageProgress& progress = {},
                         nook::material::Material* material = nullptr);

// Replaces the BTF of another material's file by as many principal components as fit into the same bytes. The
// VOTF and the rest of the file are kept and counted.
MethodRow measure_pca(const RawMaterial& raw, std::span<const std::byte> file, std::uint64_t seed);

// Fits the maps of a physically based material with parallax to the raw material. If `unseen` is not null,
// also measures the maps on this raw material. Set has_shadows to draw relief shadows, which need a ray march
// for each light.
MethodRow measure_pbr(const RawMaterial& raw, const RawMaterial* unseen, bool has_shadows);

// The size of a neural material that is fitted to the same tile.
enum class NeuralSize {
  small,   // takes about 14 bytes per texel
  filling  // takes as many bytes as a whole file; as in measure_pca, VOTF and directions of the file are kept
           // and counted
};
MethodRow measure_neural(const RawMaterial& raw, const RawMaterial* unseen, std::span<const std::byte> file,
                         NeuralSize size, std::uint64_t seed,
                         const bake::material::StageProgress& progress = {});

// Returns n-svd, cta, k-cta-2, k-cta-3, k-cta-4, n-svd-filled, pca, pbr and neural.
std::vector<std::string> material_baseline_names();
// Returns all names except neural, which takes minutes.
std::vector<std::string> material_peer_names();

struct BaselineRequest {
  std::vector<std::string> names;       // from material_baseline_names
  const RawMaterial* unseen = nullptr;  // views or lights that were not used for any fit; may be null
  // Measures jumps while the view moves. CTA then gets view maps of the same size as in the file, as K-CTA
  // does.
  bool jumps = false;
  std::uint32_t votf_refits = 2;  // refits of the VOTF in the new fits
  MethodProgress progress;
  // Called with each material and its row after the measurement, to make pictures. May be empty.
  std::function<void(const std::string& name, const nook::material::Material& material, const MethodRow& row)>
      keep;
};

// Compresses the raw material again with each named method, with the ranks of the file. n-svd-filled and pca
// use as many bytes as the whole file.
nlohmann::ordered_json material_baseline_rows(const RawMaterial& raw, const MaterialFile& file,
                                              std::uint64_t seed, const BaselineRequest& request);

// Returns two rows for CTA and two rows for K-CTA with K = 3. In the first row of each, the initial clusters
// are chosen by directions, and in the second by values.
nlohmann::ordered_json seeding_rows(const RawMaterial& raw, const CompressionSettings& settings,
                                    const MethodProgress& progress);

}  // namespace nook::lab
