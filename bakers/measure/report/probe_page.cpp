#include "bakers/measure/report/pages.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/measure/probe/probe_report.h"
#include "bakers/measure/report/advice.h"
#include "bakers/measure/report/report_pictures.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::report {
namespace {

using bake::Colour;
using bake::Environment;
using bake::Picture;
using nook::probe::Probes;

constexpr Colour background{0.32f, 0.34f, 0.38f};
constexpr float mean_shade = 0.3f;  // linear pixel value of a white surface under the mean light
constexpr std::uint32_t max_layers = 4;
constexpr int max_side_px = 1000;

Vec3 irradiance_of(const Probes& probes, std::size_t index, Vec3 normal) {
  return nook::probe::irradiance(probes.basis, probes.of(index), nook::probe::IrradianceForm::bands, normal);
}

// Statistics of a probe's irradiance for fourteen normals: towards the six faces and the eight corners of a
// cube.
struct BallLight {
  float mean = 0;      // luminance
  int below_zero = 0;  // directions with a luminance below 0
};
constexpr int ball_directions = 14;

BallLight ball_light(const Probes& probes, std::size_t index) {
  BallLight light;
  const auto add = [&](Vec3 direction) {
    const float value = bake::luminance(irradiance_of(probes, index, normalised(direction)));
    light.mean += value / ball_directions;
    light.below_zero += value < 0 ? 1 : 0;
  };
  for (const float side : {-1.0f, 1.0f}) {
    for (const Vec3 face : {Vec3{side, 0, 0}, Vec3{0, side, 0}, Vec3{0, 0, side}}) add(face);
    for (const float y : {-1.0f, 1.0f})
      for (const float z : {-1.0f, 1.0f}) add({side, y, z});
  }
  return light;
}

// Draws a white ball that is lit by a probe. The viewer is at +z, and +y is up.
void draw_ball(Picture& picture, int left, int top, int side, const Probes& probes, std::size_t index,
               float exposure) {
  constexpr int samples = 2;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Colour sum{};
      for (int s = 0; s < samples * samples; ++s) {
        const float px = (float(x) + (float(s % samples) + 0.5f) / samples) / float(side) * 2 - 1;
        const float py = 1 - (float(y) + (float(s / samples) + 0.5f) / samples) / float(side) * 2;
        const float inside = 0.9025f - px * px - py * py;
        const Colour c =
            inside > 0
                ? display(exposure * irradiance_of(probes, index, normalised({px, py, std::sqrt(inside)})))
                : background;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / (samples * samples);
      }
      set_pixel(picture, left + x, top + y, sum);
    }
}

// Draws the probes of one layer, which have the same y. x goes to the right, and z goes down.
Picture layer_picture(const Probes& probes, std::uint32_t layer, float exposure) {
  const auto columns = int(probes.grid.counts[0]), rows = int(probes.grid.counts[2]);
  // Shows only every n-th probe if the grid is wider than the picture.
  const int step = (std::max(columns, rows) * 8 + max_side_px - 1) / max_side_px;
  const int shown_columns = (columns + step - 1) / step, shown_rows = (rows + step - 1) / step;
  const int side = std::clamp(max_side_px / std::max(shown_columns, shown_rows), 8, 160);
  Picture picture = plain_picture(shown_columns * side, shown_rows * side, background);
  for (int z = 0; z < shown_rows; ++z)
    for (int x = 0; x < shown_columns; ++x) {
      const std::size_t index =
          (std::size_t(z * step) * probes.grid.counts[1] + layer) * probes.grid.counts[0] +
          std::size_t(x * step);
      draw_ball(picture, x * side, z * side, side, probes, index, exposure);
    }
  return picture;
}

