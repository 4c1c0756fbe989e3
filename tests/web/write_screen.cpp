// Writes a view of spheres on a floor and its AO by the CPU reference of the screen-space pass:
//
//   web_screen FOLDER
//
// The size, the projection and the radius go to FOLDER/screen.json. FOLDER/screen.bin holds three images,
// whose rows begin at the bottom: depth as floats (-z in metres), normals as four floats for each pixel (view
// space), and AO as bytes.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sdk/src/nnao/network_evaluate.h"
#include "sdk/src/nnao/network_file.h"

using namespace nook;

namespace {

constexpr std::uint32_t width = 480, height = 270;
constexpr float radius_m = 0.6f, floor_y = -1, sky_m = 100;
// A perspective of 60 degrees, whose depths the pass does not read.
constexpr float focal = 1.7320508f;
constexpr float projection[16] = {
    focal * height / width, 0, 0, 0, 0, focal, 0, 0, 0, 0, -1.002f, -1, 0, 0, -0.2f, 0};

struct Sphere {
  Vec3 centre;
  float radius;
};
constexpr Sphere spheres[] = {{{-1.1f, -0.45f, -4}, 0.55f},
                              {{0.05f, -0.3f, -4.4f}, 0.7f},
                              {{1.15f, -0.6f, -3.6f}, 0.4f},
                              {{0.4f, -0.8f, -3.1f}, 0.2f},
                              {{0.2f, 0.55f, -4.3f}, 0.3f}};

// The first hit of a ray from the eye, whose direction has z = -1: the depth, and the normal.
float hit(Vec3 direction, Vec3& normal) {
  float nearest = std::numeric_limits<float>::infinity();
  if (direction.y < 0 && floor_y / direction.y < sky_m) {
    nearest = floor_y / direction.y;
    normal = {0, 1, 0};
  }
  for (const Sphere& sphere : spheres) {
    const float a = dot(direction, direction), b = dot(direction, sphere.centre);
    const float inside = b * b - a * (dot(sphere.centre, sphere.centre) - sphere.radius * sphere.radius);
    if (inside < 0) continue;
    const float t = (b - std::sqrt(inside)) / a;
    if (t <= 0 || t >= nearest) continue;
    nearest = t;
    normal = normalised(t * direction - sphere.centre);
  }
  return nearest;
}

template <class T>
void write(std::ofstream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: web_screen FOLDER\n", stderr);
    return 2;
  }
  const nnao::ScreenRays rays = nnao::screen_rays(projection, width, height);
  std::vector<float> depth(width * height), ao(depth.size()), texels(4 * depth.size());
  std::vector<Vec3> normal(depth.size());
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::size_t i = std::size_t(y) * width + x;
      normal[i] = {0, 0, 1};
      depth[i] = hit(view_position(rays, float(x) + 0.5f, float(y) + 0.5f, 1), normal[i]);
      texels[4 * i] = normal[i].x;
      texels[4 * i + 1] = normal[i].y;
      texels[4 * i + 2] = normal[i].z;
    }
  nnao::Sampling sampling;
  sampling.radius = radius_m;
  // The pass's defaults, as the number of taps is.
  sampling.max_radius_px = 0.25f * height;
  sampling.min_radius_px = 12;
  nnao::evaluate(nnao::read_network(nnao::default_network_file()), {width, height, rays, depth, normal},
                 sampling, ao);
  std::vector<std::uint8_t> bytes;
  for (const float value : ao) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
  const std::string folder = argv[1];
  std::ofstream text(folder + "/screen.json");
  text << nlohmann::json{
      {"width", width}, {"height", height}, {"radius", radius_m}, {"projection", projection}};
  std::ofstream file(folder + "/screen.bin", std::ios::binary);
  write(file, depth);
  write(file, texels);
  write(file, bytes);
  if (!text.flush() || !file.flush()) {
    std::fprintf(stderr, "web_screen: %s cannot be written\n", folder.c_str());
    return 3;
  }
  return 0;
}
