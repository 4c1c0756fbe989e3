// Recorded frames: what is read back, that a replay gives the same AO, and what the call may not do.
#include <nook/experimental/nook_recording.h>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "sdk/src/core/floats.h"
#include "sdk/src/gl/touched_state.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// A replay gives AO within one step of 8 bits on the same driver; here it runs the same program on the same
// bits, so that it is equal.
constexpr float bound = 1.0f / 255 + 1e-6f;

struct Recorded {
  nook_nnao_recording handle = nullptr;
  nook_nnao_recording_desc desc{};

  Recorded(nook_nnao pass, const ScreenFrame& frame, const char* note = nullptr) {
    NOOK_OK_OR_FAIL(nook_nnao_record(pass, &frame, &frame, note, &handle));
    desc.struct_size = sizeof desc;
    NOOK_OK_OR_FAIL(nook_nnao_recording_describe(handle, &desc));
  }
  ~Recorded() { nook_nnao_recording_destroy(&handle); }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

  std::size_t pixels() const { return std::size_t(desc.width) * std::size_t(desc.height); }
  std::vector<float> image(const float* values, std::size_t channels = 1) const {
    return values ? std::vector<float>(values, values + channels * pixels()) : std::vector<float>();
  }
};

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// Draws a recording as a tool does that has nothing but the recording.
std::vector<float> replayed(NnaoFixture& fixture, const nook_nnao_recording_desc& desc) {
  const int w = desc.width, h = desc.height;
  const std::size_t pixels = std::size_t(w) * std::size_t(h);
  const auto upload = [&](GLint format, int channels, const float* values) {
    return fixture.textures.floats(format, channels, w, h,
                                   std::vector<float>(values, values + std::size_t(channels) * pixels));
  };
  PassDesc pass_settings = pass_desc(w, h);
  pass_settings.taps = desc.taps;
  pass_settings.half_resolution = desc.half_resolution;
  pass_settings.blur = desc.blur;
  pass_settings.blur_sharpness = desc.blur_sharpness;
  pass_settings.debug.path = desc.path;
  pass_settings.network = desc.network;
  pass_settings.network_size = desc.network_size;
  nook_nnao pass = create_pass(fixture.gl, pass_settings);
  ScreenFrame frame;
  frame.width = w;
  frame.height = h;
  frame.depth_texture = upload(GL_R32F, 1, desc.depth);
  frame.depth_kind = desc.depth_kind;
  frame.sky_depth = desc.sky_depth;
  if (desc.normals) frame.normal_texture = upload(GL_RGB32F, 3, desc.normals);
  frame.normal_scale = desc.normal_scale;
  frame.normal_bias = desc.normal_bias;
  std::memcpy(frame.normal_matrix, desc.normal_matrix, sizeof frame.normal_matrix);
  std::memcpy(frame.projection, desc.projection, sizeof frame.projection);
  frame.clip_space = desc.clip;
  frame.radius = desc.radius;
  frame.max_radius_px = desc.max_radius_px;
  frame.min_radius_px = desc.min_radius_px;
  frame.fade_begin = desc.fade_begin;
  frame.fade_end = desc.fade_end;
  frame.intensity = desc.intensity;
  frame.power = desc.power;
  frame.gbuffer_ao = desc.layer;
  if (desc.layer) frame.gbuffer_ao_texture = upload(GL_RG32F, 2, desc.layer_texels);
  frame.debug.show = desc.view;
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  std::vector<float> ao = own_ao(fixture.context.gl(), pass, w, h);
  nook_nnao_destroy(&pass);
  return ao;
}

