#include "bakers/world/training_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/random.h"
#include "bakers/world/surroundings.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn) {
  constexpr double golden_angle = 2.399963229728653;
  const Frame frame = turned_frame(cone.axis, 1, 0);
  const double versine = 2 * std::pow(std::sin(0.5 * double(cone.half_angle_radians)), 2);
  std::uint32_t open = 0;
  for (std::uint32_t r = 0; r < rays; ++r) {
    const double w = versine * (r + 0.5) / rays, sine = std::sqrt(w * (2 - w));
    const double angle = golden_angle * r + 2 * std::numbers::pi * double(turn);
    const Vec3 direction{float(sine * std::cos(angle)), float(sine * std::sin(angle)), float(1 - w)};
    open += !scene.occluded(origin, to_world(frame, direction));
  }
  return float(open) / float(rays);
}

namespace {

// The range of the lights' heights above the horizon.
constexpr float lowest_light_radians = 0.4f, highest_light_radians = 1.4f;

Vec3 random_light(Random& random) {
  const float bearing = 2 * std::numbers::pi_v<float> * random.unit();
  const float up = random.between(lowest_light_radians, highest_light_radians);
  return {std::cos(up) * std::sin(bearing), std::sin(up), std::cos(up) * std::cos(bearing)};
}

// Returns the pose turned about the vertical axis, then laid on its side.
Pose lying(const Pose& pose, float yaw_radians) {
  const float c = std::cos(yaw_radians), s = std::sin(yaw_radians);
  // Turns about y, then maps x to -y and y to x.
  const Mat3x4 turn{{0, 1, 0, 0, -c, 0, -s, 0, -s, 0, c, 0}};
  Pose out;
  for (const Mat3x4& bone : pose) out.push_back(turn * bone);
  return out;
}

// In every fourth pose, the body lies on the floor, as when it falls or sleeps. So every part of it comes
// near the floor in some poses.
constexpr std::size_t lying_every = 4;

// Half angles of cones of light. At run time, a cone is split into 16 parts with a quarter of its angle. The
// range covers the parts of cones from 4 to 60 degrees.
constexpr float least_cone_radians = 0.008f, most_cone_radians = 0.13f;

// Makes a point with its own light, and traces which share of the light is open.
TrainingPoint lit_point(const RayScene& scene, Vec3 at, Vec3 light, std::uint32_t rays, float offset,
                        Random& random) {
  const float half = least_cone_radians * std::pow(most_cone_radians / least_cone_radians, random.unit());
  TrainingPoint point;
  point.position = at;
  point.normal = light;
  point.slope = std::tan(half);
  point.ao = open_cone_share(scene, at + Vec3{0, offset, 0}, {light, half}, rays, random.unit());
  return point;
}

// Each point of the floor has its own light.
void add_cones(TrainingPoints& set, const RayScene& scene, const SurfacePoints& floor, std::uint32_t pose,
               std::uint32_t rays, float offset, Random& random, double& none) {
  const FlushDenormals flush;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    TrainingPoint point = lit_point(scene, floor.position[i], random_light(random), rays, offset, random);
    point.pose = pose;
    point.kind = PointKind::cone;
    point.weight = floor.weight[i];
    none += double(point.weight) * double(1 - point.ao) * double(1 - point.ao);
    set.point.push_back(point);
  }
}

