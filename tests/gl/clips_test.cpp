// Baked clips in shaders: the GLSL of nook_gl.h against the CPU.
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_stages.h>
#include <nook/nook_gl.h>

#include <cmath>
#include <vector>

#include "platform/program.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "tests/character/clip_sample.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"
#include "tests/gl/test_context.h"
#include "tests/pose_of_rows.h"

using namespace nook;
using namespace nook::test;

namespace {

// Each vertex is a point on a pixel of its own.
const char vertex_text[] =
    "uniform ivec2 frames; uniform float share; uniform float vertex_count;\n"
    "flat out float ao;\n"
    "void main() {\n"
    "  ao = nook_clip_ao(gl_VertexID, frames, share);\n"
    "  gl_Position = vec4((float(gl_VertexID) + 0.5) / vertex_count * 2.0 - 1.0, 0.0, 0.0, 1.0);\n"
    "  gl_PointSize = 1.0;\n"
    "}\n";
const char fragment_text[] = "flat in float ao; out vec4 value; void main() { value = vec4(ao); }\n";

struct Loaded {
  Loaded() {
    const CharacterModel plain = sample_model(4, {5, 7, 12, 900, 60, 4});
    const std::vector<std::byte> model_bytes = write_character_model(plain),
                                 bytes = write_clip_set(sample_clips(plain, 2, 12).set);
    NOOK_OK_OR_FAIL(nook_model_load(host.handle, model_bytes.data(), model_bytes.size(), &model));
    NOOK_OK_OR_FAIL(nook_clips_load(host.handle, model, bytes.data(), bytes.size(), &clips));
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_clips_describe(clips, &info));
  }
  ~Loaded() {
    nook_clips_destroy(&clips);
    nook_model_destroy(&model);
  }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  CountedContext host;
  nook_model model = nullptr;
  nook_clips clips = nullptr;
  nook_clips_info info{};
};
}  // namespace