// The file of a recording gives the same recording back.
void check_file(NnaoFixture& fixture, const Recorded& recorded) {
  std::size_t size = 0;
  NOOK_OK_OR_FAIL(nook_nnao_recording_save(recorded.handle, nullptr, &size));
  std::vector<std::byte> bytes(size), again(size);
  NOOK_OK_OR_FAIL(nook_nnao_recording_save(recorded.handle, bytes.data(), &size));
  nook_nnao_recording loaded = nullptr;
  NOOK_OK_OR_FAIL(nook_nnao_recording_load(fixture.host.handle, bytes.data(), size, &loaded));
  NOOK_OK_OR_FAIL(nook_nnao_recording_save(loaded, again.data(), &size));
  CHECK(again == bytes);
  nook_nnao_recording_destroy(&loaded);
}

// Values in [0, 1] as integers of 8, 16 or 32 bits, as OpenGL ES wants them.
template <class Integer>
std::vector<Integer> normalised_integers(const std::vector<float>& values) {
  std::vector<Integer> out;
  for (const float value : values)
    out.push_back(Integer(std::llround(double(value) * std::numeric_limits<Integer>::max())));
  return out;
}

float mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return float(sum / double(values.size()));
}

void check_replay(NnaoFixture& fixture, nook_nnao pass, const ScreenFrame& frame) {
  NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
  const std::vector<float> drawn = own_ao(fixture.context.gl(), pass, frame.width, frame.height);
  const Recorded recorded(pass, frame);
  const std::vector<float> ao = recorded.image(recorded.desc.ao);
  CHECK(difference(ao, drawn, bound).largest < 1e-6f);
  // The picture is not empty.
  CHECK((mean(ao) < 0.99f && mean(ao) > 0.2f));
  const Difference found = difference(replayed(fixture, recorded.desc), ao, bound);
  INFO("largest " << found.largest << ", mean " << found.mean);
  CHECK(found.largest <= bound);
  check_file(fixture, recorded);
}

}  // namespace

TEST_CASE("nnao: a recorded frame has the host's depth and normals bit for bit, and replays") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  // More rows than a strip of the reader, and no multiple of it.
  const int width = 61, height = 120;
  for (const Camera& camera : cameras(float(width) / float(height))) {
    INFO(camera.name);
    const Picture picture = look(camera, still_life(), width, height);
    const GLuint depth = fixture.depth_of(camera, picture), normal = fixture.normals_of(picture);
    const ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.7f);
    nook_nnao pass = fixture.pass_of(16, 0, 1, nullptr);
    const Recorded recorded(pass, frame, "a remark");
    CHECK(same_bits(recorded.image(recorded.desc.depth), stored_depth(camera, picture)));
    CHECK(same_bits(recorded.image(recorded.desc.normals, 3), flat(picture.normal)));
    CHECK(recorded.desc.layer_texels == nullptr);
    CHECK(std::memcmp(recorded.desc.projection, camera.projection, sizeof camera.projection) == 0);
    CHECK(recorded.desc.clip == camera.clip);
    CHECK(recorded.desc.radius == 0.7f);
    CHECK(recorded.desc.taps == 16);
    CHECK(recorded.desc.path == (info_of(pass).compute ? NOOK_NNAO_PATH_COMPUTE : NOOK_NNAO_PATH_FRAGMENT));
    CHECK(recorded.desc.library_version == nook_version());
    CHECK(recorded.desc.note == std::string("a remark"));
    CHECK(recorded.desc.renderer == context.renderer());
    CHECK(recorded.desc.driver_version == context.version());
    CHECK(std::string(recorded.desc.vendor) != "");
    CHECK((recorded.desc.network != nullptr && recorded.desc.network_size > 100));
    check_replay(fixture, pass, frame);
  }
}

