// Where nothing wrote a normal, targets of normalised integers hold what they were cleared to: about 1/2 in
// each channel, which is a short vector. Its normal follows from depth, as without a texture of normals.
#include <nook/experimental/nook_recording.h>

#include <cmath>
#include <numeric>

#include "sdk/src/nnao/recording.h"
#include "tests/gl/nnao_sampled_images.h"
#include "tests/gl/nnao_stage_renderer.h"
#include "tests/gl/test_context.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr int width = 48, height = 32;

struct Cleared {
  const char* name;
  GLuint texture;
  float scale, bias;
};

// Textures of one texel value, as glClear leaves them.
std::vector<Cleared> cleared_textures(const GladGLContext& gl, Textures& textures) {
  const std::size_t pixels = std::size_t(width) * height;
  const std::vector<std::uint8_t> half(4 * pixels, 128), half_below(4 * pixels, 127);
  const std::vector<std::int8_t> near_zero(4 * pixels, 1), short_ones(4 * pixels, 16);
  const std::vector<std::uint32_t> ten(pixels, 512u | 512u << 10 | 512u << 20 | 3u << 30);
  std::vector<Cleared> all{
      {"GL_RGBA8, 128", textures.make(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height, half.data()), 2,
       -1},
      {"GL_RGBA8, 127", textures.make(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height, half_below.data()),
       2, -1},
      {"GL_RGB10_A2",
       textures.make(GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, width, height, ten.data()), 2, -1},
      {"GL_RGBA8_SNORM, 1", textures.make(GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, width, height, near_zero.data()),
       1, 0},
      {"GL_RGBA8_SNORM, 16",
       textures.make(GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, width, height, short_ones.data()), 1, 0}};
  if (!is_es(gl)) {
    const std::vector<std::uint16_t> wide(4 * pixels, 32768);
    all.push_back({"GL_RGBA16",
                   textures.make(GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, width, height, wide.data()), 2, -1});
  }
  return all;
}

ScreenFrame with_normals(ScreenFrame frame, const Cleared& normals) {
  frame.normal_texture = normals.texture;
  frame.normal_scale = normals.scale;
  frame.normal_bias = normals.bias;
  return frame;
}

struct Still {
  explicit Still(platform::Context& context)
      : fixture(context),
        camera(plain_camera(float(width) / height)),
        picture(look(camera, still_life(), width, height)),
        depth(fixture.depth_of(camera, picture)) {}

  ScreenFrame frame() const { return frame_desc(camera, width, height, depth, 0, 0.8f); }
  std::vector<float> drawn(nook_nnao pass, const ScreenFrame& frame) {
    NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
    return own_ao(fixture.context.gl(), pass, width, height);
  }

  NnaoFixture fixture;
  Camera camera;
  Picture picture;
  GLuint depth;
};

}  // namespace

TEST_CASE("cleared normals: AO is the same as without a texture of normals, on every path and form") {
  NOOK_NEED_CONTEXT(context);
  Still still(context);
  const std::vector<Cleared> textures = cleared_textures(context.gl(), still.fixture.textures);
  for (const nnao::NetworkForm form : {nnao::NetworkForm::horizon, nnao::NetworkForm::paper})
    for (const nook_nnao_path path : paths_of(context))
      for (const int half : {0, 1}) {
        if (form == nnao::NetworkForm::paper && path != NOOK_NNAO_PATH_FRAGMENT) continue;
        INFO("form " << int(form) << ", path " << path << ", half " << half);
        const nnao::Network network = mild_network(form);
        PassDesc desc = pass_desc(width, height);
        desc.taps = 16;
        desc.half_resolution = half;
        desc.debug.path = path;
        nook_nnao pass = create_pass(still.fixture.gl, desc, network);
        const std::vector<float> wanted = still.drawn(pass, still.frame());
        for (const Cleared& cleared : textures) {
          INFO(cleared.name);
          ScreenFrame frame = with_normals(still.frame(), cleared);
          CHECK((still.drawn(pass, frame) == wanted));
          // Scales lengths, and so the bound.
          for (float& element : frame.normal_matrix) element *= 0.1f;
          CHECK((still.drawn(pass, frame) == wanted));
        }
        nook_nnao_destroy(&pass);
      }
}

