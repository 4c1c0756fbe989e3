// Rows of the report on a compressed material, as `nook evaluate material` prints them.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/material/baked_figures.h"
#include "bakers/measure/material/table_error.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

// One row of the paper's Table I, with additional measures.
struct MethodRow : BakedFigures {
  MethodRow() = default;
  explicit MethodRow(BakedFigures figures) : BakedFigures(std::move(figures)) {}

  // The error of the material when it is drawn from textures (see table_error.h), and the bytes of these
  // textures per texel.
  std::optional<double> se_db_drawn, se_db_drawn_unseen, gpu_bytes_texel;
  std::vector<LevelError> levels;     // errors for pixels that cover many texels
  std::vector<GrazingError> grazing;  // errors for pixels in tilted views
  // The error in views or under lights that were not used for the fit.
  std::optional<double> se_db_unseen;
  std::optional<std::size_t> error_texels_unseen;
  // Jumps of the radiance while the view moves (see view_errors.h), with the material's view map and without
  // it.
  std::optional<ViewJumps> jumps, jumps_without_map;
  int iterations = 0;  // iterations of the BTF's fit
};

// Returns the row that baked_figures.h makes, with the additional measures of MethodRow.
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row);

}  // namespace nook::bake::material

namespace nook::measure {

// Returns the progress callback of the named method.
using MethodProgress = std::function<bake::material::StageProgress(const std::string& method)>;

// Returns the settings that can be derived from the sizes of a material's tensors. If K-CTA made the
// material, the settings include the view map.
bake::material::CompressionSettings settings_of(const nook::material::Material& material, std::uint64_t seed);

// A material and the bytes of the file that it was read from.
struct MaterialFile {
  std::span<const std::byte> bytes;
  const nook::material::Material& material;
};

// The measures of a file that are requested in addition to its errors in the fitted views.
struct FileMeasures {
  const bake::material::RawMaterial* unseen = nullptr;  // also measures errors in these views; null: none
  bool jumps = false, mipmaps = false, grazing = false;
  nook::material::ModeForm form;  // number format of the modes that are drawn
};
bake::material::MethodRow material_file_row(const bake::material::RawMaterial& raw, const MaterialFile& file,
                                            const FileMeasures& measures = {});

// Adds the error of a material in unseen views, and its jumps while the view moves. This is used both for
// files and for other methods.
void add_unseen(const bake::material::RawMaterial* unseen, const nook::material::Material& material,
                bake::material::MethodRow& row);
void add_jumps(const nook::material::Material& material, bake::material::MethodRow& row);

}  // namespace nook::measure
