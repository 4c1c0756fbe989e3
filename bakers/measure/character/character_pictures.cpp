#include "bakers/measure/character/character_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/bent_study.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/raytrace/specular_visibility.h"
#include "sdk/src/nnao/lighting.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr int width_px = 420, height_px = 760, pair_width_px = 560;
constexpr float error_gain = 4;  // an AO error of 0.25 has the colour at the upper end of the ramp

Picture draw_pose(const SkinnedMesh& mesh, const Pose& pose, std::span<const float> traced,
                  std::span<const float> predicted) {
  std::vector<Vec3> posed;
  skin_positions(mesh, pose, posed);
  std::vector<float> error(traced.size());
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = error_gain * std::fabs(traced[i] - predicted[i]);
  std::vector<Picture> panels;
  for (BodySide side : {BodySide::front, BodySide::back}) {
    const BodyView view(mesh.triangle, posed, side, width_px, height_px);
    panels.push_back(view.draw(traced, grey));
    panels.push_back(view.draw(predicted, grey));
    panels.push_back(view.draw(error, viridis));
  }
  return side_by_side(panels);
}

Picture draw_rms(const SkinnedMesh& mesh, std::span<const float> vertex_rms) {
  std::vector<float> scaled(vertex_rms.begin(), vertex_rms.end());
  for (float& value : scaled) value *= error_gain;
  std::vector<Picture> panels;
  for (BodySide side : {BodySide::front, BodySide::back})
    panels.push_back(BodyView(mesh.triangle, mesh.position, side, width_px, height_px).draw(scaled, viridis));
  return side_by_side(panels);
}

// The vertices of both bodies. The vertices of the receiver come first.
struct DrawnPair {
  TriangleSoup soup;
  std::vector<float> traced, predicted, error;
};

DrawnPair drawn_pair(const SkinnedMesh& mesh, const CharacterModel& model, const BodyPair& pair,
                     const CasterStudy& study) {
  DrawnPair drawn;
  for (const BodyPair& side : {pair, BodyPair{pair.caster, pair.receiver}}) {
    const auto first = std::uint32_t(drawn.soup.position.size());
    std::vector<Vec3> posed;
    skin_positions(mesh, side.receiver, posed);
    drawn.soup.position.insert(drawn.soup.position.end(), posed.begin(), posed.end());
    for (const auto& t : mesh.triangle)
      drawn.soup.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
    const std::vector<float> traced = trace_pair(mesh, side, study.rays, study.seed).together,
                             predicted = linked_ao(model, side);
    for (std::size_t i = 0; i < traced.size(); ++i) {
      drawn.traced.push_back(traced[i]);
      drawn.predicted.push_back(predicted[i]);
      drawn.error.push_back(error_gain * std::fabs(traced[i] - predicted[i]));
    }
  }
  return drawn;
}

// Returns a camera whose picture contains both bodies, whichever side it looks from.
BodyCamera pair_camera(std::span<const Vec3> position, Vec3 towards) {
  Vec3 low = position[0], high = position[0];
  for (const Vec3 p : position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float wide = std::hypot(high.x - low.x, high.z - low.z), tall = high.y - low.y;
  constexpr float margin = 1.04f;
  return {(low + high) * 0.5f, towards,
          margin * std::max(wide / float(pair_width_px), tall / float(height_px))};
}

// The view is oblique, because one body would hide the other if both stood in a row.
Picture draw_pair(const DrawnPair& pair) {
  std::vector<Picture> panels;
  for (const Vec3 towards : {Vec3{0.8f, 0, 0.6f}, Vec3{-0.8f, 0, -0.6f}}) {
    const BodyView view(pair.soup.triangle, pair.soup.position, pair_camera(pair.soup.position, towards),
                        pair_width_px, height_px);
    panels.push_back(view.draw(pair.traced, grey));
    panels.push_back(view.draw(pair.predicted, grey));
    panels.push_back(view.draw(pair.error, viridis));
  }
  return side_by_side(panels);
}

constexpr Vec3 to_viewer{0, 0, 1};
constexpr int samples = 2;  // along each side of a pixel
constexpr float margin = 1.04f, middle_grey = 0.3f, background = 0.05f;
// A vertex normal can face away from the viewer although its triangle faces the viewer.
constexpr float least_facing = 0.02f;

enum Panel { open, lagarde, bent, traced, panel_count };
using Radiance = std::array<Vec3, panel_count>;

// The middle of the body, and the scale at which the body fills the picture.
struct View {
  Vec3 centre;
  float metres_per_pixel = 1, beyond_z = 0;
};

View view_of(std::span<const Vec3> positions, const GlossyPictureSettings& settings) {
  Vec3 low = positions.front(), high = low;
  for (const Vec3 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float pixels =
      std::max((high.x - low.x) / float(settings.width_px), (high.y - low.y) / float(settings.height_px));
  return {0.5f * (low + high), margin * std::max(pixels, 1e-6f), high.z + 1};
}

struct Stage {
  const bake::SkinnedMesh& mesh;
  const BentBody& body;
  bake::RayScene scene;
  nook::nnao::SpecularNumbers numbers;
  float origin_offset = 0;
};

// Returns the radiance of each panel for a pixel whose ray hits the body.
Radiance shade(const Stage& stage, const bake::RayHit& hit, Vec3 position, const GlossyMap& map,
               const GlossyPictureSettings& settings, std::uint64_t seed) {
  const auto& corner = stage.mesh.triangle[hit.triangle];
  const float w = 1 - hit.u - hit.v;
  const auto between = [&](const auto& value) {
    return w * value[corner[0]] + hit.u * value[corner[1]] + hit.v * value[corner[2]];
  };
  Vec3 normal = normalised(between(stage.body.normal));
  if (dot(normal, to_viewer) < least_facing)
    normal = normalised(normal + (least_facing - dot(normal, to_viewer)) * to_viewer);
  const float ao = between(stage.body.ao);
  const bake::GlossyPoint point{position, normal, to_viewer, std::numeric_limits<float>::infinity(),
                                stage.origin_offset};
  const bake::GlossyLight light =
      bake::trace_glossy_light(stage.scene, point, settings.roughness, settings.rays, seed, {&map.light, 1});
  const nook::nnao::LitPixel lit{normalised(between(stage.body.bent)), normal, to_viewer, ao};
  Radiance seen;
  seen[open] = light.open[0];
  seen[lagarde] =
      bake::nnao::lagarde_occlusion(ao, dot(normal, to_viewer), settings.roughness) * light.open[0];
  seen[bent] = nook::nnao::specular_occlusion(stage.numbers, lit, settings.roughness) * light.open[0];
  seen[traced] = light.seen[0];
  return seen;
}

std::uint8_t shown(float radiance, double mean) {
  const double value = mean > 0 ? middle_grey * double(radiance) / mean : 0;
  return std::uint8_t(std::lround(255 * std::pow(std::clamp(value, 0.0, 1.0), 1 / 2.2)));
}

}  // namespace

void write_pair_picture(const std::filesystem::path& path, const SkinnedMesh& mesh,
                        const CharacterModel& model, const BodyPair& pair, const CasterStudy& study) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  write_png(path, draw_pair(drawn_pair(mesh, model, pair, study)));
}

