#include "bakers/job/material_bake.h"

#include <string_view>

#include "bakers/material/baked_figures.h"
#include "bakers/material/builtin_ranks.h"
#include "bakers/material/fill_gaps.h"
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

CompressedMaterial compress_to_file(const RawMaterial& raw, ReliefSource relief, const ChooseSettings& choose,
                                    const Json& source, const Json& relief_source,
                                    const StageProgress& progress) {
  const platform::Stopwatch watch;
  const MovedMaterial moved = move_views(raw, relief, progress);
  const CompressionSettings settings = choose(moved.or_still(raw));
  nook::material::Material material = compress_moved(raw, moved, settings, progress);
  const double seconds = watch.seconds();
  CompressedMaterial out;
  out.recipe = {{"source", source}, {"compression", describe(settings)}};
  if (!relief_source.is_null()) out.recipe["relief"] = relief_source;
  // Names come from files and need not be UTF-8.
  material.recipe = out.recipe.dump(-1, ' ', false, Json::error_handler_t::replace).c_str();
  set_core_rounding(raw, material);
  out.file = nook::material::write_material(material);
  BakedFigures figures = measure_material(raw, nook::material::read_material(out.file));
  figures.method = method_name(settings.method);
  figures.seconds = seconds;
  out.row = report_row(raw.name, figures);
  return out;
}

BakedFile bake_material(MaterialTask& task, const StageReport& progress) {
  const platform::Stopwatch watch;
  const RawMaterial raw = obtain(task, progress);
  const double seconds_source = watch.seconds();
  CompressedMaterial compressed = compress_to_file(
      raw, task.settings.relief, [&](const RawMaterial& fitted) { return settings_for(task, fitted); },
      source_of(task, raw), {},
      [&](const char* stage, std::size_t done, std::size_t total) {
        return progress(stage_of(stage), done, total);
      });
  Json report = std::move(compressed.row);
  report["seconds_source"] = seconds_source;
  report["file_bytes"] = compressed.file.size();
  report["recipe"] = std::move(compressed.recipe);
  return {std::move(compressed.file), report.dump(2)};
}

}  // namespace nook::bake
