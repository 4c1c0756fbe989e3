// Passes of multisampled images: the frames that they refuse, their memory, and the OpenGL state that they
// leave.
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_stages.h>
#include <cstring>

#include "sdk/src/gl/touched_state.h"
#include "tests/gl/nnao_sampled_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = sampled_width, height = sampled_height;

bool message_has(const char* part) {
  INFO(nook_last_message());
  return std::strstr(nook_last_message(), part) != nullptr;
}

}  // namespace

TEST_CASE("nnao: multisampled images are refused where they do not fit, and by their name") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  Textures& textures = fixture.textures;
  const Camera camera = plain_camera(float(width) / height);
  nook_nnao pass = nullptr;
  const auto unsupported = [&](int layers, const char* message) {
    PassDesc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
    desc.views = layers;
    CHECK(nook_nnao_create(fixture.gl, &desc, &pass) == NOOK_ERROR_UNSUPPORTED);
    CHECK(pass == nullptr);
    CHECK(message_has(message));
  };
  if (context.is_es() && version_of(context) < 31) {
    unsupported(0, "desc.depth_samples needs multisample textures (got OpenGL ES 3.0, need 3.1 or newer)");
    unsupported(2, "desc.depth_samples needs multisample textures");
    return;
  }
  if (context.is_es() && version_of(context) < 32)
    unsupported(2,
                "desc.views with desc.depth_samples needs multisample texture arrays (got OpenGL ES 3.1, "
                "need 3.2 or newer)");
  NOOK_NEED_SAMPLES(context);
  const std::vector<float> image(std::size_t(width * height), 0.9f), colours(3 * image.size(), 0.9f);
  const std::vector<std::vector<float>> four(4, image), four_colours(4, colours), two_colours(2, colours);
  const GLuint samples = textures.samples(SampledImage::depth, width, height, four),
               normals = textures.samples(SampledImage::colours, width, height, four_colours),
               two_normals = textures.samples(SampledImage::colours, width, height, two_colours),
               flat_normals = single_normals(fixture, colours),
               flat = textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, image);
  pass = make_sampled_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN);
  nook_nnao plain = make_sampled_pass(fixture, 0, NOOK_NNAO_SAMPLE_MEDIAN),
            eight = make_sampled_pass(fixture, 8, NOOK_NNAO_SAMPLE_MEDIAN),
            both = make_sampled_pass(fixture, 4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
  const auto refused = [&](nook_nnao by, GLuint depth, GLuint normal, const char* message) {
    ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.5f);
    CHECK(nook_nnao_render(by, &frame, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has(message));
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    take_debug_messages();
  };
  refused(pass, flat, 0, "frame.depth_texture is a texture of another kind");
  refused(pass, flat, 0, "need a multisample texture");
  refused(plain, samples, 0, "need a 2D texture without layers or samples");
  refused(plain, samples, 0, "set nook_nnao_desc.depth_samples to its number of samples");
  refused(plain, flat, normals, "frame.normal_texture is a texture of another kind");
  refused(plain, flat, normals, "only depth and normals may be");
  nook_world world = nullptr;
  const nook_world_desc world_desc = world::world_desc(width, height);
  NOOK_OK_OR_FAIL(nook_world_create(fixture.gl, &world_desc, &world));
  const DarkenedFrame darkened(frame_desc(camera, width, height, samples, 0, 0.5f));
  CHECK(nook_world_render(world, &darkened, &darkened) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("this pass cannot read: resolve it"));
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  take_debug_messages();
  nook_world_destroy(&world);
  refused(pass, samples, normals, "frame.normal_texture is a texture of another kind");
  refused(both, samples, flat_normals, "frame.normal_texture is a texture of another kind");
  refused(both, samples, flat_normals, "need a multisample texture");
  refused(eight, samples, 0,
          "frame.depth_texture has another size (got 4 samples, need desc.depth_samples, 8)");
  GLint least = 0;  // a driver may round the number up
  context.gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, two_normals);
  context.gl().GetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE, 0, GL_TEXTURE_SAMPLES, &least);
  context.gl().BindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
  if (least == 2)
    refused(both, samples, two_normals,
            "frame.normal_texture has another size (got 2 samples, need desc.depth_samples, 4)");
  ScreenFrame frame = frame_desc(camera, width, height, samples, 0, 0.5f);
  nook_nnao_recording recording = nullptr;
  CHECK(nook_nnao_record(pass, &frame, &frame, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("this pass reads texture arrays or multisample textures"));
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  // Normals are optional with samples as without.
  NOOK_OK_OR_FAIL(nook_nnao_render(both, &frame, &frame));
  for (nook_nnao* made : {&plain, &eight}) nook_nnao_destroy(made);
  if (has_sample_arrays(context)) {
    PassDesc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::sampled);
    desc.views = 2;
    nook_nnao eyes = create_pass(fixture.gl, desc);
    const GLuint array = textures.sample_array(SampledImage::depth, width, height, {four, four}),
                 one = textures.sample_array(SampledImage::depth, width, height, {four});
    refused(eyes, samples, 0, "need a multisample texture array");
    refused(eyes, one, 0, "frame.depth_texture has another size (got 1 layers, need desc.views, 2)");
    refused(eyes, array, normals, "frame.normal_texture is a texture of another kind");
    refused(pass, array, 0, "frame.depth_texture is a texture of another kind");
    nook_nnao_destroy(&eyes);
  }
  for (nook_nnao* made : {&pass, &both}) nook_nnao_destroy(made);
}

