#include "bakers/measure/composite/populated_room.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bakers/import/skinned_mesh.h"
#include "bakers/import/static_scene.h"
#include "bakers/nnao/solids.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/world/surroundings.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr int attempts = 4000;
constexpr float turn = 2 * std::numbers::pi_v<float>;

// Returns the height of the floor on a vertical line. The floor is the lowest surface on this line that faces
// up and has 2 m of free space above it.
std::optional<float> floor_at(const RayScene& room, const Bounds& bounds, float x, float z) {
  const float top = bounds.high.y + 1;
  std::optional<float> found;
  float ceiling = INFINITY;
  for (float y = top; y > bounds.low.y;) {
    const RayHit hit = room.nearest({x, y, z}, {0, -1, 0});
    if (!(hit.distance < INFINITY)) break;
    const float at = y - hit.distance;
    // The ray can hit both sides of a triangle, so only the distance to the ceiling identifies a floor.
    if (hit.normal.y > 0.95f && ceiling - at > 2 && ceiling < INFINITY) found = at;
    ceiling = at;
    y = at - 1e-3f;
  }
  return found;
}

bool is_level(const RayScene& room, Vec3 foot) {
  for (int i = 0; i < 8; ++i) {
    const float angle = turn * float(i) / 8;
    const Vec3 from = foot + Vec3{0.25f * std::cos(angle), 0.4f, 0.25f * std::sin(angle)};
    if (std::abs(room.nearest(from, {0, -1, 0}).distance - 0.4f) > 0.01f) return false;
  }
  return true;
}

// Returns true if no surface is between the body's vertical axis and the body's vertices.
bool is_clear(const RayScene& room, std::span<const Vec3> body, Vec3 foot) {
  for (std::size_t v = 0; v < body.size(); v += 7) {
    const Vec3 axis{foot.x, std::max(body[v].y, foot.y + 0.02f), foot.z};
    const Vec3 to = body[v] + Vec3{0, 0.005f, 0} - axis;
    if (length(to) > 0 && room.nearest(axis, 1.05f * to).distance <= 1) return false;
  }
  return true;
}

Pose moved_pose(const Pose& pose, const Mat3x4& move) {
  Pose moved;
  for (const Mat3x4& bone : pose) moved.push_back(move * bone);
  return moved;
}

Figure standing(const SkinnedMesh& mesh, const Pose& pose, Vec3 foot, float angle) {
  std::vector<Vec3> body;
  skin_positions(mesh, pose, body);
  const Bounds b = bounds_of(body);
  const Vec3 middle{0.5f * (b.low.x + b.high.x), b.low.y, 0.5f * (b.low.z + b.high.z)};
  Mat3x4 back;
  back.m[3] = -middle.x;
  back.m[7] = -middle.y;
  back.m[11] = -middle.z;
  Figure figure;
  figure.pose = moved_pose(pose, bake::nnao::standing_frame(foot, angle) * back);
  figure.foot = foot;
  skin_positions(mesh, figure.pose, figure.body);
  return figure;
}

}  // namespace

std::vector<Figure> stand_in_room(const TriangleSoup& room, const SkinnedMesh& mesh,
                                  std::span<const Pose> poses, std::size_t count, std::uint64_t seed) {
  const FlushDenormals flush;
  const RayScene rays(room);
  const Bounds bounds = bounds_of(room.position);
  std::vector<Figure> figures;
  Random random(seed);
  for (int attempt = 0; attempt < attempts && figures.size() < count; ++attempt) {
    const float x = random.between(bounds.low.x, bounds.high.x),
                z = random.between(bounds.low.z, bounds.high.z), angle = turn * random.unit();
    const std::optional<float> floor = floor_at(rays, bounds, x, z);
    if (!floor || !is_level(rays, {x, *floor, z})) continue;
    const Vec3 foot{x, *floor, z};
    const bool crowded = std::any_of(figures.begin(), figures.end(),
                                     [&](const Figure& other) { return length(other.foot - foot) < 0.9f; });
    if (crowded) continue;
    Figure figure = standing(mesh, poses[(2 * figures.size() + 1) * poses.size() / (2 * count)], foot, angle);
    if (is_clear(rays, figure.body, foot)) figures.push_back(std::move(figure));
  }
  return figures;
}

