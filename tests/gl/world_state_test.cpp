// The world pass beside its host: the state contract, refused allocations, bad input.
#include <nook/nook_world.h>

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
  ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  const GLuint colour = fixture.textures.floats(GL_RGBA16F, 4, width, height,
                                                std::vector<float>(std::size_t(width) * height * 4, 1.0f));
  const View view;
  const std::vector<nook_capsule> casters = props(view);
  const auto render = [&](bool to_texture, nook_result wanted = NOOK_OK) {
    ScreenFrame of = screen;
    if (to_texture) {
      of.target = NOOK_TARGET_TEXTURE;
      of.target_name = wanted == NOOK_OK ? colour : of.depth_texture;
      of.blend = NOOK_BLEND_MULTIPLY;
    }
    DarkenedFrame frame = world_frame(of, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    const nook_result result = nook_world_render(fixture.pass, &frame, &frame);
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
         nook_world_destroy(&fixture.pass);
         nook_world_desc desc = world_desc();
         desc.half_resolution = 1;
         fixture.made(desc);
         render(false);
       }},
      {"coloured frame", half,
       [&] {
         nook_world_destroy(&fixture.pass);
         nook_world_desc desc = world_desc();
         desc.half_resolution = desc.coloured = 1;
         fixture.made(desc);
         DarkenedFrame frame = world_frame(screen, view);
         frame.capsules = casters.data();
         frame.capsule_count = std::uint32_t(casters.size());
         frame.light_axis[1] = 1;
         frame.light_degrees = 20;
         CHECK(nook_world_render(fixture.pass, &frame, &frame) == NOOK_OK);
       }},
      {"refused frame", half, [&] { render(true, NOOK_ERROR_INVALID_ARGUMENT); }},
      {"destroy", draws, [&] { nook_world_destroy(&fixture.pass); }},
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
  const nook_world_desc desc = world_desc(32, 32);
  nook_world pass = nullptr;
  int refusals = 0;
  for (long n = 0; pass == nullptr && n < 100; ++n) {
    host.refuse_after = n;
    const nook_result result = nook_world_create(gl, &desc, &pass);
    host.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(host.bytes == bytes);
  }
  CHECK(refusals >= 1);
  nook_world_destroy(&pass);
  CHECK(host.bytes == bytes);
  nook_gl_destroy(&gl);
}

TEST_CASE("world: bad input is refused at once, and draws nothing") {
  NOOK_NEED_CONTEXT(context);
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const ScreenFrame screen = frame_desc(camera, width, height, fixture.depth_of(camera, picture), 0, 1);
  const View view;
  const std::vector<nook_capsule> casters = props(view);
  const auto refused = [&](const char* text, const std::function<void(DarkenedFrame&)>& change) {
    DarkenedFrame frame = world_frame(screen, view);
    frame.capsules = casters.data();
    frame.capsule_count = std::uint32_t(casters.size());
    change(frame);
    CHECK(nook_world_render(pass, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(text) != std::string::npos);
  };
  refused("frame.textures_changed", [](auto& f) { f.textures_changed = 2; });
  refused("desc.intensity", [](auto& f) { f.intensity = -1; });
  refused("frame.view", [](auto& f) { f.view[0] = NAN; });
  refused("frame.view", [](auto& f) { f.view[5] = 2; });
  refused("desc.capsules is NULL", [](auto& f) { f.capsules = nullptr; });
  refused("desc.cutoff_error", [](auto& f) { f.cutoff_error = -1; });
  refused("desc.level_error", [](auto& f) { f.level_error = NAN; });
  refused("desc.combine", [](auto& f) { f.combine = 2; });
  refused("debug.show", [](auto& f) { f.debug.show = -1; });
  refused("desc.ao_texture", [](auto& f) { f.ao_texture = 12345; });
  nook_capsule bad = casters[0];
  bad.radius_a = 0;
  refused("desc.capsules[0] has a radius", [&](auto& f) {
    f.capsules = &bad;
    f.capsule_count = 1;
  });
  refused("frame.width", [](auto& f) { f.width = 4 * width; });
  CHECK(nook_world_render(nullptr, nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  for (const float value : fixture.own()) REQUIRE(value == 1);
  nook_world_desc desc = world_desc(0, 4);
  nook_world none = nullptr;
  CHECK(nook_world_create(fixture.gl, &desc, &none) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  desc = world_desc(4, 4);
  desc.half_resolution = 2;
  CHECK(nook_world_create(fixture.gl, &desc, &none) == NOOK_ERROR_INVALID_ARGUMENT);
}
