// AO in buffers and textures of the host: the same numbers as in Nook's own buffer, in the host's format and
// place, and nothing beside them.
#include <cmath>
#include <cstring>

#include "sdk/src/core/floats.h"
#include "sdk/src/gl/touched_state.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"

using namespace nook;
using namespace nook::test;

namespace {

constexpr unsigned char guard_byte = 0xa5;

struct Fixture {
  platform::Context& context;
  Cast cast;
  CrowdOptions options;
  Crowd crowd;
  nook_gl gl;
  const GladGLContext& api;

  Fixture(platform::Context& of, int tier, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE)
      : context(of),
        crowd(cast.context.handle, cast.models, cast.bone_counts, options),
        gl(create_gl(cast.context.handle, platform::Context::loader, &of, tier, mode)),
        api(of.gl()) {
    crowd.pose(1);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
  }
  ~Fixture() {
    nook_gl_destroy(&gl);
    for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
    CHECK(api.GetError() == GL_NO_ERROR);
  }

  std::vector<float> ao(std::size_t index) { return gpu_ao(gl, crowd, cast.model_of(index), index); }

  GLuint make_buffer(std::size_t bytes) const {
    const std::vector<unsigned char> guards(bytes, guard_byte);
    GLuint name = 0;
    api.GenBuffers(1, &name);
    api.BindBuffer(GL_ARRAY_BUFFER, name);
    api.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(bytes), guards.data(), GL_STATIC_DRAW);
    return name;
  }
  std::vector<unsigned char> take_buffer(GLuint name, std::size_t bytes) const {
    const std::vector<unsigned char> out = read_buffer(api, name, 0, bytes);
    api.DeleteBuffers(1, &name);
    return out;
  }
};

nook_gl_ao_target target_of(GLuint buffer, nook_format format) {
  nook_gl_ao_target target{};
  target.struct_size = sizeof target;
  target.buffer = buffer;
  target.format = format;
  return target;
}

// The value that the bytes hold, and how far from the truth its rounding may take it.
float value_at(const unsigned char* bytes, nook_format format) {
  if (format == NOOK_FORMAT_UNORM8) return static_cast<float>(*bytes) / 255;
  if (format == NOOK_FORMAT_HALF) {
    std::uint16_t half;
    std::memcpy(&half, bytes, sizeof half);
    return from_half(half);
  }
  float value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}
float tolerance_of(nook_format format) {
  // Half a step of a byte, and of a half below 1, and a rounding.
  return format == NOOK_FORMAT_UNORM8 ? 0.5f / 255 + 1e-6f
         : format == NOOK_FORMAT_HALF ? 0.25f / 1024 + 1e-7f
                                      : 0;
}

constexpr nook_format formats[] = {NOOK_FORMAT_FLOAT, NOOK_FORMAT_HALF, NOOK_FORMAT_UNORM8};

}  // namespace

TEST_CASE("AO arrives tightly packed in a host's buffer") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Fixture f(context, tier);
    for (const nook_format format : formats) {
      INFO("format " << format);
      const std::vector<float> expected = f.ao(0);
      const std::size_t each = sizeof(float) >> format, bytes = (expected.size() * each + 3) / 4 * 4;
      const std::size_t offset = 20;
      const GLuint buffer = f.make_buffer(offset + bytes + 8);
      nook_gl_ao_target target = target_of(buffer, format);
      target.offset = offset;
      NOOK_OK_OR_FAIL(nook_gl_scene_write(f.gl, f.crowd.scene, f.crowd.ids.data(), 1, &target));
      const auto got = f.take_buffer(buffer, offset + bytes + 8);
      float worst = 0;
      for (std::size_t v = 0; v < expected.size(); ++v)
        worst = std::max(worst, std::abs(value_at(&got[offset + v * each], format) - expected[v]));
      CHECK(worst <= tolerance_of(format));
      for (std::size_t i = 0; i < offset; ++i) CHECK(got[i] == guard_byte);
      for (std::size_t i = offset + bytes; i < got.size(); ++i) CHECK(got[i] == guard_byte);
    }
  }
}

