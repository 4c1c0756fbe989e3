#include "bakers/measure/material/report.h"

#include "platform/peak_memory.h"

namespace nook::bake::material {
nlohmann::ordered_json report_row(const std::string& material, const MethodRow& row) {
  nlohmann::ordered_json json = {{"material", material}, {"method", row.method}, {"k", row.mixture}};
  json["view_rank"] = row.view_rank ? nlohmann::ordered_json(*row.view_rank) : nlohmann::ordered_json();
  json["file_bytes"] = row.file_bytes;
  json["bytes"] = row.bytes;
  json["se_db"] = row.se_db;
  json["psnr_db"] = row.psnr_db;
  if (row.psnr_toned_db) json["psnr_toned_db"] = *row.psnr_toned_db;
  const auto texels = [&](const char* key, const std::optional<std::size_t>& count) {
    json[key] = count ? nlohmann::ordered_json(*count) : nlohmann::ordered_json();
  };
  texels("votf_error_texels_binary", row.error_texels_binary);
  texels("votf_error_texels_distance", row.error_texels_distance);
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
    // A material of one colour has no error to compare with.
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
  json["seconds"] = row.seconds;
  json["peak_bytes"] = platform::peak_bytes();
  return json;
}

nlohmann::ordered_json describe(const CompressionSettings& settings) {
  const bool is_neural = settings.method == Method::neural;
  const CompressionSettings s = votf_settings(settings);
  const char* const votf = s.visibility == nook::material::VisibilityForm::none     ? "none"
                           : s.visibility == nook::material::VisibilityForm::binary ? "binary"
                                                                                    : "distance";
  nlohmann::ordered_json json = {{"method", method_name(settings.method)}};
  if (is_neural) {
    json["channels"] = s.neural_channels;
    if (s.neural_steps > 0) json["steps"] = s.neural_steps;
  } else {
    json["ranks"] = {s.rank_light, s.rank_view, s.rank_x, s.rank_y};
  }
  json["votf"] = votf;
  json["seed"] = s.seed;
  if (is_neural && s.visibility == nook::material::VisibilityForm::none) return json;
  json["votf_ranks"] = {s.votf_rank_x, s.votf_rank_y};
  json["cluster_rank"] = s.method == Method::n_svd ? s.rank_view : s.cluster_rank_view;
  json["clusters"] = s.method == Method::n_svd ? 1 : s.cluster_count();
  json["mixture"] = s.method == Method::k_cta ? s.mixture : 1;
  json["seeding"] = s.seeding == Seeding::directions ? "directions" : "values";
  json["votf_refits"] = s.votf_refits;
  json["view_map"] = s.made_map_side();
  json["bits"] = s.bits;
  if (s.step_penalty > 0) json["step_penalty"] = s.step_penalty;
  if (s.relief != ReliefSource::none)
    json["relief"] = s.relief == ReliefSource::known ? "known" : "estimated";
  return json;
}

}  // namespace nook::bake::material