TEST_CASE("nnao: frames of every setting replay to the same AO") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const int width = 64, height = 45;
  const Camera camera = plain_camera(float(width) / float(height));
  const Picture picture = look(camera, still_life(), width, height);
  const GLuint depth = fixture.depth_of(camera, picture);
  const GLuint linear = fixture.textures.floats(GL_R32F, 1, width, height, picture.depth);
  const GLuint normal = fixture.normals_of(picture);
  std::vector<float> levels;
  for (int i = 0; i < 2 * width * height; ++i) levels.push_back(float(i * 37 % 200 + 55) / 255);
  const GLuint layer = fixture.textures.make(GL_RG8, GL_RG, GL_UNSIGNED_BYTE, width, height,
                                             normalised_integers<GLubyte>(levels).data());
  const nnao::Network paper = mild_network(nnao::NetworkForm::paper);
  const auto frame_with = [&](const std::function<void(ScreenFrame&)>& change) {
    ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.6f);
    change(frame);
    return frame;
  };
  const struct {
    const char* name;
    nook_nnao pass;
    ScreenFrame frame;
  } settings[] = {
      {"normals of depth", fixture.pass_of(9, 0, 1, nullptr),
       frame_with([](auto& f) { f.normal_texture = 0; })},
      {"half resolution", fixture.pass_of(9, 1, 1, nullptr), frame_with([](auto&) {})},
      {"two filters", fixture.pass_of(32, 0, 2, nullptr), frame_with([](auto&) {})},
      {"the paper's form", fixture.pass_of(32, 0, 1, &paper), frame_with([](auto&) {})},
      {"intensity and power", fixture.pass_of(16, 0, 1, nullptr), frame_with([](auto& f) {
         f.intensity = 1.4f;
         f.power = 1.6f;
       })},
      {"a layer", fixture.pass_of(16, 0, 1, nullptr), frame_with([&](auto& f) {
         f.gbuffer_ao = NOOK_GBUFFER_AO_REPLACE;
         f.gbuffer_ao_texture = layer;
       })},
      {"raw", fixture.pass_of(16, 0, 1, nullptr),
       frame_with([](auto& f) { f.debug.show = NOOK_NNAO_VIEW_RAW; })},
      {"linear depth", fixture.pass_of(16, 0, 1, nullptr), frame_with([&](auto& f) {
         f.depth_texture = linear;
         f.depth_kind = NOOK_DEPTH_LINEAR;
         f.sky_depth = 6;
         f.max_radius_px = 9;
         f.min_radius_px = 7;
         f.fade_begin = 1;
         f.fade_end = 9;
       })},
  };
  for (const auto& [name, pass, frame] : settings) {
    INFO(name);
    check_replay(fixture, pass, frame);
  }
}

TEST_CASE("nnao: depth and normals of every format are recorded as the shaders read them") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const int width = 40, height = 30;
  const Camera camera = plain_camera(float(width) / float(height));
  const Picture picture = look(camera, still_life(), width, height);
  std::vector<float> half_range;
  for (const float c : flat(picture.normal)) half_range.push_back(0.5f * c + 0.5f);
  const std::vector<float> stored = stored_depth(camera, picture);
  Textures& textures = fixture.textures;
  const GLuint depths[] = {textures.make(GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, width,
                                         height, normalised_integers<GLushort>(stored).data()),
                           textures.make(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width,
                                         height, normalised_integers<GLuint>(stored).data()),
                           textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, stored),
                           textures.floats(GL_R32F, 1, width, height, stored)};
  const GLuint normals[] = {textures.make(GL_RGB8, GL_RGB, GL_UNSIGNED_BYTE, width, height,
                                          normalised_integers<GLubyte>(half_range).data()),
                            textures.floats(GL_RGB32F, 3, width, height, half_range)};
  for (const GLuint depth : depths)
    for (const GLuint normal : normals) {
      INFO("depth " << depth - depths[0] << ", normals " << normal - normals[0]);
      ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.6f);
      frame.normal_scale = 2;
      frame.normal_bias = -1;
      check_replay(fixture, fixture.pass_of(16, 0, 1, nullptr), frame);
    }
}

