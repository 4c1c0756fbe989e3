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

// One row of the paper's Table I, with all that is measured besides.
struct MethodRow : BakedFigures {
  MethodRow() = default;
  explicit MethodRow(BakedFigures figures) : BakedFigures(std::move(figures)) {}

  // As drawn from textures, see table_error.h: the error, and the textures' bytes for each texel.
  std::optional<double> se_db_drawn, se_db_drawn_unseen, gpu_bytes_texel;
  std::vector<LevelError> levels;     // of pixels that cover many texels
  std::vector<GrazingError> grazing;  // of pixels of tilted views
  // Errors in views, and under lights, that were not fitted.
  std::optional<double> se_db_unseen;
  std::optional<std::size_t> error_texels_unseen;
  // Jumps as the view moves, see view_errors.h, and those of the material without its view map.
  std::optional<ViewJumps> jumps, jumps_without_map;
  int iterations = 0;  // of the BTF
};

// The row of baked_figures.h with all that was measured besides.
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row);

}  // namespace nook::bake::material

namespace nook::measure {

// Returns the progress of one method, whose name it is given.
using MethodProgress = std::function<bake::material::StageProgress(const std::string& method)>;

// The settings that the sizes of a material's tensors give: those of its view map where K-CTA made it.
bake::material::CompressionSettings settings_of(const nook::material::Material& material, std::uint64_t seed);

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

// The error in unseen views, and jumps as the view moves, of a material, the same for the file and for other
// methods.
void add_unseen(const bake::material::RawMaterial* unseen, const nook::material::Material& material,
                bake::material::MethodRow& row);
void add_jumps(const nook::material::Material& material, bake::material::MethodRow& row);

}  // namespace nook::measure
