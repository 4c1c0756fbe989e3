#include "bakers/measure/world/world_report.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/darkeners.h"
#include "bakers/measure/world/ratio_bounds.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "bakers/world/body_metres.h"
#include "bakers/world/surroundings.h"
#include "bakers/world/training_points.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

constexpr float visible_ao = 0.01f;
constexpr double cone_elevation_radians = 0.25 * std::numbers::pi;

// Sums over the points of one surface in one pose.
struct Sums {
  double weight = 0, none2 = 0;
  std::vector<double> error2, bias;  // per variant
};

// One surface, or one cone of light on the floor, over all poses.
struct Surface {
  std::string name;
  float cone_degrees = 0;  // 0: AO
  std::vector<Sums> pose = {};
};

// Points with their traced reference values. Each value is traced twice, with half of the rays each. The two
// results have independent noise. The mean of (value - first) * (value - second) is therefore the squared
// error without the noise of the rays.
struct TracedPoints {
  SurfacePoints points;
  std::vector<float> first, second;
};

TracedPoints visible_points(const RayScene& scene, SurfacePoints points, AoSettings rays) {
  TracedPoints traced;
  const std::vector<float> first = trace_ao(scene, {points.position, points.normal}, rays);
  rays.seed = mix_bits(rays.seed);
  const std::vector<float> second = trace_ao(scene, {points.position, points.normal}, rays);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] + second[i] < 2 * visible_ao) continue;
    traced.points.add(points.position[i], points.normal[i], points.weight[i]);
    traced.first.push_back(first[i]);
    traced.second.push_back(second[i]);
  }
  return traced;
}

// Traces rays that are spread evenly over the cone's solid angle. Returns the open share.
std::vector<float> trace_cone(const RayScene& scene, const SurfacePoints& points, const LightCone& cone,
                              std::uint32_t rays, float offset, std::uint64_t seed) {
  std::vector<float> open(points.size());
  tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
    const FlushDenormals flush;
    open[i] = open_cone_share(scene, points.position[i] + offset * points.normal[i],
                              {cone.axis, cone.half_angle_radians}, rays, unit_float(mix_bits(seed + i)));
  });
  return open;
}

template <class Value>
Sums sums_of(const TracedPoints& traced, std::size_t variants, const Value& value) {
  constexpr std::size_t chunks = 16;
  std::vector<Sums> part(chunks);
  tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
    Sums& s = part[chunk];
    s.error2.assign(variants, 0);
    s.bias.assign(variants, 0);
    const std::size_t end = (chunk + 1) * traced.first.size() / chunks;
    for (std::size_t i = chunk * traced.first.size() / chunks; i < end; ++i) {
      const double w = double(traced.points.weight[i]);
      const double first = double(traced.first[i]), second = double(traced.second[i]);
      s.weight += w;
      s.none2 += w * (1 - first) * (1 - second);
      for (std::size_t v = 0; v < variants; ++v) {
        const double own = double(value(v, traced.points.position[i], traced.points.normal[i]));
        s.error2[v] += w * (own - first) * (own - second);
        s.bias[v] += w * (own - 0.5 * (first + second));
      }
    }
  });
  Sums sums = std::move(part[0]);
  for (std::size_t c = 1; c < chunks; ++c) {
    sums.weight += part[c].weight;
    sums.none2 += part[c].none2;
    for (std::size_t v = 0; v < variants; ++v) {
      sums.error2[v] += part[c].error2[v];
      sums.bias[v] += part[c].bias[v];
    }
  }
  return sums;
}

struct FlatMethod {
  std::string name;
  std::size_t first = 0, count = 0;  // the range of this method in the list of all variants
};

std::size_t best_variant(const Surface& surface, const FlatMethod& method) {
  std::size_t best = method.first;
  double least = INFINITY;
  for (std::size_t v = method.first; v < method.first + method.count; ++v) {
    double error = 0;
    for (const Sums& s : surface.pose) error += s.error2[v];
    if (error < least) {
      least = error;
      best = v;
    }
  }
  return best;
}

std::vector<double> errors_of(const Surface& surface, std::size_t variant) {
  std::vector<double> errors;
  for (const Sums& s : surface.pose) errors.push_back(s.error2[variant]);
  return errors;
}

Json row_of(const Surface& surface, const std::vector<FlatMethod>& methods, const FlatMethod& method,
            const WorldStudy& study) {
  const std::size_t variant = best_variant(surface, method);
  double weight = 0, none = 0, error = 0, bias = 0;
  std::vector<double> none_by_pose;
  for (const Sums& s : surface.pose) {
    weight += s.weight;
    none += s.none2;
    error += s.error2[variant];
    bias += s.bias[variant];
    none_by_pose.push_back(s.none2);
  }
  const std::vector<double> errors = errors_of(surface, variant);
  const RatioBounds bounds = ratio_bounds(errors, none_by_pose, study.bootstrap, study.seed);
  Json row;
  row["surface"] = surface.name;
  if (surface.cone_degrees > 0) row["cone_degrees"] = surface.cone_degrees;
  row["method"] = method.name;
  row["mse"] = error / weight;
  row["mse_none"] = none / weight;
  row["bias"] = bias / weight;
  row["over_none"] = error / none;
  row["over_none_low"] = bounds.low;
  row["over_none_high"] = bounds.high;
  for (const FlatMethod& other : methods) {
    if (other.name != "capsules") continue;
    const std::vector<double> theirs = errors_of(surface, best_variant(surface, other));
    double sum = 0;
    for (const double e : theirs) sum += e;
    const RatioBounds ratio = ratio_bounds(errors, theirs, study.bootstrap, study.seed + 1);
    row["over_capsules"] = error / sum;
    row["over_capsules_low"] = ratio.low;
    row["over_capsules_high"] = ratio.high;
  }
  row["poses"] = surface.pose.size();
  row["rays"] = surface.cone_degrees > 0 ? study.cone_rays() : study.rays;
  return row;
}

}  // namespace

