#include "bakers/measure/probe/gloss_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "bakers/measure/probe/visible_reflections.h"
#include "bakers/probe/map_light.h"
#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::measure {
namespace {

constexpr std::size_t roughnesses = std::size(gloss_roughness);
// Number of visible normals along each axis of their grid. Doubling it changes the sums of reflections by
// less than 1 %.
constexpr int steps = 32;

probe::Surface metal(Vec3 direction, float roughness) {
  probe::Surface surface;
  surface.normal = surface.view = direction;
  surface.tangent = bake::turned_frame(direction, 1, 0).x;
  surface.alpha_x = surface.alpha_y = roughness * roughness;
  surface.reflectance = 1;
  return surface;
}

// Sums over directions from which the errors are computed.
struct Sums {
  std::size_t lit = 0, dark = 0, negative = 0, all = 0;
  double lowest = 0, square = 0, lobes = 0, truth = 0;

  void add(Vec3 lobe, Vec3 truth_rgb, double mean) {
    const double here = double(bake::luminance(lobe)), there = double(bake::luminance(truth_rgb));
    const double least = double(std::min({lobe.x, lobe.y, lobe.z}));
    ++all;
    if (there > gloss_lit * mean) {
      ++lit;
      if (here < gloss_dark * there) ++dark;
    }
    if (least < 0) ++negative;
    lowest = std::min(lowest, least);
    square += (here - there) * (here - there);
    lobes += here;
    truth += there;
  }
  void add(const Sums& other) {
    lit += other.lit, dark += other.dark, negative += other.negative, all += other.all;
    lowest = std::min(lowest, other.lowest);
    square += other.square, lobes += other.lobes, truth += other.truth;
  }
  GlossError error(double mean) const {
    const auto share = [](std::size_t part, std::size_t whole) {
      return whole > 0 ? double(part) / double(whole) : 0.0;
    };
    return {share(dark, lit), share(negative, all), lowest / mean, std::sqrt(square / double(all)) / mean,
            lobes / truth};
  }
};

}  // namespace

GlossTruth::GlossTruth(const bake::Environment& map, std::uint32_t directions)
    : direction_(directions), truth_(roughnesses, std::vector<Vec3>(directions)) {
  const bake::Environment sky = bake::probe::reduced(bake::without_suns(map), 256);
  const bake::probe::Channels whole = integrate(sky, bake::probe::Region{}).radiance;
  mean_ =
      double(bake::luminance({float(whole[0]), float(whole[1]), float(whole[2])})) / (4 * std::numbers::pi);
  probe::vogel_sphere(direction_);
  tbb::parallel_for(std::uint32_t(0), directions, [&](std::uint32_t i) {
    for (std::size_t r = 0; r < roughnesses; ++r) {
      const probe::Surface s = metal(direction_[i], gloss_roughness[r]);
      const bake::Frame frame{s.tangent, cross(s.normal, s.tangent), s.normal};
      for (const ReflectedDirection& l : visible_reflections(s, steps))
        truth_[r][i] +=
            sky.radiance(bake::to_world(frame, {float(l.x), float(l.y), float(l.z)})) * float(l.weight);
    }
  });
}

std::vector<GlossError> GlossTruth::errors(std::span<const SphericalGaussian> lobes) const {
  std::vector<GlossError> errors;
  Sums all;
  for (std::size_t r = 0; r < roughnesses; ++r) {
    Sums sums;
    for (std::size_t i = 0; i < direction_.size(); ++i)
      sums.add(specular(lobes, probe::SpecularForm::anisotropic, metal(direction_[i], gloss_roughness[r])),
               truth_[r][i], mean_);
    errors.push_back(sums.error(mean_));
    all.add(sums);
  }
  errors.push_back(all.error(mean_));
  return errors;
}

}  // namespace nook::measure
