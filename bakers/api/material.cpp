// The start of material jobs; job.cpp has the other functions of jobs.
#include <nook/nook_bake_material.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/material_bake.h"
#include "bakers/material/directions.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_material_desc = offsetof(nook_bake_material_desc, progress_user) + sizeof(void*);

nook_bake_material_desc default_material_desc() {
  const bake::material::TraceSettings trace;
  const bake::material::CompressionSettings compression;
  nook_bake_material_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.light_count = desc.view_count = 100;
  desc.width = trace.width;
  desc.height = trace.height;
  desc.max_tilt_degrees = bake::material::default_max_tilt_deg;
  desc.samples = trace.samples;
  desc.bounces = trace.bounces;
  desc.bounce_rays = trace.bounce_rays;
  desc.method = NOOK_BAKE_METHOD_K_CTA;
  desc.visibility = std::int32_t(compression.visibility);
  desc.cluster_rank_view = compression.cluster_rank_view;
  desc.mixture = compression.mixture;
  desc.view_map_side = compression.map_side;
  desc.bits = bake::material::default_bits;
  desc.rank_threshold = 0.01f;
  desc.seed = 1;
  desc.neural_channels = compression.neural_channels;
  desc.neural_steps = compression.neural_steps;
  return desc;
}

}  // namespace

nook_result nook_bake_material_desc_init(nook_bake_material_desc* desc, size_t size,
                                         uint32_t header_version) {
  return api::enter("nook_bake_material_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_material_desc, default_material_desc());
  });
}

nook_result nook_bake_material_start(const nook_bake_material_desc* desc, nook_bake_job* out) {
  return api::enter("nook_bake_material_start", [&] {
    need(out, "out");
    *out = nullptr;
    const nook_bake_material_desc d =
        read_descriptor(desc, "nook_bake_material_desc_init", first_material_desc, default_material_desc());
    auto task = std::make_shared<MaterialTask>(material_task_of(d));
    auto bake = [task](const StageReport& report) { return bake_material(*task, report); };
    *out = new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
  });
}
