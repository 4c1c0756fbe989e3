// A compressed material beside the methods that it competes with, as rows of the report of `nook evaluate
// material`.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/measure/material/report.h"
#include "bakers/measure/material/sweep.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/tables.h"

namespace nook::measure {

// n-svd, cta, k-cta-2, k-cta-3, k-cta-4, n-svd-filled, pca, pbr, neural.
std::vector<std::string> material_baseline_names();
// All but neural, which takes minutes.
std::vector<std::string> material_peer_names();

// The settings that the sizes of a material's tensors give: those of its view map where K-CTA made it.
bake::material::CompressionSettings settings_of(const nook::material::Material& material, std::uint64_t seed);

struct BaselineRequest {
  std::vector<std::string> names;                       // of material_baseline_names
  const bake::material::RawMaterial* unseen = nullptr;  // views, and lights, of no fit; null: none
  // Measure jumps as the view moves. CTA then has view maps of the file's size, as K-CTA has.
  bool jumps = false;
  std::uint32_t votf_refits = 2;  // of the new fits
  MethodProgress progress;
  // Receives each material after it was measured, and its row, for pictures. May be empty.
  std::function<void(const std::string& name, const nook::material::Material& material,
                     const bake::material::MethodRow& row)>
      keep;
};

// A material and the bytes of the file that it was read from.
struct MaterialFile {
  std::span<const std::byte> bytes;
  const nook::material::Material& material;
};

// Measures of a file beside its errors in the fitted views.
struct FileMeasures {
  const bake::material::RawMaterial* unseen = nullptr;  // errors in these views; null: none
  bool jumps = false, mipmaps = false, grazing = false;
  nook::material::ModeForm form;  // of the modes of what is drawn
};
bake::material::MethodRow material_file_row(const bake::material::RawMaterial& raw, const MaterialFile& file,
                                            const FileMeasures& measures = {});

// Compresses the raw material anew by each named method, at the ranks of the file; n-svd-filled and PCA take
// as many bytes as the whole file.
nlohmann::ordered_json material_baseline_rows(const bake::material::RawMaterial& raw,
                                              const MaterialFile& file, std::uint64_t seed,
                                              const BaselineRequest& request);

// CTA and K-CTA with K = 3, each from first clusters by directions and by values.
nlohmann::ordered_json seeding_rows(const bake::material::RawMaterial& raw,
                                    const bake::material::CompressionSettings& settings,
                                    const MethodProgress& progress);

}  // namespace nook::measure
