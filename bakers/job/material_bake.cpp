#include "bakers/job/material_bake.h"

#include <string_view>

#include "bakers/material/builtin_ranks.h"
#include "bakers/material/fill_gaps.h"
#include "bakers/measure/material/report.h"
#include "platform/stopwatch.h"
#include "sdk/src/material/material_file.h"

namespace nook::bake {
namespace {

using namespace material;
using Json = nlohmann::ordered_json;

RawMaterial obtain(MaterialTask& task, const StageReport& progress) {
  if (!task.meso) {
    RawMaterial raw = std::move(task.raw);
    if (!task.coverage.empty()) fill_gaps(raw, task.coverage);
    return raw;
  }
  RawMaterial raw = trace_material(
      make_meso_surface(*task.meso), task.raw.lights, task.raw.views, task.trace,
      [&](std::size_t done, std::size_t total) { return progress(JobStage::raytrace, done, total); });
  raw.name = task.meso->name;
  return raw;
}

// Chooses the defaults of `nook bake material`. raw has the images that are fitted: on the relief, if there
// is one.
CompressionSettings settings_for(const MaterialTask& task, const RawMaterial& raw) {
  CompressionSettings s = task.settings;
  const bool has_ranks = s.method != Method::neural || has_votf(raw, s);
  if (has_ranks && !task.ranks_given && !set_builtin_ranks(raw, s))
    s = ranks_by_threshold(raw, task.rank_threshold, s);
  if (task.votf_ranks_given) {
    s.votf_rank_x = task.settings.votf_rank_x;
    s.votf_rank_y = task.settings.votf_rank_y;
  }
  if (votf_settings(s).method == Method::k_cta && s.clusters == 0)
    s.mixture = std::min(s.mixture, s.cluster_count());
  check_settings(s, raw);
  return s;
}

Json source_of(const MaterialTask& task, const RawMaterial& raw) {
  Json source = {{"lights", raw.lights.size()},
                 {"views", raw.views.size()},
                 {"width", raw.width},
                 {"height", raw.height}};
  if (!task.meso) {
    source["measured"] = true;
    return source;
  }
  const MesoParameters& p = *task.meso;
  source.update({{"meso", p.name},
                 {"count", p.count},
                 {"radius", p.radius},
                 {"thickness", p.thickness},
                 {"roughness", p.roughness},
                 {"samples", task.trace.samples},
                 {"bounces", task.trace.bounces},
                 {"bounce_rays", task.trace.bounce_rays},
                 {"seed", p.seed}});
  return source;
}

JobStage stage_of(std::string_view stage) {
  if (stage == "BTF" || stage == "offset" || stage == "network") return JobStage::btf;
  if (stage == "relief" || stage == "views on the relief") return JobStage::relief;
  return stage == "VOTF" ? JobStage::votf : JobStage::view_map;
}

}  // namespace

BakedFile bake_material(MaterialTask& task, const StageReport& progress) {
  platform::Stopwatch watch;
  const RawMaterial raw = obtain(task, progress);
  const double seconds_source = watch.lap_seconds();
  const StageProgress stages = [&](const char* stage, std::size_t done, std::size_t total) {
    return progress(stage_of(stage), done, total);
  };
  const MovedMaterial moved = move_views(raw, task.settings.relief, stages);
  const CompressionSettings settings = settings_for(task, moved.or_still(raw));
  nook::material::Material material = compress_moved(raw, moved, settings, stages);
  const double seconds = watch.seconds();
  const Json recipe = {{"source", source_of(task, raw)}, {"compression", describe(settings)}};
  material.recipe = recipe.dump().c_str();
  set_core_rounding(raw, material);
  BakedFile file;
  file.model = nook::material::write_material(material);
  MethodRow row = measure_material(raw, nook::material::read_material(file.model));
  row.method = method_name(settings.method);
  row.seconds = seconds;
  Json report = report_row(raw.name, row);
  report["seconds_source"] = seconds_source;
  report["file_bytes"] = file.model.size();
  report["recipe"] = recipe;
  file.report = report.dump(2);
  return file;
}

}  // namespace nook::bake