TEST_CASE("nnao: if the viewport is a part of an image, only this part is recorded") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const Camera camera = plain_camera(1.5f);
  const Picture picture = look(camera, still_life(), 45, 30);
  const Place place{64, 50, 7, 11};
  const GLuint depth =
      fixture.textures.floats(GL_DEPTH_COMPONENT32F, 1, place.width, place.height,
                              placed(stored_depth(camera, picture), 1, picture, place, 0.3f));
  ScreenFrame frame = frame_desc(camera, place.width, place.height, depth, 0, 0.5f);
  frame.viewport[0] = place.x;
  frame.viewport[1] = place.y;
  frame.viewport[2] = 45;
  frame.viewport[3] = 30;
  const Recorded recorded(fixture.pass_of(16, 0, 1, nullptr), frame);
  CHECK((recorded.desc.width == 45 && recorded.desc.height == 30));
  CHECK(same_bits(recorded.image(recorded.desc.depth), stored_depth(camera, picture)));
  CHECK(recorded.desc.normals == nullptr);
  CHECK(difference(replayed(fixture, recorded.desc), recorded.image(recorded.desc.ao), bound).largest <=
        bound);
}

TEST_CASE("nnao: recording writes no target of the host and keeps the OpenGL state") {
  NOOK_NEED_CONTEXT(context);
  const int width = 33, height = 21;
  const Camera camera = plain_camera(float(width) / float(height));
  const Picture picture = look(camera, still_life(), width, height);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST})
    for (const nook_nnao_path path : paths_of(context)) {
      INFO("mode " << mode << ", path " << path);
      NnaoFixture fixture(context, mode);
      const GLuint depth = fixture.depth_of(camera, picture), normal = fixture.normals_of(picture);
      const GLuint target = fixture.textures.floats(GL_R32F, 1, width, height,
                                                    std::vector<float>(std::size_t(width) * height, 0.7f));
      PassDesc desc = pass_desc(width, height);
      desc.debug.path = path;
      nook_nnao pass = create_pass(fixture.gl, desc);
      ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.5f);
      frame.target = NOOK_TARGET_TEXTURE;
      frame.target_name = target;
      frame.blend = NOOK_BLEND_MULTIPLY;
      const unsigned users = gl::screen | gl::screen_reads |
                             (path == NOOK_NNAO_PATH_COMPUTE ? unsigned{gl::screen_compute} : 0u);
      nook_nnao_recording recording = nullptr;
      {
        Poison poison(context, users);
        if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
        const StateValues touched = poison.touched(), untouched = poison.untouched();
        NOOK_OK_OR_FAIL(nook_nnao_record(pass, &frame, &frame, nullptr, &recording));
        if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
        if (mode == NOOK_GL_STATE_DEFAULTS) {
          StateValues left = poison.touched();
          left.erase("viewport");
          CHECK(left == poison.defaults());
        }
        CHECK(poison.untouched() == untouched);
        CHECK(context.gl().GetError() == GL_NO_ERROR);
      }
      for (const float value : read_texture(context.gl(), target, width, height)) REQUIRE(value == 0.7f);
      // The recording is right under the odd state as well.
      nook_nnao_recording_desc held{};
      held.struct_size = sizeof held;
      NOOK_OK_OR_FAIL(nook_nnao_recording_describe(recording, &held));
      const std::size_t pixels = std::size_t(width) * height;
      CHECK(same_bits({held.depth, held.depth + pixels}, stored_depth(camera, picture)));
      const std::vector<float> ao(held.ao, held.ao + pixels);
      CHECK(difference(replayed(fixture, held), ao, bound).largest <= bound);
      nook_nnao_recording_destroy(&recording);
      // The next frame goes to its target.
      NOOK_OK_OR_FAIL(nook_nnao_render(pass, &frame, &frame));
      CHECK(mean(read_texture(context.gl(), target, width, height)) < 0.69f);
      nook_nnao_destroy(&pass);
    }
}

