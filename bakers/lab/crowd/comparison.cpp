#include "bakers/lab/crowd/comparison.h"

#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_character.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nook/nook.hpp>
#include <numbers>
#include <utility>

#include "bakers/lab/crowd/sheet.h"

namespace nook::lab::crowd {
namespace {

constexpr std::uint32_t ao_rays = 128;       // per vertex, for the errors
constexpr std::uint32_t light_rays = 64;     // per estimate; the reference is the mean of two estimates
constexpr std::uint32_t picture_rays = 256;  // for the sheets, where noise is visible
// Points per side of the floor. For AO, they are about 2 cm apart; for light, the distance is larger.
constexpr std::uint32_t ao_floor_side = 320, light_floor_side = 100;

VertexValues ao_of(const EvaluatedCrowd& evaluated, std::span<const std::uint32_t> characters) {
  VertexValues ao;
  for (const std::uint32_t character : characters) ao.push_back(evaluated.ao(character));
  return ao;
}

VertexValues difference_grey(const VertexValues& a, const VertexValues& b) {
  VertexValues grey = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t v = 0; v < a[i].size(); ++v)
      grey[i][v] = std::max(0.0f, 1 - 4 * std::abs(a[i][v] - b[i][v]));
  return grey;
}

std::string gamma_label(const EvaluatedCrowd& evaluated, const char* rest) {
  char text[96];
  std::snprintf(text, sizeof text, "gamma %.2f, %s", double(evaluated.gamma()), rest);
  return text;
}

std::string screen_space_label(const ScreenSpaceSettings& settings) {
  return "screen-space AO (NNAO) alone, " + std::to_string(settings.taps) + " taps" +
         (settings.half_resolution ? ", half resolution" : "");
}

// Draws panels of one group and collects them for a sheet.
class Painter {
 public:
  explicit Painter(const Subject& subject) : subject_(subject), group_(choose_group(subject.places)) {}

  const Group& group() const { return group_; }

  void add(const std::string& label, AoPanel panel) {
    panels_.push_back(subject_.renderer.draw(group_, panel));
    draw_label(panels_.back(), label);
  }
  void add(const std::string& label, const EvaluatedCrowd& evaluated,
           ScreenSpace screen_space = ScreenSpace::nowhere) {
    add(label, {ao_of(evaluated, group_.members), screen_space, {}});
  }
  platform::Image sheet(int columns) const { return tile(panels_, columns); }

