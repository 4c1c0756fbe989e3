// Lists the descriptors of the library, one per line: the name after NOOK_DESC_, and the struct.
#pragma once

#include <nook/experimental/nook_capture.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_sg.h>
#include <nook/experimental/nook_transfer.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_character.h>
#include <nook/nook_gl.h>
#include <nook/nook_material.h>
#include <nook/nook_nnao.h>
#include <nook/nook_probe.h>
#include <nook/nook_world.h>

#include "sdk/src/core/descriptors.h"

#define NOOK_DESCRIPTORS(X)                         \
  X(CONTEXT, nook_context_desc)                     \
  X(SCENE, nook_scene_desc)                         \
  X(POSE, nook_pose_desc)                           \
  X(BONE_MAP, nook_bone_map_desc)                   \
  X(VERTEX_MATCH, nook_vertex_match_desc)           \
  X(POSE_CHECK, nook_pose_check_desc)               \
  X(GL, nook_gl_desc)                               \
  X(GL_FRAME, nook_gl_frame_desc)                   \
  X(NNAO, nook_nnao_desc)                           \
  X(NNAO_FRAME, nook_nnao_frame_desc)               \
  X(WORLD, nook_world_desc)                         \
  X(WORLD_FRAME, nook_world_frame_desc)             \
  X(PROBE_FIT, nook_probe_fit_desc)                 \
  X(PROBE, nook_probe_desc)                         \
  X(MATERIAL, nook_material_desc)                   \
  X(NNAO_RECORDING, nook_nnao_recording_desc)       \
  X(WORLD_SAMPLE, nook_world_sample_desc)           \
  X(GL_CAPTURE, nook_gl_capture_desc)               \
  X(TRANSFER_LIGHT, nook_transfer_light_desc)       \
  X(TRANSFER_MESH, nook_transfer_mesh_desc)         \
  X(TRANSFER_VECTORS, nook_transfer_vectors_desc)   \
  X(TRANSFER_RESPONSE, nook_transfer_response_desc) \
  X(PROBE_FIT_STUDY, nook_probe_fit_study_desc)     \
  X(NNAO_DEBUG, nook_nnao_debug_desc)               \
  X(NNAO_FRAME_DEBUG, nook_nnao_frame_debug_desc)   \
  X(WORLD_FRAME_DEBUG, nook_world_frame_debug_desc)

namespace nook {

#define NOOK_DECLARE_DESCRIPTOR(name, desc)                                \
  template <>                                                              \
  inline constexpr std::uint32_t descriptor_type<desc> = NOOK_DESC_##name; \
  template <>                                                              \
  inline constexpr const char* descriptor_init<desc> = #desc "_init";      \
  template <>                                                              \
  desc default_desc<desc>();
NOOK_DESCRIPTORS(NOOK_DECLARE_DESCRIPTOR)
#undef NOOK_DECLARE_DESCRIPTOR

}  // namespace nook
