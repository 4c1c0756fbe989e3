// Where the passes over the screen darken the crowd's pictures: the floor by the body, as rays find it, and
// not the body.
#include <OpenImageIO/imageio.h>
#include <nook/experimental/nook_trace.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "samples/crowd/camera.h"
#include "samples/crowd/places.h"
#include "tests/catch.h"

namespace {

constexpr int kWidth_px = 480, kHeight_px = 360;
constexpr float kRadius_m = 0.5f;  // of the pass

struct Picture {
  std::vector<float> red;  // sRGB, [0, 1], the top row first
  float at(glm::ivec2 p) const { return red[std::size_t(p.y) * kWidth_px + std::size_t(p.x)]; }
};

Picture read(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  REQUIRE(input->spec().width == kWidth_px);
  REQUIRE(input->spec().height == kHeight_px);
  Picture picture;
  picture.red.resize(std::size_t(kWidth_px) * kHeight_px);
  std::vector<float> all(picture.red.size() * std::size_t(input->spec().nchannels));
  REQUIRE(input->read_image(0, 0, 0, input->spec().nchannels, OIIO::TypeDesc::FLOAT, all.data()));
  for (std::size_t i = 0; i < picture.red.size(); ++i)
    picture.red[i] = all[i * std::size_t(input->spec().nchannels)];
  return picture;
}

struct Run {
  Picture picture;
  nlohmann::json report;
};

Run draw_one(const std::string& context, const std::string& tier, const std::string& screen_space) {
  const std::filesystem::path out = std::filesystem::path(CROWD_OUT) / (context + tier + screen_space);
  std::filesystem::remove_all(out);
  const std::string command =
      "'" CROWD "' --quiet --no-sheets --no-light --characters 1 --frames 1 --size 480x360 --context " +
      context + " --tier " + tier + " --screen-space " + screen_space + " --out '" + out.string() +
      "' > /dev/null";
  const int status = std::system(command.c_str());
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == 0);
  return {read(out / "frame_0000.png"), nlohmann::json::parse(std::ifstream(out / "report.json"))};
}

// The one character of the first frame, where the sample puts it, and the sample's camera.
struct Scene {
  std::vector<float> positions_ws, normals_ws;
  std::vector<std::uint32_t> triangles;
  glm::vec3 root_ws;
  crowd::Camera camera;
  glm::mat4 clip_from_world;

  Scene() {
    const crowd::Hero hero(CROWD_CACHE "/mannequin.glb");
    triangles = hero.triangles;
    const crowd::Placement place = crowd::make_layout(crowd::clip_outlines(hero), 1, 1)[0];
    hero.skin(crowd::placed_pose(hero, place, 0), positions_ws, normals_ws);
    root_ws = {place.x_m, 0, place.z_m};
    camera = crowd::orbit(std::hypot(place.x_m, place.z_m) + 1.0f, 0);
    clip_from_world = crowd::clip_from_world(camera, float(kWidth_px) / kHeight_px);
  }
  std::size_t vertices() const { return positions_ws.size() / 3; }
  glm::vec3 vertex(std::size_t i) const {
    return {positions_ws[3 * i], positions_ws[3 * i + 1], positions_ws[3 * i + 2]};
  }
  std::optional<glm::ivec2> pixel(const glm::vec3& p) const {
    const glm::vec4 clip = clip_from_world * glm::vec4(p, 1);
    const glm::vec2 at =
        (0.5f + 0.5f * glm::vec2(clip.x, -clip.y) / clip.w) * glm::vec2(kWidth_px, kHeight_px);
    if (clip.w <= 0 || at.x < 0 || at.y < 0 || at.x >= kWidth_px || at.y >= kHeight_px) return {};
    return glm::ivec2(at);
  }
  float distance_to_body_m(const glm::vec3& p) const {
    float nearest = INFINITY;
    for (std::size_t i = 0; i < vertices(); ++i) nearest = std::min(nearest, glm::distance(p, vertex(i)));
    return nearest;
  }
  // The foot's point nearest to the camera: nothing stands between it and the lens.
  glm::vec3 front_toe_ws() const {
    glm::vec3 best(INFINITY);
    for (std::size_t i = 0; i < vertices(); ++i)
      if (vertex(i).y < 0.05f && glm::distance(vertex(i), camera.eye_ws) < glm::distance(best, camera.eye_ws))
        best = vertex(i);
    return {best.x, 0, best.z};
  }
  glm::vec3 towards_camera() const {
    return glm::normalize(glm::vec3(camera.eye_ws.x - root_ws.x, 0, camera.eye_ws.z - root_ws.z));
  }
};