TEST_CASE("AO of many instances lies at equal distances, for one instanced draw") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    Fixture f(context, tier);
    std::vector<nook_instance_id> ids;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < f.crowd.ids.size(); i += f.cast.models.size()) {
      ids.push_back(f.crowd.ids[i]);
      indices.push_back(i);
    }
    const std::size_t vertices = f.ao(0).size(), distance = (vertices + 3) / 4 * 4 + 16;
    const GLuint buffer = f.make_buffer(distance * ids.size());
    nook_gl_ao_target target = target_of(buffer, NOOK_FORMAT_UNORM8);
    target.instance_stride = distance;
    NOOK_OK_OR_FAIL(nook_gl_scene_write(f.gl, f.crowd.scene, ids.data(),
                                        static_cast<std::uint32_t>(ids.size()), &target));
    const auto got = f.take_buffer(buffer, distance * ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::vector<float> expected = f.ao(indices[i]);
      float worst = 0;
      for (std::size_t v = 0; v < vertices; ++v)
        worst = std::max(worst, std::abs(value_at(&got[i * distance + v], NOOK_FORMAT_UNORM8) - expected[v]));
      CHECK(worst <= tolerance_of(NOOK_FORMAT_UNORM8));
      CHECK(got[(i + 1) * distance - 1] == guard_byte);
    }
  }
}

TEST_CASE("AO is a word among other attributes where there are compute shaders, else the stride is refused") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Fixture f(context, tier);
    for (const nook_format format : formats) {
      const std::vector<float> expected = f.ao(1);
      const std::size_t stride = 36, offset = 12, bytes = offset + stride * expected.size();
      const GLuint buffer = f.make_buffer(bytes);
      nook_gl_ao_target target = target_of(buffer, format);
      target.offset = offset;
      target.stride = stride;
      const nook_result result = nook_gl_scene_write(f.gl, f.crowd.scene, &f.crowd.ids[1], 1, &target);
      if (!computes(tier)) {
        CHECK(result == NOOK_ERROR_UNSUPPORTED);
        CHECK(std::string(nook_last_message()).find("compute shaders") != std::string::npos);
        f.take_buffer(buffer, bytes);
        continue;
      }
      INFO(nook_last_message());
      REQUIRE(result == NOOK_OK);
      const auto got = f.take_buffer(buffer, bytes);
      float worst = 0;
      std::size_t touched = 0;
      for (std::size_t v = 0; v < expected.size(); ++v) {
        worst = std::max(worst, std::abs(value_at(&got[offset + v * stride], format) - expected[v]));
        for (std::size_t i = 4; i < stride; ++i)
          touched += offset + v * stride + i < bytes && got[offset + v * stride + i] != guard_byte;
      }
      CHECK(worst <= tolerance_of(format));
      CHECK(touched == 0);
    }
  }
}

TEST_CASE("AO arrives in a texture of the host, row by row") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    Fixture f(context, tier);
    for (const auto& [internal, format] :
         {std::pair{GL_R8, NOOK_FORMAT_UNORM8}, std::pair{GL_R16F, NOOK_FORMAT_HALF},
          std::pair{GL_R32F, NOOK_FORMAT_FLOAT}}) {
      const std::vector<float> expected = f.ao(0);
      const int width = 7, first = 5;
      const int height = (first + static_cast<int>(expected.size()) + width - 1) / width + 1;
      Textures textures(f.api);
      const GLuint texture =
          textures.floats(static_cast<GLint>(internal), 1, width, height,
                          std::vector<float>(static_cast<std::size_t>(width * height), 0.25f));
      // OpenGL ES converts no upload; 3.0 does not tell the width.
      nook_gl_ao_target target = target_of(0, is_es(f.api) ? format : NOOK_FORMAT_FLOAT);
      target.texture = texture;
      target.texture_width = is_es(f.api) ? width : 0;
      target.offset = first;
      NOOK_OK_OR_FAIL(nook_gl_scene_write(f.gl, f.crowd.scene, f.crowd.ids.data(), 1, &target));
      const std::vector<float> texels = read_texture(f.api, texture, width, height);
      float worst = 0;
      for (std::size_t v = 0; v < expected.size(); ++v)
        worst = std::max(worst, std::abs(texels[first + v] - expected[v]));
      // OpenGL converts the upload. It may cut floats to halves instead of rounding them, and NVIDIA's driver
      // comes within 0.55 of a step of a byte; Direct3D demands 0.6.
      const float converted = is_es(f.api) ? 1.0f : format == NOOK_FORMAT_HALF ? 2.0f : 1.2f;
      CHECK(worst <= tolerance_of(format) * converted);
      CHECK(std::abs(texels[first - 1] - 0.25f) < 0.002f);
      CHECK(std::abs(texels[first + expected.size()] - 0.25f) < 0.002f);
    }
  }
}

