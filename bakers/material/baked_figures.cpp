#include "bakers/material/baked_figures.h"

#include "bakers/material/btf_error.h"
#include "platform/peak_memory.h"
#include "sdk/src/material/material_file.h"

namespace nook::bake::material {
namespace {

using nook::material::Material;
using nook::material::VisibilityForm;

Method method_of(const Material& material) {
  if (material.neural.is_used()) return Method::neural;
  const auto& shape = material.btf.shape;
  return shape.clusters == 1 ? Method::n_svd : shape.mixture == 1 ? Method::cta : Method::k_cta;
}

}  // namespace

const char* method_name(Method method) {
  constexpr const char* names[] = {"N-SVD", "CTA", "K-CTA", "neural"};
  return names[std::size_t(method)];
}

BakedFigures measure_material(const RawMaterial& raw, const Material& material) {
  BakedFigures row;
  row.method = method_name(method_of(material));
  row.mixture = material.btf.shape.mixture;
  if (!material.neural.is_used()) row.view_rank = material.btf.shape.rank_view * material.btf.shape.clusters;
  row.bytes = nook::material::compressed_bytes(material);
  row.file_bytes = nook::material::write_material(material).size();
  const BtfError error = measure_btf(raw, material);
  row.se_db = error.se_db();
  row.psnr_db = error.psnr_db();
  row.psnr_toned_db = error.psnr_toned_db();
  if (material.visibility == VisibilityForm::none || raw.mask.empty()) return row;
  (material.visibility == VisibilityForm::binary ? row.error_texels_binary : row.error_texels_distance) =
      count_error_texels(raw, material.votf, material.visibility);
  return row;
}

nlohmann::ordered_json report_row(const std::string& material, const BakedFigures& figures,
                                  const nlohmann::ordered_json& more) {
  nlohmann::ordered_json json = {{"material", material}, {"method", figures.method}, {"k", figures.mixture}};
  json["view_rank"] =
      figures.view_rank ? nlohmann::ordered_json(*figures.view_rank) : nlohmann::ordered_json();
  json["file_bytes"] = figures.file_bytes;
  json["bytes"] = figures.bytes;
  json["se_db"] = figures.se_db;
  json["psnr_db"] = figures.psnr_db;
  if (figures.psnr_toned_db) json["psnr_toned_db"] = *figures.psnr_toned_db;
  const auto texels = [&](const char* key, const std::optional<std::size_t>& count) {
    json[key] = count ? nlohmann::ordered_json(*count) : nlohmann::ordered_json();
  };
  texels("votf_error_texels_binary", figures.error_texels_binary);
  texels("votf_error_texels_distance", figures.error_texels_distance);
  json.update(more);
  json["seconds"] = figures.seconds;
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
