#include "bakers/measure/world/world_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/darkeners.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "bakers/world/surroundings.h"
#include "bakers/world/training_points.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr int width_px = 380, height_px = 380;
constexpr float light_half_angle = 10 * std::numbers::pi_v<float> / 180;

// What each pixel shows: body, floor or wall.
struct View {
  std::vector<Vec3> position, normal;  // of the pixels that show floor or wall
  std::vector<std::uint32_t> pixel;    // the index of each of these pixels
  std::vector<float> body;             // brightness of the body; negative where a pixel does not show the
                                       // body
};

// Places a camera beside the body, a floor below it and a wall behind it.
View look(const RayScene& scene, std::span<const Vec3> body, float offset) {
  Vec3 low = body.front(), high = low;
  for (const Vec3 p : body) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const Vec3 middle = 0.5f * (low + high);
  const Vec3 eye = middle + size * Vec3{0.9f, 0.55f, 1.5f};
  const Vec3 ahead = normalised(middle - Vec3{0, 0.1f * size, 0} - eye);
  const Vec3 right = normalised(cross(ahead, {0, 1, 0})), up = cross(right, ahead);
  const float wall_z = low.z - wall_distance_m;
  View view;
  view.body.assign(std::size_t(width_px) * height_px, -1.0f);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const float u = (2 * (float(x) + 0.5f) / width_px - 1) * 0.5f,
                  v = (1 - 2 * (float(y) + 0.5f) / height_px) * 0.5f;
      const Vec3 direction = ahead + u * right + v * up;
      const std::uint32_t pixel = std::uint32_t(y * width_px + x);
      const RayHit hit = scene.nearest(eye, direction);
      const float floor = direction.y < 0 ? (low.y - eye.y) / direction.y : INFINITY;
      const float wall = direction.z < 0 ? (wall_z - eye.z) / direction.z : INFINITY;
      const float nearest = std::min(floor, wall);
      if (hit.distance < nearest) {
        view.body[pixel] = 0.25f + 0.35f * std::abs(dot(hit.normal, normalised(eye - middle)));
      } else if (nearest < INFINITY) {
        const Vec3 normal = floor < wall ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        view.position.push_back(eye + nearest * direction + offset * normal);
        view.normal.push_back(normal);
        view.pixel.push_back(pixel);
      }
    }
  return view;
}

Picture drawn(const View& view, std::span<const float> value) {
  Picture picture{width_px, height_px, std::vector<std::uint8_t>(std::size_t(width_px) * height_px * 3, 255)};
  const auto put = [&](std::size_t pixel, bake::Colour colour) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * pixel + c] = std::uint8_t(std::lround(255 * std::clamp(colour[c], 0.0f, 1.0f)));
  };
  for (std::size_t i = 0; i < value.size(); ++i) put(view.pixel[i], grey(value[i]));
  for (std::size_t p = 0; p < view.body.size(); ++p)
    if (view.body[p] >= 0) put(p, {0.75f * view.body[p], 0.85f * view.body[p], view.body[p]});
  return picture;
}

template <class Value>
std::vector<float> values_of(const View& view, const Value& value) {
  std::vector<float> values(view.position.size());
  tbb::parallel_for(std::size_t(0), values.size(), [&](std::size_t i) {
    const FlushDenormals flush;
    values[i] = value(i);
  });
  return values;
}

// Returns the values of the best variant. It is the one closest to the reference, as measured at every 23rd
// pixel.
template <class Value>
std::vector<float> best_of(const Method& method, const View& view, std::span<const float> truth,
                           const Value& value) {
  const Darkener* best = nullptr;
  double least = INFINITY;
  for (const auto& variant : method.variant) {
    double error = 0;
    for (std::size_t i = 0; i < truth.size(); i += 23) {
      const double e = double(value(*variant, i)) - double(truth[i]);
      error += e * e;
    }
    if (error < least) {
      least = error;
      best = variant.get();
    }
  }
  return values_of(view, [&](std::size_t i) { return value(*best, i); });
}

Picture above(const Picture& upper, const Picture& lower) {
  Picture both{upper.width, upper.height + lower.height, upper.rgb};
  both.rgb.insert(both.rgb.end(), lower.rgb.begin(), lower.rgb.end());
  return both;
}

}  // namespace

void write_world_pictures(const std::filesystem::path& directory, const SkinnedMesh& mesh,
                          const CharacterModel& model, std::span<const Pose> poses, std::size_t count,
                          std::uint32_t rays, std::uint64_t seed) {
  std::filesystem::create_directories(directory);
  std::vector<Method> methods;
  methods.push_back(nook_method({model.world_casters.begin(), model.world_casters.end()}));
  methods.push_back(capsule_method(mesh));
  methods.push_back(blob_method(mesh));
  const float offset = ray_origin_offset(mesh.position);
  LightCone light;
  light.axis = normalised({-0.5f, 1.2f, 0.8f});
  light.half_angle_radians = light_half_angle;
  light.parts = world::cone_parts_of(light.axis, light_half_angle);
  count = std::min(count, poses.size());
  for (std::size_t p = 0; p < count; ++p) {
    const Pose& pose = poses[(2 * p + 1) * poses.size() / (2 * count)];
    std::vector<Vec3> body;
    skin_positions(mesh, pose, body);
    const RayScene scene(TriangleSoup{body, mesh.triangle});
    const View view = look(scene, body, offset);
    const std::vector<float> ao = trace_ao(scene, {view.position, view.normal}, {rays, seed});
    const std::vector<float> open = values_of(view, [&](std::size_t i) {
      return open_cone_share(scene, view.position[i], {light.axis, light.half_angle_radians},
                             std::max(rays / 4, 1u), unit_float(mix_bits(seed + i)));
    });
    std::vector<Picture> upper{drawn(view, ao)}, lower{drawn(view, open)};
    for (Method& method : methods) {
      for (auto& variant : method.variant) variant->pose(pose);
      upper.push_back(drawn(view, best_of(method, view, ao, [&](const Darkener& d, std::size_t i) {
                              return d.ao(view.position[i], view.normal[i]);
                            })));
      lower.push_back(drawn(view, best_of(method, view, open, [&](const Darkener& d, std::size_t i) {
                              return d.cone(view.position[i], light);
                            })));
    }
    write_png(directory / ("pose_" + std::to_string(p) + ".png"),
              above(side_by_side(upper), side_by_side(lower)));
  }
}

}  // namespace nook::measure
