// The default values of all descriptors of the bakers' library, and the function that returns them.
#include <limits>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_entry.h"
#include "bakers/job/clip_bake.h"
#include "bakers/job/material_bake.h"
#include "bakers/job/synthesis_bake.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/job/vertex_bakes.h"
#include "bakers/material/raw_material.h"

namespace nook {
using namespace bake;

template <>
nook_bake_source_desc default_desc() {
  nook_bake_source_desc desc{};
  desc.influences = 4;
  return desc;
}

template <>
nook_bake_character_desc default_desc() {
  nook_bake_character_desc desc{};
  desc.preset = NOOK_BAKE_PRESET_STANDARD;
  desc.pose_mode = NOOK_BAKE_POSES_ALL;
  desc.seed = 1;
  return desc;
}

template <>
nook_bake_character_study_desc default_desc() {
  return {};
}

template <>
nook_bake_bent_desc default_desc() {
  const BentTask task;
  nook_bake_bent_desc desc{};
  desc.rays = task.rays;
  desc.auto_pose_count = task.auto_poses;
  desc.samples_per_clip = task.samples_per_clip;
  desc.seed = task.seed;
  return desc;
}

template <>
nook_bake_clips_desc default_desc() {
  const ClipTask task;
  nook_bake_clips_desc desc{};
  desc.rays = task.rays;
  desc.frames_per_second = float(task.frames_per_second);
  desc.max_error = float(task.tables.max_error);
  desc.max_bytes = float(task.tables.max_bytes);
  desc.max_modes = task.tables.max_modes;
  desc.seed = task.tables.seed;
  return desc;
}

template <>
nook_bake_material_desc default_desc() {
  const bake::material::TraceSettings trace;
  const bake::material::CompressionSettings compression;
  nook_bake_material_desc desc{};
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

template <>
nook_bake_synthesis_desc default_desc() {
  const bake::synthesis::SynthesisSettings settings;
  nook_bake_synthesis_desc desc{};
  desc.is_tiling = 1;
  desc.side = settings.side;
  desc.jitter = settings.jitter;
  desc.passes = settings.passes;
  desc.seed = settings.seed;
  return desc;
}

template <>
nook_bake_transfer_desc default_desc() {
  const bake::transfer::BakeSettings settings;
  nook_bake_transfer_desc desc{};
  desc.lobes = settings.lobes;
  desc.ray_side = settings.side;
  desc.tiles = settings.tiles;
  return desc;
}

template <>
nook_bake_trace_desc default_desc() {
  nook_bake_trace_desc desc{};
  desc.rays = 64;
  desc.seed = 1;
  desc.radius = std::numeric_limits<float>::infinity();
  desc.origin_offset = 1e-4f;
  return desc;
}

template <>
nook_bake_irradiance_desc default_desc() {
  nook_bake_irradiance_desc desc{};
  desc.rays = 64;
  desc.seed = 1;
  desc.max_bounces = UINT32_MAX;
  desc.origin_offset = 1e-4f;
  return desc;
}

}  // namespace nook

using namespace nook;
using namespace nook::bake;

nook_result nook_bake_desc_init(uint32_t type, void* desc, size_t size, uint32_t header_version) {
  switch (type) {
#define NOOK_INIT_DESCRIPTOR(name, struct_type) \
  case NOOK_DESC_##name:                        \
    return api::enter(#struct_type "_init",     \
                      [&] { init_descriptor(static_cast<struct_type*>(desc), size, header_version); });
    NOOK_BAKE_DESCRIPTORS(NOOK_INIT_DESCRIPTOR)
#undef NOOK_INIT_DESCRIPTOR
    default:
      return api::enter("nook_bake_desc_init", [&] {
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "type is unknown (got %u, need a NOOK_DESC_ constant that this library knows); call "
                      "the init function of your descriptor",
                      type);
      });
  }
}
