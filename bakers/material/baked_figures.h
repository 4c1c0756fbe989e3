// The figures of a baked material, and its settings, as reports and recipes name them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bakers/material/compression.h"

namespace nook::bake::material {

struct BakedFigures {
  std::string method;  // "PCA", "N-SVD", "CTA", "K-CTA", "neural"
  std::uint32_t mixture = 1;
  std::optional<std::uint32_t> view_rank;  // in total over the clusters; of tensors
  // Of the whole file that a user ships, view maps of the settings' size included, and of the numbers alone
  // that the paper's Table I counts: numbers and indices without view maps.
  std::size_t file_bytes = 0, bytes = 0;
  double se_db = 0, psnr_db = 0;
  std::optional<double> psnr_toned_db;  // of toned() in btf_error.h
  std::optional<std::size_t> error_texels_binary, error_texels_distance;
  double seconds = 0;  // of the BTF and of one VOTF
};

// Measures a compressed material against the raw one. The seconds are the caller's.
BakedFigures measure_material(const RawMaterial& raw, const nook::material::Material& material);

const char* method_name(Method method);

// One row of the tables, with the most memory that the process has held so far. `more` stands before the
// seconds.
nlohmann::ordered_json report_row(const std::string& material, const BakedFigures& figures,
                                  const nlohmann::ordered_json& more = nlohmann::ordered_json::object());

// Returns the settings as the recipe of a file has them.
nlohmann::ordered_json describe(const CompressionSettings& settings);

}  // namespace nook::bake::material
