// nook_gl.h as callers of older and newer headers use it.
#include "sdk/src/character/model_file.h"
#include "tests/abi/growing_struct.h"
#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

std::vector<std::byte> nook_test_model_bytes() {
  return write_character_model(sample_model(3));
}

TEST_CASE("answers about OpenGL are cut to the caller's struct") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(3));
  Crowd crowd(host.handle, {model}, {5}, {});
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene));
  check_info<nook_gl_info>([&](nook_gl_info* info) { return nook_gl_describe(gl, info); });
  check_info<nook_gl_view>([&](nook_gl_view* view) {
    return nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, view);
  });
  const nook_lobe lobe{{0, 1, 0}, 6, {1, 1, 1}, 0};
  NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[0], &lobe, 1));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  check_info<nook_gl_view>([&](nook_gl_view* view) {
    return nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_DIRECTIONAL_AO, view);
  });
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}