TEST_CASE("nnao: the number of a normal's sample takes four bytes of each pixel of the surface") {
  PassDesc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, Normals::rebuilt);
  for (const int half : {0, 1})
    for (const int temporal : {0, 4}) {
      desc.half_resolution = half;
      desc.max_history_frames = temporal;
      std::uint64_t one = 0, with = 0;
      desc.normal_samples = 0;
      NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &one));
      desc.normal_samples = 4;
      NOOK_OK_OR_FAIL(nook_nnao_memory(&desc, &with));
      CHECK(with - one == std::uint64_t((temporal ? 8 : 4) * width * height / (half ? 4 : 1)));
    }
}

TEST_CASE("nnao: passes of multisampled images keep the state contract") {
  NOOK_NEED_CONTEXT(context);
  NOOK_NEED_SAMPLES(context);
  const std::vector<float> image(std::size_t(width * height), 0.9f), colours(3 * image.size(), 0.9f);
  const std::vector<std::vector<float>> four(4, image), four_colours(4, colours);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS})
    for (const int layers : {0, 2})
      for (const Normals kind : {Normals::single, Normals::sampled}) {
        if (layers && !has_sample_arrays(context)) continue;
        NnaoFixture fixture(context, mode);
        Textures& textures = fixture.textures;
        const auto sampled = [&](SampledImage of, const std::vector<std::vector<float>>& images) {
          return layers ? textures.sample_array(of, width, height, {images, images})
                        : textures.samples(of, width, height, images);
        };
        const GLuint normals = kind == Normals::sampled ? sampled(SampledImage::colours, four_colours)
                               : layers ? textures.array(GL_RGB32F, 3, width, height, {colours, colours})
                                        : single_normals(fixture, colours);
        const ScreenFrame frame =
            sampled_frame(plain_camera(float(width) / height), sampled(SampledImage::depth, four), normals);
        PassDesc desc = sampled_desc(4, NOOK_NNAO_SAMPLE_MEDIAN, kind, {.half = 1});
        desc.views = layers;
        nook_nnao pass = create_pass(fixture.gl, desc);
        const unsigned compute = info_of(pass).compute ? unsigned{gl::screen_compute} : 0u;
        const unsigned images = layers ? gl::screen_layers | gl::screen_sample_layers : gl::screen_samples;
        Poison poison(context, gl::screen | images | compute);
        if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
        StateValues before = poison.touched();
        const StateValues untouched = poison.untouched();
        NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
        StateValues after = poison.touched();
        if (mode == NOOK_GL_STATE_DEFAULTS) before = poison.defaults(), after.erase("viewport");
        INFO("layers " << layers << ", normals " << int(kind));
        CHECK(after == before);
        CHECK(poison.untouched() == untouched);
        nook_nnao_destroy(&pass);
      }
}
