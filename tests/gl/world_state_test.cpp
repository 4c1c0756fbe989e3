// The world pass beside its host: the state contract, refused allocations, bad input.
#include <nook/nook_gl_world.h>

#include <cmath>
#include <functional>
#include <utility>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/poison.h"
#include "tests/gl/traced_loader.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

namespace {

using Check = std::function<void(const char*, Poison&, const std::function<void()>&)>;

void walk(platform::Context& context, nook_gl_state_mode mode, const Check& check) {
  WorldFixture fixture(context, mode);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  nook_nnao_frame_desc screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const GLuint colour = fixture.textures.floats(GL_RGBA16F, 4, width, height,
                                                std::vector<float>(std::size_t(width) * height * 4, 1.0f));
  const View view;
  const std::vector<nook_world_capsule> casters = props(view);
  const auto render = [&](bool to_texture, nook_result wanted = NOOK_OK) {
    nook_nnao_frame_desc of = screen;
    if (to_texture) {
      of.target = NOOK_NNAO_TARGET_TEXTURE;
      of.target_name = wanted == NOOK_OK ? colour : of.depth_texture;
      of.blend = NOOK_NNAO_MULTIPLY;
    }
    nook_world_frame_desc frame = world_frame(of, view);
    frame.props = casters.data();
    frame.prop_count = std::uint32_t(casters.size());
    const nook_result result = nook_world_render(fixture.pass, &frame);
    INFO(nook_last_message());
    CHECK(result == wanted);
  };
  const unsigned draws = gl::screen | (context.is_es() ? unsigned{gl::texel_uploads} : 0u);
  const unsigned half = draws | (computes(tiers_of(context).front()) ? unsigned{gl::screen_compute} : 0u);
  const struct {
    const char* name;
    unsigned users;
    std::function<void()> call;
  } steps[] = {
      {"create", draws, [&] { fixture.made(); }},
      {"texture", draws, [&] { render(true); }},
      {"first frame", draws, [&] { render(false); }},
      {"later frame", draws, [&] { render(false); }},
      {"half resolution", half,
       [&] {
         nook_world_pass_destroy(&fixture.pass);
         nook_world_pass_desc desc = world_desc();
         desc.half_resolution = 1;
         fixture.made(desc);
         render(false);
       }},
      {"coloured frame", half,
       [&] {
         nook_world_pass_destroy(&fixture.pass);
         nook_world_pass_desc desc = world_desc();
         desc.half_resolution = desc.coloured = 1;
         fixture.made(desc);
         nook_world_frame_desc frame = world_frame(screen, view);
         frame.props = casters.data();
         frame.prop_count = std::uint32_t(casters.size());
         frame.light_axis[1] = 1;
         frame.light_degrees = 20;
         CHECK(nook_world_render(fixture.pass, &frame) == NOOK_OK);
       }},
      {"refused frame", half, [&] { render(true, NOOK_ERROR_INVALID_ARGUMENT); }},
      {"destroy", draws, [&] { nook_world_pass_destroy(&fixture.pass); }},
  };
  for (const auto& [name, users, call] : steps) {
    Poison poison(context, users);
    check(name, poison, call);
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
}

}  // namespace

TEST_CASE("world: PRESERVE puts all state back") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_PRESERVE,
       [&](const char* step, Poison& poison, const std::function<void()>& call) {
         INFO(step);
         const StateValues touched = poison.touched(), untouched = poison.untouched();
         call();
         CHECK(poison.touched() == touched);
         CHECK(poison.untouched() == untouched);
       });
}

TEST_CASE("world: HOST touches nothing beside the list") {
  NOOK_NEED_CONTEXT(context);
  walk(context, NOOK_GL_STATE_HOST, [&](const char* step, Poison& poison, const std::function<void()>& call) {
    INFO(step);
    const StateValues untouched = poison.untouched();
    call();
    CHECK(poison.untouched() == untouched);
  });
}

TEST_CASE("world: every refused allocation leaves nothing behind") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  const long long bytes = host.bytes;
  const nook_world_pass_desc desc = world_desc(32, 32);
  nook_world_pass pass = nullptr;
  int refusals = 0;
  for (long n = 0; pass == nullptr && n < 100; ++n) {
    host.refuse_after = n;
    const nook_result result = nook_world_pass_create(gl, &desc, &pass);
    host.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.bytes == bytes);
  }
  CHECK(refusals >= 1);
  nook_world_pass_destroy(&pass);
  CHECK(host.bytes == bytes);
  nook_gl_destroy(&gl);
}

TEST_CASE("world: bad input is refused at once, and draws nothing") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world_pass pass = fixture.made();
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const nook_nnao_frame_desc screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), 0, 1);
  const View view;
  const std::vector<nook_world_capsule> casters = props(view);
  const auto refused = [&](const char* text, const std::function<void(nook_world_frame_desc&)>& change) {
    nook_world_frame_desc frame = world_frame(screen, view);
    frame.props = casters.data();
    frame.prop_count = std::uint32_t(casters.size());
    change(frame);
    CHECK(nook_world_render(pass, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(text) != std::string::npos);
  };
  refused("frame.screen", [](auto& f) { f.screen = nullptr; });
  refused("frame.view", [](auto& f) { f.view[0] = NAN; });
  refused("frame.view", [](auto& f) { f.view[5] = 2; });
  refused("frame.props is NULL", [](auto& f) { f.props = nullptr; });
  refused("frame.cutoff_error", [](auto& f) { f.cutoff_error = -1; });
  refused("frame.level_error", [](auto& f) { f.level_error = NAN; });
  refused("frame.composition", [](auto& f) { f.composition = 2; });
  refused("frame.show", [](auto& f) { f.show = -1; });
  refused("frame.ao_texture", [](auto& f) { f.ao_texture = 12345; });
  nook_world_capsule bad = casters[0];
  bad.radius_a = 0;
  refused("frame.props[0] has a radius", [&](auto& f) {
    f.props = &bad;
    f.prop_count = 1;
  });
  nook_nnao_frame_desc wide = screen;
  wide.width = 4 * width;
  refused("frame.width", [&](auto& f) { f.screen = &wide; });
  CHECK(nook_world_render(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_world_recheck(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  NOOK_OK_OR_FAIL(nook_world_recheck(pass));
  for (const float value : fixture.own()) REQUIRE(value == 1);
  nook_world_pass_desc desc = world_desc(0, 4);
  nook_world_pass none = nullptr;
  CHECK(nook_world_pass_create(fixture.gl, &desc, &none) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  desc = world_desc(4, 4);
  desc.half_resolution = 2;
  CHECK(nook_world_pass_create(fixture.gl, &desc, &none) == NOOK_ERROR_INVALID_ARGUMENT);
}
