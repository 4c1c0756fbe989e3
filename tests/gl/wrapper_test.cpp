// The C++ wrapper of nook_gl.h and nook_nnao.h on a living OpenGL context. This file sees public headers
// only, as a host does.
#include <nook/experimental/nook_capture.hpp>
#include <nook/experimental/nook_debug.hpp>
#include <nook/experimental/nook_gl_poses.hpp>
#include <nook/experimental/nook_recording.hpp>
#include <nook/experimental/nook_stages.hpp>
#include <nook/experimental/nook_streaming.hpp>
#include <nook/experimental/nook_synthesis.hpp>
#include <nook/experimental/nook_transfer.hpp>
#include <nook/experimental/nook_world_sample.hpp>
#include <nook/nook.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/gl/host_textures.h"
#include "tests/gl/test_context.h"

std::vector<std::byte> nook_test_model_bytes();
std::vector<std::byte> nook_test_material_bytes();

static_assert(std::is_nothrow_move_constructible_v<nook::Nnao> && !std::is_copy_constructible_v<nook::Nnao>);
static_assert(std::is_nothrow_move_constructible_v<nook::Gl> && !std::is_copy_constructible_v<nook::Gl>);

TEST_CASE("the C++ wrapper evaluates on the GPU what it evaluates on the CPU") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = nook_test_model_bytes();
  const nook::Context host;
  const nook::CharacterModel model(host, bytes.data(), bytes.size());
  nook::Scene scene(host);
  const nook_instance_id id = scene.add_instance(model);
  const std::uint32_t count = model.info().file_vertex_count;
  std::vector<float> cpu(count), gpu(count);

  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  nook::Gl made(host, desc);
  nook::Gl gl = std::move(made);
  CHECK_FALSE(made);
  gl.prepare(scene);
  const nook_gl_view view = gl.view(scene, id);
  CHECK(view.count == count);
  CHECK(context.gl().IsBuffer(view.buffer));
  gl.update(scene);
  gl.read(scene, id, NOOK_CHANNEL_AO, gpu.data(), count);
  scene.update();
  scene.read_ao(id, cpu.data(), count);
  // The header's promise.
  for (std::uint32_t i = 0; i < count; ++i) CHECK(std::fabs(gpu[i] - cpu[i]) < 2e-3f);
  CHECK(gl.info().ao_bytes >= count * sizeof(float));
  CHECK_FALSE(std::string(gl.info().renderer).empty());

  gl.release(scene);
  CHECK(gl.info().ao_bytes == 0);
  CHECK_FALSE(context.gl().IsBuffer(view.buffer));
  gl = nook::Gl(host, desc);
  gl.context_lost();
  try {
    gl.update(scene);
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_GL);
    CHECK(std::string(error.what()).find("nook_gl_scene_update: ") == 0);
  }
}

TEST_CASE("the C++ wrapper takes poses from the GPU") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = nook_test_model_bytes();
  const nook::Context host;
  const nook::CharacterModel model(host, bytes.data(), bytes.size());
  nook::Scene scene(host);
  const nook_instance_id id = scene.add_instance(model);
  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  nook::Gl gl(host, desc);
  const std::uint32_t bones = model.info().bone_count;
  std::vector<float> rows;
  for (std::uint32_t b = 0; b < bones; ++b) rows.insert(rows.end(), {1, 0, 0, 0.5f, 0, 1, 0, 0, 0, 0, 1, 0});
  GLuint buffer = 0;
  context.gl().GenBuffers(1, &buffer);
  context.gl().BindBuffer(GL_ARRAY_BUFFER, buffer);
  context.gl().BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rows.size() * sizeof(float)), rows.data(),
                          GL_STATIC_DRAW);
  nook_pose_desc pose = nook::pose_desc();
  pose.kind = NOOK_POSE_REST_TO_WORLD;
  pose.layout = NOOK_TRANSFORM_ROWS_3X4;
  pose.transform_count = bones;
  nook_gl_poses poses{};
  poses.pose = &pose;
  poses.buffer = buffer;
  poses.size = rows.size() * sizeof(float);
  nook_gl_instance_pose one{};
  one.instance = id;
  one.bound_radius = 2;
  one.scale = 1;
  one.place_3x4[0] = one.place_3x4[5] = one.place_3x4[10] = 1;
  if (nook::test::computes(gl.info().tier)) {
    nook::set_poses(gl, scene, poses, {one});
    gl.update(scene);
    CHECK(nook::read_pose(gl, scene, id, bones) == rows);
    // The same in the pool of another scene, which has a place for it.
    nook::Scene pooled(host);
    nook::set_pool(gl, pooled, {0, 4, 10, 1});
    one.instance = pooled.add_instance(model);
    nook::set_poses(gl, pooled, poses, {one});
    gl.update(pooled);
    CHECK(nook::pool_info(gl, pooled).near_count == 1);
    CHECK(nook::read_pool(gl, pooled, {one.instance})[0].is_near == 1);
    CHECK(nook::read_pose(gl, pooled, one.instance, bones) == rows);
    std::vector<std::uint32_t> ao_buffers;
    CHECK(nook::read_pool_table(gl, pooled, model, ao_buffers).entry_count >= 1);
    CHECK(ao_buffers == std::vector{nook::read_pool(gl, pooled, {one.instance})[0].buffer});
  } else {
    CHECK_THROWS_AS(nook::set_poses(gl, scene, poses, {one}), nook::Error);
    nook::Scene pooled(host);
    CHECK_THROWS_AS(nook::set_pool(gl, pooled, {0, 4, 10, 1}), nook::Error);
  }
  nook::Scene streamed(host);
  const nook_instance_id new_one = streamed.add_instance(model);
  nook::set_streaming(gl, streamed, {0, 0, 1});
  while (nook::prepare_within(gl, streamed, 100).pending_count > 0) gl.update(streamed);
  gl.update(streamed);
  CHECK(nook::read_pool(gl, streamed, {new_one})[0].is_near == 1);
  context.gl().DeleteBuffers(1, &buffer);
}