TEST_CASE("targets that cannot take the values are refused before anything is written") {
  NOOK_NEED_CONTEXT(context);
  Fixture f(context, tiers_of(context).back());
  const std::size_t bytes = 4 * f.ao(0).size();
  const GLuint buffer = f.make_buffer(bytes);
  const auto refused = [&](auto&& spoil, const char* part, std::uint32_t count = 1) {
    nook_gl_ao_target target = target_of(buffer, NOOK_FORMAT_FLOAT);
    spoil(target);
    CHECK(nook_gl_scene_write(f.gl, f.crowd.scene, f.crowd.ids.data(), count, &target) ==
          NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(part) != std::string::npos);
  };
  refused([](nook_gl_ao_target& t) { t.struct_size = 4; }, "target.struct_size");
  refused([](nook_gl_ao_target& t) { t.format = 3; }, "target.format");
  refused([](nook_gl_ao_target& t) { t.buffer = 0; }, "exactly one");
  refused([](nook_gl_ao_target& t) { t.texture = 1; }, "exactly one");
  refused([](nook_gl_ao_target& t) { t.offset = 2; }, "multiples of 4");
  refused([](nook_gl_ao_target& t) { t.offset = 4; }, "too small");
  refused([](nook_gl_ao_target&) {}, "target.instance_stride", 2);
  const auto got = f.take_buffer(buffer, bytes);
  CHECK(std::all_of(got.begin(), got.end(), [](unsigned char byte) { return byte == guard_byte; }));
  nook_gl_ao_target target = target_of(buffer, NOOK_FORMAT_FLOAT);
  const nook_instance_id unknown = 4711;
  CHECK(nook_gl_scene_write(f.gl, f.crowd.scene, &unknown, 1, &target) == NOOK_ERROR_INVALID_HANDLE);
}

TEST_CASE("a texture's width and format are checked as far as the context tells them") {
  NOOK_NEED_CONTEXT(context);
  Fixture f(context, tiers_of(context).back());
  Textures textures(f.api);
  const int vertices = static_cast<int>(f.ao(0).size());
  nook_gl_ao_target target = target_of(0, NOOK_FORMAT_FLOAT);
  target.texture = textures.floats(GL_R32F, 1, 64, vertices / 64 + 1, {});
  const auto write = [&] { return nook_gl_scene_write(f.gl, f.crowd.scene, f.crowd.ids.data(), 1, &target); };
  const auto says = [&](const char* part) {
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(part) != std::string::npos);
  };
  const bool asked = !context.is_es() || version_of(context) >= 31;
  if (asked) {
    CHECK(write() == NOOK_OK);
    target.texture_width = 63;
    CHECK(write() == NOOK_ERROR_INVALID_ARGUMENT);
    says("target.texture_width differs from the width of texture");
  } else {
    CHECK(write() == NOOK_ERROR_INVALID_ARGUMENT);
    says("target.texture_width is 0 (OpenGL ES 3.0 cannot report it");
  }
  target.texture_width = 64;
  CHECK(write() == NOOK_OK);
  if (!context.is_es()) return;  // uploads convert there
  target.format = NOOK_FORMAT_UNORM8;
  CHECK(write() == (asked ? NOOK_ERROR_INVALID_ARGUMENT : NOOK_ERROR_GL));
  says(asked ? "target.format differs from the format of texture"
             : "on OpenGL ES, target.format must match the format of the texture");
  take_debug_messages();
}

TEST_CASE("writing AO keeps the promise of each state mode") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context))
    for (const nook_gl_state_mode mode :
         {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
      INFO("tier " << tier << ", mode " << mode);
      Fixture f(context, tier, mode);
      const std::size_t bytes = 36 * f.ao(0).size();
      const GLuint buffer = f.make_buffer(bytes);
      GLuint texture = 0;
      f.api.GenTextures(1, &texture);
      f.api.BindTexture(GL_TEXTURE_2D, texture);
      f.api.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, 64, 64, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
      for (int kind = 0; kind < (computes(tier) ? 3 : 2); ++kind) {
        Poison poison(context, computes(tier) ? gl::outputs | gl::outputs_compute : unsigned{gl::outputs});
        if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
        const StateValues touched = poison.touched(), untouched = poison.untouched();
        nook_gl_ao_target target = target_of(kind == 1 ? 0 : buffer, NOOK_FORMAT_HALF);
        target.texture = kind == 1 ? texture : 0;
        if (kind == 1 && context.is_es()) {
          target.format = NOOK_FORMAT_UNORM8;
          target.texture_width = 64;
        }
        target.stride = kind == 2 ? 36 : 0;
        NOOK_OK_OR_FAIL(nook_gl_scene_write(f.gl, f.crowd.scene, f.crowd.ids.data(), 1, &target));
        if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
        if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
        CHECK(poison.untouched() == untouched);
      }
      f.api.DeleteTextures(1, &texture);
      f.take_buffer(buffer, bytes);
    }
}
