// The sample as a user runs it: in Vulkan the stages draw the AO that the OpenGL pass draws of the same
// depth, without a complaint of the validation layer.
#include <OpenImageIO/imageio.h>
#include <glad/gl.h>
#include <sys/wait.h>

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
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/platform.h"
#include "tests/catch.h"

namespace {

constexpr int width = 960, height = 540;

struct Picture {
  int channels = 0;
  std::vector<unsigned char> texels;  // the upper row first
  int at(int x, int y) const { return texels[(std::size_t(y) * width + x) * channels]; }
};

Picture read(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  REQUIRE(input->spec().width == width);
  REQUIRE(input->spec().height == height);
  Picture picture{input->spec().nchannels, {}};
  picture.texels.resize(std::size_t(width) * height * picture.channels);
  REQUIRE(input->read_image(0, 0, 0, picture.channels, OIIO::TypeDesc::UINT8, picture.texels.data()));
  return picture;
}

// Returns the exit code. Where the validation layer is installed, it looks for missing barriers as well.
int run(const std::string& arguments) {
  const std::string validation =
      "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT ";
  return WEXITSTATUS(std::system((validation + VULKAN_SAMPLE + " " + arguments).c_str()));
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

// Of its own for each case: they run side by side.
struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "nook_vulkan_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

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
  desc.temporal_frames = frames > 1 ? frames : 0;
  nook::Nnao pass(nook_gl, desc);
  nook_nnao_frame_desc drawn = nook::nnao_frame_desc();
  drawn.width = width;
  drawn.height = height;
  drawn.depth_texture = textures[0];
  drawn.normal_texture = frame.normals ? textures[1] : 0;
  std::copy(std::begin(frame.normal_matrix), std::end(frame.normal_matrix), drawn.normal_matrix);
  drawn.clip = frame.clip;
  std::copy(std::begin(frame.projection), std::end(frame.projection), drawn.projection);
  drawn.radius = frame.radius;
  for (int i = 0; i < frames; ++i) pass.render(drawn);
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
  if (!context || !drew(folder.path.string() + " " + arguments)) return false;
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
  for (std::size_t i = 0; i < before.texels.size(); ++i)
    brighter = std::max(brighter, after.texels[i] - before.texels[i]);
  CHECK(brighter <= 0);
  CHECK(after.at(480, 500) > before.at(480, 500) - 8);
  CHECK(after.at(541, 362) < before.at(541, 362) - 20);
}

TEST_CASE("sample vulkan: bad arguments and folders have exit codes of their own") {
  const Folder folder;
  CHECK(run(folder.path.string() + " backwards 2> /dev/null") == 2);
  if (!drew(folder.path.string() + " 0 2> /dev/null", 2)) return;
  CHECK(run((folder.path / "absent").string() + " 2> /dev/null") == 1);
}
