// The error of each stage in medium precision, on OpenGL ES, against ray tracing.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/gl/nnao_images.h"
#include "tests/gl/nnao_stage_renderer.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 96, height = 64, rays = 256;
constexpr float radius = 0.5f;

bool hits(const Surface& surface, Vec3 origin, Vec3 direction) {
  if (!surface.ball) {
    const float t = (surface.offset_or_radius - dot(origin, surface.normal_or_centre)) /
                    dot(direction, surface.normal_or_centre);
    return t > 1e-4f && t < radius;
  }
  const Vec3 to = surface.normal_or_centre - origin;
  const float b = dot(to, direction);
  const float rest = b * b - dot(to, to) + surface.offset_or_radius * surface.offset_or_radius;
  if (rest <= 0) return false;
  const float near = b - std::sqrt(rest), far = b + std::sqrt(rest);
  return (near > 1e-4f && near < radius) || (far > 1e-4f && far < radius);
}

// Cosine-weighted visibility of the hemisphere up to the radius, by points of a golden spiral.
float traced_ao(const std::vector<Surface>& scene, Vec3 position, Vec3 normal) {
  const Vec3 aside = std::abs(normal.x) < 0.5f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalised(cross(aside, normal)), y = cross(normal, x);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const float share = (float(i) + 0.5f) / rays, r = std::sqrt(share), angle = 2.39996323f * float(i);
    const Vec3 direction =
        x * (r * std::cos(angle)) + y * (r * std::sin(angle)) + normal * std::sqrt(1 - share);
    const Vec3 origin = position + normal * 1e-3f;
    open +=
        std::ranges::none_of(scene, [&](const Surface& surface) { return hits(surface, origin, direction); });
  }
  return float(open) / rays;
}

std::vector<float> truth_of(const Picture& picture, const std::vector<Surface>& scene) {
  std::vector<float> ao;
  const nnao::View view = picture.view();
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const std::size_t pixel = view.at(x, y);
      const Vec3 position =
          nnao::view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, picture.depth[pixel]);
      ao.push_back(view.has_surface(x, y) ? traced_ao(scene, position, picture.normal[pixel]) : 1);
    }
  return ao;
}

// The text of a stage as GLSL ES 3.10. The numbers of the frame keep their precision.
std::string with_precision(std::string text, const char* precision) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at != std::string::npos) text.replace(at, from.size(), to);
  };
  std::string head =
      "#version 310 es\nprecision highp int;\nprecision highp sampler2D;\n"
      "precision highp usampler2D;\nprecision ";
  head.append(precision).append(" float;\n");
  replace("#version 450\n", head);
  replace("  vec4 nook_earlier[", "  highp vec4 nook_earlier[");
  return text;
}

struct Measured {
  double squared = 0, changed = 0, beyond = 0, pixels = 0;
};

// Adds the error of the pass with each of its stages in medium precision, and with none.
void measure_stages(NnaoFixture& fixture, nook_nnao_stages stages, const Camera& camera,
                    std::map<std::string, Measured>& measured) {
  const GladGLContext& gl = fixture.context.gl();
  const Picture picture = look(camera, still_life(), width, height);
  const std::vector<float> truth = truth_of(picture, still_life());
  const GLuint depth = nearest(gl, GL_TEXTURE_2D, fixture.depth_of(camera, picture));
  const ScreenFrame frame = frame_desc(camera, width, height, depth, 0, radius);
  auto info = sized<nook_nnao_stages_info>();
  NOOK_OK_OR_FAIL(nook_nnao_stages_describe(stages, &info));
  std::vector<std::string> names{"none"};
  for (std::uint32_t i = 0; i + 1 < info.stage_count; ++i) {
    auto stage = sized<nook_nnao_stage_info>();
    NOOK_OK_OR_FAIL(nook_nnao_stages_describe_stage(stages, i, &stage));
    // Two filters draw filter_x and filter_y twice; a name stands for both of its draws.
    if (std::find(names.begin(), names.end(), stage.name) == names.end()) names.push_back(stage.name);
  }
  std::vector<float> high;
  for (const std::string& name : names) {
    StageRenderer renderer(gl, stages, [&](const std::string& text, const std::string& stage) {
      return with_precision(text, stage == name ? "mediump" : "highp");
    });
    renderer.draw(frame, nullptr, 0, 0,
                  {{NOOK_NNAO_IMAGE_HOST_DEPTH, {GL_TEXTURE_2D, depth}},
                   {NOOK_NNAO_IMAGE_HOST_NORMAL, {GL_TEXTURE_2D, depth}}});
    const std::vector<float> ao = read_texture(gl, renderer.target(), width, height);
    if (name == "none") high = ao;
    Measured& sum = measured[name];
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double error = ao[i] - truth[i], change = std::abs(ao[i] - high[i]);
      sum.squared += error * error;
      sum.changed += change > 0.5 / 255;
      sum.beyond += change > 1.5 / 255;
      sum.pixels += 1;
    }
  }
}

}  // namespace

TEST_CASE("nnao: the error of each stage in medium precision is printed, and the filter's is small") {
  NOOK_NEED_CONTEXT(context);
  if (!context.is_es() || version_of(context) < 31) {
    std::printf("medium precision is measured on OpenGL ES 3.1 and later\n");
    return;
  }
  const std::vector<Camera> all = cameras(float(width) / height);
  const struct {
    const char* name;
    int half, blur;
  } passes[] = {{"full resolution", 0, 1},
                {"half resolution", 1, 1},
                {"two filters", 0, 2},
                {"half resolution, two filters", 1, 2}};
  for (const auto& pass : passes) {
    NnaoFixture fixture(context);
    PassDesc desc = pass_desc(width, height);
    desc.half_resolution = pass.half;
    desc.blur = pass.blur;
    nook_nnao_stages stages = nullptr;
    NOOK_OK_OR_FAIL(nook_nnao_stages_create(fixture.host.handle, &desc, &stages));
    std::map<std::string, Measured> measured;
    for (std::size_t index = 0; index < all.size(); ++index)
      measure_stages(fixture, stages, all[index], measured);
    nook_nnao_stages_destroy(&stages);
    const double high = measured.at("none").squared;
    for (const auto& [name, sum] : measured)
      std::printf(
          "%s, medium precision in stage %s: mse %.3e, %.4f of that in high precision; %.1f %% of the "
          "pixels change, %.1f %% by more than a step\n",
          pass.name, name.c_str(), sum.squared / sum.pixels, sum.squared / high,
          100 * sum.changed / sum.pixels, 100 * sum.beyond / sum.pixels);
    // The pass draws its filter at half resolution in medium precision. AO is rounded to 8 bits afterwards,
    // so that 1 to 5 % of the pixels take the next step. At an rms error of 0.065, the squared error changes
    // by 2 * 0.05 * 0.065 / 255 / 0.0042 = 0.6 % if all of them step away from the truth. Less than half of
    // that may happen; measured: -0.1 to 0.1 %. A mean of seven texels can be two steps away in a pixel of
    // thousands.
    if (pass.half) {
      for (const char* const filter : {"filter_x", "filter_y"}) {
        CHECK(measured.at(filter).squared < 1.0025 * high);
        CHECK(measured.at(filter).beyond < 1e-3 * measured.at(filter).pixels);
      }
    }
  }
}
