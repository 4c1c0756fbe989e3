// A pass of multisampled depth and normals against a pass of the samples that its rule takes, and two eyes in
// one call against two calls.
#include <cstdio>
#include <limits>
#include <span>

#include "sdk/src/nnao/host_depth.h"
#include "tests/gl/nnao_sampled_images.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = sampled_width, height = sampled_height;

}  // namespace

TEST_CASE("nnao: the number of the sample that a rule takes") {
  const std::vector<float> depths{3, 1, 2, 2, std::numeric_limits<float>::infinity()};
  CHECK(nnao::chosen_sample(nnao::SampleRule::first, depths) == 0);
  CHECK(nnao::chosen_sample(nnao::SampleRule::nearest, depths) == 1);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, depths) == 3);
  // Of an even number the nearer one in the middle; of equal depths in their order.
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::span(depths).first(4)) == 2);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::vector<float>(4, 5.0f)) == 1);
  CHECK(nnao::chosen_sample(nnao::SampleRule::nearest, std::vector<float>(4, 5.0f)) == 0);
  CHECK(nnao::chosen_sample(nnao::SampleRule::median, std::span(depths).first(1)) == 0);
}

TEST_CASE("nnao: each rule gives the AO of the depth and the normal of the sample that it takes") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  struct View {
    Camera camera;
    Samples samples;
    GLuint depth, normals, centre_normals;
  };
  std::vector<View> views;
  const std::vector<Camera> all = cameras(float(width) / height);
  for (const std::size_t index : {0u, 2u, 7u}) {
    const Samples samples = look_at_samples(all[index], fenced_still_life());
    const Picture centre = look(all[index], fenced_still_life(), width, height);
    views.push_back({all[index], samples,
                     fixture.textures.samples(SampledImage::depth, width, height, samples.stored),
                     fixture.textures.samples(SampledImage::colours, width, height, samples.normals),
                     single_normals(fixture, halved_range(flat(centre.normal)))});
  }
  for (const int half : {0, 1})
    for (const nook_nnao_path path : paths_of(context)) {
      const SampledSettings settings{.half = half, .path = path};
      nook_nnao plain = make_sampled_pass(fixture, 0, NOOK_NNAO_SAMPLE_MEDIAN, Normals::single, settings);
      for (const nook_nnao_sample rule : sample_rules)
        for (const Normals kind : {Normals::single, Normals::sampled}) {
          // A compute shader reads samples of normals alone.
          if (path == NOOK_NNAO_PATH_COMPUTE && kind != Normals::sampled) continue;
          nook_nnao pass = make_sampled_pass(fixture, 4, rule, kind, settings);
          for (const View& view : views)
            for (const bool given : {true, false}) {
              if (!given && kind == Normals::sampled) continue;
              const Resolved taken = resolved(rule, view.samples);
              const GLuint depth_taken =
                  fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, taken.stored);
              GLuint sampled = 0, single = 0;
              if (given) {
                sampled = kind == Normals::sampled ? view.normals : view.centre_normals;
                single =
                    kind == Normals::sampled ? single_normals(fixture, taken.normals) : view.centre_normals;
              }
              INFO(view.camera.name << ", rule " << rule << ", normals " << int(kind) << ", half " << half);
              // Samples of one depth in view space may be stored apart by a rounding, which is another tap
              // for a pixel in a thousand; elsewhere both are the same bits.
              CHECK(difference(drawn_ao(fixture, pass, sampled_frame(view.camera, view.depth, sampled)),
                               drawn_ao(fixture, plain, sampled_frame(view.camera, depth_taken, single)),
                               1.5f / 255)
                        .beyond <= 0.001f);
            }
          nook_nnao_destroy(&pass);
        }
      nook_nnao_destroy(&plain);
    }
}

