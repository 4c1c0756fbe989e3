#include "bakers/measure/world/split_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/probe/map_bake.h"
#include "bakers/world/posed_casters.h"
#include "sdk/src/probe/probe_light.h"
#include "sdk/src/world/sample.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr std::uint32_t lobe_count = 32;

double mean_radiance(const Environment& map) {
  const bake::probe::MapIntegrals sum = bake::probe::integrate(map, {});
  return (sum.radiance[0] + sum.radiance[1] + sum.radiance[2]) / (12 * std::numbers::pi);
}

Environment difference(const Environment& all, const Environment& part) {
  std::vector<float> rest(all.rgb().begin(), all.rgb().end());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= part.rgb()[i];
  return Environment(all.width(), all.height(), std::move(rest));
}

}  // namespace

float SplitLight::sun_half_angle_radians() const {
  // Uses the sine of half the angle, because the cosine of a small angle rounds to 1.
  return 2 * std::asin(std::sqrt(std::min(sun->disc_solid_angle / (4 * std::numbers::pi_v<float>), 1.0f)));
}

Vec3 SplitLight::sun_irradiance(Vec3 normal) const {
  return sun ? sun->irradiance * std::max(dot(normal, sun->direction), 0.0f) : Vec3{};
}

Vec3 SplitLight::soft_irradiance(Vec3 normal) const {
  const Vec3 sum = nook::probe::irradiance(lobes, nook::probe::IrradianceForm::bands, normal);
  return {std::max(sum.x, 0.0f), std::max(sum.y, 0.0f), std::max(sum.z, 0.0f)};
}

SplitLight split(const NamedMap& named) {
  const Environment& map = named.map;
  const Environment soft = without_suns(map, 1);
  const std::vector<Sun> suns = find_suns(map, 1);
  SplitLight light{
      named.name, soft, difference(map, soft), {}, {}, {}, std::numbers::pi * mean_radiance(map)};
  if (!suns.empty()) light.sun = suns.front();
  bake::probe::MapBakeSettings settings;
  settings.basis = nook::probe::vogel_basis(lobe_count);
  const std::vector<Vec3> amplitude = bake::probe::bake_map(light.soft, settings);
  for (std::uint32_t i = 0; i < lobe_count; ++i)
    light.lobes.push_back({settings.basis.axis[i], settings.basis.sharpness[i], amplitude[i]});
  light.terms = world::terms_of(light.lobes);
  return light;
}

SampledLight sample_light(std::span<const PosedCaster> casters, const SurfacePoints& points,
                          const SplitLight& light) {
  world::SampleRequest request;
  request.positions = &points.position[0].x;
  request.normals = &points.normal[0].x;
  request.count = std::uint32_t(points.size());
  request.terms = &light.terms;
  request.has_light = light.sun.has_value();
  if (light.sun) {
    request.light_axis = light.sun->direction;
    request.light_half_angle_radians = light.sun_half_angle_radians();
  }
  world::CasterGroups groups{
      1, &casters, [](const void* user, std::uint32_t, PosedCaster&) {
        constexpr float everywhere = 1e3f;  // metres
        return world::CasterGroup{
            *static_cast<const std::span<const PosedCaster>*>(user), {}, everywhere, everywhere};
      }};
  SampledLight sampled{std::vector<float>(points.size()), std::vector<float>(points.size(), 1.0f),
                       std::vector<float>(3 * points.size())};
  world::sample(*world::world_kernels(choose_isa(NOOK_ISA_AUTO)), {}, request, groups, sampled.ao.data(),
                sampled.cone.data(), sampled.rgb.data());
  return sampled;
}

std::vector<PosedCaster> casters_in(const CharacterModel& model, const Pose& pose) {
  std::vector<PosedCaster> casters;
  for (const WorldCaster& caster : model.world_casters)
    casters.push_back({posed(caster, pose, CasterUse::light), caster.ao_scale});
  return casters;
}

}  // namespace nook::measure
