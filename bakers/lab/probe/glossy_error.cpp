#include "bakers/lab/probe/glossy_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/lab/probe/prefiltered_cube.h"
#include "bakers/measure/probe/visible_reflections.h"
#include "bakers/probe/map_bake.h"
#include "bakers/probe/map_light.h"
#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::lab {
namespace {

using Json = nlohmann::ordered_json;
using Light = std::function<Vec3(Vec3)>;
using measure::ReflectedDirection;
using measure::visible_reflections;
using probe::SpecularForm;
using probe::Surface;

// Number of visible normals per axis; doubling it changes the sums by less than 0.2 %.
constexpr int steps = 64;

struct Kind {
  const char* name;
  bool two_widths;
  float reflectance;
  float least_facing, most_facing;
};
constexpr Kind kinds[] = {{"one width, reflectance 1", false, 1, 0.02f, 1},
                          {"one width, reflectance 0.04", false, 0.04f, 0.02f, 1},
                          {"two widths, grazing, reflectance 1", true, 1, 0.02f, 0.3f}};

float random_alpha(bake::Random& random) {
  const float roughness = 0.1f + 0.9f * random.unit();
  return roughness * roughness;
}

// Returns a random surface of a kind. Normals are uniform over the sphere. Views are uniform over the part of
// the hemisphere that the kind allows.
Surface random_surface(const Kind& kind, bake::Random& random) {
  Surface s;
  const float z = 2 * random.unit() - 1, turn = 2 * std::numbers::pi_v<float> * random.unit();
  const float across = std::sqrt(1 - z * z);
  s.normal = {across * std::cos(turn), across * std::sin(turn), z};
  const bake::Frame frame = bake::turned_frame(s.normal, 1, 0);
  s.tangent = frame.x;
  const float facing = kind.least_facing + (kind.most_facing - kind.least_facing) * random.unit();
  const float azimuth = 2 * std::numbers::pi_v<float> * random.unit();
  const float sine = std::sqrt(1 - facing * facing);
  s.view = bake::to_world(frame, {sine * std::cos(azimuth), sine * std::sin(azimuth), facing});
  s.alpha_x = random_alpha(random);
  s.alpha_y = kind.two_widths ? random_alpha(random) : s.alpha_x;
  s.reflectance = kind.reflectance;
  return s;
}

// The reference values: the radiance that a surface reflects under the light of the lobes and under the light
// of the map.
struct Truth {
  Vec3 of_lobes, of_map;
};
Truth truth_of(const Surface& s, const Light& lobes, const Light& map) {
  const bake::Frame frame{s.tangent, cross(s.normal, s.tangent), s.normal};
  Truth truth;
  for (const ReflectedDirection& l : visible_reflections(s, steps)) {
    const Vec3 d = bake::to_world(frame, {float(l.x), float(l.y), float(l.z)});
    const auto weight = float(l.weight * (double(s.reflectance) + (1 - double(s.reflectance)) * l.schlick));
    truth.of_lobes += lobes(d) * weight;
    truth.of_map += map(d) * weight;
  }
  return truth;
}

// Returns the root mean square of the difference over the channels.
double apart(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return std::sqrt(double(dot(d, d)) / 3);
}

Json row_of(std::vector<double>& of_lobes, const std::vector<double>& of_map, double mean) {
  const auto rms = [&](const std::vector<double>& errors) {
    double sum = 0;
    for (const double e : errors) sum += e * e;
    const double relative = std::sqrt(sum / double(errors.size())) / mean;
    return std::isfinite(relative) ? Json(relative) : Json();
  };
  std::ranges::sort(of_lobes);
  const auto at = [&](double share) {
    const double e = of_lobes[std::size_t(share * double(of_lobes.size() - 1))] / mean;
    return std::isfinite(e) ? Json(e) : Json();
  };
  return {{"rms", rms(of_lobes)}, {"percentile_95", at(0.95)}, {"worst", at(1)}, {"map_rms", rms(of_map)}};
}

// A representation of glossy light. Its functions return the reflection of a surface in the light of the
// lobes and in the light of the map.
struct Form {
  std::string name;
  std::size_t bytes;
  std::function<Vec3(const Surface&)> of_lobes, of_map;
};

std::vector<Form> forms_of(const std::vector<SphericalGaussian>& lobes, const Light& lobe_light,
                           const Light& map_light) {
  std::vector<Form> forms;
  for (const auto& [name, form] : {std::pair{"lobes, isotropic", SpecularForm::isotropic},
                                   {"lobes, anisotropic", SpecularForm::anisotropic}}) {
    const auto reflected = [&lobes, form = form](const Surface& s) { return specular(lobes, form, s); };
    forms.push_back({name, lobes.size() * sizeof(nook_lobe), reflected, reflected});
  }
  for (const std::uint32_t size : {4u, 16u}) {
    const auto reflected = [](PrefilteredCube cube) {
      return [cube = std::move(cube)](const Surface& s) {
        return cube.reflected(s) * directional_albedo(probe::view_of(s), s);
      };
    };
    PrefilteredCube of_lobes(size, lobe_light), of_map(size, map_light);
    const std::size_t bytes = of_map.bytes();
    forms.push_back({"cube map, faces of " + std::to_string(size), bytes, reflected(std::move(of_lobes)),
                     reflected(std::move(of_map))});
  }
  return forms;
}

std::vector<SphericalGaussian> fitted_lobes(const bake::Environment& map, const GlossySettings& settings) {
  bake::probe::MapBakeSettings bake;
  bake.basis = probe::vogel_basis(settings.lobes);
  bake.seed = settings.seed;
  const std::vector<Vec3> amplitudes = bake_map(map, bake);
  std::vector<SphericalGaussian> lobes;
  for (std::uint32_t i = 0; i < settings.lobes; ++i)
    lobes.push_back({bake.basis.axis[i], bake.basis.sharpness[i], amplitudes[i]});
  return lobes;
}

void add_kind(const Kind& kind, const std::vector<Form>& forms, const Light& lobes, const Light& map,
              double mean, const std::string& map_name, const GlossySettings& settings, Json& rows) {
  std::vector<std::vector<double>> of_lobes(forms.size(), std::vector<double>(settings.surfaces)),
      of_map = of_lobes;
  tbb::parallel_for(std::uint32_t(0), settings.surfaces, [&](std::uint32_t i) {
    bake::Random random(bake::mix_bits(settings.seed) + i);
    const Surface surface = random_surface(kind, random);
    const Truth truth = truth_of(surface, lobes, map);
    for (std::size_t f = 0; f < forms.size(); ++f) {
      of_lobes[f][i] = apart(forms[f].of_lobes(surface), truth.of_lobes);
      of_map[f][i] = apart(forms[f].of_map(surface), truth.of_map);
    }
  });
  for (std::size_t f = 0; f < forms.size(); ++f) {
    Json row{{"map", map_name},
             {"surfaces", kind.name},
             {"form", forms[f].name},
             {"lobes", settings.lobes},
             {"bytes", forms[f].bytes}};
    row.update(row_of(of_lobes[f], of_map[f], mean));
    rows.push_back(row);
  }
}

}  // namespace

Json glossy_rows(const bake::Environment& map, const std::string& map_name, const GlossySettings& settings,
                 const bake::Progress& progress) {
  const std::vector<SphericalGaussian> lobes = fitted_lobes(map, settings);
  const bake::Environment small = bake::probe::reduced(map, 128);
  const bake::probe::Channels whole = integrate(map, bake::probe::Region{}).radiance;
  const double mean =
      double(bake::luminance({float(whole[0]), float(whole[1]), float(whole[2])})) / (4 * std::numbers::pi);
  const Light lobe_light = [&](Vec3 d) {
    Vec3 sum;
    for (const SphericalGaussian& g : lobes) sum += value(g, d);
    return sum;
  };
  const Light map_light = [&](Vec3 d) { return small.radiance(d); };
  const std::vector<Form> forms = forms_of(lobes, lobe_light, map_light);
  Json rows = Json::array();
  std::size_t done = 0;
  for (const Kind& kind : kinds) {
    if (progress && !progress(done++, std::size(kinds)))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring glossy reflection of %s",
                    map_name.c_str());
    add_kind(kind, forms, lobe_light, map_light, mean, map_name, settings, rows);
  }
  return rows;
}

}  // namespace nook::lab
