// The sample as a user runs it: in Vulkan the stages draw the AO that the OpenGL pass draws of the same
// depth, without a complaint of the validation layer.
#include <glad/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nook/nook.hpp>
#include <string>
#include <vector>

#include "platform/platform.h"
#include "tests/catch.h"
#include "tests/samples/sample_run.h"

using nook::test::Folder, nook::test::quoted;

namespace {

constexpr int width = 960, height = 540;

using Picture = nook::test::SamplePicture<unsigned char>;

Picture read(const std::filesystem::path& path) {
  return nook::test::read_picture<unsigned char>(path, width, height);
}

// Where the validation layer is installed, it looks for missing barriers as well.
int run(const std::string& arguments) {
  const std::string validation =
      "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT ";
  return nook::test::exit_code(validation + quoted(VULKAN_SAMPLE) + " " + arguments);
}

bool required(const char* variable) {
  const char* value = std::getenv(variable);
  return value && std::strcmp(value, "1") == 0;
}

// False where the sample finds no device.
bool drew(const std::string& arguments, int wanted = 0) {
  constexpr int no_device = 3;
  const int code = run(arguments);
  if (code == no_device) {
    std::printf("NO VULKAN DEVICE, TEST SKIPPED\n");
    if (required("NOOK_REQUIRE_VULKAN")) FAIL("a Vulkan device is required");
    return false;
  }
  // Complaints of the validation layer are 1.
  REQUIRE(code == wanted);
  return true;
}

std::unique_ptr<platform::Context> opengl() {
  try {
    return platform::create_context({});
  } catch (const std::exception& e) {
    std::printf("NO OPENGL CONTEXT, TEST SKIPPED: %s\n", e.what());
    if (required("NOOK_REQUIRE_GL")) FAIL("an OpenGL context is required: " << e.what());
    return nullptr;
  }
}

// Draws the recorded frame with OpenGL so many times, and returns its AO in the order of the recording.
std::vector<unsigned char> drawn_by_opengl(platform::Context& context, const nook_nnao_recording_desc& frame,
                                           int frames) {
  const GladGLContext& gl = context.gl();
  GLuint textures[2] = {};  // depth, normals
  gl.GenTextures(2, textures);
  gl.BindTexture(GL_TEXTURE_2D, textures[1]);
  if (frame.normals)
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, frame.normals);
  gl.BindTexture(GL_TEXTURE_2D, textures[0]);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                frame.depth);
  gl.BindTexture(GL_TEXTURE_2D, 0);
  const nook::Context nook_context;
  nook_gl_desc gl_desc = nook::gl_desc();
  gl_desc.get_proc = platform::Context::loader;
  gl_desc.get_proc_user = &context;
  const nook::Gl nook_gl(nook_context, gl_desc);
  nook_nnao_desc desc = nook::nnao_desc();
  desc.max_width = width;
  desc.max_height = height;
  desc.taps = frame.taps;
  desc.half_resolution = frame.half_resolution;
  desc.blur = frame.blur;
  desc.max_history_frames = frames > 1 ? frames : 0;
  nook::Nnao pass(nook_gl, desc);
  nook_gl_frame_desc drawn = nook::gl_frame_desc();
  nook_nnao_frame_desc settings = nook::nnao_frame_desc();
  drawn.width = width;
  drawn.height = height;
  drawn.depth_texture = textures[0];
  drawn.normal_texture = frame.normals ? textures[1] : 0;
  std::copy(std::begin(frame.normal_matrix), std::end(frame.normal_matrix), drawn.normal_matrix);
  drawn.clip_space = frame.clip;
  std::copy(std::begin(frame.projection), std::end(frame.projection), drawn.projection);
  settings.radius = frame.radius;
  for (int i = 0; i < frames; ++i) pass.render(drawn, settings);
  std::vector<unsigned char> ao(std::size_t(width) * height);
  gl.BindTexture(GL_TEXTURE_2D, pass.info().texture);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_UNSIGNED_BYTE, ao.data());
  gl.BindTexture(GL_TEXTURE_2D, 0);
  gl.DeleteTextures(2, textures);
  return ao;
}

// Returns false where there is no Vulkan or no OpenGL.
bool compare(const Folder& folder, const std::string& arguments, int frames) {
  const std::unique_ptr<platform::Context> context = opengl();
  if (!context || !drew(quoted(folder.path) + " " + arguments)) return false;
  std::ifstream file(folder.path / "frame.nook", std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  const nook::Context nook_context;
  const nook::Recording recording(nook_context, bytes.data(), bytes.size());
  const nook_nnao_recording_desc frame = recording.desc();
  REQUIRE((frame.width == width && frame.height == height));
  const std::vector<unsigned char> wanted = drawn_by_opengl(*context, frame, frames);
  // Row 0 of the recording is the upper one in Vulkan, as in the picture.
  const Picture found = read(folder.path / "ao.png");
  std::size_t off = 0, dark = 0;
  int largest = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int difference = std::abs(found.at(x, y) - wanted[std::size_t(y) * width + x]);
      off += difference > 1;
      largest = std::max(largest, difference);
      dark += found.at(x, y) < 200;
    }
  std::printf("vulkan %s: %zu of %d pixels differ by more than 1/255, the largest by %d/255\n",
              arguments.c_str(), off, width * height, largest);
  // The compilers of two drivers may contract the same expressions in different ways: a tap on the border of
  // two texels then goes the other way. Of random taps some 1e-4 lie so near a border.
  CHECK(off <= std::size_t(width * height) / 1000);
  CHECK(dark > std::size_t(width * height) / 50);
  return true;
}

}  // namespace

TEST_CASE("sample vulkan: AO is the OpenGL pass's, preset fast") {
  compare(Folder(), "fast", 1);
}

TEST_CASE("sample vulkan: AO is the OpenGL pass's, reversed depth and normals of the host") {
  compare(Folder(), "reversed normals", 1);
}

TEST_CASE("sample vulkan: AO is the OpenGL pass's, mean over four frames") {
  compare(Folder(), "mean", 4);
}

TEST_CASE("sample vulkan: AO is the OpenGL pass's, preset default, and darkens corners and nothing else") {
  const Folder folder;
  if (!compare(folder, "default", 1)) return;
  const Picture before = read(folder.path / "before.png"), after = read(folder.path / "after.png"),
                ao = read(folder.path / "ao.png");
  // The places of tests/samples/nnao: open floor, sky above the walls, the corner of two walls, the floor
  // under the ball.
  CHECK(ao.at(480, 500) > 242);
  CHECK(ao.at(600, 5) == 255);
  CHECK(ao.at(370, 150) < 204);
  CHECK(ao.at(541, 362) < 179);
  int brighter = 0;
  for (std::size_t i = 0; i < before.values.size(); ++i)
    brighter = std::max(brighter, after.values[i] - before.values[i]);
  CHECK(brighter <= 0);
  CHECK(after.at(480, 500) > before.at(480, 500) - 8);
  CHECK(after.at(541, 362) < before.at(541, 362) - 20);
}

TEST_CASE("sample vulkan: bad arguments and folders have exit codes of their own") {
  const Folder folder;
  CHECK(run(quoted(folder.path) + " backwards 2> /dev/null") == 2);
  if (!drew(quoted(folder.path) + " 0 2> /dev/null", 2)) return;
  CHECK(run(quoted(folder.path / "absent") + " 2> /dev/null") == 1);
}
