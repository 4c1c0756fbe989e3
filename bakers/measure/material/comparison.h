// Methods beside each other: one row of the paper's Table I.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/material/baked_figures.h"
#include "bakers/measure/material/grazing.h"
#include "bakers/measure/material/table_error.h"
#include "bakers/measure/material/view_jumps.h"

namespace nook::bake::material {

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
  // Jumps as the view moves, see view_jumps.h, and those of the material without its view map.
  std::optional<ViewJumps> jumps, jumps_without_map;
  int iterations = 0;  // of the BTF
};

// Compresses and measures what is left after rounding. `material`, where given, receives it
// with the VOTF of settings.visibility and with view maps; without it they are counted but not made.
MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings,
                         const StageProgress& progress = {}, nook::material::Material* material = nullptr);

// Principal components in the place of the BTF in another material's file, as many as its bytes hold: the
// VOTF and the rest of that file stay and are counted.
MethodRow measure_pca(const RawMaterial& raw, std::span<const std::byte> file, std::uint64_t seed);

// The maps of a physically based material with parallax, fitted to the raw one, and `unseen` where it is not
// null: relief shadows take a march for each light.
MethodRow measure_pbr(const RawMaterial& raw, const RawMaterial* unseen, bool has_shadows);

// The same tile as a neural material of one of two sizes, fitted to the raw one.
enum class NeuralSize {
  small,   // about 14 bytes for each texel
  filling  // the bytes of a whole file, of which VOTF and directions stay as in measure_pca
};
MethodRow measure_neural(const RawMaterial& raw, const RawMaterial* unseen, std::span<const std::byte> file,
                         NeuralSize size, std::uint64_t seed, const StageProgress& progress = {});

}  // namespace nook::bake::material