TEST_CASE("cleared normals: normals that were written stay, and short ones in floats") {
  NOOK_NEED_CONTEXT(context);
  Still still(context);
  Textures& textures = still.fixture.textures;
  nook_nnao pass = create_pass(still.fixture.gl, pass_desc(width, height));
  // The left half has normals.
  std::vector<float> eight_bits = halved_range(flat(still.picture.normal)), four_channels;
  std::vector<float> as_floats;
  for (std::size_t i = 0; i < std::size_t(width) * height; ++i) {
    const bool written = int(i % width) < width / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      four_channels.push_back(written ? eight_bits[3 * i + k] : 128.0f / 255);
      as_floats.push_back(written ? eight_bits[3 * i + k] : 0.5f);  // no length at all
    }
    four_channels.push_back(1);
    as_floats.push_back(1);
  }
  const Cleared bytes{"", textures.floats(GL_RGBA8, 4, width, height, four_channels), 2, -1},
      floats{"", textures.floats(GL_RGBA32F, 4, width, height, as_floats), 2, -1};
  const std::vector<float> found = still.drawn(pass, with_normals(still.frame(), bytes)),
                           wanted = still.drawn(pass, with_normals(still.frame(), floats));
  CHECK((found == wanted));
  CHECK((found != still.drawn(pass, still.frame())));
  // A tenth of the length, and a half in a matrix of normalised integers.
  std::vector<float> tenth;
  for (std::size_t i = 0; i < as_floats.size(); ++i)
    tenth.push_back(0.1f * (2 * eight_bits[std::min(3 * (i / 4) + i % 4, eight_bits.size() - 1)] - 1));
  std::vector<float> whole = tenth;
  for (float& number : whole) number *= 10;
  const auto float_frame = [&](const std::vector<float>& values) {
    return with_normals(still.frame(), {"", textures.floats(GL_RGBA32F, 4, width, height, values), 1, 0});
  };
  CHECK(difference(still.drawn(pass, float_frame(tenth)), still.drawn(pass, float_frame(whole)), 1.1f / 255)
            .largest < 1.1f / 255);
  nook_nnao_destroy(&pass);
}

TEST_CASE("cleared normals: with samples and views AO is the same as without normals") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  Still still(context);
  Textures& textures = still.fixture.textures;
  const std::vector<float> stored = stored_depth(still.camera, still.picture);
  const std::vector<float> cleared(std::size_t(3) * width * height, 128.0f / 255);
  std::vector<float> cleared_rgba(std::size_t(4) * width * height, 128.0f / 255);
  if (samples_of(context) > 0) {
    const std::size_t count = std::size_t(samples_of(context));
    PassDesc desc = pass_desc(width, height);
    desc.depth_samples = desc.normal_samples = samples_of(context);
    nook_nnao pass = create_pass(still.fixture.gl, desc);
    ScreenFrame frame = still.frame();
    frame.depth_texture =
        textures.samples(SampledImage::depth, width, height, std::vector<std::vector<float>>(count, stored));
    const std::vector<float> wanted = still.drawn(pass, frame);
    frame = with_normals(frame, {"",
                                 textures.samples(SampledImage::colours, width, height,
                                                  std::vector<std::vector<float>>(count, cleared)),
                                 2, -1});
    CHECK((still.drawn(pass, frame) == wanted));
    nook_nnao_destroy(&pass);
  }
  {
    PassDesc desc = pass_desc(width, height);
    desc.views = 2;
    nook_nnao pass = create_pass(still.fixture.gl, desc);
    ScreenFrame frame = still.frame();
    frame.depth_texture = textures.array(GL_R32F, 1, width, height, {stored, stored});
    const auto eyes = [&] {
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      std::vector<float> both = read_texture(gl, info_of(pass).texture, width, height, 1, 0);
      const std::vector<float> right = read_texture(gl, info_of(pass).texture, width, height, 1, 1);
      both.insert(both.end(), right.begin(), right.end());
      return both;
    };
    const std::vector<float> wanted = eyes();
    frame = with_normals(
        frame, {"", textures.array(GL_RGBA8, 4, width, height, {cleared_rgba, cleared_rgba}), 2, -1});
    CHECK((eyes() == wanted));
    nook_nnao_destroy(&pass);
  }
}

