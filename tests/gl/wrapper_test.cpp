// The C++ wrapper of nook_gl.h on a living OpenGL context. This file sees public headers only, as a host
// does.
#include <nook/nook.hpp>

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "test_context.h"

std::vector<std::byte> nook_test_model_bytes();
std::vector<std::byte> nook_test_material_bytes();

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
  const nook_gl_ao_view view = gl.ao_buffer(scene, id);
  CHECK(view.count == count);
  CHECK(context.gl().IsBuffer(view.buffer));
  gl.update(scene);
  gl.read_ao(scene, id, gpu.data(), count);
  scene.update();
  scene.read_ao(id, cpu.data(), count);
  // The header's promise.
  for (std::uint32_t i = 0; i < count; ++i) CHECK(std::fabs(gpu[i] - cpu[i]) < 2e-3f);
  CHECK(gl.info().ao_bytes >= count * sizeof(float));

  gl.release(scene);
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
  nook::GlMaterial uploaded(gl, material);
  const std::vector<nook_gl_material_texture> textures = uploaded.textures();
  CHECK(textures.size() == 7);
  CHECK(textures[0].uniform == std::string("nook_light_map"));
  CHECK(uploaded.info().texture_bytes == material.info().table_bytes);
  for (const nook_gl_material_texture& texture : textures) CHECK(context.gl().IsTexture(texture.texture));
  uploaded = nook::GlMaterial();
  for (const nook_gl_material_texture& texture : textures)
    CHECK_FALSE(context.gl().IsTexture(texture.texture));
}
