#include "bakers/measure/world/world_report.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/ratio_bounds.h"
#include "bakers/measure/world/split_light.h"
#include "bakers/probe/map_bake.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/path_tracer.h"
#include "bakers/raytrace/random.h"
#include "bakers/world/surroundings.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

constexpr float visible_ao = 0.01f;
constexpr std::uint32_t visible_rays = 128;

// The methods that are compared, as named in rows.
constexpr std::array<const char*, 3> methods{"none", "ao_x_probe", "per_lobe"};

// Sums of squared errors over the points of a surface in a pose and over all three channels. There are three
// sums: for all light, for the soft light alone, and for all light but with the exact irradiance of the map
// in place of the lobes.
struct Sums {
  double weight = 0;
  std::array<double, methods.size()> all{}, soft{}, exact{};
};

// Irradiance from each half of the paths.
struct TracedLight {
  std::array<std::vector<Vec3>, 2> soft, sun;
};

class LitBody {
 public:
  LitBody(const std::vector<Vec3>& position, const SkinnedMesh& mesh)
      : position_(position), mesh_(mesh), offset_(ray_origin_offset(mesh.position)) {}

  SurfacePoints visible(const SurfacePoints& points, std::uint64_t seed) const {
    AoSettings rays{visible_rays, seed};
    rays.origin_offset = offset_;
    const std::vector<float> ao =
        trace_ao(TriangleSoup{position_, mesh_.triangle}, {points.position, points.normal}, rays);
    SurfacePoints seen;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (ao[i] >= visible_ao) seen.add(points.position[i], points.normal[i], points.weight[i]);
    return seen;
  }

  TracedLight trace(const SurfacePoints& points, const SplitLight& light, std::uint32_t rays,
                    Random& random) const {
    TracedLight traced;
    for (const auto& [map, found] : {std::pair{&light.soft, &traced.soft}, {&light.sun_map, &traced.sun}}) {
      const bool dark = map == &light.sun_map && !light.sun;
      const LitScene scene({{position_, mesh_.triangle},
                            {Surface{{0, 0, 0}, {}}},
                            std::vector<std::uint32_t>(mesh_.triangle.size(), 0)},
                           *map);
      for (std::vector<Vec3>& half : *found) {
        IrradianceSettings settings;
        settings.rays = rays;
        settings.seed = random.bits();
        settings.path = {0, offset_};
        half = dark ? std::vector<Vec3>(points.size())
                    : trace_irradiance(scene, {points.position, points.normal}, settings);
      }
    }
    return traced;
  }

 private:
  const std::vector<Vec3>& position_;
  const SkinnedMesh& mesh_;
  float offset_;
};

double product_of_errors(Vec3 value, Vec3 first, Vec3 second) {
  const Vec3 a = value - first, b = value - second;
  return double(a.x) * double(b.x) + double(a.y) * double(b.y) + double(a.z) * double(b.z);
}

// All points have the same normal.
Sums sums_of(const SurfacePoints& points, const TracedLight& traced, const SampledLight& sampled,
             const SplitLight& light) {
  Sums sums;
  const double scale = 1 / (3 * light.unit * light.unit);
  const std::vector<Vec3> exact =
      bake::probe::map_irradiance(light.soft, {}, {points.normal.data(), std::size_t(1)});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 normal = points.normal[i], sun = light.sun_irradiance(normal),
               soft = light.soft_irradiance(normal);
    const float* const rgb = &sampled.rgb[3 * i];
    const float ao = sampled.ao[i];
    const std::array<Vec3, methods.size()> shares{Vec3{1, 1, 1}, {ao, ao, ao}, {rgb[0], rgb[1], rgb[2]}};
    const double weight = double(points.weight[i]);
    sums.weight += weight;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Vec3 lit = m == 0 ? sun : sun * sampled.cone[i], of_lobes = by_channel(soft, shares[m]);
      const Vec3 first = traced.soft[0][i] + traced.sun[0][i], second = traced.soft[1][i] + traced.sun[1][i];
      sums.soft[m] += weight * scale * product_of_errors(of_lobes, traced.soft[0][i], traced.soft[1][i]);
      sums.all[m] += weight * scale * product_of_errors(of_lobes + lit, first, second);
      sums.exact[m] +=
          weight * scale * product_of_errors(by_channel(exact[0], shares[m]) + lit, first, second);
    }
  }
  return sums;
}

