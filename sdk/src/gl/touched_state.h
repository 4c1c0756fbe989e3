// Lists the OpenGL state that Nook changes. The state guard, docs/gl_state.md and the test of poisoned state
// are generated from this list.
#pragma once

#include "shaders/character/layout.h"
#include "shaders/nnao/layout.h"
#include "shaders/probe/capture/layout.h"

namespace nook::gl {

// A user is a part of Nook that changes OpenGL state. Each item of state has a mask of its users. Characters
// have one user for each tier. Uploads have one user for each kind: probes and materials, grids, clips,
// captures of probes, and the binding of uploads. The screen-space pass has several users: the pass itself,
// the code that reads its timers, and a network in a compute shader. Passes with nook_nnao_desc.views, with
// nook_nnao_desc.depth_samples, or with both are users, too. Two more users write AO to the host's buffers
// and textures, and record frames. The last user uploads tables of texels, which are 2D textures on OpenGL
// ES.
enum : unsigned {
  tier_33 = 1,
  tier_43 = 2,
  screen = 4,
  screen_timers = 8,
  materials = 16,
  probes = 32,
  screen_compute = 64,
  outputs = 128,
  outputs_compute = 256,
  texel_uploads = 512,
  screen_reads = 1024,
  screen_layers = 2048,
  screen_samples = 4096,
  grids = 8192,
  captures = 16384,
  screen_sample_layers = 32768,
  binds = 65536,
  clips = 131072,
  characters = tier_33 | tier_43,
  everyone = characters | screen,
  draws = tier_33 | screen,
};

// Each line is X(name, users, OpenGL's names of the state, purpose and default of the state). Each item needs
// a member of SavedState with this name, and functions query_name and restore_name in state_guard.cpp or
// state_guard_draw.cpp.
#define NOOK_GL_TOUCHED_STATE(X)                                                                            \
  X(program, everyone | outputs | captures, "GL_CURRENT_PROGRAM", "runs the passes; default 0")             \
  X(array_buffer, everyone | probes | outputs | captures, "GL_ARRAY_BUFFER_BINDING",                        \
    "Nook uploads buffers through it; default 0")                                                           \
  X(vertex_array, draws | outputs | captures, "GL_VERTEX_ARRAY_BINDING",                                    \
    "inputs of the vertex pass, or none; default 0")                                                        \
  X(active_texture, everyone | probes | grids | materials | outputs | captures | binds | clips,             \
    "GL_ACTIVE_TEXTURE", "selects units; default GL_TEXTURE0")                                              \
  X(texture_unit_0, characters | probes | captures,                                                         \
    "GL_TEXTURE_BINDING_BUFFER of unit 0; on OpenGL ES GL_TEXTURE_BINDING_2D",                              \
    "shadows at key points, texels of probes and lights; default 0")                                        \
  X(texture_2d, screen | outputs | clips, "GL_TEXTURE_BINDING_2D of units 0 to 4",                          \
    "inputs of the stages; default 0")                                                                      \
  X(samplers, screen, "GL_SAMPLER_BINDING of units 0 to 4",                                                 \
    "so that the parameters of textures have no effect; default 0")                                         \
  X(filter_texture, screen, "GL_TEXTURE_BINDING_BUFFER of unit 2, not on OpenGL ES",                        \
    "filters of the paper's network; default 0")                                                            \
  X(layer_textures, screen_layers, "GL_TEXTURE_BINDING_2D_ARRAY of units 1, 3 and 4",                       \
    "the host's arrays; default 0")                                                                         \
  X(sample_texture, screen_samples, "GL_TEXTURE_BINDING_2D_MULTISAMPLE of unit 1",                          \
    "the host's depth and normals; default 0")                                                              \
  X(sample_array, screen_sample_layers, "GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY of unit 1",                \
    "the host's depth and normals; default 0")                                                              \
  X(image_unit, screen_compute, "GL_IMAGE_BINDING_NAME, LEVEL, LAYERED, LAYER, ACCESS, FORMAT of unit 0",   \
    "what a compute shader writes; default 0, GL_READ_ONLY, GL_R8 (OpenGL ES: GL_R32UI)")                   \
  X(texture_2d_array, materials, "GL_TEXTURE_BINDING_2D_ARRAY of unit 0", "uploads; default 0")             \
  X(texture_3d, grids | captures, "GL_TEXTURE_BINDING_3D of unit 0", "uploads; default 0")                  \
  X(cube_map, captures, "GL_TEXTURE_BINDING_CUBE_MAP of unit 1", "the host's cube map; default 0")          \
  X(capture_samplers, captures, "GL_SAMPLER_BINDING of units 0 and 1",                                      \
    "so that the parameters of textures have no effect; default 0")                                         \
  X(pixel_unpack_buffer, screen | materials | grids | outputs | texel_uploads | captures | clips,           \
    "GL_PIXEL_UNPACK_BUFFER_BINDING",                                                                       \
    "in nook_nnao_create, nook_gl_upload_material, nook_gl_upload_clips, nook_gl_upload_probe, "            \
    "nook_gl_update_probe and "                                                                             \
    "nook_gl_scene_write only; on OpenGL ES in updates "                                                    \
    "and probes "                                                                                           \
    "too; default 0")                                                                                       \
  X(pixel_store, materials | grids | outputs | texel_uploads | captures | clips,                            \
    "GL_UNPACK_SWAP_BYTES, LSB_FIRST, ROW_LENGTH, IMAGE_HEIGHT, SKIP_ROWS, SKIP_PIXELS, SKIP_IMAGES, "      \
    "ALIGNMENT; the first two not on OpenGL ES",                                                            \
    "uploads have no gaps between rows; default 0, alignment 4")                                            \
  X(draw_framebuffer, draws | outputs | captures, "GL_DRAW_FRAMEBUFFER_BINDING",                            \
    "draws need a complete framebuffer; default 0")                                                         \
  X(read_framebuffer, screen_reads, "GL_READ_FRAMEBUFFER_BINDING",                                          \
    "the framebuffer that Nook reads back; default 0")                                                      \
  X(pixel_pack_buffer, screen_reads, "GL_PIXEL_PACK_BUFFER_BINDING",                                        \
    "unbound, so that texels go to host memory; default 0")                                                 \
  X(pixel_pack, screen_reads,                                                                               \
    "GL_PACK_ALIGNMENT, ROW_LENGTH, SKIP_ROWS, SKIP_PIXELS, SWAP_BYTES; the last not on OpenGL ES",         \
    "texels have no gaps between rows; default alignment 4, else 0")                                        \
  X(renderbuffer, tier_33 | outputs | captures, "GL_RENDERBUFFER_BINDING",                                  \
    "in nook_gl_create, nook_gl_scene_write and nook_gl_capture_create only; default 0")                    \
  X(viewport, screen, "GL_VIEWPORT, of index 0 from OpenGL 4.1 on",                                         \
    "the size of the stages; Nook leaves it at the frame's viewport instead of a default")                  \
  X(blend, screen,                                                                                          \
    "GL_BLEND, GL_BLEND_SRC/DST_RGB/ALPHA, GL_BLEND_EQUATION_RGB/ALPHA, of draw buffer 0 from OpenGL 4.0 "  \
    "on",                                                                                                   \
    "multiplies into a target; default disabled, GL_ONE, GL_ZERO, GL_FUNC_ADD")                             \
  X(color_mask, screen, "GL_COLOR_WRITEMASK of draw buffer 0", "all four; default all GL_TRUE")             \
  X(polygon_mode, screen, "GL_POLYGON_MODE, not on OpenGL ES", "one triangle is filled; default GL_FILL")   \
  X(scissor_test, screen, "GL_SCISSOR_TEST, of index 0 from OpenGL 4.1 on", "off; default disabled")        \
  X(framebuffer_srgb, screen, "GL_FRAMEBUFFER_SRGB, not on OpenGL ES",                                      \
    "enabled while Nook draws into the host's targets; default disabled")                                   \
  X(fragment_tests, screen,                                                                                 \
    "GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_COLOR_LOGIC_OP, GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK, " \
    "GL_SAMPLE_ALPHA_TO_COVERAGE, GL_CLIP_DISTANCE0 to GL_CLIP_DISTANCE7; on OpenGL ES those that it has",  \
    "off; default disabled")                                                                                \
  X(dither, screen, "GL_DITHER", "off; default enabled")                                                    \
  X(rasterizer_discard, draws | outputs | captures, "GL_RASTERIZER_DISCARD",                                \
    "on in tier 33, where nothing is drawn, off in the screen-space pass; default disabled")                \
  X(primitive_restart, draws | outputs | captures, "GL_PRIMITIVE_RESTART, not on OpenGL ES",                \
    "disabled, so that every index is a vertex; default disabled")                                          \
  X(transform_feedback, tier_33 | outputs | captures, "GL_TRANSFORM_FEEDBACK_BINDING",                      \
    "from OpenGL 4.0 and OpenGL ES 3.0 on; default 0")                                                      \
  X(feedback_buffer, tier_33 | outputs | captures,                                                          \
    "GL_TRANSFORM_FEEDBACK_BUFFER_BINDING and its range, index 0", "AO; default 0")                         \
  X(query_buffer, screen_timers, "GL_QUERY_BUFFER_BINDING",                                                 \
    "from OpenGL 4.4 on, in nook_nnao_read_timings only; default 0")                                        \
  X(storage_buffer, tier_43 | outputs_compute, "GL_SHADER_STORAGE_BUFFER_BINDING",                          \
    "binding a range sets it; default 0")                                                                   \
  X(storage_ranges, tier_43 | outputs_compute,                                                              \
    "GL_SHADER_STORAGE_BUFFER_BINDING and its range, index 0 to 3", "passes; default 0")

inline constexpr int storage_binding_count = NOOK_BINDING_COUNT;
inline constexpr int texture_unit_count = NOOK_UNIT_COUNT;  // units of the screen-space pass
inline constexpr int cube_map_unit = NOOK_CAPTURE_UNIT_CUBE;
inline constexpr int host_depth_unit = NOOK_UNIT_HOST_DEPTH;
// The units to which a screen-space pass with layers binds texture arrays.
inline constexpr int layer_units[] = {NOOK_UNIT_HOST_DEPTH, NOOK_UNIT_LAYER, NOOK_UNIT_MOTION};
inline constexpr int filter_unit = NOOK_UNIT_FILTERS;
inline constexpr int image_unit_index = NOOK_IMAGE_UNIT;

}  // namespace nook::gl
