#include "bakers/measure/material/report.h"

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
  return report_row(material, row, json);
}

}  // namespace nook::bake::material