// One map on one surface over all poses.
struct LitSurface {
  std::string map, surface;
  bool sun = false;
  std::vector<Sums> pose;
};

using ErrorsOf = std::array<double, methods.size()> Sums::*;

std::vector<double> by_pose(const LitSurface& lit, ErrorsOf errors, std::size_t method) {
  std::vector<double> values;
  for (const Sums& s : lit.pose) values.push_back((s.*errors)[method]);
  return values;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

Json row_of(const LitSurface& lit, std::size_t method, const WorldStudy& study) {
  double weight = 0;
  for (const Sums& s : lit.pose) weight += s.weight;
  Json row{{"map", lit.map}, {"surface", lit.surface}, {"method", methods[method]}, {"sun", lit.sun}};
  const auto put = [&](ErrorsOf errors, const std::string& name) {
    const std::vector<double> own = by_pose(lit, errors, method), other = by_pose(lit, errors, 1);
    const RatioBounds bounds = ratio_bounds(own, other, study.bootstrap, study.seed);
    row["mse" + name] = sum_of(own) / weight;
    row["over_ao_x_probe" + name] = sum_of(own) / sum_of(other);
    row["over_ao_x_probe" + name + "_low"] = bounds.low;
    row["over_ao_x_probe" + name + "_high"] = bounds.high;
  };
  put(&Sums::all, "");
  put(&Sums::soft, "_soft");
  put(&Sums::exact, "_exact");
  row["poses"] = lit.pose.size();
  row["rays"] = study.rays;
  return row;
}

}  // namespace

Json world_light_rows(const SkinnedMesh& mesh, const CharacterModel& model, std::span<const Pose> poses,
                      std::span<const NamedMap> maps, const WorldStudy& study,
                      const WorldProgress& progress) {
  if (model.world_casters.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the model has no world casters; bake the character again");
  std::vector<SplitLight> lights;
  for (const NamedMap& map : maps) lights.push_back(split(map));
  std::vector<LitSurface> surfaces;
  for (const SplitLight& light : lights)
    for (const char* surface : {"floor", "wall"})
      surfaces.push_back({light.name, surface, light.sun.has_value(), {}});
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (progress && !progress(p, poses.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring the world");
    std::vector<Vec3> position;
    skin_positions(mesh, poses[p], position);
    const LitBody body(position, mesh);
    const std::vector<PosedCaster> casters = casters_in(model, poses[p]);
    Random random(mix_bits(~study.seed) + p);
    const float bearing = 2 * std::numbers::pi_v<float> * random.unit();
    const std::array<SurfacePoints, 2> points{
        body.visible(floor_points(position, study.points, random.bits()), random.bits()),
        body.visible(wall_points(position, bearing, study.points, random.bits()), random.bits())};
    for (std::size_t l = 0; l < lights.size(); ++l)
      for (std::size_t s = 0; s < points.size(); ++s) {
        if (points[s].size() == 0) continue;
        surfaces[points.size() * l + s].pose.push_back(
            sums_of(points[s], body.trace(points[s], lights[l], std::max(study.rays / 2, 1u), random),
                    sample_light(casters, points[s], lights[l]), lights[l]));
      }
  }
  Json rows = Json::array();
  for (const LitSurface& lit : surfaces)
    for (std::size_t m = 0; m < methods.size(); ++m) rows.push_back(row_of(lit, m, study));
  return rows;
}

}  // namespace nook::measure