PopulatedRoom populated(const TriangleSoup& room, const SkinnedMesh& mesh, std::span<const Figure> figures) {
  PopulatedRoom all{room, std::uint32_t(room.triangle.size())};
  for (const Figure& figure : figures) {
    const auto first = std::uint32_t(all.soup.position.size());
    all.soup.position.insert(all.soup.position.end(), figure.body.begin(), figure.body.end());
    for (const auto& t : mesh.triangle)
      all.soup.triangle.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all;
}

std::vector<bake::nnao::Camera> cameras_at(const PopulatedRoom& room, std::span<const Figure> figures,
                                           std::size_t count, std::uint32_t width, std::uint32_t height,
                                           std::uint64_t seed) {
  const FlushDenormals flush;
  const RayScene rays(room.soup);
  Random random(seed);
  std::vector<bake::nnao::Camera> cameras;
  for (int attempt = 0; attempt < attempts && !figures.empty() && cameras.size() < count; ++attempt) {
    const Vec3 foot = figures[cameras.size() % figures.size()].foot;
    const Vec3 target = foot + Vec3{0, 0.35f, 0};
    const float angle = turn * random.unit(), distance = random.between(1.6f, 3.4f),
                height_m = random.between(0.9f, 1.9f);
    const Vec3 eye = foot + Vec3{distance * std::cos(angle), height_m, distance * std::sin(angle)};
    const RayHit hit = rays.nearest(eye, target - eye);
    if (hit.triangle < room.first_figure || hit.triangle == ~0u) continue;
    bool roomy = true;
    for (const Vec3 d :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}})
      roomy = roomy && rays.nearest(eye, d).distance > 0.25f;
    if (roomy) cameras.push_back(bake::nnao::look_at(eye, target, 0, 0.9f, width, height));
  }
  return cameras;
}

namespace {

using namespace bake::nnao;

constexpr float half_x_m = 3, half_z_m = 2.5f, height_m = 2.7f;

void add_walls(TriangleSoup& soup) {
  constexpr float thick = 0.2f;
  add_block(soup, {-half_x_m, -thick, -half_z_m}, {half_x_m, 0, half_z_m});
  add_block(soup, {-half_x_m, height_m, -half_z_m}, {half_x_m, height_m + thick, half_z_m});
  for (const float side : {-1.0f, 1.0f}) {
    add_block(soup, {side * (half_x_m + 0.5f * thick) - 0.5f * thick, 0, -half_z_m},
              {side * (half_x_m + 0.5f * thick) + 0.5f * thick, height_m, half_z_m});
    add_block(soup, {-half_x_m, 0, side * (half_z_m + 0.5f * thick) - 0.5f * thick},
              {half_x_m, height_m, side * (half_z_m + 0.5f * thick) + 0.5f * thick});
  }
}

void add_steps(TriangleSoup& soup) {
  for (int step = 0; step < 3; ++step)
    add_block(soup, {half_x_m - 0.9f + 0.3f * float(step), 0, -half_z_m},
              {half_x_m, 0.17f * float(step + 1), -half_z_m + 1.6f});
}

void add_table_with_legs(TriangleSoup& soup, Vec3 middle, Vec3 half, float height, float leg) {
  add_block(soup, {middle.x - half.x, height - 0.04f, middle.z - half.z},
            {middle.x + half.x, height, middle.z + half.z});
  for (const float x : {-1.0f, 1.0f})
    for (const float z : {-1.0f, 1.0f})
      add_rod(soup, {middle.x + x * (half.x - leg), 0, middle.z + z * (half.z - leg)},
              {middle.x + x * (half.x - leg), height - 0.04f, middle.z + z * (half.z - leg)}, leg);
}

void add_chair_with_back(TriangleSoup& soup, Vec3 middle, float side) {
  add_table_with_legs(soup, middle, {0.21f, 0, 0.21f}, 0.45f, 0.02f);
  add_block(soup, {middle.x - 0.21f, 0.45f, middle.z + side * 0.19f - 0.02f},
            {middle.x + 0.21f, 0.95f, middle.z + side * 0.19f + 0.02f});
}

void add_shelf(TriangleSoup& soup) {
  for (int board = 0; board < 5; ++board)
    add_block(soup, {-half_x_m, 0.45f * float(board), 0.2f},
              {-half_x_m + 0.32f, 0.45f * float(board) + 0.03f, 1.8f});
  for (const float z : {0.2f, 1.77f})
    add_block(soup, {-half_x_m, 0, z}, {-half_x_m + 0.32f, 1.83f, z + 0.03f});
}

}  // namespace

TriangleSoup own_room() {
  TriangleSoup soup;
  add_walls(soup);
  add_steps(soup);
  add_table_with_legs(soup, {-0.6f, 0, -0.8f}, {0.8f, 0, 0.45f}, 0.75f, 0.035f);
  add_chair_with_back(soup, {-0.9f, 0, 0.05f}, 1);
  add_chair_with_back(soup, {-0.3f, 0, -1.65f}, -1);
  add_shelf(soup);
  return soup;
}

bake::TriangleSoup room_of(const std::filesystem::path& file, float metres_per_unit,
                           const ImportOptions& reading, std::vector<std::string>& warnings) {
  StaticScene scene = import_static_scene(file, SceneTextures::skip, reading);
  warnings.insert(warnings.end(), scene.warnings.begin(), scene.warnings.end());
  for (Vec3& p : scene.position) p = metres_per_unit * p;
  return {std::move(scene.position), std::move(scene.triangle)};
}

}  // namespace nook::measure
