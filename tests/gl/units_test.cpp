// Worlds in several units of length: the CPU and the tiers agree, and the passes draw the picture that they
// draw in metres. tests/abi/units_test.cpp compares the AO of characters on the CPU with that in metres.
#include <cmath>
#include <cstring>

#include "tests/gl/crowd.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

namespace {

// Lengths of the world for each metre: kilometres, feet, centimetres, millimetres.
constexpr float units[] = {0.001f, 1 / 0.3048f, 100, 1000};

// A tenth of a step of a byte for AO in floats; for AO in bytes half a step of rounding.
constexpr double allowed = 5e-4;
// The shadow of a cone rounds more: seen from a point beside a capsule, an end of it is up to hundreds of
// radii of a part away, and the square of that leaves 3e-4 of the light. This moves one value of 8 bits in
// fifty by a step.
constexpr double allowed_of_light = 7e-4;

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - b[i], 2);
  return std::sqrt(sum / double(a.size()));
}

// The same crowd on the CPU in metres and on a tier in a unit of its own. The balls of a Crowd are of one
// size in all units, so that they stay away; tests/abi/units_test.cpp has some.
double error_of(platform::Context& context, const Cast& cast, int tier, float unit) {
  CrowdOptions options;
  options.occluders = false;
  const Crowd metres(cast.context.handle, cast.models, cast.bone_counts, options);
  options.scale = unit;
  const Crowd other(cast.context.handle, cast.models, cast.bone_counts, options);
  // Crowd::spacing is in bodies, the distance of link_nearest in the world's unit.
  NOOK_OK_OR_FAIL(nook_scene_link_nearest(other.scene, 3, 3.3f * unit));
  nook_gl gl = create_gl(cast.context.handle, platform::Context::loader, &context, tier);
  NOOK_OK_OR_FAIL(nook_scene_update(metres.scene));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, other.scene));
  CHECK(stats_of(other).links == stats_of(metres).links);
  double worst = 0;
  for (std::size_t i = 0; i < metres.ids.size(); ++i)
    worst = std::max(worst, rms(gpu_ao(gl, other, cast.model_of(i), i), cpu_ao(metres, cast.model_of(i), i)));
  nook_gl_destroy(&gl);
  return worst;
}

// A frame of a picture whose depth is linear, in a unit.
ScreenFrame linear_frame(NnaoFixture& fixture, const Camera& camera, const Picture& picture, float unit,
                         bool normals) {
  std::vector<float> depth = picture.depth;
  for (float& value : depth) value *= unit;
  ScreenFrame frame =
      frame_desc(camera, width, height, fixture.textures.floats(GL_R32F, 1, width, height, depth),
                 normals ? fixture.normals_of(picture) : 0, 0.5f * unit);
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  return frame;
}

std::vector<nook_capsule> scaled(std::vector<nook_capsule> capsules, float unit) {
  for (nook_capsule& c : capsules) {
    for (int i = 0; i < 3; ++i) {
      c.a[i] *= unit;
      c.b[i] *= unit;
    }
    c.radius_a *= unit;
    c.radius_b *= unit;
  }
  return capsules;
}

// The light that the world pass leaves, in a context that has the unit. light_reach has its default.
std::vector<float> world_light(platform::Context& context, float unit, bool normals, float far_away_m) {
  NnaoFixture images(context);
  nook_context_desc context_desc;
  NOOK_OK_OR_FAIL(nook_context_desc_init(&context_desc));
  context_desc.units_per_metre = unit;
  nook_context host = nullptr;
  NOOK_OK_OR_FAIL(nook_context_create(&context_desc, &host));
  nook_gl gl = create_gl(host, platform::Context::loader, &context, 0);
  nook_world_desc desc = world_desc();
  desc.coloured = 1;
  nook_world pass = nullptr;
  NOOK_OK_OR_FAIL(nook_world_create(gl, &desc, &pass));
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  View view = turned_view();
  std::vector<nook_capsule> casters = props(view);
  // A ball far above the floor, on the way to the light.
  casters.push_back(prop(view, {0, far_away_m, -2.5f}, 4, {0, far_away_m, -2.5f}, 4));
  casters = scaled(casters, unit);
  for (int i = 12; i < 15; ++i) view.matrix[i] *= unit;
  DarkenedFrame frame = world_frame(linear_frame(images, camera, picture, unit, normals), view);
  frame.capsules = casters.data();
  frame.capsule_count = std::uint32_t(casters.size());
  frame.light_axis[1] = 1;
  frame.light_degrees = 20;
  NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
  nook_world_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
  const std::vector<float> texels = read_texture(context.gl(), info.texture, width, height, 4);
  nook_world_destroy(&pass);
  nook_gl_destroy(&gl);
  nook_context_destroy(&host);
  return texels;
}

}  // namespace

TEST_CASE("the tiers give in every unit the AO that the CPU gives in metres") {
  NOOK_NEED_CONTEXT(context);
  const Cast cast(KernelForm::nook, 1);
  for (const int tier : tiers_of(context))
    for (const float unit : units) {
      INFO("tier " << tier << ", units per metre " << unit);
      CHECK(error_of(context, cast, tier, unit) <= allowed);
    }
}

TEST_CASE("world: AO and the light's cone are the same in every unit", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  for (const bool normals : {true, false}) {
    // One ball within the default reach of 30 m, and one beyond it.
    const std::vector<float> metres = world_light(context, 1, normals, 25),
                             beyond = world_light(context, 1, normals, 60);
    CHECK(rms(metres, beyond) > 20 * allowed);
    for (const float unit : units) {
      INFO("units per metre " << unit << ", normals " << normals);
      CHECK(rms(world_light(context, unit, normals, 25), metres) <= allowed_of_light);
      CHECK(rms(world_light(context, unit, normals, 60), beyond) <= allowed_of_light);
    }
  }
}

TEST_CASE("nnao: AO is the same in every unit", "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  for (const int half : {0, 1})
    for (const bool normals : {true, false}) {
      nook_nnao pass = fixture.pass_of(32, half, 1, nullptr);
      const auto drawn = [&](float unit) {
        const ScreenFrame frame = linear_frame(fixture, camera, picture, unit, normals);
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        return own_ao(context.gl(), pass, width, height);
      };
      const std::vector<float> metres = drawn(1);
      for (const float unit : units) {
        INFO("units per metre " << unit << ", half " << half << ", normals " << normals);
        CHECK(rms(drawn(unit), metres) <= allowed);
      }
    }
}