TEST_CASE("a wrapper that cannot be made throws") {
  const nook::Context host;
  try {
    const nook::Gl gl(host, nook::gl_desc());
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(error.what()).find("desc.get_proc is NULL") != std::string::npos);
  }
}

TEST_CASE("the C++ wrapper uploads a material and deletes its textures") {
  NOOK_NEED_CONTEXT(context);
  const std::vector<std::byte> bytes = nook_test_material_bytes();
  const nook::Context host;
  nook_gl_desc desc = nook::gl_desc();
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  const nook::Gl gl(host, desc);
  const nook::Material material(host, bytes.data(), bytes.size());
  nook::Upload uploaded(gl, material);
  const nook_gl_upload_info info = uploaded.info();
  const std::vector<nook_gl_upload_texture> textures(info.textures, info.textures + info.texture_count);
  CHECK(textures.size() == 7);
  CHECK(textures[0].uniform == std::string("nook_light_map"));
  CHECK(uploaded.info().bytes == material.info().table_bytes);
  for (const nook_gl_upload_texture& texture : textures) {
    CHECK(context.gl().IsTexture(texture.texture));
    CHECK(std::string(info.glsl).find(texture.uniform) != std::string::npos);
  }
  uploaded = nook::Upload();
  for (const nook_gl_upload_texture& texture : textures) CHECK_FALSE(context.gl().IsTexture(texture.texture));
}

TEST_CASE("the C++ wrapper draws the screen-space pass") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& g = context.gl();
  constexpr int width = 48, height = 32;
  GLuint depth = 0;
  g.GenTextures(1, &depth);
  g.BindTexture(GL_TEXTURE_2D, depth);
  // A wall three metres away, its lower half 0.3 m nearer.
  std::vector<float> depths(width * height, 3.0f);
  std::fill_n(depths.begin(), width * height / 2, 2.7f);
  g.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, depths.data());

  const nook::Context host;
  nook_gl_desc gl_desc = nook::gl_desc();
  gl_desc.get_proc = platform::Context::loader;
  gl_desc.get_proc_user = &context;
  const nook::Gl gl(host, gl_desc);
  nook_nnao_desc desc = nook::nnao_desc();
  desc.max_width = width;
  desc.max_height = height;
  nook_nnao_debug_desc debug;
  REQUIRE(nook_nnao_debug_desc_init(&debug) == NOOK_OK);
  debug.path = NOOK_NNAO_PATH_FRAGMENT;
  debug.timers = 1;
  desc.next = &debug;
  nook::Nnao made(gl, desc);
  nook::Nnao pass = std::move(made);
  CHECK_FALSE(made);
  CHECK(pass.info().texture_bytes == nook::nnao_memory(desc));
  CHECK(pass.info().compute == 0);
  CHECK(pass.timings().valid == 0);

  nook_gl_frame_desc frame = nook::gl_frame_desc();
  nook_nnao_frame_desc frame_desc = nook::nnao_frame_desc();
  frame.width = width;
  frame.height = height;
  frame.depth_texture = depth;
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  const float projection[16] = {1, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
  std::copy_n(projection, 16, frame.projection);
  frame_desc.radius = 0.5f;
  frame.textures_changed = 1;
  pass.render(frame, frame_desc);
  const std::vector<float> ao = nook::test::read_texture(g, pass.info().texture, width, height);
  // Next to the step the wall is darker than away from it.
  CHECK(ao[17 * width + width / 2] + 20.0f / 255 < ao[28 * width + width / 2]);

  frame_desc.radius = 0;
  try {
    pass.render(frame, frame_desc);
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(error.what()).find("nook_nnao_render: ") == 0);
  }
  g.DeleteTextures(1, &depth);
}
