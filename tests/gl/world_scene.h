// The scene of the tests of the world pass: props over a floor, seen by a turned camera, and the AO that the
// CPU gives at the same pixels.
#pragma once

#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_world.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "sdk/src/nnao/network_evaluate.h"
#include "tests/gl/nnao_images.h"
#include "tests/gl/test_context.h"

namespace nook::test::world {

inline constexpr int width = 96, height = 64;

// The pass keeps AO in 8 bits, half a step off at most; as much again for its arithmetic.
inline constexpr float bound = 1.0f / 255;

inline nook_world_desc world_desc(int w = width, int h = height) {
  nook_world_desc desc;
  NOOK_OK_OR_FAIL(nook_world_desc_init(&desc));
  desc.max_width = w;
  desc.max_height = h;
  desc.capsules = 8;  // so that a crowd outgrows it
  return desc;
}

// From world space to the view of a camera that is turned about y and stands aside.
struct View {
  float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  Vec3 to_world(Vec3 p) const {
    const Vec3 d = p - Vec3{matrix[12], matrix[13], matrix[14]};
    return turn_back(d);
  }
  Vec3 turn_back(Vec3 d) const {
    return {dot(d, {matrix[0], matrix[1], matrix[2]}), dot(d, {matrix[4], matrix[5], matrix[6]}),
            dot(d, {matrix[8], matrix[9], matrix[10]})};
  }
};
inline View turned_view() {
  View view;
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const float m[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.4f, -0.2f, 1.5f, 1};
  std::memcpy(view.matrix, m, sizeof m);
  return view;
}

inline nook_capsule prop(const View& view, Vec3 a, float radius_a, Vec3 b, float radius_b) {
  const Vec3 wa = view.to_world(a), wb = view.to_world(b);
  return {{wa.x, wa.y, wa.z}, radius_a, {wb.x, wb.y, wb.z}, radius_b};
}

// Props over the floor of still_life, one of them outside the view.
inline std::vector<nook_capsule> props(const View& view) {
  return {prop(view, {-0.2f, -0.5f, -2.2f}, 0.2f, {-0.2f, -0.5f, -2.2f}, 0.2f),
          prop(view, {0.5f, -0.6f, -3.0f}, 0.1f, {0.4f, 0.4f, -3.2f}, 0.15f),
          prop(view, {-3.0f, -0.2f, -3.0f}, 0.6f, {-3.0f, 0.8f, -3.0f}, 0.6f)};
}

struct WorldFixture : NnaoFixture {
  explicit WorldFixture(platform::Context& made_in, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE)
      : NnaoFixture(made_in, mode) {}
  ~WorldFixture() { nook_world_destroy(&pass); }

  nook_world made(nook_world_desc desc = world_desc()) {
    if (!pass) NOOK_OK_OR_FAIL(nook_world_create(gl, &desc, &pass));
    return pass;
  }
  std::vector<float> own(int w = width, int h = height) {
    nook_world_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
    return read_texture(context.gl(), info.texture, w, h);
  }

  nook_world pass = nullptr;
};

inline DarkenedFrame world_frame(const ScreenFrame& screen, const View& view) {
  DarkenedFrame frame(screen);
  frame.intensity = screen.intensity;
  frame.power = screen.power;
  std::memcpy(frame.view, view.matrix, sizeof frame.view);
  return frame;
}

// The AO that the CPU gives at the pixels of a picture; 1 where there is sky.
inline std::vector<float> sampled(const Picture& picture, const View& view, nook_scene scene,
                                  const std::vector<nook_capsule>& casters) {
  std::vector<float> position, normal;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const std::size_t i = std::size_t(y) * picture.width + x;
      const float depth = std::isfinite(picture.depth[i]) ? picture.depth[i] : 1;
      const Vec3 p =
          view.to_world(nnao::view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, depth));
      const Vec3 n = view.turn_back(picture.normal[i]);
      position.insert(position.end(), {p.x, p.y, p.z});
      normal.insert(normal.end(), {n.x, n.y, n.z});
    }
  nook_world_sample_desc desc;
  NOOK_OK_OR_FAIL(nook_world_sample_desc_init(&desc));
  desc.positions = position.data();
  desc.normals = normal.data();
  desc.point_count = std::uint32_t(picture.depth.size());
  desc.capsules = casters.data();
  desc.capsule_count = std::uint32_t(casters.size());
  std::vector<float> ao(picture.depth.size());
  NOOK_OK_OR_FAIL(nook_world_sample(scene, &desc, ao.data(), nullptr));
  for (std::size_t i = 0; i < ao.size(); ++i)
    if (!std::isfinite(picture.depth[i])) ao[i] = 1;
  return ao;
}

inline float darkest(const std::vector<float>& ao) {
  return *std::min_element(ao.begin(), ao.end());
}

}  // namespace nook::test::world
