#include "bakers/measure/composite/composite.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/measure/composite/populated_room.h"
#include "bakers/measure/world/darkeners.h"
#include "bakers/raytrace/hemisphere.h"
#include "bakers/raytrace/lit_scene.h"
#include "bakers/raytrace/path_tracer.h"
#include "platform/platform.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr float origin_offset_m = 3e-4f;
constexpr std::size_t compared_every = 23;  // every n-th pixel is used to choose the scale of the capsules

struct Scene {
  std::vector<Figure> figures;
  RoomView view;
  SurfacePoints points;  // points of the room's pixels
};

Scene seen(const MeasuredRoom& measured, const SkinnedMesh& mesh, std::span<const Pose> poses,
           const LitRoomSettings& settings) {
  Scene scene;
  scene.figures = stand_in_room(measured.soup, mesh, poses, settings.figures, settings.seed);
  const PopulatedRoom room = populated(measured.soup, mesh, scene.figures);
  const std::vector<bake::nnao::Camera> cameras =
      cameras_at(room, scene.figures, 1, settings.width, settings.height, mix_bits(settings.seed));
  if (cameras.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s has too little space for characters and a camera (placed %zu characters); need level "
                  "ground with 2 m of free height; the scene must be in metres with +y up",
                  measured.name.c_str(), scene.figures.size());
  // Uses only the surfaces of the view, not the traced AO.
  scene.view = trace_room_view(room, RayScene(room.soup), cameras.front(), {1, 0.01f, 1, settings.seed});
  const RoomPixels& p = scene.view.pixels;
  for (std::size_t i = 0; i < p.pixel.size(); ++i)
    scene.points.add(p.position[i] + origin_offset_m * p.normal[i], p.normal[i], 1);
  return scene;
}

std::vector<Vec3> traced(const Scene& scene, const SkinnedMesh& mesh, const SplitLight& light,
                         const LitRoomSettings& settings) {
  const PopulatedRoom figures = populated({}, mesh, scene.figures);
  const std::size_t triangles = figures.soup.triangle.size();
  std::vector<Vec3> sum(scene.points.size());
  for (const Environment* map : {&light.soft, &light.sun_map}) {
    if (map == &light.sun_map && !light.sun) continue;
    const LitScene dark({figures.soup, {Surface{{0, 0, 0}, {}}}, std::vector<std::uint32_t>(triangles, 0)},
                        *map);
    IrradianceSettings paths;
    paths.rays = settings.rays;
    paths.seed = settings.seed;
    paths.path = {0, origin_offset_m};
    const std::vector<Vec3> part =
        trace_irradiance(dark, {scene.points.position, scene.points.normal}, paths);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  }
  return sum;
}

Vec3 lit(const SplitLight& light, Vec3 normal, Vec3 soft_share, float sun_share) {
  return by_channel(light.soft_irradiance(normal), soft_share) + light.sun_irradiance(normal) * sun_share;
}

// Returns the light at every n-th pixel, darkened by the method.
std::vector<Vec3> lit_by(Darkener& method, const Scene& scene, const SplitLight& light, std::size_t every) {
  const std::size_t count = (scene.points.size() + every - 1) / every;
  std::vector<float> ao(count, 1.0f), sun(count, 1.0f);
  LightCone cone;
  if (light.sun)
    cone = {light.sun->direction, light.sun_half_angle_radians(),
            world::cone_parts_of(light.sun->direction, light.sun_half_angle_radians())};
  for (const Figure& figure : scene.figures) {
    method.pose(figure.pose);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t k) {
      const Vec3 at = scene.points.position[every * k];
      ao[k] *= method.ao(at, scene.points.normal[every * k]);
      if (light.sun) sun[k] *= method.cone(at, cone);
    });
  }
  std::vector<Vec3> sum(count);
  for (std::size_t k = 0; k < count; ++k)
    sum[k] = lit(light, scene.points.normal[every * k], {ao[k], ao[k], ao[k]}, sun[k]);
  return sum;
}