TEST_CASE("cleared normals: with stages AO is the same as without normals") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  if (is_es(gl) || version_of(context) < 43) return;  // the text of stages is of OpenGL 4.5
  Still still(context);
  Textures& textures = still.fixture.textures;
  const std::vector<float> stored = stored_depth(still.camera, still.picture);
  const std::vector<float> cleared_rgba(std::size_t(4) * width * height, 128.0f / 255);
  const PassDesc desc = pass_desc(width, height);
  nook_nnao_stages stages = nullptr;
  NOOK_OK_OR_FAIL(nook_nnao_stages_create(still.fixture.host.handle, &desc, &stages));
  {
    StageRenderer renderer(gl, stages);
    const GLuint normals =
                     nearest(gl, GL_TEXTURE_2D, textures.floats(GL_RGBA8, 4, width, height, cleared_rgba)),
                 depth = nearest(gl, GL_TEXTURE_2D, textures.floats(GL_R32F, 1, width, height, stored));
    const std::map<nook_nnao_image, std::pair<GLenum, GLuint>> host{
        {NOOK_NNAO_IMAGE_HOST_DEPTH, {GL_TEXTURE_2D, depth}},
        {NOOK_NNAO_IMAGE_HOST_NORMAL, {GL_TEXTURE_2D, normals}}};
    ScreenFrame frame = still.frame();
    renderer.draw(frame, nullptr, 0, 0, host);
    const std::vector<float> wanted = read_texture(gl, renderer.target(), width, height);
    renderer.draw(with_normals(frame, {"", normals, 2, -1}), nullptr, 0, 0, host);
    CHECK((read_texture(gl, renderer.target(), width, height) == wanted));
  }
  nook_nnao_stages_destroy(&stages);
}

TEST_CASE("cleared normals: the world pass is the same as without normals") {
  NOOK_NEED_CONTEXT(context);
  for (const int half : {0, 1}) {
    world::WorldFixture fixture(context);
    nook_world_desc desc = world::world_desc(width, height);
    desc.half_resolution = half;
    nook_world pass = fixture.made(desc);
    const Camera camera = plain_camera(float(width) / height);
    const Picture picture = look(camera, still_life(), width, height);
    const ScreenFrame screen = frame_desc(camera, width, height, fixture.depth_of(camera, picture), 0, 1);
    const world::View view;
    const std::vector<nook_capsule> casters = world::props(view);
    const auto drawn = [&](const ScreenFrame& of) {
      DarkenedFrame frame = world::world_frame(of, view);
      frame.capsules = casters.data();
      frame.capsule_count = std::uint32_t(casters.size());
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      return fixture.own(width, height);
    };
    const std::vector<float> wanted = drawn(screen);
    CHECK(world::darkest(wanted) < 0.9f);
    for (const Cleared& cleared : cleared_textures(context.gl(), fixture.textures)) {
      INFO(cleared.name << ", half " << half);
      CHECK((drawn(with_normals(screen, cleared)) == wanted));
    }
  }
}

TEST_CASE("cleared normals: a recording gives the CPU the same normals") {
  NOOK_NEED_CONTEXT(context);
  Still still(context);
  nook_nnao pass = create_pass(still.fixture.gl, pass_desc(width, height));
  for (const Cleared& cleared : cleared_textures(context.gl(), still.fixture.textures)) {
    INFO(cleared.name);
    const ScreenFrame frame = with_normals(still.frame(), cleared);
    nook_nnao_recording handle = nullptr;
    NOOK_OK_OR_FAIL(nook_nnao_record(pass, &frame, &frame, nullptr, &handle));
    nook_nnao_recording_desc recorded{};
    recorded.struct_size = sizeof recorded;
    NOOK_OK_OR_FAIL(nook_nnao_recording_describe(handle, &recorded));
    REQUIRE(recorded.normals != nullptr);
    double longest = 0;
    for (int i = 0; i < 3 * width * height; ++i)
      longest =
          std::max(longest, std::abs(double(recorded.normals[i]) * cleared.scale + double(cleared.bias)));
    // The bound of float normals, which a recording has.
    CHECK(longest < nnao::shortest_float_normal / 2);
    nook_nnao_recording_destroy(&handle);
  }
  nook_nnao_destroy(&pass);
}