 private:
  const Subject& subject_;
  Group group_;
  std::vector<platform::Image> panels_;
};

// Returns the irradiance from the lobes without occlusion, three floats for each unit normal.
std::vector<float> open_irradiance(const Light& light, const std::vector<float>& normals) {
  std::vector<float> irradiance(normals.size());
  nook::check(nook_sg_irradiance(light.lobes.data(), std::uint32_t(light.lobes.size()),
                                 NOOK_PROBE_IRRADIANCE_BANDS, normals.data(), irradiance.data(),
                                 normals.size() / 3));
  for (float& channel : irradiance) channel = std::max(channel, 0.0f);
  return irradiance;
}

// Returns the RGB irradiance of a surface in constant light with the mean radiance of the lobes.
std::vector<float> constant_irradiance(const Light& light) {
  std::vector<float> irradiance(3, 0.0f);
  for (const nook_lobe& lobe : light.lobes) {
    float integral[3];
    nook::check(nook_sg_integral(&lobe, integral));
    for (int c = 0; c < 3; ++c) irradiance[c] += integral[c] / 4;  // times pi, divided by 4 pi
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

AoErrors measure_ao(const Subject& subject) {
  const PosedCrowd& crowd = subject.crowd;
  const auto [sample, have_neighbours] = choose_sample(subject.places);
  const VertexValues reference = traced_ao(crowd, sample, {ao_rays, subject.seed});
  const VertexValues again = traced_ao(crowd, sample, {ao_rays, subject.seed + 1});
  AoErrors result;
  result.rays = ao_rays;
  // The mean squared difference of two independent estimates is twice the variance of one estimate.
  result.noise_floor_mse = compare(crowd, sample, again, reference).mse / 2;
  result.characters = sample.size();
  result.have_neighbours = have_neighbours;
  const std::pair<const char*, std::uint32_t> forms[4] = {{"self", NOOK_TERM_SELF},
                                                          {"self_ground", NOOK_TERM_SELF | NOOK_TERM_GROUND},
                                                          {"self_links", NOOK_TERM_SELF | NOOK_TERM_LINKS},
                                                          {"all", NOOK_TERM_ALL}};
  for (const auto& [name, terms] : forms) {
    subject.evaluated.update(terms);
    result.forms.push_back({name, compare(crowd, sample, ao_of(subject.evaluated, sample), reference)});
  }
  const VertexValues static_ao(sample.size(), subject.evaluated.static_ao());
  result.forms.push_back({"static", compare(crowd, sample, static_ao, reference)});
  // Both forms include the ground, so they differ only in the neighbours.
  result.links_cut_mse_area = 1 - result.forms[3].errors.mse_area / result.forms[1].errors.mse_area;
  return result;
}

platform::Image ao_sheet(const Subject& subject, const ScreenSpaceSettings* screen_space) {
  Painter painter(subject);
  const std::vector<std::uint32_t>& members = painter.group().members;
  const TraceSettings trace{picture_rays, subject.seed};
  const VertexValues reference = traced_ao(subject.crowd, members, trace);
  painter.add("no AO", AoPanel{});
  painter.add("static AO, baked in the rest pose",
              AoPanel{VertexValues(members.size(), subject.evaluated.static_ao()), {}, {}});
  if (screen_space) painter.add(screen_space_label(*screen_space), AoPanel{{}, ScreenSpace::everywhere, {}});
  subject.evaluated.update(NOOK_TERM_SELF);
  painter.add("Nook, self only", subject.evaluated);
  subject.evaluated.update(NOOK_TERM_ALL);
  painter.add("Nook, self + neighbours + ground", subject.evaluated);
  if (screen_space) {
    painter.add("the same, screen-space AO on the floor", subject.evaluated, ScreenSpace::on_floor);
    const FloorPatch patch =
        floor_under(painter.group(), subject.places, screen_space->radius_m, ao_floor_side);
    const std::vector<float> floor =
        traced_floor_ao(subject.crowd, members, patch, screen_space->radius_m, trace);
    painter.add("ray traced, the floor to 0.5 m like screen-space AO",
                AoPanel{reference, {}, FloorValues{patch, floor}});
  } else {
    painter.add("ray traced", AoPanel{reference, {}, {}});
  }
  painter.add("error of Nook x 4, dark is wrong",
              AoPanel{difference_grey(ao_of(subject.evaluated, members), reference), {}, {}});
  return painter.sheet(screen_space ? 4 : 3);
}

platform::Image double_shadowing_sheet(const Subject& subject, EvaluatedCrowd& one_norm,
                                       EvaluatedCrowd& one_norm_gamma_2) {
  constexpr std::uint32_t no_ground = NOOK_TERM_SELF | NOOK_TERM_LINKS;
  Painter painter(subject);
  const auto add_one_norm = [&](EvaluatedCrowd& evaluated) {
    evaluated.update(NOOK_TERM_SELF);
    painter.add(gamma_label(evaluated, "self"), evaluated);
    evaluated.update(no_ground);
    painter.add(gamma_label(evaluated, "self + neighbours in one norm"), evaluated);
  };
  add_one_norm(one_norm);
  const VertexValues reference =
      traced_ao(subject.crowd, painter.group().members, {picture_rays, subject.seed, false});
  painter.add("ray traced, no ground", AoPanel{reference, {}, {}});
  add_one_norm(one_norm_gamma_2);
  subject.evaluated.update(no_ground);
  painter.add(gamma_label(subject.evaluated, "composed (default)"), subject.evaluated);
  return painter.sheet(3);
}

LightErrors measure_light(const Subject& subject, const Light& light) {
  const std::vector<std::uint32_t> sample = choose_sample(subject.places).characters;
  const Forms forms = light_characters(subject, sample, light);
  const auto trace = [&](std::uint64_t seed) {
    return traced_irradiance(subject.crowd, sample, nullptr, light.environment, {light_rays, seed}).bodies;
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
  // The mean squared difference of two independent estimates is twice the variance of one estimate. Their
  // mean has half the variance of one estimate.
  result.noise_floor_mse = compare(subject.crowd, sample, other, one, 3, unit).mse / 4;
  return result;
}

platform::Image light_sheet(const Subject& subject, const Light& light) {
  const Group group = choose_group(subject.places);
  const FloorPatch patch = floor_under(group, subject.places, 1.0f, light_floor_side);
  const TracedIrradiance reference = traced_irradiance(subject.crowd, group.members, &patch,
                                                       light.environment, {picture_rays, subject.seed});
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

}  // namespace nook::lab::crowd