Json world_rows(const SkinnedMesh& mesh, const CharacterModel& model, std::span<const Pose> poses,
                const WorldStudy& study, const WorldProgress& progress) {
  std::vector<WorldCaster> casters = study.casters;
  if (casters.empty()) casters.assign(model.world_casters.begin(), model.world_casters.end());
  if (casters.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the model has no world casters; bake the character again");
  // Surfaces are in metres.
  if (const float scale = scale_to_metres(mesh); scale != 1) {
    WorldStudy in_metres = study;
    in_metres.casters = casters_in_metres(casters, scale);
    CharacterModel spheres;
    for (ProxySphere sphere : model.spheres) {
      sphere.centre = scale * sphere.centre;
      sphere.radius *= scale;
      spheres.spheres.push_back(sphere);
    }
    return world_rows(mesh_in_metres(mesh, scale), spheres, poses_in_metres(poses, scale), in_metres,
                      progress);
  }
  std::vector<Method> methods;
  methods.push_back(nook_method(casters));
  methods.push_back(capsule_method(mesh));
  methods.push_back(ellipsoid_method(mesh));
  methods.push_back(blob_method(mesh));
  methods.push_back(proxy_method(model));
  std::vector<Darkener*> variants;
  std::vector<FlatMethod> flat;
  for (Method& method : methods) {
    flat.push_back({method.name, variants.size(), method.variant.size()});
    for (auto& variant : method.variant) variants.push_back(variant.get());
  }
  std::vector<Surface> surfaces{{"floor"}, {"wall"}, {"contact"}, {"neighbour"}};
  for (const float degrees : study.cone_degrees) surfaces.push_back({"cone", degrees});

  const float offset = ray_origin_offset(mesh.position);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (progress && !progress(p, poses.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring the world");
    const Pose& other_pose = poses[(p + 1) % poses.size()];
    std::vector<Triangle> turned;
    PosedBody body{{}, mesh.triangle}, other{{}, posed_triangles(mesh, other_pose, turned)};
    skin_positions(mesh, poses[p], body.position);
    skin_positions(mesh, other_pose, other.position);
    for (Darkener* variant : variants) variant->pose(poses[p]);
    const RayScene scene(TriangleSoup{body.position, mesh.triangle});
    Random random(mix_bits(~study.seed) + p);
    const float bearing = 2 * std::numbers::pi_v<float> * random.unit();
    AoSettings rays{std::max(study.rays / 2, 1u), random.bits()};
    rays.origin_offset = offset;
    const auto by_ao = [&](std::size_t v, Vec3 at, Vec3 n) { return variants[v]->ao(at, n); };
    const TracedPoints floor =
        visible_points(scene, floor_points(body.position, study.points, random.bits()), rays);
    const auto score = [&](std::size_t s, const TracedPoints& traced) {
      surfaces[s].pose.push_back(sums_of(traced, variants.size(), by_ao));
    };
    score(0, floor);
    score(1, visible_points(scene, wall_points(body.position, bearing, study.points, random.bits()), rays));
    score(2, visible_points(scene, contact_points(body, study.points, random.bits()), rays));
    score(3, visible_points(
                 scene, neighbour_points(body.position, other, bearing, study.points, random.bits()), rays));
    // The light comes from the side of the wall.
    const float up = float(std::sin(cone_elevation_radians)), aside = float(std::cos(cone_elevation_radians));
    for (std::size_t c = 0; c < study.cone_degrees.size(); ++c) {
      LightCone cone;
      cone.axis = {aside * std::sin(bearing), up, aside * std::cos(bearing)};
      cone.half_angle_radians = 0.5f * study.cone_degrees[c] * std::numbers::pi_v<float> / 180;
      cone.parts = world::cone_parts_of(cone.axis, cone.half_angle_radians);
      TracedPoints traced;
      traced.points = floor.points;
      for (std::vector<float>* half : {&traced.first, &traced.second})
        *half =
            trace_cone(scene, floor.points, cone, std::max(study.cone_rays() / 2, 1u), offset, random.bits());
      surfaces[4 + c].pose.push_back(sums_of(traced, variants.size(), [&](std::size_t v, Vec3 at, Vec3) {
        return variants[v]->cone(at, cone);
      }));
    }
  }
  Json rows = Json::array();
  for (const Surface& surface : surfaces)
    for (const FlatMethod& method : flat) rows.push_back(row_of(surface, flat, method, study));
  return rows;
}

}  // namespace nook::measure
