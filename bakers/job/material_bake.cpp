#include "bakers/job/material_bake.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "bakers/job/material_identity.h"
#include "bakers/material/baked_figures.h"
#include "bakers/material/raw_relief.h"
#include "bakers/raytrace/worker_arena.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_check.h"
#include "sdk/src/material/material_file.h"

namespace nook::bake {

material::RawMaterial trace_meso_source(const MesoSource& source, const Progress& progress) {
  const material::MesoSurface surface = source.tile ? *source.tile : material::make_meso_surface(source.meso);
  const auto lights =
      material::spiral_directions(source.lights ? source.lights : source.views, source.max_tilt_deg);
  const auto views = material::spiral_directions(source.views, source.max_tilt_deg);
  material::RawMaterial raw = material::trace_material(surface, lights, views, source.trace, progress);
  raw.name = source.meso.name;
  return raw;
}

namespace {

using namespace nook::bake::material;
using nook::material::VisibilityForm;

constexpr std::uint64_t most_raw_bytes = std::uint64_t{6} << 30;

Method method_of(nook_bake_method method) {
  switch (method) {
    case NOOK_BAKE_METHOD_K_CTA:
      return Method::k_cta;
    case NOOK_BAKE_METHOD_CTA:
      return Method::cta;
    case NOOK_BAKE_METHOD_N_SVD:
      return Method::n_svd;
    case NOOK_BAKE_METHOD_NEURAL:
      return Method::neural;
    default:
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.method is unknown (got %d); use a NOOK_BAKE_METHOD_ constant", int(method));
  }
}

// The heights of a built-in structure are always known. The heights of measured data are only known if the
// caller passes them.
ReliefSource relief_source_of(const nook_bake_material_desc& desc) {
  check_range("desc.relief", desc.relief, 0, 1);
  if (desc.heights && desc.relief == 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "desc.heights are given, but desc.relief is 0; set desc.relief to 1, or desc.heights to NULL");
  if (desc.relief == 0) return ReliefSource::none;
  return desc.meso || desc.heights ? ReliefSource::known : ReliefSource::estimated;
}

// Reads the heights of measured data. The heights of a structure come from ray tracing instead.
void read_heights(const nook_bake_material_desc& desc, RawMaterial& raw) {
  if (!desc.heights) return;
  for (std::size_t x = 0; x < raw.width; ++x)
    for (std::size_t y = 0; y < raw.height; ++y) raw.heights.push_back(desc.heights[y * raw.width + x]);
  check_heights(raw);
}

std::vector<Vec3> directions_of(const char* name, const float* xyz, std::uint32_t count,
                                const nook_bake_material_desc& desc) {
  if (!xyz) {
    if (!desc.meso)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is NULL; give the directions of the measured data",
                    name);
    return spiral_directions(count, desc.max_tilt_degrees);
  }
  std::vector<Vec3> directions(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    directions[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    for (std::uint32_t j = 0; j < i; ++j)
      if (length(directions[j] - directions[i]) < nook::material::min_distance)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "directions %u and %u of %s are the same (%g %g %g); leave one out", j, i, name,
                      double(xyz[3 * i]), double(xyz[3 * i + 1]), double(xyz[3 * i + 2]));
  }
  return directions;
}

std::vector<float> coverage_of(const nook_bake_material_desc& desc, const RawMaterial& raw) {
  if (!desc.coverage) return {};
  std::vector<float> coverage(raw.views.size() * raw.texels());
  for (std::size_t view = 0; view < raw.views.size(); ++view)
    for (std::size_t y = 0; y < raw.height; ++y)
      for (std::size_t x = 0; x < raw.width; ++x) {
        const float share = desc.coverage[(view * raw.height + y) * raw.width + x];
        if (!(share >= 0 && share <= 1))
          throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                        "desc.coverage of view %zu at texel (%zu, %zu) is out of range (got %g, need 0 to 1)",
                        view, x, y, double(share));
        coverage[(view * raw.width + x) * raw.height + y] = share;
      }
  return coverage;
}

// Converts RGB images to rows, one for each light and channel. If the descriptor has a coverage, multiplies
// the values by it.
void read_btf(const float* images, const std::vector<float>& coverage, RawMaterial& raw) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  raw.btf.resize(raw.light_rows() * views * texels);
  for (std::size_t light = 0; light < raw.lights.size(); ++light)
    for (std::size_t view = 0; view < views; ++view)
      for (std::size_t y = 0; y < raw.height; ++y)
        for (std::size_t x = 0; x < raw.width; ++x) {
          const std::size_t texel = x * raw.height + y;
          const float* rgb = images + 3 * (((light * views + view) * raw.height + y) * raw.width + x);
          const float share = coverage.empty() ? 1 : coverage[view * texels + texel];
          for (std::size_t c = 0; c < 3; ++c)
            raw.btf[((3 * light + c) * views + view) * texels + texel] = share > 0 ? share * rgb[c] : 0;
        }
}