TEST_CASE("nnao: recording refuses what it cannot record, and every refused allocation leaves nothing") {
  NOOK_NEED_CONTEXT(context);
  CountedContext host;
  Trace trace(context);
  nook_gl gl = create_gl(host.handle, Trace::loader, &trace, 0);
  Textures textures(context.gl());
  const int width = 20, height = 12;
  const Camera camera = plain_camera(float(width) / float(height));
  const Picture picture = look(camera, still_life(), width, height);
  const GLuint depth =
      textures.floats(GL_DEPTH_COMPONENT32F, 1, width, height, stored_depth(camera, picture));
  const GLuint normal = textures.floats(GL_RGB32F, 3, width, height, flat(picture.normal));
  nook_nnao pass = create_pass(gl, pass_desc(width, height));
  ScreenFrame frame = frame_desc(camera, width, height, depth, normal, 0.5f);

  nook_nnao_recording recording = nullptr;
  const std::string long_note(1001, 'x');
  CHECK(nook_nnao_record(nullptr, &frame, &frame, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_record(pass, nullptr, &frame, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_record(pass, &frame, &frame, nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_record(pass, &frame, &frame, long_note.c_str(), &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_nnao_record(pass, &frame, &frame, "two\nlines", &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  ScreenFrame bad = frame;
  bad.radius = -1;
  CHECK(nook_nnao_record(pass, &bad, &bad, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  bad = frame;
  bad.depth_texture = 999999;
  CHECK(nook_nnao_record(pass, &bad, &bad, nullptr, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(recording == nullptr);

  const auto programs = [&] {
    int count = 0;
    for (GLuint name = 1; name < 10000; ++name)
      count += context.gl().IsProgram(name) + context.gl().IsTexture(name) + context.gl().IsSampler(name) +
               context.gl().IsVertexArray(name) + context.gl().IsFramebuffer(name) +
               context.gl().IsShader(name);
    return count;
  };
  const int living = programs();
  const long long bytes = host.bytes;
  int refusals = 0;
  for (long n = 0; recording == nullptr; ++n) {
    host.refuse_after = n;
    const nook_result result =
        nook_nnao_record(pass, &frame, &frame, "a remark that is longer than a short string", &recording);
    host.refuse_after = -1;
    CHECK(programs() == living);
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    REQUIRE(recording == nullptr);
    CHECK(host.bytes == bytes);
  }
  // Depth, normals, AO, the bits of a strip, the network, the note, the object.
  CHECK(refusals >= 7);
  // The recording outlives everything, and needs no OpenGL.
  trace.shaders_fail = true;
  nook_nnao_recording second = nullptr;
  CHECK(nook_nnao_record(pass, &frame, &frame, nullptr, &second) == NOOK_ERROR_GL);
  CHECK(second == nullptr);
  CHECK(programs() == living);
  trace.shaders_fail = false;
  nook_nnao_destroy(&pass);
  nook_gl_destroy(&gl);
  nook_context_destroy(&host.handle);
  context.clear_current();
  std::size_t size = 0;
  NOOK_OK_OR_FAIL(nook_nnao_recording_save(recording, nullptr, &size));
  CHECK(size > std::size_t(width) * height * 5);
  nook_nnao_recording_destroy(&recording);
  CHECK(host.bytes == 0);
  context.make_current();
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("nnao: depths that are negative or not finite are recorded unchanged") {
  NOOK_NEED_CONTEXT(context);
  NnaoFixture fixture(context);
  const int width = 16, height = 16;
  const Camera camera = plain_camera(1);
  Picture picture = look(camera, still_life(), width, height);
  std::vector<float> depth = picture.depth;
  depth[40] = NAN;
  depth[41] = -1;
  depth[42] = INFINITY;
  const GLuint texture = fixture.textures.floats(GL_R32F, 1, width, height, depth);
  ScreenFrame frame = frame_desc(camera, width, height, texture, 0, 0.5f);
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  const Recorded recorded(fixture.pass_of(16, 0, 1, nullptr), frame);
  CHECK(std::isnan(recorded.desc.depth[40]));
  CHECK(recorded.desc.depth[41] == -1);
  CHECK(std::isinf(recorded.desc.depth[42]));
  for (const std::size_t sky : {40u, 41u, 42u}) CHECK(recorded.desc.ao[sky] == 1);
  check_file(fixture, recorded);
}
