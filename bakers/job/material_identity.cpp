#include "bakers/job/material_identity.h"

#include "bakers/import/content_hash.h"

namespace nook::bake {
namespace {

using Json = nlohmann::json;
using namespace nook::bake::material;

Json parameters_of(const MesoParameters& p) {
  return {{"name", p.name},           {"count", p.count},   {"radius", p.radius}, {"thickness", p.thickness},
          {"roughness", p.roughness}, {"detail", p.detail}, {"seed", p.seed}};
}

Json settings_of(const TraceSettings& t) {
  return {{"width", t.width},
          {"height", t.height},
          {"samples", t.samples},
          {"bounces", t.bounces},
          {"bounce_rays", t.bounce_rays},
          {"seed", t.seed},
          {"finds_heights", t.finds_heights}};
}

}  // namespace

std::string content_hash(const RawMaterial& raw) {
  ContentHash hash;
  hash.add(std::string_view("nook raw material 1"));
  hash.add(raw.name);  // the ranks of built-in materials depend on their names
  hash.add_list(raw.lights);
  hash.add_list(raw.views);
  hash.add(raw.width);
  hash.add(raw.height);
  hash.add_list(raw.btf);
  hash.add_list(raw.mask);
  hash.add_list(raw.heights);
  return hash.hex();
}

std::string content_hash(const MesoSurface& surface) {
  ContentHash hash;
  hash.add(std::string_view("nook meso-surface 1"));
  hash.add_list(surface.position);
  hash.add_list(surface.normal);
  hash.add_list(surface.albedo);
  hash.add_list(surface.triangle);
  hash.add(surface.specular);
  hash.add(surface.shininess);
  hash.add_list(surface.ggx_width);
  hash.add_list(surface.reflectance);
  return hash.hex();
}

std::string content_hash(const PbrMaps& maps) {
  static_assert(sizeof(MapSlope) == 3 * sizeof(float));
  ContentHash hash;
  hash.add(std::string_view("nook maps 1"));
  hash.add(maps.side);
  hash.add_list(maps.base_colour);
  hash.add_list(maps.height);
  hash.add_list(maps.slope);
  hash.add_list(maps.squared_width);
  hash.add_list(maps.metalness);
  return hash.hex();
}

Json settings_of(const CompressionSettings& s) {
  Json settings = {{"method", int(s.method)},
                   {"rank_light", s.rank_light},
                   {"rank_view", s.rank_view},
                   {"rank_x", s.rank_x},
                   {"rank_y", s.rank_y},
                   {"votf_rank_x", s.votf_rank_x},
                   {"votf_rank_y", s.votf_rank_y},
                   {"cluster_rank_view", s.cluster_rank_view},
                   {"clusters", s.clusters},
                   {"mixture", s.mixture},
                   {"votf_refits", s.votf_refits},
                   {"seeding", int(s.seeding)},
                   {"visibility", int(s.visibility)},
                   {"map_side", s.map_side},
                   {"step_penalty", s.step_penalty},
                   {"is_cta_mapped", s.is_cta_mapped},
                   {"bits", s.bits},
                   {"relief", int(s.relief)},
                   {"neural_channels", s.neural_channels},
                   {"neural_steps", s.neural_steps},
                   {"seed", s.seed}};
  if (s.mapping) settings["mapping"] = {s.mapping->threshold, s.mapping->weight};
  return settings;
}

Json settings_of(const MesoSource& source) {
  Json settings = {{"views", source.views},
                   {"lights", source.lights ? source.lights : source.views},
                   {"max_tilt_deg", source.max_tilt_deg},
                   {"trace", settings_of(source.trace)}};
  if (!source.tile) settings["meso"] = parameters_of(source.meso);
  return settings;
}

Json inputs_of(const MesoSource& source) {
  Json inputs = Json::object();
  if (source.tile) inputs["surface"] = content_hash(*source.tile);
  return inputs;
}

BakeIdentity identify_material(const MaterialTask& task) {
  Json settings = {{"compression", settings_of(task.settings)},
                   {"ranks_given", task.ranks_given},
                   {"votf_ranks_given", task.votf_ranks_given},
                   {"rank_threshold", task.rank_threshold}};
  if (task.meso) settings["meso"] = parameters_of(*task.meso);
  if (task.meso) settings["trace"] = settings_of(task.trace);
  ContentHash coverage;
  coverage.add_list(task.coverage);
  // For a structure, nothing has been traced yet, so the raw material contains only sizes and directions.
  return identify_bake(BakeKind::material, settings,
                       {{"raw", content_hash(task.raw)}, {"coverage", coverage.hex()}});
}

}  // namespace nook::bake