void read_measured(const nook_bake_material_desc& desc, MaterialTask& task) {
  need(desc.btf, "desc.btf");
  task.coverage = coverage_of(desc, task.raw);
  read_btf(desc.btf, task.coverage, task.raw);
  read_heights(desc, task.raw);
  for (const float share : task.coverage) task.raw.mask.push_back(share >= 0.5f ? 1.0f : 0.0f);
  task.raw.name = "measured";
  try {
    check_raw_material(task.raw);
  } catch (const Failure& failure) {
    // The error is in the caller's arguments, not in a file.
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.btf or its directions: %s", failure.what());
  }
}

void read_meso(const nook_bake_material_desc& desc, MaterialTask& task) {
  if (desc.btf || desc.coverage || desc.heights)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.meso is given together with desc.btf, desc.coverage or desc.heights; give either "
                  "desc.meso or the measured data");
  check_range("desc.samples", desc.samples, 1, 16);
  check_range("desc.bounces", desc.bounces, 0, 16);
  check_range("desc.bounce_rays", desc.bounce_rays, 1, 4096);
  for (const auto& set : {task.raw.lights, task.raw.views})
    for (const Vec3 d : set)
      if (!(d.z >= lowest_traced_z))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.lights or desc.views: (%g, %g, %g) is more than 85 degrees from the normal; "
                      "desc.meso can only be traced up to 85 degrees",
                      double(d.x), double(d.y), double(d.z));
  task.meso = meso_parameters(desc.meso);
  task.raw.name = task.meso->name;
  task.meso->seed = desc.seed;
  task.trace = {desc.width,
                desc.height,
                desc.samples,
                desc.bounces,
                desc.bounce_rays,
                desc.seed,
                task.settings.relief == ReliefSource::known};
}

void set_paper_form(CompressionSettings& s) {
  if (s.method == Method::neural || s.relief != ReliefSource::none)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.form is NOOK_FORM_PAPER, which allows neither the method NEURAL nor a relief; use "
                  "another method, and set desc.relief to 0");
  s.bits = 16;
  s.map_side = 0;
  if (!s.mapping) s.mapping = nook::material::paper_mapping(s.visibility);
}

CompressionSettings settings_of(const nook_bake_material_desc& desc) {
  CompressionSettings s;
  s.method = method_of(desc.method);
  check_range("desc.visibility", std::uint32_t(desc.visibility), 0, 2);
  s.visibility = VisibilityForm(desc.visibility);
  if (desc.visibility_threshold != 0 || desc.visibility_weight != 0)
    s.mapping = nook::material::VisibilityMapping{desc.visibility_threshold, desc.visibility_weight};
  check_range("desc.cluster_rank_view", desc.cluster_rank_view, 1, 64);
  check_range("desc.mixture", desc.mixture, 1, nook::material::max_mixture);
  check_range("desc.view_map_side", desc.view_map_side, 0, nook::material::max_map_side);
  s.cluster_rank_view = desc.cluster_rank_view;
  s.clusters = desc.clusters;
  s.mixture = desc.mixture;
  s.map_side = desc.view_map_side;
  check_fits("desc.bits", desc.bits, desc.bits == 8 || desc.bits == 16, "8 or 16");
  s.bits = desc.bits;
  s.relief = relief_source_of(desc);
  s.neural_channels = desc.neural_channels;
  s.neural_steps = desc.neural_steps;
  s.seed = desc.seed;
  if (desc.form == NOOK_FORM_PAPER) {
    set_paper_form(s);
  } else if (desc.form != NOOK_FORM_DEFAULT) {
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.form is unknown (got %d); use a NOOK_FORM_ constant",
                  int(desc.form));
  }
  return s;
}

// Returns true if a group of ranks is set. Throws if only some ranks of the group are set.
bool given(const char* names, std::initializer_list<std::uint32_t> ranks) {
  std::size_t zeros = 0;
  for (const std::uint32_t rank : ranks) zeros += rank == 0;
  if (zeros != 0 && zeros != ranks.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "some of %s are 0; give all of them, or none", names);
  return zeros == 0;
}

// Returns the settings that do not depend on the data.
CompressionSettings known_settings(const MaterialTask& task) {
  CompressionSettings s = task.settings;
  if (!set_builtin_ranks(task.raw, s)) set_lowest_ranks(task.raw, s);
  if (task.votf_ranks_given) {
    s.votf_rank_x = task.settings.votf_rank_x;
    s.votf_rank_y = task.settings.votf_rank_y;
  }
  if (votf_settings(s).method == Method::k_cta && s.clusters == 0)
    s.mixture = std::min(s.mixture, s.cluster_count());
  return s;
}

}  // namespace

