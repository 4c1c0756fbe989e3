#include "tests/gl/nnao_images.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "sdk/src/nnao/network_file.h"
#include "tests/gl/real_projections.h"
#include "tests/gl/test_context.h"
#include "tests/nnao/network_sample.h"

namespace nook::test {
namespace {

constexpr float sky = std::numeric_limits<float>::infinity();
constexpr float near_m = 0.2f, far_m = 40.0f;

Camera perspective(std::string name, float aspect, float depth_row_z, float depth_row_w,
                   nook_clip_space clip) {
  Camera camera{std::move(name), {}, clip};
  camera.projection[0] = 1.4f / aspect;
  camera.projection[5] = 1.4f;
  camera.projection[10] = depth_row_z;
  camera.projection[11] = -1;
  camera.projection[14] = depth_row_w;
  return camera;
}

Camera parallel(std::string name, float aspect, float depth_row_z, float depth_row_w, nook_clip_space clip) {
  Camera camera{std::move(name), {}, clip};
  camera.projection[0] = 0.4f / aspect;
  camera.projection[5] = 0.4f;
  camera.projection[10] = depth_row_z;
  camera.projection[14] = depth_row_w;
  camera.projection[15] = 1;
  return camera;
}

float distance_along(const Surface& surface, Vec3 origin, Vec3 direction) {
  if (!surface.ball) {
    const float t = (surface.offset_or_radius - dot(origin, surface.normal_or_centre)) /
                    dot(direction, surface.normal_or_centre);
    return t > 0 ? t : sky;
  }
  const Vec3 to = surface.normal_or_centre - origin;
  const float a = dot(direction, direction), b = dot(to, direction);
  const float rest = b * b - a * (dot(to, to) - surface.offset_or_radius * surface.offset_or_radius);
  const float t = rest > 0 ? (b - std::sqrt(rest)) / a : sky;
  return t > 0 ? t : sky;
}

}  // namespace

Camera plain_camera(float aspect) {
  return perspective("perspective", aspect, (far_m + near_m) / (near_m - far_m),
                     2 * far_m * near_m / (near_m - far_m), NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE);
}

std::vector<Camera> cameras(float aspect) {
  const auto both = NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE, zero = NOOK_CLIP_SPACE_ZERO_TO_ONE;
  const float span = far_m - near_m;
  std::vector<Camera> all{
      plain_camera(aspect),
      perspective("0 to 1", aspect, -far_m / span, -far_m * near_m / span, zero),
      perspective("reversed, 0 to 1", aspect, near_m / span, far_m * near_m / span, zero),
      perspective("reversed, -1 to 1", aspect, (far_m + near_m) / span, 2 * far_m * near_m / span, both),
      perspective("infinite far plane", aspect, -1, -2 * near_m, both),
      perspective("reversed and infinite, 0 to 1", aspect, 0, near_m, zero),
      parallel("orthographic", aspect, -2 / span, -(far_m + near_m) / span, both),
      parallel("orthographic, reversed, 0 to 1", aspect, 1 / span, far_m / span, zero),
      parallel("orthographic from behind the camera", aspect, -1 / far_m, 0, both),
  };
  Camera off_centre = plain_camera(aspect);
  off_centre.name = "off-centre";
  off_centre.projection[8] = 0.3f;
  off_centre.projection[9] = -0.2f;
  Camera off_centre_parallel = all[6];
  off_centre_parallel.name = "off-centre orthographic";
  off_centre_parallel.projection[12] = 0.1f;
  off_centre_parallel.projection[13] = -0.15f;
  Camera flipped = plain_camera(aspect);
  flipped.name = "upside down";
  flipped.projection[5] *= -1;
  Camera scaled = plain_camera(aspect);
  scaled.name = "times 3";
  for (float& number : scaled.projection) number *= 3;
  // Clipped by a plane that leans, 0.3 m before the camera.
  Camera oblique = off_centre, oblique_parallel = off_centre_parallel;
  oblique.name = "oblique near plane";
  Matrix4 clipped{};
  std::copy_n(off_centre.projection, 16, clipped.begin());
  clipped = lengyel_oblique(clipped, {0.1, 0.2, -0.97, -0.3});
  std::transform(clipped.begin(), clipped.end(), oblique.projection, [](double v) { return float(v); });
  oblique_parallel.name = "orthographic with oblique planes";
  oblique_parallel.projection[2] = 0.004f;
  oblique_parallel.projection[6] = -0.007f;
  for (Camera& camera :
       {std::ref(off_centre), std::ref(off_centre_parallel), std::ref(flipped), std::ref(scaled)})
    all.push_back(camera);
  for (const Camera& camera : {oblique, oblique_parallel}) all.push_back(camera);
  return all;
}

Surface plane_through(Vec3 point, Vec3 normal) {
  const Vec3 unit = normalised(normal);
  return {unit, dot(point, unit), false};
}

Surface ball(Vec3 centre, float radius) {
  return {centre, radius, true};
}

std::vector<Surface> still_life() {
  return {plane_through({0, -0.8f, 0}, {0, 1, 0.05f}), plane_through({0, 0, -6}, {0.5f, -0.25f, 1}),
          ball({-0.5f, -0.4f, -2.6f}, 0.45f), ball({0.6f, -0.55f, -2.2f}, 0.3f),
          ball({0.2f, 0.3f, -3.5f}, 0.4f)};
}

Picture look(const Camera& camera, const std::vector<Surface>& scene, std::uint32_t width,
             std::uint32_t height) {
  Picture picture{width, height, {}, {}, {}};
  float projection[16];
  const bool orthographic = camera.projection[11] == 0;
  for (int i = 0; i < 16; ++i)
    projection[i] = camera.projection[i] / (orthographic ? camera.projection[15] : -camera.projection[11]);
  picture.rays = nnao::screen_rays(projection, width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const Vec3 at_1 = nnao::view_position(picture.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      const Vec3 origin = orthographic ? Vec3{at_1.x, at_1.y, 0} : Vec3{};
      const Vec3 direction = orthographic ? Vec3{0, 0, -1} : at_1;
      float nearest = sky;
      Vec3 normal{0, 0, 1};
      for (const Surface& surface : scene) {
        const float t = distance_along(surface, origin, direction);
        // The wall ends at the sky.
        if (t >= nearest || t > 7) continue;
        nearest = t;
        normal = surface.ball ? normalised(origin + direction * t - surface.normal_or_centre)
                              : surface.normal_or_centre;
        if (dot(normal, direction) > 0) normal = -normal;
      }
      picture.depth.push_back(nearest);
      picture.normal.push_back(normal);
    }
  return picture;
}

Picture halved(const Picture& picture) {
  Picture half{(picture.width + 1) / 2, (picture.height + 1) / 2, picture.rays, {}, {}};
  half.rays.x_offset -= 0.5f * half.rays.x_scale;
  half.rays.y_offset -= 0.5f * half.rays.y_scale;
  half.rays.x_scale *= 2;
  half.rays.y_scale *= 2;
  for (std::uint32_t y = 0; y < picture.height; y += 2)
    for (std::uint32_t x = 0; x < picture.width; x += 2) {
      half.depth.push_back(picture.depth[std::size_t(y) * picture.width + x]);
      half.normal.push_back(picture.normal[std::size_t(y) * picture.width + x]);
    }
  return half;
}

std::vector<float> stored_depth(const Camera& camera, const Picture& picture) {
  const float* m = camera.projection;
  const bool zero_to_one = camera.clip == NOOK_CLIP_SPACE_ZERO_TO_ONE;
  const bool orthographic = m[11] == 0;
  // ray: x and y of view space at a depth of one metre.
  const auto stored = [&](Vec3 ray, double depth) {
    const double x = ray.x * (orthographic ? 1 : depth), y = ray.y * (orthographic ? 1 : depth);
    const double ndc = (m[2] * x + m[6] * y - m[10] * depth + m[14]) / (-m[11] * depth + m[15]);
    return zero_to_one ? ndc : 0.5 * ndc + 0.5;
  };
  const float far_stored = stored({}, 5) > stored({}, 4) ? 1.0f : 0.0f;
  std::vector<float> out;
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    const float depth = picture.depth[i];
    const Vec3 ray = nnao::view_position(picture.rays, float(i % picture.width) + 0.5f,
                                         float(i / picture.width) + 0.5f, 1);
    out.push_back(std::isfinite(depth) ? float(stored(ray, depth)) : far_stored);
  }
  return out;
}

std::vector<float> flat(const std::vector<Vec3>& normals) {
  std::vector<float> out;
  for (const Vec3 n : normals)
    for (const float c : {n.x, n.y, n.z}) out.push_back(c);
  return out;
}

std::vector<float> halved_range(std::vector<float> numbers) {
  for (float& number : numbers) number = std::round(255 * (0.5f * number + 0.5f)) / 255;
  return numbers;
}

std::vector<float> placed(const std::vector<float>& image, int channels, const Picture& picture,
                          const Place& place, float around) {
  std::vector<float> out(std::size_t(place.width) * place.height * channels, around);
  const std::size_t row = std::size_t(picture.width) * channels;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    std::copy_n(image.begin() + y * row, row,
                out.begin() + ((place.y + y) * std::size_t(place.width) + place.x) * channels);
  return out;
}

NnaoFixture::NnaoFixture(platform::Context& made_in, nook_gl_state_mode mode)
    : context(made_in),
      gl(create_gl(host.handle, platform::Context::loader, &context, 0, mode)),
      textures(context.gl()) {}

NnaoFixture::~NnaoFixture() {
  for (auto& [key, pass] : passes) nook_nnao_destroy(&pass);
  nook_gl_destroy(&gl);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

GLuint NnaoFixture::depth_of(const Camera& camera, const Picture& picture) {
  return textures.floats(GL_DEPTH_COMPONENT32F, 1, int(picture.width), int(picture.height),
                         stored_depth(camera, picture));
}

GLuint NnaoFixture::normals_of(const Picture& picture) {
  return textures.floats(GL_RGB32F, 3, int(picture.width), int(picture.height), flat(picture.normal));
}

nook_nnao NnaoFixture::pass_of(int taps, int half, int blur, const nnao::Network* network) {
  nook_nnao& pass = passes[{taps, half, blur, network ? 1 + int(network->form) : 0}];
  if (pass) return pass;
  PassDesc desc = pass_desc(192, 128);
  desc.taps = taps;
  desc.half_resolution = half;
  desc.blur = blur;
  return pass = network ? create_pass(gl, desc, *network) : create_pass(gl, desc);
}

nnao::Network mild_network(nnao::NetworkForm form, std::uint32_t seed) {
  nnao::Network network = sample_network(form, seed);
  for (float& weight : network.paper.filters) weight /= 64;
  for (float& weight : network.paper.layer_3.weights) weight *= 0.1f;
  for (float& weight : network.horizon.tap.weights) weight = std::abs(weight);
  for (float& weight : network.horizon.out) weight = -0.3f * std::abs(weight);
  // The sum of the normal and what bends it stays far from zero, where rounding would decide its direction.
  for (float& weight : network.horizon.bent.weights) weight *= 0.1f;
  network.paper.layer_3.bias = {0.5f};
  return network;
}

std::vector<nook_nnao_path> paths_of(const platform::Context& context) {
  if (!computes(tiers_of(context).front())) return {NOOK_NNAO_PATH_FRAGMENT};
  return {NOOK_NNAO_PATH_FRAGMENT, NOOK_NNAO_PATH_COMPUTE};
}

PassDesc pass_desc(int width, int height) {
  PassDesc desc;
  desc.max_width = width;
  desc.max_height = height;
  return desc;
}

nook_nnao create_pass(nook_gl gl, PassDesc desc, const nnao::Network& network) {
  const std::vector<std::byte> bytes = nnao::write_network(network);
  desc.network = bytes.data();
  desc.network_size = bytes.size();
  return create_pass(gl, desc);
}

nook_nnao create_pass(nook_gl gl, const PassDesc& desc) {
  nook_nnao pass = nullptr;
  NOOK_OK_OR_FAIL(nook_nnao_create(gl, &desc, &pass));
  return pass;
}

ScreenFrame frame_desc(const Camera& camera, int width, int height, GLuint depth, GLuint normal,
                       float radius) {
  ScreenFrame frame;
  frame.width = width;
  frame.height = height;
  frame.depth_texture = depth;
  frame.normal_texture = normal;
  std::memcpy(frame.projection, camera.projection, sizeof frame.projection);
  frame.clip_space = camera.clip;
  frame.radius = radius;
  frame.min_radius_px = 0;  // these pictures are small
  return frame;
}

nook_nnao_info info_of(nook_nnao pass) {
  nook_nnao_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_nnao_describe(pass, &info));
  return info;
}

std::vector<float> own_ao(const GladGLContext& gl, nook_nnao pass, int width, int height) {
  return read_texture(gl, info_of(pass).texture, width, height);
}

Difference difference(const std::vector<float>& a, const std::vector<float>& b, float bound) {
  REQUIRE(a.size() == b.size());
  Difference result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float d = std::abs(a[i] - b[i]);
    result.largest = std::max(result.largest, d);
    result.mean += d / float(a.size());
    result.beyond += (d > bound) / float(a.size());
  }
  return result;
}

}  // namespace nook::test