TEST_CASE("clips in a vertex shader agree with the CPU") {
  NOOK_NEED_CONTEXT(context);
  const GladGLContext& gl = context.gl();
  Loaded loaded;
  nook_gl gl_half = create_gl(loaded.host.handle, platform::Context::loader, &context, 0);
  nook_gl_upload upload = nullptr;
  CHECK(nook_gl_upload_clips(gl_half, nullptr, &upload) == NOOK_ERROR_INVALID_ARGUMENT);
  NOOK_OK_OR_FAIL(nook_gl_upload_clips(gl_half, loaded.clips, &upload));
  nook_gl_upload_info described{};
  described.struct_size = sizeof described;
  NOOK_OK_OR_FAIL(nook_gl_upload_describe(upload, &described));
  CHECK(described.texture_count == 2);
  const platform::Program program(gl, {glsl_header(gl), described.glsl, vertex_text},
                                  {glsl_header(gl), fragment_text});
  NOOK_OK_OR_FAIL(nook_gl_upload_bind(upload, program.name(), 0));
  const auto count = int(loaded.info.file_vertex_count);
  gl.Uniform1f(program.uniform("vertex_count"), float(count));
  Textures textures(gl);
  gl.ActiveTexture(GL_TEXTURE2);
  const GLuint target = textures.floats(GL_RGBA32F, 4, count, 1, {});
  GLuint framebuffer = 0, array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenVertexArrays(1, &array);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
  gl.Viewport(0, 0, count, 1);
  gl.BindVertexArray(array);
  for (const double seconds : {0.0, 0.6, 1.99, 3.3}) {
    const nook_clip_time time{1, NOOK_CLIP_LOOP, seconds};
    std::uint32_t frames[2] = {0, 0};
    float share = 0;
    NOOK_OK_OR_FAIL(nook_clips_frames(loaded.clips, &time, frames, &share));
    gl.Uniform2i(program.uniform("frames"), GLint(frames[0]), GLint(frames[1]));
    gl.Uniform1f(program.uniform("share"), share);
    gl.DrawArrays(GL_POINTS, 0, count);
    const std::vector<float> drawn = read_texture(gl, target, count, 1, 1);
    std::vector<float> ao(std::size_t(count), -1.0f);
    NOOK_OK_OR_FAIL(
        nook_clips_read_ao(loaded.clips, &time, NOOK_FORMAT_FLOAT, ao.data(), std::uint32_t(count), 0));
    REQUIRE(drawn.size() == ao.size());
    float worst = 0;
    for (std::size_t i = 0; i < ao.size(); ++i) worst = std::max(worst, std::abs(drawn[i] - ao[i]));
    // Weights are half floats of ten bits below one, and there are twelve of them.
    CHECK(worst < 12 * 0.6f / 4096);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.DeleteVertexArrays(1, &array);
  gl.DeleteFramebuffers(1, &framebuffer);
  nook_gl_upload_destroy(&upload);
  nook_gl_destroy(&gl_half);
  gl.ActiveTexture(GL_TEXTURE0);
}

TEST_CASE("an update on OpenGL leaves the whole AO of bones, and of clips what the others leave open") {
  NOOK_NEED_CONTEXT(context);
  Loaded loaded;
  const std::uint32_t count = loaded.info.file_vertex_count;
  Numbers numbers(5);
  nook_scene_desc desc;
  NOOK_OK_OR_FAIL(nook_scene_desc_init(&desc));
  nook_scene scene = nullptr;
  NOOK_OK_OR_FAIL(nook_scene_create(loaded.host.handle, &desc, &scene));
  // Runs of both kinds, and a change between them.
  constexpr bool has_clip[] = {false, true, true, false, true, false};
  std::vector<nook_instance_id> ids(std::size(has_clip));
  const float ground[] = {0, 1, 0, 0.4f};
  for (std::size_t i = 0; i < ids.size(); ++i) {
    NOOK_OK_OR_FAIL(nook_scene_add_instance(scene, loaded.model, &ids[i]));
    NOOK_OK_OR_FAIL(nook_scene_set_ground(scene, ids[i], ground));
    if (i > 0) NOOK_OK_OR_FAIL(nook_scene_link(scene, ids[i], ids[i - 1]));
    const float x = 0.4f * float(i);
    if (has_clip[i]) {
      const float place[] = {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0};
      const nook_clip_time time{1, NOOK_CLIP_LOOP, 0.6};
      NOOK_OK_OR_FAIL(nook_scene_set_clip(scene, ids[i], loaded.clips, &time, place));
    } else {
      const std::vector<Mat3x4> pose = random_pose(numbers, loaded.info.bone_count, {x, 0, 0});
      NOOK_OK_OR_FAIL(nook::test::set_rows(scene, ids[i], pose[0].m, loaded.info.bone_count));
    }
  }
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    nook_gl gl = create_gl(loaded.host.handle, platform::Context::loader, &context, tier);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, scene));
    std::vector<std::vector<float>> drawn(ids.size(), std::vector<float>(count));
    for (std::size_t i = 0; i < ids.size(); ++i)
      NOOK_OK_OR_FAIL(nook_gl_scene_read(gl, scene, ids[i], NOOK_CHANNEL_AO, drawn[i].data(), count));
    nook_gl_destroy(&gl);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      NOOK_OK_OR_FAIL(
          nook_scene_set_terms(scene, has_clip[i] ? NOOK_TERM_ALL - NOOK_TERM_SELF : NOOK_TERM_ALL));
      NOOK_OK_OR_FAIL(nook_scene_update(scene));
      std::vector<float> ao(count);
      NOOK_OK_OR_FAIL(
          nook_scene_read(scene, ids[i], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(), count, 0));
      CHECK(largest_difference(drawn[i], ao) < promised_difference);
    }
    NOOK_OK_OR_FAIL(nook_scene_set_terms(scene, NOOK_TERM_ALL));
  }
  nook_scene_destroy(&scene);
}