MaterialTask material_task_of(const nook_bake_material_desc& desc) {
  check_range("desc.light_count", desc.light_count, 1, nook::material::max_directions);
  check_range("desc.view_count", desc.view_count, 1, nook::material::max_directions);
  check_range("desc.width", desc.width, 1, nook::material::max_texels);
  check_range("desc.height", desc.height, 1, nook::material::max_texels);
  need_threads(desc.threads);
  check_fits("desc.rank_threshold", desc.rank_threshold, desc.rank_threshold > 0 && desc.rank_threshold < 1,
             "0 to 1");
  const std::uint64_t bytes =
      std::uint64_t{12} * desc.light_count * desc.view_count * desc.width * desc.height;
  if (bytes > most_raw_bytes)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the uncompressed material takes %llu MiB (need at most %llu); use fewer directions or texels",
        static_cast<unsigned long long>(bytes >> 20), static_cast<unsigned long long>(most_raw_bytes >> 20));
  MaterialTask task;
  task.settings = settings_of(desc);
  task.rank_threshold = double(desc.rank_threshold);
  task.ranks_given = given("desc.rank_light, rank_view, rank_x and rank_y",
                           {desc.rank_light, desc.rank_view, desc.rank_x, desc.rank_y});
  task.votf_ranks_given = given("desc.votf_rank_x and votf_rank_y", {desc.votf_rank_x, desc.votf_rank_y});
  task.raw.lights = directions_of("desc.lights", desc.lights, desc.light_count, desc);
  task.raw.views = directions_of("desc.views", desc.views, desc.view_count, desc);
  task.raw.width = desc.width;
  task.raw.height = desc.height;
  desc.meso ? read_meso(desc, task) : read_measured(desc, task);

  CompressionSettings& s = task.settings;
  const bool has_mask = task.meso || !task.raw.mask.empty();
  if (task.votf_ranks_given) {
    s.votf_rank_x = desc.votf_rank_x;
    s.votf_rank_y = desc.votf_rank_y;
  } else {
    s.votf_rank_x = std::min(s.votf_rank_x, desc.width);
    s.votf_rank_y = std::min(s.votf_rank_y, desc.height);
  }
  if (!task.ranks_given) {
    check_settings(known_settings(task), task.raw, has_mask);
    return task;
  }
  s.rank_light = desc.rank_light;
  s.rank_view = desc.rank_view;
  s.rank_x = desc.rank_x;
  s.rank_y = desc.rank_y;
  check_settings(s, task.raw, has_mask);
  return task;
}

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

// Chooses the same defaults as `nook bake material`. `raw` contains the images to fit. If the material has a
// relief, these images are already projected onto it.
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
                                    const StageProgress& progress, const BakeIdentity& identity) {
  const platform::Stopwatch watch;
  const MovedMaterial moved = move_views(raw, relief, progress);
  const CompressionSettings settings = choose(moved.or_still(raw));
  nook::material::Material material = compress_moved(raw, moved, settings, progress);
  const double seconds = watch.seconds();
  CompressedMaterial out;
  out.verdict = judge(moved.or_still(raw), settings, progress);
  out.recipe = {{"source", source}, {"compression", describe(settings)}};
  out.recipe.update(describe(out.verdict));
  if (!relief_source.is_null()) out.recipe["relief"] = relief_source;
  store_identity(out.recipe, identity);
  // Names come from files and may not be UTF-8.
  material.recipe = out.recipe.dump(-1, ' ', false, Json::error_handler_t::replace).c_str();
  set_core_rounding(raw, material);
  out.file = nook::material::write_material(material);
  BakedFigures figures = measure_material(raw, nook::material::read_material(out.file));
  figures.method = method_name(settings.method);
  figures.seconds = seconds;
  out.row = report_row(raw.name, figures);
  out.row.update(describe(out.verdict));
  return out;
}

BakedFile bake_material(MaterialTask& task, const StageReport& progress) {
  const platform::Stopwatch watch;
  const BakeIdentity identity = identify_material(task);
  const RawMaterial raw = obtain(task, progress);
  const double seconds_source = watch.seconds();
  CompressedMaterial compressed = compress_to_file(
      raw, task.settings.relief, [&](const RawMaterial& fitted) { return settings_for(task, fitted); },
      source_of(task, raw), {},
      [&](const char* stage, std::size_t done, std::size_t total) {
        return progress(stage_of(stage), done, total);
      },
      identity);
  Json report = std::move(compressed.row);
  report["seconds_source"] = seconds_source;
  report["file_bytes"] = compressed.file.size();
  report["recipe"] = std::move(compressed.recipe);
  return {std::move(compressed.file), report.dump(2)};
}

}  // namespace nook::bake