void write_pictures(const std::filesystem::path& directory, const SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed) {
  std::filesystem::create_directories(directory);
  std::vector<Pose> picked;
  count = std::min(count, poses.size());
  for (std::size_t i = 0; i < count; ++i) picked.push_back(poses[(2 * i + 1) * poses.size() / (2 * count)]);
  const AoTargets targets = trace_character_ao(mesh, picked, rays, seed);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<float> traced;
    for (std::uint16_t value : targets.row(i)) traced.push_back(float(value) * AoTargets::scale);
    write_png(directory / ("pose_" + std::to_string(i) + ".png"),
              draw_pose(mesh, picked[i], traced, predict_ao(model, picked[i])));
  }
  write_png(directory / "rms.png", draw_rms(mesh, vertex_rms));
}

bake::Picture glossy_picture(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                             const bake::Pose& pose, const GlossyMap& map,
                             const GlossyPictureSettings& settings) {
  const BentBody body = bent_body(mesh, model, pose);
  const View view = view_of(body.position, settings);
  const Stage stage{mesh, body, bake::RayScene(bake::TriangleSoup{body.position, mesh.triangle}),
                    character_specular_numbers(), bake::ray_origin_offset(mesh.position)};
  const double mean = mean_radiance(map.light);
  std::vector<bake::Picture> panels(panel_count);
  for (bake::Picture& panel : panels) {
    panel = {settings.width_px, settings.height_px, {}};
    panel.rgb.resize(3 * std::size_t(settings.width_px) * std::size_t(settings.height_px));
  }
  tbb::parallel_for(0, settings.height_px, [&](int y) {
    const bake::FlushDenormals flush;
    for (int x = 0; x < settings.width_px; ++x) {
      const std::size_t pixel = std::size_t(y) * std::size_t(settings.width_px) + std::size_t(x);
      Radiance sum{};
      for (int s = 0; s < samples * samples; ++s) {
        const float column = float(x) + (float(s % samples) + 0.5f) / samples,
                    row = float(y) + (float(s / samples) + 0.5f) / samples;
        const Vec3 origin{view.centre.x + (column - 0.5f * float(settings.width_px)) * view.metres_per_pixel,
                          view.centre.y + (0.5f * float(settings.height_px) - row) * view.metres_per_pixel,
                          view.beyond_z};
        const bake::RayHit hit = stage.scene.nearest(origin, -to_viewer);
        Radiance seen;
        seen.fill(Vec3{background, background, background} * float(mean));
        if (std::isfinite(hit.distance))
          seen = shade(
              stage, hit, origin - hit.distance * to_viewer, map, settings,
              bake::mix_bits(settings.seed ^ bake::mix_bits(samples * samples * pixel + std::size_t(s))));
        for (int p = 0; p < panel_count; ++p) sum[p] += (1.0f / (samples * samples)) * seen[p];
      }
      for (int p = 0; p < panel_count; ++p) {
        std::uint8_t* rgb = &panels[p].rgb[3 * pixel];
        rgb[0] = shown(sum[p].x, mean);
        rgb[1] = shown(sum[p].y, mean);
        rgb[2] = shown(sum[p].z, mean);
      }
    }
  });
  return bake::side_by_side(panels);
}

}  // namespace nook::measure
