#include "samples/crowd/light.h"

#include <nook/experimental/nook_sg.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nook/nook.hpp>

namespace crowd {
namespace {

// nook::ProbeFit gives these lobes for a sky that is blue above, white at the horizon, and brown below it.
const std::vector<nook_lobe> fitted_sky = {
    {{0.39965263f, 0, 0.916666687f}, 6, {0.373414665f, 0.363219291f, 0.345577747f}, 0},
    {{-0.487723678f, 0.446794838f, 0.75f}, 6, {0.291322649f, 0.477503419f, 0.884204924f}, 0},
    {{0.0710100457f, -0.80912286f, 0.583333313f}, 6, {0.278238058f, 0.208205387f, 0.126509026f}, 0},
    {{0.553107083f, 0.721430242f, 0.416666716f}, 6, {0.193248063f, 0.399598539f, 0.89441514f}, 0},
    {{-0.953444719f, -0.168650955f, 0.25f}, 6, {0.360850066f, 0.310655624f, 0.236934289f}, 0},
    {{0.840820491f, -0.534861147f, 0.0833333358f}, 6, {0.279575258f, 0.242725179f, 0.196857944f}, 0},
    {{-0.258701354f, 0.96235615f, -0.0833333433f}, 6, {0.050801497f, 0.283202499f, 0.877811611f}, 0},
    {{-0.4462713f, -0.859268248f, -0.25f}, 6, {0.31517449f, 0.250422895f, 0.170471936f}, 0},
    {{0.853898823f, 0.311842471f, -0.416666657f}, 6, {0.317375243f, 0.454347908f, 0.75225091f}, 0},
    {{-0.750783861f, 0.309912652f, -0.583333313f}, 6, {0.352694869f, 0.48620677f, 0.767675638f}, 0},
    {{0.280347794f, -0.59908694f, -0.750000119f}, 6, {0.318020046f, 0.211280927f, 0.0298771728f}, 0},
    {{0.119609579f, 0.381334186f, -0.916666687f}, 6, {0.281022727f, 0.391988933f, 0.657399476f}, 0}};
// A sun 30 degrees above the horizon, about 15 degrees wide.
constexpr nook_lobe hazy_sun{{0.62f, 0.5f, 0.605f}, 30, {40, 30, 18}, 0};

// The irradiance of a surface that faces up.
glm::vec3 irradiance_up(const nook_lobe* lobes, std::size_t count) {
  const float up[3] = {0, 1, 0};
  glm::vec3 rgb(0);
  nook::check(nook_sg_irradiance(lobes, std::uint32_t(count), NOOK_PROBE_IRRADIANCE_BANDS, up,
                                 glm::value_ptr(rgb), 1));
  return glm::max(rgb, glm::vec3(0));
}

}  // namespace

Light::Light(std::vector<nook_lobe> all_lobes, bool has_sun) : lobes(std::move(all_lobes)), soft(lobes) {
  if (has_sun) {
    const nook_lobe& sun = lobes.back();
    to_sun = glm::make_vec3(sun.axis);
    // The cone whose directions have the same mean distance from the axis: 1 / sharpness = (1 - cos(half
    // angle)) / 2.
    sun_degrees = 2 * std::acos(1 - 2 / sun.sharpness) * 180 / glm::pi<float>();
    sun_up = irradiance_up(&sun, 1);
    soft.pop_back();
  }
  soft_up = irradiance_up(soft.data(), soft.size());
  const glm::vec3 up = irradiance_up(lobes.data(), lobes.size());
  const float luminance = 0.2126f * up.r + 0.7152f * up.g + 0.0722f * up.b;
  exposure = 1.2f * glm::pi<float>() / std::max(luminance, 1e-6f);
}

glm::vec3 Light::radiance(const glm::vec3& direction) const {
  glm::vec3 rgb(0);
  nook::check(nook_sg_radiance(lobes.data(), std::uint32_t(lobes.size()), glm::value_ptr(direction),
                               glm::value_ptr(rgb), 1));
  return glm::max(rgb, glm::vec3(0));
}

Light sky() {
  std::vector<nook_lobe> lobes = fitted_sky;
  lobes.push_back(hazy_sun);
  return Light(std::move(lobes), true);
}

}  // namespace crowd
