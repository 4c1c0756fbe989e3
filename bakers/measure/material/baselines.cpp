#include "bakers/measure/material/baselines.h"

#include <algorithm>

#include "bakers/measure/material/table_error.h"
#include "bakers/measure/material/unseen_views.h"
#include "bakers/measure/material/whole_file.h"
#include "sdk/src/material/check.h"

namespace nook::measure {
namespace {

using namespace bake::material;
using nook::material::ClusteredTensor;
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

void add_unseen(const RawMaterial* unseen, const Material& material, MethodRow& row) {
  if (!unseen) return;
  const UnseenError error = measure_unseen(*unseen, material);
  row.se_db_unseen = error.se_db;
  row.error_texels_unseen = error.error_texels;
}

void add_jumps(const Material& material, MethodRow& row) {
  constexpr std::uint64_t seed = 1;  // the same arcs for all methods
  row.jumps = measure_view_jumps(material, seed);
  if (material.btf.map.side == 0) return;
  Material without = material;
  without.btf.map = nook::material::ViewMap();
  row.jumps_without_map = measure_view_jumps(without, seed);
}

// The view rank at which an N-SVD of integers takes no more bytes than a file: they depend on the values, so
// that ranks are tried from where those of the first are in proportion.
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

// The view rank at which an N-SVD takes as many bytes as a file, its recipe counted: the text of the greatest
// rank is the longest.
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
  add_unseen(request.unseen, compressed, row);
  if (request.jumps) add_jumps(compressed, row);
  if (request.keep) request.keep(name, compressed, row);
  return row;
}

}  // namespace

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

CompressionSettings settings_of(const Material& material, std::uint64_t seed) {
  const bool is_neural = material.neural.is_used();
  const auto &btf = material.btf.shape, &votf = material.votf.shape;
  const ClusteredTensor& viewed = is_neural ? material.votf : material.btf;  // has the view modes
  CompressionSettings s;
  s.visibility = material.visibility;
  s.bits = material.bits;
  s.seed = seed;
  s.rank_view = viewed.shape.rank_view * viewed.shape.clusters;
  s.cluster_rank_view = viewed.shape.clusters > 1 ? viewed.shape.rank_view : 4;
  if (viewed.shape.clusters > 1 && viewed.shape.mixture > 1) s.map_side = viewed.map.side;
  if (material.visibility != VisibilityForm::none) {
    s.votf_rank_x = votf.rank_x;
    s.votf_rank_y = votf.rank_y;
  }
  if (is_neural) {
    s.method = Method::neural;
    s.neural_channels = material.neural.shape.channels;
    s.neural_steps = 0;  // unknown: it is in no file
    s.mixture = votf.mixture;
    return s;
  }
  s.rank_light = btf.rank_light;
  s.rank_x = btf.rank_x;
  s.rank_y = btf.rank_y;
  return s;
}

MethodRow material_file_row(const RawMaterial& raw, const MaterialFile& file, const FileMeasures& measures) {
  MethodRow own(measure_material(raw, file.material));
  own.method = "file: " + own.method;
  own.file_bytes = file.bytes.size();
  const nook::material::MaterialTables tables = nook::material::make_tables(
      file.material, {}, default_memory(), nook::material::default_map_side, measures.form);
  // A network is measured as it is drawn.
  own.se_db_drawn = tables.neural.is_used() ? own.se_db : measure_tables(raw, tables).se_db();
  own.gpu_bytes_texel = table_bytes_texel(tables);
  if (measures.mipmaps) own.levels = measure_levels(raw, tables);
  if (measures.grazing) own.grazing = measure_grazing(raw, tables);
  add_unseen(measures.unseen, file.material, own);
  if (measures.unseen && !tables.neural.is_used())
    own.se_db_drawn_unseen = measure_tables(*measures.unseen, tables).se_db();
  if (measures.jumps) add_jumps(file.material, own);
  return own;
}

Json material_baseline_rows(const RawMaterial& raw, const MaterialFile& file, std::uint64_t seed,
                            const BaselineRequest& request) {
  if (std::any_of(std::begin(baselines), std::end(baselines),
                  [&](const Baseline& baseline) { return contains(request.names, baseline.name); }) ||
      contains(request.names, n_svd_filled_name))
    nook::material::refuse_neural(file.material.neural.is_used(), "a fit at equal ranks");
  CompressionSettings settings = settings_of(file.material, seed);
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

}  // namespace nook::measure