TEST_CASE("nnao: of multisampled normals the one of the sample that the depth rule takes is shown") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(float(width) / height);
  // Planted: the order of the depths differs from pixel to pixel, and each sample has a normal of its own.
  const float planted[4][3] = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, -0.6f, 0.8f}, {-0.8f, 0, 0.6f}};
  std::vector<std::vector<float>> depths(4), normals(4);
  for (std::size_t pixel = 0; pixel < std::size_t(width * height); ++pixel)
    for (std::size_t sample = 0; sample < 4; ++sample) {
      depths[sample].push_back(0.8f + 0.01f * float((pixel * 7 / 3 + sample * (1 + 2 * (pixel % 2))) % 4));
      normals[sample].insert(normals[sample].end(), planted[sample], planted[sample] + 3);
    }
  for (std::vector<float>& image : normals) image = halved_range(image);
  const GLuint depth = fixture.textures.samples(SampledImage::depth, width, height, depths),
               normal = fixture.textures.samples(SampledImage::colours, width, height, normals),
               target = fixture.textures.floats(GL_RGBA8, 4, width, height, {});
  for (const nook_nnao_sample rule : sample_rules)
    for (const int half : {0, 1}) {
      nook_nnao pass = make_sampled_pass(fixture, 4, rule, Normals::sampled, {.half = half});
      ScreenFrame frame = sampled_frame(camera, depth, normal);
      frame.debug.show = NOOK_NNAO_VIEW_NORMALS;
      frame.target = NOOK_TARGET_TEXTURE;
      frame.target_name = target;
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      const std::vector<float> shown = read_texture(context.gl(), target, width, height, 3);
      std::vector<float> wanted;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const auto pixel = std::size_t(half ? y / 2 * 2 * width + x / 2 * 2 : y * width + x);
          const float of_samples[] = {depths[0][pixel], depths[1][pixel], depths[2][pixel], depths[3][pixel]};
          const std::size_t sample = nnao::chosen_sample(nnao::SampleRule(rule), of_samples);
          for (const float number : planted[sample]) wanted.push_back(0.5f * number + 0.5f);
        }
      INFO("rule " << rule << ", half " << half);
      // 8 bits of the stored normal, turned and of unit length, and of the target.
      CHECK(difference(shown, wanted, 2.0f / 255).beyond == 0);
      nook_nnao_destroy(&pass);
    }
}

TEST_CASE("nnao: two eyes of samples in one call have the AO of two calls") {
  NOOK_NEED_CONTEXT(context);
  if (!has_sample_arrays(context)) {
    std::printf("no arrays of multisample textures: not tested here\n");
    return;
  }
  NnaoFixture fixture(context);
  Textures& textures = fixture.textures;
  const std::vector<Camera> all = cameras(float(width) / height);
  const Camera eyes[] = {all[0], all[9]};
  std::vector<std::vector<std::vector<float>>> depths, normals;
  std::vector<std::vector<float>> centres;
  std::vector<float> projections;
  for (const Camera& eye : eyes) {
    const Samples samples = look_at_samples(eye, fenced_still_life());
    depths.push_back(samples.stored);
    normals.push_back(samples.normals);
    centres.push_back(halved_range(flat(look(eye, fenced_still_life(), width, height).normal)));
    projections.insert(projections.end(), eye.projection, eye.projection + 16);
  }
  const GLuint depth = textures.sample_array(SampledImage::depth, width, height, depths),
               sampled = textures.sample_array(SampledImage::colours, width, height, normals),
               single = textures.array(GL_RGB32F, 3, width, height, centres);
  const nook_nnao_path best = paths_of(context).back();
  const struct {
    SampledSettings settings;
    Normals kind;
  } cases[] = {{{.path = NOOK_NNAO_PATH_FRAGMENT}, Normals::single},
               {{.path = NOOK_NNAO_PATH_FRAGMENT}, Normals::sampled},
               {{.half = 1, .temporal = 4, .path = best}, Normals::sampled},
               {{.bent = 1, .path = best}, Normals::rebuilt}};
  for (const auto& [settings, kind] : cases) {
    PassDesc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, kind, settings);
    nook_nnao alone[] = {create_pass(fixture.gl, desc), create_pass(fixture.gl, desc)};
    desc.views = 2;
    nook_nnao both = create_pass(fixture.gl, desc);
    const int channels = settings.bent ? 4 : 1;
    for (int count = 0; count < (settings.temporal ? 2 : 1); ++count) {
      const GLuint of_both = kind == Normals::sampled ? sampled : kind == Normals::single ? single : 0;
      ScreenFrame frame = sampled_frame(eyes[0], depth, of_both);
      frame.view_projections = projections.data();
      NOOK_OK_OR_FAIL(nook_nnao_render(both, &frame, &frame));
      for (std::size_t eye = 0; eye < 2; ++eye) {
        GLuint normal = 0;
        if (kind == Normals::sampled)
          normal = textures.samples(SampledImage::colours, width, height, normals[eye]);
        if (kind == Normals::single) normal = single_normals(fixture, centres[eye]);
        const GLuint of_eye = textures.samples(SampledImage::depth, width, height, depths[eye]);
        frame = sampled_frame(eyes[eye], of_eye, normal);
        NOOK_OK_OR_FAIL(nook_nnao_render(alone[eye], &frame, &frame));
        INFO("eye " << eye << ", normals " << int(kind) << ", half " << settings.half);
        CHECK((read_texture(context.gl(), info_of(both).texture, width, height, channels, int(eye)) ==
               read_texture(context.gl(), info_of(alone[eye]).texture, width, height, channels)));
      }
    }
    for (nook_nnao* made : {&both, &alone[0], &alone[1]}) nook_nnao_destroy(made);
  }
}