std::vector<Vec3> lit_by_capsules(const Scene& scene, const SkinnedMesh& mesh, const SplitLight& light,
                                  std::span<const Vec3> truth) {
  const Method capsules = capsule_method(mesh);
  Darkener* best = nullptr;
  double least = INFINITY;
  for (const auto& variant : capsules.variant) {
    const std::vector<Vec3> some = lit_by(*variant, scene, light, compared_every);
    double error = 0;
    for (std::size_t k = 0; k < some.size(); ++k) {
      const Vec3 off = some[k] - truth[compared_every * k];
      error += double(dot(off, off));
    }
    if (error >= least) continue;
    least = error;
    best = variant.get();
  }
  return lit_by(*best, scene, light, 1);
}

// Returns the exposure at which one pixel in twenty is brighter than white.
float exposure_of(std::span<const Vec3> light) {
  if (light.empty()) return 1;
  std::vector<float> bright;
  for (const Vec3 rgb : light) bright.push_back(luminance(rgb));
  const auto at = bright.begin() + std::ptrdiff_t(bright.size() * 19 / 20);
  std::nth_element(bright.begin(), at, bright.end());
  return 0.8f / std::max(*at, 1e-20f);
}

std::vector<Vec3> panel_of(const Scene& scene, std::span<const Vec3> light, float exposure) {
  const RoomView& view = scene.view;
  std::vector<Vec3> panel(view.is_figure.size());
  for (std::size_t i = 0; i < panel.size(); ++i)
    if (view.is_figure[i]) panel[i] = Vec3{1, 1, 1} * (0.12f + 0.2f * std::abs(view.view.normal[i].z));
  for (std::size_t k = 0; k < light.size(); ++k) panel[view.pixels.pixel[k]] = light[k] * exposure;
  return panel;
}

void write_panels(const std::filesystem::path& file, const LitRoomSettings& settings,
                  std::span<const std::vector<Vec3>> panels) {
  platform::Image image;
  image.width = int(settings.width * panels.size());
  image.height = int(settings.height);
  image.channels = 3;
  const auto put = [&](float channel) {
    const float shown = std::pow(std::clamp(channel, 0.0f, 1.0f), 1 / 2.2f);
    image.pixels.push_back(std::uint8_t(std::lround(255 * shown)));
  };
  for (std::size_t y = settings.height; y-- > 0;)
    for (const std::vector<Vec3>& panel : panels)
      for (std::size_t x = 0; x < settings.width; ++x) {
        const Vec3 rgb = panel[y * settings.width + x];
        put(rgb.x);
        put(rgb.y);
        put(rgb.z);
      }
  platform::write_image(file, image);
}

}  // namespace

void write_lit_room(const std::filesystem::path& file, const MeasuredRoom& measured, const SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const Pose> poses, const SplitLight& light,
                    const LitRoomSettings& settings) {
  const Scene scene = seen(measured, mesh, poses, settings);
  const std::vector<Vec3> truth = traced(scene, mesh, light, settings);
  std::vector<PosedCaster> casters;
  for (const Figure& figure : scene.figures)
    for (const PosedCaster& caster : casters_in(model, figure.pose)) casters.push_back(caster);
  const SampledLight sampled = sample_light(casters, scene.points, light);
  std::vector<Vec3> by_lobes, by_ao;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vec3 normal = scene.points.normal[i];
    const float* const rgb = &sampled.rgb[3 * i];
    const float ao = sampled.ao[i];
    by_lobes.push_back(lit(light, normal, {rgb[0], rgb[1], rgb[2]}, sampled.cone[i]));
    by_ao.push_back(lit(light, normal, {ao, ao, ao}, sampled.cone[i]));
  }
  const float exposure = exposure_of(truth);
  const std::array<std::vector<Vec3>, 4> panels{
      panel_of(scene, truth, exposure), panel_of(scene, by_lobes, exposure), panel_of(scene, by_ao, exposure),
      panel_of(scene, lit_by_capsules(scene, mesh, light, truth), exposure)};
  write_panels(file, settings, panels);
}

}  // namespace nook::measure