float linear_of(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

// Mean AO of points of the floor against the body.
float traced_floor_ao(const Scene& scene, const std::vector<glm::vec3>& points) {
  const nook_bake_occluder_mesh mesh{scene.positions_ws.data(), scene.triangles.data(),
                                     std::uint32_t(scene.vertices()), std::uint32_t(scene.triangles.size())};
  std::vector<float> positions, normals, ao(points.size());
  for (const glm::vec3& p : points) {
    positions.insert(positions.end(), {p.x, p.y, p.z});
    normals.insert(normals.end(), {0, 1, 0});
  }
  nook_bake_trace_desc desc;
  REQUIRE(nook_bake_trace_desc_init(&desc) == NOOK_OK);
  desc.meshes = &mesh;
  desc.mesh_count = 1;
  desc.positions = positions.data();
  desc.normals = normals.data();
  desc.point_count = std::uint32_t(points.size());
  desc.rays = 4096;
  REQUIRE(nook_bake_trace_ao(&desc, ao.data(), desc.point_count) == NOOK_OK);
  return std::accumulate(ao.begin(), ao.end(), 0.0f) / float(ao.size());
}

void check_floor_and_body(const Picture& on, const Picture& off) {
  const Scene scene;
  const glm::vec3 toe = scene.front_toe_ws(), forward = scene.towards_camera();
  // Red light that the floor sends back of an open sky: albedo, colour of the sky, strength.
  constexpr float kAmbient = 0.36f * 0.80f * 0.58f;
  std::vector<glm::vec3> points;
  float drawn = 0;
  for (float ahead_m = 0.03f; ahead_m < 0.2f; ahead_m += 0.01f) {
    points.push_back(toe + ahead_m * forward);
    const auto pixel = scene.pixel(points.back());
    REQUIRE(pixel);
    drawn += 1 - (linear_of(off.at(*pixel)) - linear_of(on.at(*pixel))) / kAmbient;
  }
  drawn /= float(points.size());
  const float traced = traced_floor_ao(scene, points);
  CAPTURE(drawn, traced);
  CHECK(drawn < 0.95f);
  // Casters beside a foot are a few centimetres off.
  CHECK(std::abs(drawn - traced) < 0.06f);

  // Farther away than the screen-space pass would darken the casters do.
  points.clear();
  drawn = 0;
  float half_step = 0;  // AO that half a step of the picture's 8 bits is worth
  const glm::vec3 aside(forward.z, 0, -forward.x);
  for (float ahead_m = 0.5f; ahead_m < 2.5f; ahead_m += 0.1f)
    for (float aside_m = -2; aside_m < 2; aside_m += 0.1f) {
      const glm::vec3 p = scene.root_ws + ahead_m * forward + aside_m * aside;
      const auto pixel = scene.pixel(p);
      if (!pixel || scene.distance_to_body_m(p) < 1.2f * kRadius_m) continue;
      points.push_back(p);
      const float open = off.at(*pixel);
      drawn += 1 - (linear_of(open) - linear_of(on.at(*pixel))) / kAmbient;
      half_step += (linear_of(open + 0.5f / 255) - linear_of(open)) / kAmbient;
    }
  CHECK(points.size() > 50);
  drawn /= float(points.size());
  half_step /= float(points.size());
  const float traced_far = traced_floor_ao(scene, points);
  CAPTURE(drawn, traced_far, half_step);
  // The open floor is nearly of one colour, so that its rounding does not vanish from the mean. Beside it
  // stand a step of the 8 bits of AO, and what casters of a draft are off by: their mse is 0.016 of that of
  // no darkening (nook evaluate world), its root an eighth.
  CHECK(std::abs(drawn - traced_far) < half_step + 1.0f / 255 + 0.13f * (1 - traced_far));
  CHECK(drawn < 1 - 0.5f * (1 - traced_far));

  // The pass is exactly 1 on characters. Only above the hands: between fingers and at the feet a pixel holds
  // some of the floor.
  int body_points = 0;
  float body_off = 0;
  for (std::size_t i = 0; i < scene.vertices(); ++i) {
    const auto pixel = scene.pixel(scene.vertex(i));
    if (scene.vertex(i).y < 1.0f || !pixel) continue;
    ++body_points;
    body_off = std::max(body_off, std::abs(on.at(*pixel) - off.at(*pixel)));
  }
  CHECK(body_points > 1000);
  // A pixel at the silhouette holds some of the floor behind.
  CHECK(body_off < 0.06f);
}

}  // namespace

TEST_CASE("the body darkens the floor as rays find it, and the passes over the screen leave the body alone") {
  const Run off = draw_one("egl", "33", "off");
  CHECK(off.report["ms"]["screen_space"] == 0);
  CHECK(off.report["screen_space"].is_null());
  for (const auto& [context, tier] : {std::pair("egl", "33"), {"egl", "43"}, {"osmesa", "33"}}) {
    CAPTURE(context, tier);
    const Run on = draw_one(context, tier, "on");
    CHECK(on.report["ms"]["screen_space"] > 0);
    CHECK(on.report["screen_space"]["radius_m"] == kRadius_m);
    check_floor_and_body(on.picture, off.picture);
  }
}
