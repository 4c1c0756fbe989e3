#include "bakers/measure/world/silhouette.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/measure/world/darkeners.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/world/body_metres.h"
#include "bakers/world/surroundings.h"
#include "bakers/world/training_points.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

constexpr float cell_m = 0.01f, light_degrees = 1, half_open = 0.5f;
constexpr std::size_t directions = 8;
constexpr float up_radians = 0.25f * std::numbers::pi_v<float>;
// If the first rays of a cell disagree, the cell may be near the outline of the shadow, where half of the
// light is hidden. Such a cell is traced with more rays.
constexpr std::uint32_t first_rays = 7, rays_at_edges = 48;

// The grid of floor cells that the body may shade.
struct Floor {
  Vec3 corner;
  int columns = 0, rows = 0;

  std::size_t size() const { return std::size_t(columns) * std::size_t(rows); }
  Vec3 middle(std::size_t cell) const {
    return corner + cell_m * Vec3{float(cell % std::size_t(columns)) + 0.5f, 0,
                                  float(cell / std::size_t(columns)) + 0.5f};
  }
};

Floor shaded_floor(std::span<const Vec3> body, Vec3 axis) {
  const float height = floor_height(body);
  Vec3 low{INFINITY, height, INFINITY}, high{-INFINITY, height, -INFINITY};
  for (const Vec3 p : body) {
    const Vec3 q = p - ((p.y - height) / axis.y) * axis;
    low = {std::min(low.x, q.x), height, std::min(low.z, q.z)};
    high = {std::max(high.x, q.x), height, std::max(high.z, q.z)};
  }
  // Casters may reach farther than the body.
  constexpr float margin_m = 0.1f;
  const auto cells = [](float metres) { return int(std::ceil(metres / cell_m)); };
  return {low - Vec3{margin_m, 0, margin_m}, cells(high.x - low.x + 2 * margin_m),
          cells(high.z - low.z + 2 * margin_m)};
}

template <class Shaded>
std::vector<char> shaded_cells(const Floor& floor, const Shaded& shaded) {
  std::vector<char> cells(floor.size());
  tbb::parallel_for(std::size_t(0), cells.size(), [&](std::size_t i) {
    const FlushDenormals flush;
    cells[i] = shaded(floor.middle(i), i);
  });
  return cells;
}

double intersection_over_union(const std::vector<char>& a, const std::vector<char>& b) {
  std::size_t both = 0, either = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += a[i] && b[i];
    either += a[i] || b[i];
  }
  return either ? double(both) / double(either) : 1;
}

}  // namespace

Json silhouette_rows(const SkinnedMesh& mesh, const CharacterModel& model, std::span<const Pose> poses,
                     const WorldStudy& study, const WorldProgress& progress) {
  std::vector<WorldCaster> casters = study.casters;
  if (casters.empty()) casters.assign(model.world_casters.begin(), model.world_casters.end());
  if (casters.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the model has no world casters; bake the character again");
  // Cells are in metres.
  if (const float scale = scale_to_metres(mesh); scale != 1) {
    WorldStudy in_metres = study;
    in_metres.casters = casters_in_metres(casters, scale);
    return silhouette_rows(mesh_in_metres(mesh, scale), model, poses_in_metres(poses, scale), in_metres,
                           progress);
  }
  std::vector<Method> methods;
  methods.push_back(nook_method(casters));
  methods.push_back(capsule_method(mesh));
  std::vector<std::vector<std::vector<double>>> iou;  // by method, variant and shadow
  for (const Method& method : methods) iou.emplace_back(method.variant.size());
  const float offset = ray_origin_offset(mesh.position);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (progress && !progress(p, poses.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring silhouettes");
    const Pose& pose = poses[p];
    std::vector<Vec3> body;
    skin_positions(mesh, pose, body);
    for (Method& method : methods)
      for (auto& variant : method.variant) variant->pose(pose);
    const RayScene scene(TriangleSoup{body, mesh.triangle});
    for (std::size_t d = 0; d < directions; ++d) {
      const float bearing = 2 * std::numbers::pi_v<float> * float(d) / float(directions);
      LightCone cone;
      cone.axis = {std::cos(up_radians) * std::sin(bearing), std::sin(up_radians),
                   std::cos(up_radians) * std::cos(bearing)};
      cone.half_angle_radians = 0.5f * light_degrees * std::numbers::pi_v<float> / 180;
      cone.parts = world::cone_parts_of(cone.axis, cone.half_angle_radians);
      const Floor floor = shaded_floor(body, cone.axis);
      const std::uint64_t seed = mix_bits(study.seed + directions * p + d);
      const std::vector<char> truth = shaded_cells(floor, [&](Vec3 at, std::size_t i) {
        const Vec3 origin = at + Vec3{0, offset, 0};
        const float turn = unit_float(mix_bits(seed + i));
        const RayCone rays{cone.axis, cone.half_angle_radians};
        const float open = open_cone_share(scene, origin, rays, first_rays, turn);
        return (open > 0 && open < 1 ? open_cone_share(scene, origin, rays, rays_at_edges, turn) : open) <
               half_open;
      });
      for (std::size_t m = 0; m < methods.size(); ++m)
        for (std::size_t v = 0; v < methods[m].variant.size(); ++v)
          iou[m][v].push_back(intersection_over_union(truth, shaded_cells(floor, [&](Vec3 at, std::size_t) {
                                                        return methods[m].variant[v]->cone(at, cone) <
                                                               half_open;
                                                      })));
    }
  }
  Json rows = Json::array();
  for (std::size_t m = 0; m < methods.size(); ++m) {
    double best = -1, worst = 1;
    for (const std::vector<double>& shadows : iou[m]) {
      double sum = 0;
      for (const double one : shadows) sum += one;
      const double mean = sum / double(shadows.size());
      if (mean <= best) continue;
      best = mean;
      worst = *std::min_element(shadows.begin(), shadows.end());
    }
    rows.push_back({{"surface", "silhouette"},
                    {"cone_degrees", light_degrees},
                    {"method", methods[m].name},
                    {"iou", best},
                    {"iou_low", worst},
                    {"poses", poses.size()},
                    {"shadows", poses.size() * directions}});
  }
  return rows;
}

}  // namespace nook::measure
