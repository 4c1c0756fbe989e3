// Defines the defaults of all descriptors of the library, and the function that returns them.
#include <algorithm>
#include <iterator>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/nnao/recording.h"

namespace nook {

template <>
nook_context_desc default_desc() {
  nook_context_desc desc{};
  desc.units_per_metre = 1;
  return desc;
}

template <>
nook_scene_desc default_desc() {
  const SceneSettings defaults;
  nook_scene_desc desc{};
  desc.form = defaults.form;
  desc.cutoff_error = defaults.cutoff_error;
  desc.lod_error = defaults.lod_error;
  desc.lod_max_interval = defaults.lod_max_interval;
  desc.strict_poses = defaults.strict_poses;
  desc.far_error = defaults.far_error;
  return desc;
}

template <>
nook_pose_desc default_desc() {
  nook_pose_desc desc{};
  desc.kind = NOOK_POSE_SKINNING;
  desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  return desc;
}

template <>
nook_bone_map_desc default_desc() {
  nook_bone_map_desc desc{};
  return desc;
}

template <>
nook_vertex_match_desc default_desc() {
  nook_vertex_match_desc desc{};
  desc.primitive = NOOK_ALL_PRIMITIVES;
  desc.influences = 4;
  return desc;
}

template <>
nook_pose_check_desc default_desc() {
  nook_pose_check_desc desc{};
  desc.tolerance = 0.005f;
  return desc;
}

template <>
nook_gl_desc default_desc() {
  nook_gl_desc desc{};
  desc.state_mode = NOOK_GL_STATE_PRESERVE;
  return desc;
}

template <>
nook_nnao_desc default_desc() {
  nook_nnao_desc desc{};
  desc.taps = desc.half_resolution = desc.blur = -1;
  desc.blur_sharpness = 16;
  return desc;
}

template <>
nook_gl_frame_desc default_desc() {
  nook_gl_frame_desc frame{};
  frame.normal_scale = 1;
  frame.normal_matrix[0] = frame.normal_matrix[4] = frame.normal_matrix[8] = 1;
  frame.view[0] = frame.view[5] = frame.view[10] = frame.view[15] = 1;
  frame.depth_log_scale = 1;
  return frame;
}

template <>
nook_nnao_frame_desc default_desc() {
  nook_nnao_frame_desc desc{};
  desc.intensity = desc.power = 1;
  desc.min_radius_px = 12;
  desc.motion_vector_scale[0] = desc.motion_vector_scale[1] = 1;
  return desc;
}

template <>
nook_world_desc default_desc() {
  nook_world_desc desc{};
  desc.capsules = 4096;
  return desc;
}

template <>
nook_world_frame_desc default_desc() {
  nook_world_frame_desc frame{};
  frame.cutoff_error = SceneSettings{}.cutoff_error;
  frame.level_error = 1.0f / 256;
  frame.intensity = frame.power = 1;
  return frame;
}

template <>
nook_probe_fit_desc default_desc() {
  nook_probe_fit_desc desc{};
  desc.method = NOOK_PROBE_FIT_LEAST_SQUARES;
  desc.match_sh = 1;
  desc.up[2] = 1;
  desc.lobe_count = 12;
  desc.order = 2;
  return desc;
}

template <>
nook_probe_desc default_desc() {
  nook_probe_desc desc{};
  for (int i = 0; i < 3; ++i) {
    desc.counts[i] = 1;
    desc.spacing_ws[i] = 1;
  }
  return desc;
}

template <>
nook_material_desc default_desc() {
  nook_material_desc desc{};
  desc.blocks = NOOK_MATERIAL_BLOCKS_NONE;
  desc.whole_light_modes = std::int32_t(material::ModeForm{}.whole_light_modes);
  return desc;
}

template <>
nook_nnao_recording_desc default_desc() {
  const nnao::RecordedFrame frame;
  const nnao::RecordedPass pass;
  nook_nnao_recording_desc desc{};
  desc.normal_scale = frame.normal_scale;
  std::copy(std::begin(frame.normal_matrix), std::end(frame.normal_matrix), desc.normal_matrix);
  desc.intensity = frame.intensity;
  desc.power = frame.power;
  desc.taps = pass.taps;
  desc.blur = pass.blur;
  desc.blur_sharpness = pass.blur_sharpness;
  return desc;
}

template <>
nook_world_sample_desc default_desc() {
  nook_world_sample_desc desc{};
  return desc;
}

template <>
nook_gl_capture_desc default_desc() {
  nook_gl_capture_desc desc{};
  desc.face_size_px = 64;
  desc.history = 1;
  desc.match_sh = 1;
  return desc;
}

template <>
nook_transfer_light_desc default_desc() {
  nook_transfer_light_desc desc{};
  return desc;
}

template <>
nook_transfer_mesh_desc default_desc() {
  nook_transfer_mesh_desc desc{};
  return desc;
}

template <>
nook_transfer_vectors_desc default_desc() {
  nook_transfer_vectors_desc desc{};
  return desc;
}

template <>
nook_transfer_response_desc default_desc() {
  nook_transfer_response_desc desc{};
  desc.lobe_count = 642;
  return desc;
}

template <>
nook_probe_fit_study_desc default_desc() {
  nook_probe_fit_study_desc desc{};
  return desc;
}

template <>
nook_nnao_debug_desc default_desc() {
  nook_nnao_debug_desc desc{};
  return desc;
}

template <>
nook_nnao_frame_debug_desc default_desc() {
  nook_nnao_frame_debug_desc desc{};
  return desc;
}

template <>
nook_world_frame_debug_desc default_desc() {
  nook_world_frame_debug_desc desc{};
  return desc;
}

}  // namespace nook

using namespace nook;

nook_result nook_desc_init(uint32_t type, void* desc, size_t size, uint32_t header_version) {
  switch (type) {
#define NOOK_INIT_DESCRIPTOR(name, struct_type) \
  case NOOK_DESC_##name:                        \
    return api::enter(#struct_type "_init",     \
                      [&] { init_descriptor(static_cast<struct_type*>(desc), size, header_version); });
    NOOK_DESCRIPTORS(NOOK_INIT_DESCRIPTOR)
#undef NOOK_INIT_DESCRIPTOR
    default:
      return api::enter("nook_desc_init", [&] {
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "type is unknown (got %u, need a NOOK_DESC_ constant that this library knows); call "
                      "the init function of your descriptor",
                      type);
      });
  }
}
