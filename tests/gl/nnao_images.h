// Depth and normals of a small scene, computed pixel by pixel without OpenGL, and what the tests of the
// screen-space pass do with them.
#pragma once

#include <glad/gl.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "platform/platform.h"
#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/network_evaluate.h"
#include "tests/gl/chained_descs.h"
#include "tests/gl/crowd.h"
#include "tests/gl/host_textures.h"

namespace nook::test {

struct Camera {
  std::string name;
  float projection[16] = {};
  nook_clip_space clip = NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE;
};
// Perspective, off-centre, orthographic, reversed depth, infinite far plane, both clip ranges, flipped,
// scaled.
std::vector<Camera> cameras(float aspect);
Camera plain_camera(float aspect);

// A surface is a plane (points p with dot(p, normal) = offset) where radius is 0, else a ball.
struct Surface {
  Vec3 normal_or_centre;
  float offset_or_radius = 0;
  bool ball = false;
};
Surface plane_through(Vec3 point, Vec3 normal);
Surface ball(Vec3 centre, float radius);
// A floor, a wall that ends at the sky, and balls on the floor.
std::vector<Surface> still_life();

// The view of the camera: depth in metres (infinite: sky), the normal towards the viewer.
struct Picture {
  std::uint32_t width = 0, height = 0;
  nnao::ScreenRays rays;
  std::vector<float> depth;
  std::vector<Vec3> normal;
  nnao::View view() const { return {width, height, rays, depth, normal}; }
};
Picture look(const Camera& camera, const std::vector<Surface>& scene, std::uint32_t width,
             std::uint32_t height);
// Every second pixel of every second row.
Picture halved(const Picture& picture);

// The pixels of a picture inside a larger image, everything else being `around`.
struct Place {
  int width = 0, height = 0, x = 0, y = 0;
};
std::vector<float> stored_depth(const Camera& camera, const Picture& picture);
std::vector<float> flat(const std::vector<Vec3>& normals);
// Numbers in [-1, 1] as those in [0, 1] that 8 bits hold exactly; scale 2 and bias -1 turn them back.
std::vector<float> halved_range(std::vector<float> numbers);
std::vector<float> placed(const std::vector<float>& image, int channels, const Picture& picture,
                          const Place& place, float around);

// A nook_gl, and the promise that no OpenGL error and no complaint of the driver is left at the end.
struct NnaoFixture {
  explicit NnaoFixture(platform::Context& made_in, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE);
  ~NnaoFixture();

  // Hardware depth of a picture, in 32-bit floats.
  GLuint depth_of(const Camera& camera, const Picture& picture);
  GLuint normals_of(const Picture& picture);
  // For frames up to 192 x 128; kept, because Mesa compiles the shaders anew for each. network null: the
  // embedded one; a fixture knows one network of each form.
  nook_nnao pass_of(int taps, int half, int blur, const nnao::Network* network);

  platform::Context& context;
  CountedContext host;
  nook_gl gl;
  Textures textures;
  std::map<std::array<int, 4>, nook_nnao> passes;
};

// The network's output stays well inside [0, 1], so that no difference is clamped away.
nnao::Network mild_network(nnao::NetworkForm form, std::uint32_t seed = 1);

// The ways in which a pass can run on this context.
std::vector<nook_nnao_path> paths_of(const platform::Context& context);

PassDesc pass_desc(int width, int height);
nook_nnao create_pass(nook_gl gl, PassDesc desc, const nnao::Network& network);
nook_nnao create_pass(nook_gl gl, const PassDesc& desc);
ScreenFrame frame_desc(const Camera& camera, int width, int height, GLuint depth, GLuint normal,
                       float radius);
nook_nnao_info info_of(nook_nnao pass);
// The pass's own texture.
std::vector<float> own_ao(const GladGLContext& gl, nook_nnao pass, int width, int height);

struct Difference {
  float largest = 0, mean = 0;
  float beyond = 0;  // the share of pixels whose difference is more than `bound`
};
Difference difference(const std::vector<float>& a, const std::vector<float>& b, float bound);

}  // namespace nook::test
