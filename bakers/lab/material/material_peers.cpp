#include "bakers/lab/material/material_peers.h"

#include <algorithm>

#include "bakers/lab/material/equal_bytes.h"
#include "bakers/lab/material/pbr_tile.h"
#include "bakers/material/btf_error.h"
#include "bakers/material/neural_training.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"

namespace nook::lab {
namespace {

using namespace bake::material;
using nook::material::Material;
using nook::material::VisibilityForm;
using Json = nlohmann::ordered_json;

struct Baseline {
  const char* name;
  Method method;
  std::uint32_t mixture;
};
constexpr Baseline baselines[] = {{"n-svd", Method::n_svd, 1},
                                  {"cta", Method::cta, 1},
                                  {"k-cta-2", Method::k_cta, 2},
                                  {"k-cta-3", Method::k_cta, 3},
                                  {"k-cta-4", Method::k_cta, 4}};
constexpr const char *pca_name = "pca", *n_svd_filled_name = "n-svd-filled", *pbr_name = "pbr",
                     *neural_name = "neural";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Returns the view rank with which an N-SVD with integer values takes at most as many bytes as a given file.
// The size depends on the values, so the function tries several ranks. The first guess is extrapolated from
// the size of one trial fit.
std::uint32_t filling_view_rank_of_integers(const RawMaterial& raw, CompressionSettings s,
                                            std::size_t file_bytes, const StageProgress& progress) {
  s.method = Method::n_svd;
  const auto views = std::uint32_t(raw.views.size());
  for (int tries = 0; tries < 6 && s.rank_view > 0; ++tries) {
    const std::size_t bytes = measure_method(raw, s, progress).file_bytes;
    const auto next = std::uint32_t(double(s.rank_view) * double(file_bytes) / double(bytes));
    if (next == s.rank_view || (bytes <= file_bytes && (next <= s.rank_view || s.rank_view == views)))
      return s.rank_view;
    s.rank_view = std::min(next, views);
  }
  return s.rank_view;
}

// Returns the view rank with which an N-SVD takes as many bytes as a given file. The recipe is counted as
// well. Its length is taken from the largest rank, which has the longest recipe.
std::uint32_t filling_view_rank(const RawMaterial& raw, CompressionSettings s, std::size_t file_bytes) {
  s.method = Method::n_svd;
  s.rank_view = std::uint32_t(raw.views.size());
  const std::size_t recipe = describe(s).dump().size();
  return file_bytes > recipe ? n_svd_view_rank(raw, s, file_bytes - recipe) : 0;
}

MethodRow measure_baseline(const RawMaterial& raw, const CompressionSettings& s, const std::string& name,
                           const BaselineRequest& request) {
  Material compressed;
  MethodRow row = measure_method(raw, s, request.progress(name + ", "), &compressed);
  measure::add_unseen(request.unseen, compressed, row);
  if (request.jumps) measure::add_jumps(compressed, row);
  if (request.keep) request.keep(name, compressed, row);
  return row;
}

}  // namespace

MethodRow measure_method(const RawMaterial& raw, CompressionSettings settings, const StageProgress& progress,
                         Material* material) {
  const std::uint32_t map_side = settings.made_map_side();
  const nlohmann::ordered_json recipe = describe(settings);
  // With half floats, the size of a row does not depend on its values. View maps can thus be counted without
  // computing them.
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
    // Also measures the other VOTF form at the same ranks.
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

std::vector<std::string> material_peer_names() {
  std::vector<std::string> names;
  for (const Baseline& baseline : baselines) names.emplace_back(baseline.name);
  names.emplace_back(n_svd_filled_name);
  names.emplace_back(pca_name);
  names.emplace_back(pbr_name);
  return names;
}

std::vector<std::string> material_baseline_names() {
  std::vector<std::string> names = material_peer_names();
  names.emplace_back(neural_name);
  return names;
}

Json material_baseline_rows(const RawMaterial& raw, const MaterialFile& file, std::uint64_t seed,
                            const BaselineRequest& request) {
  if (std::any_of(std::begin(baselines), std::end(baselines),
                  [&](const Baseline& baseline) { return contains(request.names, baseline.name); }) ||
      contains(request.names, n_svd_filled_name))
    nook::material::refuse_neural(file.material.neural.is_used(), "a fit at equal ranks");
  CompressionSettings settings = measure::settings_of(file.material, seed);
  settings.votf_refits = request.votf_refits;
  settings.is_cta_mapped = request.jumps;
  Json rows = Json::array();
  for (const Baseline& baseline : baselines) {
    CompressionSettings s = settings;
    s.method = baseline.method;
    s.mixture = baseline.mixture;
    if (!contains(request.names, baseline.name) ||
        (s.method == Method::k_cta && s.mixture > s.cluster_count()))
      continue;
    rows.push_back(report_row(raw.name, measure_baseline(raw, s, baseline.name, request)));
  }
  const bool fills = contains(request.names, n_svd_filled_name);
  const std::uint32_t filling =
      !fills                ? 0
      : settings.bits == 16 ? filling_view_rank(raw, settings, file.bytes.size())
                            : filling_view_rank_of_integers(raw, settings, file.bytes.size(),
                                                            request.progress("N-SVD of equal bytes, "));
  if (filling > 0) {
    CompressionSettings s = settings;
    s.method = Method::n_svd;
    s.rank_view = filling;
    MethodRow row = measure_baseline(raw, s, n_svd_filled_name, request);
    row.method = "N-SVD, equal bytes";
    rows.push_back(report_row(raw.name, row));
  }
  if (contains(request.names, pca_name)) {
    request.progress("")("principal components", 0, 1);
    rows.push_back(report_row(raw.name, measure_pca(raw, file.bytes, settings.seed)));
  }
  if (contains(request.names, pbr_name))
    for (const bool has_shadows : {false, true}) {
      request.progress("")("physically based maps", 0, 1);
      rows.push_back(report_row(raw.name, measure_pbr(raw, request.unseen, has_shadows)));
    }
  if (contains(request.names, neural_name))
    for (const NeuralSize size : {NeuralSize::small, NeuralSize::filling})
      rows.push_back(report_row(raw.name, measure_neural(raw, request.unseen, file.bytes, size, settings.seed,
                                                         request.progress("neural material, "))));
  return rows;
}

Json seeding_rows(const RawMaterial& raw, const CompressionSettings& settings,
                  const MethodProgress& progress) {
  Json rows = Json::array();
  for (const Seeding seeding : {Seeding::directions, Seeding::values})
    for (const std::uint32_t mixture : {1u, 3u}) {
      CompressionSettings s = settings;
      s.seeding = seeding;
      s.method = mixture == 1 ? Method::cta : Method::k_cta;
      s.mixture = mixture;
      if (mixture > s.cluster_count()) continue;
      const char* name = seeding == Seeding::directions ? "directions" : "values";
      rows.push_back(
          report_row(raw.name, measure_method(raw, s, progress(std::string("seeds of ") + name + ", "))));
      rows.back()["seeding"] = name;
    }
  return rows;
}

}  // namespace nook::lab
