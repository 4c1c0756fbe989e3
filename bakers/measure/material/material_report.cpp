#include "bakers/measure/material/material_report.h"

namespace nook::bake::material {

nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (row.se_db_drawn) json["se_db_drawn"] = *row.se_db_drawn;
  if (row.se_db_drawn_unseen) json["se_db_drawn_unseen"] = *row.se_db_drawn_unseen;
  if (row.gpu_bytes_texel) json["gpu_bytes_texel"] = *row.gpu_bytes_texel;
  for (const LevelError& level : row.levels)
    json["mipmaps"].push_back(
        {{"texels", level.side}, {"se_db", level.se_db}, {"se_db_finest", level.se_db_finest}});
  for (const GrazingError& error : row.grazing) {
    const GrazingError& isotropic = row.grazing.front();
    auto& entry = json["grazing"].emplace_back(
        nlohmann::ordered_json{{"fetches", error.fetches}, {"mse", error.mse}, {"mse_raw", error.mse_raw}});
    // For a material with a single colour, the error of isotropic filtering is 0, so there is no ratio.
    if (isotropic.mse > 0) entry["of_isotropic"] = error.mse / isotropic.mse;
    if (isotropic.mse_raw > 0) entry["of_isotropic_raw"] = error.mse_raw / isotropic.mse_raw;
  }
  if (row.se_db_unseen) json["se_db_unseen"] = *row.se_db_unseen;
  if (row.error_texels_unseen) json["votf_error_texels_unseen"] = *row.error_texels_unseen;
  if (row.jumps) {
    json["jump_largest"] = row.jumps->largest;
    json["jump_99"] = row.jumps->percentile_99;
  }
  if (row.jumps_without_map) {
    json["jump_largest_without_map"] = row.jumps_without_map->largest;
    json["jump_99_without_map"] = row.jumps_without_map->percentile_99;
  }
  return report_row(material, row, json);
}

}  // namespace nook::bake::material

namespace nook::measure {

using namespace bake::material;
using nook::material::ClusteredTensor;
using nook::material::Material;
using nook::material::VisibilityForm;

CompressionSettings settings_of(const Material& material, std::uint64_t seed) {
  const bool is_neural = material.neural.is_used();
  const auto &btf = material.btf.shape, &votf = material.votf.shape;
  const ClusteredTensor& viewed = is_neural ? material.votf : material.btf;  // the tensor with the view modes
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
    s.neural_steps = 0;  // unknown, because no file stores it
    s.mixture = votf.mixture;
    return s;
  }
  s.rank_light = btf.rank_light;
  s.rank_x = btf.rank_x;
  s.rank_y = btf.rank_y;
  return s;
}

void add_unseen(const RawMaterial* unseen, const Material& material, MethodRow& row) {
  if (!unseen) return;
  const UnseenError error = measure_unseen(*unseen, material);
  row.se_db_unseen = error.se_db;
  row.error_texels_unseen = error.error_texels;
}

void add_jumps(const Material& material, MethodRow& row) {
  constexpr std::uint64_t seed = 1;  // fixed, so that all methods are measured on the same arcs
  row.jumps = measure_view_jumps(material, seed);
  if (material.btf.map.side == 0) return;
  Material without = material;
  without.btf.map = nook::material::ViewMap();
  row.jumps_without_map = measure_view_jumps(without, seed);
}

MethodRow material_file_row(const RawMaterial& raw, const MaterialFile& file, const FileMeasures& measures) {
  MethodRow own(measure_material(raw, file.material));
  own.method = "file: " + own.method;
  own.file_bytes = file.bytes.size();
  const nook::material::MaterialTables tables = nook::material::make_tables(
      file.material, {}, default_memory(), nook::material::default_map_side, measures.form);
  // For a neural material, the measured error is already the error of the drawn material.
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

}  // namespace nook::measure
