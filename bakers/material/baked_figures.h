// The figures and the settings of a baked material, with the names that reports and recipes use.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bakers/material/compression.h"

namespace nook::bake::material {

struct BakedFigures {
  std::string method;  // "PCA", "N-SVD", "CTA", "K-CTA", "neural"
  std::uint32_t mixture = 1;
  std::optional<std::uint32_t> view_rank;  // only for tensors: total over the clusters
  // file_bytes is the size of the file that you ship, with view maps of the size in the settings. `bytes`
  // counts only numbers and indices, without view maps, like the paper's Table I.
  std::size_t file_bytes = 0, bytes = 0;
  double se_db = 0, psnr_db = 0;
  std::optional<double> psnr_toned_db;  // PSNR after toned() in btf_error.h
  std::optional<std::size_t> error_texels_binary, error_texels_distance;
  double seconds = 0;  // time to fit the BTF and one VOTF
};

// Compares a compressed material with the raw one. The caller must set the seconds.
BakedFigures measure_material(const RawMaterial& raw, const nook::material::Material& material);

const char* method_name(Method method);

// Returns one row of the tables, with the peak memory of the process so far. Entries of `more` are inserted
// before the seconds.
nlohmann::ordered_json report_row(const std::string& material, const BakedFigures& figures,
                                  const nlohmann::ordered_json& more = nlohmann::ordered_json::object());

// Returns the settings as they are stored in the recipe of a file.
nlohmann::ordered_json describe(const CompressionSettings& settings);

}  // namespace nook::bake::material
