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

  // The error of the material when it is drawn from textures (table_error.h), and the bytes of these textures
  // per texel.
  std::optional<double> se_db_drawn, se_db_drawn_unseen, gpu_bytes_texel;
  std::vector<LevelError> levels;     // for pixels that cover many texels
  std::vector<GrazingError> grazing;  // for pixels of tilted views
  // Errors in views, and under lights, that were not fitted.
  std::optional<double> se_db_unseen;
  std::optional<std::size_t> error_texels_unseen;
  // Jumps as the view moves (view_errors.h), with the material's view map and without it.
  std::optional<ViewJumps> jumps, jumps_without_map;
  int iterations = 0;  // for the BTF
};

// Returns the row of baked_figures.h with the additional measures.
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row);

}  // namespace nook::bake::material

namespace nook::measure {

// Returns the progress callback of the named method.
using MethodProgress = std::function<bake::material::StageProgress(const std::string& method)>;

// Returns the settings that can be derived from the sizes of a material's tensors. They include the view map
// if K-CTA made it.
bake::material::CompressionSettings settings_of(const nook::material::Material& material, std::uint64_t seed);

// A material and the bytes of the file that it was read from.
struct MaterialFile {
  std::span<const std::byte> bytes;
  const nook::material::Material& material;
};

// What to measure of a file in addition to its errors in the fitted views.
struct FileMeasures {
  const bake::material::RawMaterial* unseen = nullptr;  // measures errors in these views; null: none
  bool jumps = false, mipmaps = false, grazing = false;
  nook::material::ModeForm form;  // number format of the modes that are drawn
};
bake::material::MethodRow material_file_row(const bake::material::RawMaterial& raw, const MaterialFile& file,
                                            const FileMeasures& measures = {});

// Adds a material's error in unseen views and its jumps as the view moves. Used for files and for other
// methods.
void add_unseen(const bake::material::RawMaterial* unseen, const nook::material::Material& material,
                bake::material::MethodRow& row);
void add_jumps(const nook::material::Material& material, bake::material::MethodRow& row);

}  // namespace nook::measure
