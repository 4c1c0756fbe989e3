#include "bakers/measure/crowd/light_comparison.h"

#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <nook/nook.hpp>
#include <numbers>

#include "bakers/measure/crowd/sheet.h"

namespace nook::measure::crowd {
namespace {

constexpr std::uint32_t kRays = 64;  // for each of the two estimates whose mean is the errors' reference
constexpr std::uint32_t kPictureRays = 256;
constexpr std::uint32_t kFloorSide = 100;

// The irradiance of vertices without occlusion, from the lobes: three floats for each unit normal.
std::vector<float> open_irradiance(const Light& light, const std::vector<float>& normals) {
  std::vector<float> irradiance(normals.size());
  nook::check(nook_sg_irradiance(light.lobes.data(), std::uint32_t(light.lobes.size()),
                                 NOOK_PROBE_IRRADIANCE_BANDS, normals.data(), irradiance.data(),
                                 normals.size() / 3));
  for (float& channel : irradiance) channel = std::max(channel, 0.0f);
  return irradiance;
}

// The irradiance of any surface in constant light of the lobes' mean radiance: RGB.
std::vector<float> constant_irradiance(const Light& light) {
  std::vector<float> irradiance(3, 0.0f);
  for (const nook_lobe& lobe : light.lobes) {
    float integral[3];
    nook::check(nook_sg_integral(&lobe, integral));
    for (int c = 0; c < 3; ++c) irradiance[c] += integral[c] / 4;  // times pi, over 4 pi
  }
  return irradiance;
}

struct Forms {
  VertexValues ao_only, ao_x_probe, per_lobe;  // irradiance, three floats for each vertex
};

Forms light_characters(const Subject& subject, std::span<const std::uint32_t> characters,
                       const Light& light) {
  subject.evaluated.update(NOOK_TERM_ALL);
  VertexValues ao;
  for (const std::uint32_t character : characters) ao.push_back(subject.evaluated.ao(character));
  const VertexValues directional = subject.evaluated.directional_ao(characters, light.lobes);
  const std::vector<float> constant = constant_irradiance(light);
  Forms forms;
  for (std::size_t k = 0; k < characters.size(); ++k) {
    const std::vector<float> open = open_irradiance(light, subject.crowd.body(characters[k]).normals);
    std::vector<float> plain(open.size()), times(open.size()), lobes(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      plain[i] = ao[k][i / 3] * constant[i % 3];
      times[i] = ao[k][i / 3] * open[i];
      lobes[i] = directional[k][i] * open[i];
    }
    forms.ao_only.push_back(std::move(plain));
    forms.ao_x_probe.push_back(std::move(times));
    forms.per_lobe.push_back(std::move(lobes));
  }
  return forms;
}

VertexValues mean_of(VertexValues a, const VertexValues& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) a[k][i] = (a[k][i] + b[k][i]) / 2;
  return a;
}

}  // namespace

LightErrors measure_light(const Subject& subject, const Light& light) {
  const std::vector<std::uint32_t> sample = choose_sample(subject.places).characters;
  const Forms forms = light_characters(subject, sample, light);
  const auto trace = [&](std::uint64_t seed) {
    return traced_irradiance(subject.crowd, sample, nullptr, light.environment, {kRays, seed}).bodies;
  };
  const VertexValues one = trace(subject.seed), other = trace(subject.seed + 1);
  const VertexValues reference = mean_of(one, other);
  const float unit = std::numbers::pi_v<float> * light.mean_radiance;
  const auto errors = [&](const VertexValues& values) {
    return compare(subject.crowd, sample, values, reference, 3, unit);
  };
  LightErrors result;
  result.forms = {{"ao_only", errors(forms.ao_only)},
                  {"ao_x_probe", errors(forms.ao_x_probe)},
                  {"per_lobe", errors(forms.per_lobe)}};
  // The mean square difference of two independent estimates is twice the variance of one, and their mean has
  // half the variance of one.
  result.noise_floor_mse = compare(subject.crowd, sample, other, one, 3, unit).mse / 4;
  return result;
}

platform::Image light_sheet(const Subject& subject, const Light& light) {
  const Group group = choose_group(subject.places);
  const FloorPatch patch = floor_under(group, subject.places, 1.0f, kFloorSide);
  const TracedIrradiance reference = traced_irradiance(subject.crowd, group.members, &patch,
                                                       light.environment, {kPictureRays, subject.seed});
  const Forms forms = light_characters(subject, group.members, light);
  std::vector<platform::Image> panels;
  const auto add = [&](const char* label, const VertexValues& irradiance) {
    panels.push_back(subject.renderer.draw(
        group, IrradiancePanel{irradiance, {patch, reference.floor}, 1.0f / light.mean_radiance}));
    draw_label(panels.back(), label);
  };
  add("AO times constant light", forms.ao_only);
  add("AO times the probe", forms.ao_x_probe);
  add("occlusion of each lobe", forms.per_lobe);
  add("path traced", reference.bodies);
  return tile(panels, 2);
}

}  // namespace nook::measure::crowd