// Adds floor points where the body's shadow begins, ends or could have a hole. We project random points of
// the body along the light onto the floor, and then move them a little to the side.
void add_outlines(TrainingPoints& set, const RayScene& scene, const PosedBody& body, std::size_t count,
                  std::uint32_t pose, std::uint32_t rays, float offset, Random& random, double& none) {
  const FlushDenormals flush;
  const float height = floor_height(body.position);
  const Bounds box = bounds_of(body.position);
  const float size = length(box.high - box.low);
  std::vector<double> up_to;
  double area = 0;
  for (const Triangle& t : body.triangle) {
    const Vec3 a = body.position[t[0]];
    area += double(length(cross(body.position[t[1]] - a, body.position[t[2]] - a)));
    up_to.push_back(area);
  }
  if (!(area > 0)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), random.unit_double() * area);
    const Triangle& t = body.triangle[std::min(std::size_t(found - up_to.begin()), up_to.size() - 1)];
    float u = random.unit(), v = random.unit();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 on = (1 - u - v) * body.position[t[0]] + u * body.position[t[1]] + v * body.position[t[2]];
    const Vec3 light = random_light(random);
    const float turn = 2 * std::numbers::pi_v<float> * random.unit();
    const float aside = size * (i % 2 ? 0.02f : 0.06f) * random.unit();
    Vec3 at = on - ((on.y - height) / light.y) * light;
    at.x += aside * std::cos(turn);
    at.z += aside * std::sin(turn);
    TrainingPoint point = lit_point(scene, at, light, rays, offset, random);
    point.pose = pose;
    point.kind = PointKind::outline;
    point.weight = 1;
    none += double(1 - point.ao) * double(1 - point.ao);
    set.point.push_back(point);
  }
}

}  // namespace

TrainingPoints trace_training_points(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                     const WorldCasterSettings& settings, const CasterProgress& progress) {
  TrainingPoints set;
  const std::size_t used = std::min(settings.poses, poses.size());
  for (std::size_t i = 0; i < used; ++i) {
    const Pose& pose = poses[i * poses.size() / used];
    Random random(mix_bits(~settings.seed) + i);
    set.poses.push_back(i % lying_every == lying_every - 1
                            ? lying(pose, 2 * std::numbers::pi_v<float> * random.unit())
                            : pose);
  }
  const float offset = ray_origin_offset(mesh.position);
  std::array<double, point_kinds> none{};
  for (std::size_t p = 0; p < used; ++p) {
    if (progress && !progress(p, used))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tracing casters");
    const Pose& other_pose = set.poses[(p + 1) % used];
    std::vector<Triangle> turned;
    PosedBody body{{}, mesh.triangle}, other{{}, posed_triangles(mesh, other_pose, turned)};
    skin_positions(mesh, set.poses[p], body.position);
    skin_positions(mesh, other_pose, other.position);
    Random random(mix_bits(settings.seed) + p);
    const float wall = 2 * std::numbers::pi_v<float> * random.unit();
    const float neighbour = 2 * std::numbers::pi_v<float> * random.unit();
    const SurfacePoints surfaces[] = {
        floor_points(body.position, settings.floor_points, random.bits()),
        wall_points(body.position, wall, settings.wall_points, random.bits()),
        contact_points(body, settings.contact_points, random.bits()),
        neighbour_points(body.position, other, neighbour, settings.neighbour_points, random.bits())};
    const RayScene scene(TriangleSoup{body.position, mesh.triangle});
    for (std::size_t k = 0; k < std::size(surfaces); ++k) {
      const SurfacePoints& points = surfaces[k];
      AoSettings rays{settings.rays, random.bits()};
      rays.origin_offset = offset;
      const std::vector<float> ao = trace_ao(scene, {points.position, points.normal}, rays);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (ao[i] < 0.01f) continue;
        set.point.push_back(
            {points.position[i], points.normal[i], std::uint32_t(p), PointKind(k), ao[i], points.weight[i]});
        none[k] += double(points.weight[i]) * double(1 - ao[i]) * double(1 - ao[i]);
      }
    }
    add_cones(set, scene, floor_points(body.position, settings.cone_points, random.bits()), std::uint32_t(p),
              std::max(settings.rays / 8, 1u), offset, random, none[std::size_t(PointKind::cone)]);
    add_outlines(set, scene, body, settings.outline_points, std::uint32_t(p), std::max(settings.rays / 8, 1u),
                 offset, random, none[std::size_t(PointKind::outline)]);
  }
  // The floor near a body is the part that is most visible and hardest to get right.
  constexpr double share[point_kinds] = {2, 1, 1.5, 0.7, 1, 2};
  for (TrainingPoint& point : set.point)
    point.weight = float(share[std::size_t(point.kind)] * double(point.weight) /
                         std::max(none[std::size_t(point.kind)], 1e-12));
  return set;
}

}  // namespace nook::bake