Html layers(const Probes& probes, float exposure) {
  Html html;
  const std::uint32_t count = std::min(probes.grid.counts[1], max_layers);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t layer = (2 * i + 1) * probes.grid.counts[1] / (2 * count);
    const float height = probes.grid.origin_ws.y + float(layer) * probes.grid.spacing_ws.y;
    const std::string where =
        "layer " + std::to_string(layer + 1) + " of " + std::to_string(probes.grid.counts[1]);
    std::string alternative = "White balls in the light of the probes of ";
    alternative.append(where).append(", seen from +z");
    html += figure(layer_picture(probes, layer, exposure), alternative,
                   text(where) + Html(", at a height of ") + number(double(height)) +
                       Html(" m: x is to the right and z is down. Each ball is lit by its probe and seen "
                            "from +z. Look for balls that are black, or that differ from their neighbours "
                            "although no wall is between them."));
  }
  return html;
}

struct Lit {
  float mean = 0;
  double dark_share = 0;   // fraction of the probes that are dark
  double below_share = 0;  // fraction of the directions of all probes that are below zero
};

Lit light_of(const Probes& probes) {
  std::vector<float> light;
  double sum = 0, below = 0;
  for (std::size_t i = 0; i < probes.grid.size(); ++i) {
    const BallLight ball = ball_light(probes, i);
    light.push_back(ball.mean);
    sum += double(ball.mean);
    below += ball.below_zero;
  }
  Lit lit;
  const auto count = double(light.size());
  lit.mean = float(sum / count);
  lit.below_share = below / (count * ball_directions);
  lit.dark_share =
      double(std::ranges::count_if(light, [&](float l) { return l < 0.01f * lit.mean; })) / count;
  return lit;
}

void add_map(PageParts& parts, Measures& measures, const Probes& probes, const Environment& map) {
  const nlohmann::ordered_json errors = measure::probe_errors(map, probes);
  for (const char* name : {"irradiance_minimum", "irradiance_relative"})
    if (errors.contains(name) && errors[name].is_number()) measures.value[name] = errors[name].get<double>();
  std::vector<std::vector<Html>> rows{{Html("against the map"), Html("value")}};
  for (const auto& item : errors.items())
    if (item.value().is_number()) rows.push_back({text(item.key()), number(item.value().get<double>())});
  parts.sections +=
      Html("<section id=\"map\"><h2>Beside the map</h2>\n") +
      figure(bake::probe::map_picture(map, probes.basis, probes.of(0), 300),
             "The map, the probe's radiance, its irradiance, and the error of its radiance, "
             "each over all directions",
             Html("From the left: the map; the radiance that the probe stores; the light on a white surface "
                  "that faces each direction; the error of the second picture, where violet is no error and "
                  "yellow is an error as large as the map's mean or larger. A probe is smooth by design, so "
                  "look at the third picture, which is what diffuse surfaces use.")) +
      table(rows) + Html("</section>\n");
}

}  // namespace

PageParts probe_parts(const Probes& probes, const Environment* map) {
  const bool is_grid = probes.grid.size() > 1;
  if (map && is_grid)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a grid of probes cannot be compared with one map; leave the map out");
  const Lit lit = light_of(probes);
  Measures measures;
  measures.value["probes"] = double(probes.grid.size());
  measures.value["below_share"] = lit.below_share;
  if (is_grid) measures.value["dark_share"] = lit.dark_share;
  PageParts parts;
  if (map) add_map(parts, measures, probes, *map);
  const float exposure = lit.mean > 0 ? mean_shade / lit.mean : 1.0f;
  parts.sections += Html("<section id=\"balls\"><h2>The light of the probes</h2>\n") +
                    layers(probes, exposure) + Html("</section>\n");
  parts.lead = is_grid ? text(std::to_string(probes.grid.size())) +
                             Html(" probes. Their light is shown on white balls, all with the same exposure.")
                       : Html("One probe. Its light is shown on a white ball.");
  if (map && measures.value.contains("irradiance_relative"))
    parts.lead += Html(" The light on surfaces is off by <strong>") +
                  percent(measures.value["irradiance_relative"]) + Html("</strong> of the map's mean.");
  parts.advice = advice_list(Subject::probes, measures);
  return parts;
}

}  // namespace nook::report
