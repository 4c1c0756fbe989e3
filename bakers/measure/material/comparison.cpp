#include "bakers/measure/material/comparison.h"

#include "bakers/material/btf_error.h"
#include "bakers/material/neural_training.h"
#include "bakers/measure/material/pbr_tile.h"
#include "bakers/measure/material/pca.h"
#include "bakers/measure/material/whole_file.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_file.h"

namespace nook::bake::material {

using nook::material::Material;
using nook::material::VisibilityForm;

MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings, const StageProgress& progress,
                         Material* material) {
  const std::uint32_t map_side = settings.made_map_side();
  const nlohmann::ordered_json recipe = describe(settings);
  // Rows of half floats take the same room whatever they hold.
  if (!material && settings.bits == 16) settings.map_side = 0;
  const platform::Stopwatch watch;
  Material whole = compress(raw, settings, progress);
  const double seconds = watch.seconds();
  whole.recipe = recipe.dump().c_str();
  set_core_rounding(raw, whole);
  whole = nook::material::quantise(whole);
  MethodRow row(measure_material(raw, whole));
  row.file_bytes = whole_file_bytes(whole, map_side);
  row.method = method_name(settings.method);
  row.seconds = seconds;
  if (whole.visibility != VisibilityForm::none) {
    // The other form beside it, at the same ranks.
    CompressionSettings other = settings;
    other.map_side = 0;
    other.visibility =
        settings.visibility == VisibilityForm::binary ? VisibilityForm::distance : VisibilityForm::binary;
    Material second;
    second.bits = whole.bits;
    second.lights = whole.lights;
    second.views = whole.views;
    second.light_basis = whole.light_basis;
    second.btf = whole.btf;
    second.visibility = other.visibility;
    second.mapping = nook::material::paper_mapping(other.visibility);
    second.votf = compress_votf(raw, votf_values(raw, other.visibility), other, progress);
    second = nook::material::quantise(second);
    (other.visibility == VisibilityForm::binary ? row.error_texels_binary : row.error_texels_distance) =
        count_error_texels(raw, second.votf, other.visibility);
  }
  if (material) *material = std::move(whole);
  return row;
}

MethodRow measure_pca(const RawMaterial& raw, std::span<const std::byte> file, std::uint64_t seed) {
  const platform::Stopwatch watch;
  const std::size_t beside = bytes_beside_btf(file);
  const PcaResult pca = fit_pca(raw, file.size() - beside, seed);
  MethodRow row;
  row.method = "PCA";
  row.bytes = pca.bytes;
  row.file_bytes = beside + pca.bytes;
  row.se_db = pca.se_db;
  row.psnr_db = pca.psnr_db;
  row.seconds = watch.seconds();
  return row;
}

MethodRow measure_pbr(const RawMaterial& raw, const RawMaterial* unseen, bool has_shadows) {
  const platform::Stopwatch watch;
  const PbrTile tile = fit_pbr_tile(raw, has_shadows);
  MethodRow row;
  row.method = has_shadows ? "PBR, parallax and shadows" : "PBR, parallax";
  row.seconds = watch.seconds();
  row.bytes = row.file_bytes = tile.bytes();
  const BtfError error = measure_pbr_tile(raw, tile);
  row.se_db = error.se_db();
  row.psnr_db = error.psnr_db();
  row.psnr_toned_db = error.psnr_toned_db();
  if (unseen) row.se_db_unseen = measure_pbr_tile(*unseen, tile).se_db();
  return row;
}

MethodRow measure_neural(const RawMaterial& raw, const RawMaterial* unseen, std::span<const std::byte> file,
                         NeuralSize size, std::uint64_t seed, const StageProgress& progress) {
  const platform::Stopwatch watch;
  const std::size_t beside = bytes_beside_btf(file);
  NeuralSettings settings;
  settings.seed = seed;
  if (size == NeuralSize::filling) settings.shape = filling_neural_shape(raw, file.size() - beside);
  const NeuralTile tile = fit_neural_tile(raw, settings, progress);
  MethodRow row;
  row.method = size == NeuralSize::small ? "neural, small" : "neural, equal bytes";
  row.seconds = watch.seconds();
  row.bytes = tile.bytes();
  row.file_bytes = beside + tile.bytes();
  row.gpu_bytes_texel = double(tile.bytes()) / double(raw.texels());
  const BtfError error = measure_neural_tile(raw, tile);
  row.se_db = error.se_db();
  row.psnr_db = error.psnr_db();
  row.psnr_toned_db = error.psnr_toned_db();
  if (unseen) row.se_db_unseen = measure_neural_tile(*unseen, tile).se_db();
  return row;
}

}  // namespace nook::bake::material
