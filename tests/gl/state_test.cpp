// The promise of nook_gl_state_mode, for every call, on both tiers.
#include <functional>

#include "platform/program.h"
#include "tests/gl/crowd.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

struct Step {
  const char* name;
  std::function<void()> call;
};

// Everything that may call OpenGL, from creation to destruction, each with the host's state poisoned before.
void walk(platform::Context& context, int tier, nook_gl_state_mode mode,
          const std::function<void(const char*, Poison&, const std::function<void()>&)>& check) {
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(21));
  nook_model other = load_model(host.handle, sample_model(22, {3, 5, 9, 30, 5, 7}));
  Crowd crowd(host.handle, {model, other}, {5, 3}, {});
  nook_gl gl = nullptr;
  nook_gl_view view{};
  view.struct_size = sizeof view;
  const Step steps[] = {
      {"create", [&] { gl = create_gl(host.handle, platform::Context::loader, &context, tier, mode); }},
      {"prepare", [&] { NOOK_OK_OR_FAIL(nook_gl_scene_prepare(gl, crowd.scene)); }},
      {"first update", [&] { NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene)); }},
      {"update with a new instance",
       [&] {
         crowd.add(crowd.ids.size());
         NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
       }},
      {"view",
       [&] { NOOK_OK_OR_FAIL(nook_gl_scene_view(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_AO, &view)); }},
      {"read", [&] { gpu_ao(gl, crowd, model, 0); }},
      {"first light",
       [&] {
         const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
         NOOK_OK_OR_FAIL(nook_scene_set_light(crowd.scene, crowd.ids[0], &lobe, 1));
         NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
       }},
      {"read directional AO",
       [&] {
         std::vector<float> rgb(3 * std::size_t(file_vertices(model)));
         NOOK_OK_OR_FAIL(nook_gl_scene_read(gl, crowd.scene, crowd.ids[0], NOOK_CHANNEL_DIRECTIONAL_AO,
                                            rgb.data(), file_vertices(model)));
       }},
      {"later update",
       [&] {
         crowd.pose(1);
         NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
       }},
  };
  for (const Step& step : steps) {
    Poison poison(context, users_of_tier(tier));
    check(step.name, poison, step.call);
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
  // The AO is right in spite of the poison.
  CHECK(difference_to_cpu(gl, crowd, model, 0) < promised_difference);
  for (const char* name : {"release", "destroy"}) {
    Poison poison(context, users_of_tier(tier));
    check(name, poison, [&] {
      if (std::string(name) == "release")
        NOOK_OK_OR_FAIL(nook_gl_scene_release(gl, crowd.scene));
      else
        nook_gl_destroy(&gl);
    });
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
  nook_model_destroy(&model);
  nook_model_destroy(&other);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

}  // namespace

TEST_CASE("PRESERVE puts all state back") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    walk(context, tier, NOOK_GL_STATE_PRESERVE,
         [&](const char* step, Poison& poison, const std::function<void()>& call) {
           INFO("tier " << tier << ", " << step);
           const StateValues touched = poison.touched(), untouched = poison.untouched();
           CHECK(touched != poison.defaults());
           call();
           CHECK(poison.touched() == touched);
           CHECK(poison.untouched() == untouched);
         });
}

TEST_CASE("DEFAULTS leaves the defaults") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    walk(context, tier, NOOK_GL_STATE_DEFAULTS,
         [&](const char* step, Poison& poison, const std::function<void()>& call) {
           INFO("tier " << tier << ", " << step);
           poison.reset_touched();
           const StateValues untouched = poison.untouched();
           call();
           CHECK(poison.touched() == poison.defaults());
           CHECK(poison.untouched() == untouched);
         });
}

TEST_CASE("HOST touches only what the list names, and works whatever it finds") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    walk(context, tier, NOOK_GL_STATE_HOST,
         [&](const char* step, Poison& poison, const std::function<void()>& call) {
           INFO("tier " << tier << ", " << step);
           const StateValues untouched = poison.untouched();
           call();
           CHECK(poison.untouched() == untouched);
         });
}

TEST_CASE("PRESERVE copes with a program that the host deleted while it was current") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_model model = load_model(host.handle, sample_model(23));
  Crowd crowd(host.handle, {model}, {5}, {});
  const GladGLContext& functions = context.gl();
  for (const int tier : tiers_of(context)) {
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    const GLuint program = platform::link_program(
        functions, {glsl_header(functions), "void main() { gl_Position = vec4(0.0); }\n"},
        {glsl_header(functions), "void main() {}\n"});
    functions.UseProgram(program);
    functions.DeleteProgram(program);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    CHECK(functions.GetError() == GL_NO_ERROR);
    functions.UseProgram(0);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
  take_debug_messages();
}

TEST_CASE("an error that the host left is logged where OpenGL is queried, and is not Nook's") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  context.gl().Enable(0xdead);
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  int found = 0;
  for (const std::string& line : host.log) found += line.find("0x0500") != std::string::npos;
  CHECK(found == 1);
  nook_gl_destroy(&gl);
  take_debug_messages();
}
