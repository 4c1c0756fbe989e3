#include "samples/showcase/light.h"

#include <nook/experimental/nook_sg.h>
#include <nook/experimental/nook_trace.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace showcase {
namespace {

// Larger than the rounding errors of positions in floats, and too small to be visible in a picture.
constexpr float ray_offset_m = 2e-3f;

struct Map {
  std::uint32_t width, height;
  std::vector<glm::vec3> rgb;
  nook_bake_environment environment() const { return {glm::value_ptr(rgb[0]), width, height}; }
};

glm::vec3 direction_of(const Map& map, float x, float y) {
  const float polar = glm::pi<float>() * y / float(map.height),
              azimuth = glm::two_pi<float>() * (x / float(map.width) - 0.5f);
  return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

template <class Radiance>
Map map_of(std::uint32_t height, Radiance radiance) {
  Map map{2 * height, height, {}};
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x)
      map.rgb.push_back(radiance(direction_of(map, float(x) + 0.5f, float(y) + 0.5f)));
  return map;
}

float texel_solid_angle(const Map& map, std::uint32_t y) {
  const float top = std::cos(glm::pi<float>() * float(y) / float(map.height)),
              bottom = std::cos(glm::pi<float>() * float(y + 1) / float(map.height));
  return glm::two_pi<float>() / float(map.width) * (top - bottom);
}

// A disc that causes the stage's irradiance on a surface that faces it.
Map sun_map(const Sky& sky) {
  const float edge = std::cos(glm::radians(0.5f * sky.sun_degrees));
  Map map = map_of(
      1024, [&](const glm::vec3& d) { return glm::dot(d, sky.to_sun) > edge ? sky.sun : glm::vec3(0); });
  float share = 0;
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x)
      if (map.rgb[std::size_t(y) * map.width + x] != glm::vec3(0)) share += texel_solid_angle(map, y);
  for (glm::vec3& texel : map.rgb) texel /= std::max(share, 1e-9f);
  return map;
}

// Irradiance of open surfaces by their normals, in the layout of a map.
class OpenIrradiance {
 public:
  explicit OpenIrradiance(const Map& light) : table_{64, 32, {}} {
    for (std::uint32_t y = 0; y < table_.height; ++y)
      for (std::uint32_t x = 0; x < table_.width; ++x)
        table_.rgb.push_back(sum(light, direction_of(table_, float(x) + 0.5f, float(y) + 0.5f)));
  }

  glm::vec3 at(const glm::vec3& n) const {
    const float y = std::acos(std::clamp(n.y, -1.0f, 1.0f)) / glm::pi<float>() * float(table_.height) - 0.5f,
                x = (std::atan2(n.z, n.x) / glm::two_pi<float>() + 0.5f) * float(table_.width) - 0.5f;
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const int left = int(std::floor(x)), top = int(std::floor(y));
    return glm::mix(glm::mix(texel(left, top), texel(left + 1, top), fx),
                    glm::mix(texel(left, top + 1), texel(left + 1, top + 1), fx), fy);
  }

 private:
  static glm::vec3 sum(const Map& light, const glm::vec3& n) {
    glm::vec3 total(0);
    for (std::uint32_t y = 0; y < light.height; ++y) {
      const float solid_angle = texel_solid_angle(light, y);
      for (std::uint32_t x = 0; x < light.width; ++x)
        total += solid_angle *
                 std::max(glm::dot(n, direction_of(light, float(x) + 0.5f, float(y) + 0.5f)), 0.0f) *
                 light.rgb[std::size_t(y) * light.width + x];
    }
    return total;
  }
  const glm::vec3& texel(int x, int y) const {
    const int w = int(table_.width), h = int(table_.height);
    return table_.rgb[std::size_t(std::clamp(y, 0, h - 1) * w + (x % w + w) % w)];
  }

  Map table_;
};

nook_bake_lit_mesh black(const Mesh& mesh) {
  return {glm::value_ptr(mesh.positions_ws[0]),
          mesh.triangles.data(),
          std::uint32_t(mesh.positions_ws.size()),
          std::uint32_t(mesh.triangles.size()),
          {0, 0, 0},
          {0, 0, 0}};
}

std::vector<glm::vec3> trace(const std::vector<nook_bake_lit_mesh>& meshes,
                             const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals,
                             const Map& light, std::uint32_t rays) {
  std::vector<glm::vec3> irradiance(positions.size(), glm::vec3(0));
  if (positions.empty()) return irradiance;
  nook_bake_irradiance_desc desc;
  nook::bake::check(nook_bake_irradiance_desc_init(&desc));
  desc.meshes = meshes.data();
  desc.mesh_count = std::uint32_t(meshes.size());
  desc.positions = glm::value_ptr(positions[0]);
  desc.normals = glm::value_ptr(normals[0]);
  desc.point_count = std::uint32_t(positions.size());
  desc.environment = light.environment();
  desc.rays = rays;
  desc.max_bounces = 0;
  desc.origin_offset = ray_offset_m;
  nook::bake::check(nook_bake_trace_irradiance(&desc, glm::value_ptr(irradiance[0]), desc.point_count));
  return irradiance;
}

// The irradiance of the lobes on open surfaces.
std::vector<glm::vec3> lobe_irradiance(const std::vector<nook_lobe>& lobes,
                                       const std::vector<glm::vec3>& normals) {
  std::vector<glm::vec3> irradiance(normals.size(), glm::vec3(0));
  constexpr std::size_t block = 4096;
  tbb::parallel_for(std::size_t(0), (normals.size() + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, count = std::min(block, normals.size() - first);
    nook::check(nook_sg_irradiance(lobes.data(), std::uint32_t(lobes.size()), NOOK_PROBE_IRRADIANCE_BANDS,
                                   glm::value_ptr(normals[first]), glm::value_ptr(irradiance[first]), count));
  });
  for (glm::vec3& value : irradiance) value = glm::max(value, glm::vec3(0));
  return irradiance;
}

// The pixels that show the props, or one actor.
std::vector<std::size_t> pixels_of(const Surfaces& surfaces, Kind kind, std::size_t actor) {
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < surfaces.pixels.size(); ++i)
    if (surfaces.pixels[i].kind == kind && (kind != Kind::actor || surfaces.pixels[i].actor == actor))
      pixels.push_back(i);
  return pixels;
}

void light_by_lobes(const Surfaces& surfaces, const std::vector<std::size_t>& pixels,
                    const std::vector<nook_lobe>& lobes, Irradiance& out) {
  std::vector<glm::vec3> normals;
  for (const std::size_t i : pixels) normals.push_back(surfaces.pixels[i].normal_ws);
  const std::vector<glm::vec3> open = lobe_irradiance(lobes, normals);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const Pixel& pixel = surfaces.pixels[pixels[k]];
    out.off[pixels[k]] = open[k];
    // The shader of an engine does the same with Nook's values.
    out.nook[pixels[k]] = open[k] * (pixel.kind == Kind::actor ? pixel.directional_ao : pixel.screen_open);
  }
}

// One pass of an edge-avoiding average (Dammertz et al. 2010) over samples that lie on one surface: a 5 x 5
// kernel whose taps are `step` samples apart.
std::vector<glm::vec3> averaged_on_surfaces(const Surfaces& surfaces, const std::vector<glm::vec3>& values,
                                            int step) {
  constexpr float kernel[5] = {1 / 16.0f, 4 / 16.0f, 6 / 16.0f, 4 / 16.0f, 1 / 16.0f};
  std::vector<glm::vec3> out(values.size());
  const int width = surfaces.width_px, height = surfaces.height_px;
  tbb::parallel_for(0, height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      const Pixel& pixel = surfaces.pixels[std::size_t(row * width + column)];
      if (pixel.kind == Kind::sky) continue;
      glm::vec3 sum(0);
      float weights = 0;
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
          const int at_x = std::clamp(column + x * step, 0, width - 1),
                    at_y = std::clamp(row + y * step, 0, height - 1);
          const auto i = std::size_t(at_y * width + at_x);
          const Pixel& other = surfaces.pixels[i];
          // Uses samples whose normals are similar to this one's and which lie near its plane.
          const glm::vec3 between = other.position_ws - pixel.position_ws;
          const float off_plane = std::abs(glm::dot(between, pixel.normal_ws)),
                      alike = glm::dot(other.normal_ws, pixel.normal_ws);
          if (other.kind != pixel.kind || alike < 0.9f || off_plane > 0.2f * glm::length(between)) continue;
          const float weight = kernel[x + 2] * kernel[y + 2];
          sum += weight * values[i];
          weights += weight;
        }
      out[std::size_t(row * width + column)] = sum / weights;
    }
  });
  return out;
}

glm::vec3 filmic(const glm::vec3& x) {  // K. Narkowicz's fit of ACES
  return glm::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

glm::vec3 srgb(const glm::vec3& linear) {
  const auto encode = [](float v) {
    return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  };
  return {encode(linear.r), encode(linear.g), encode(linear.b)};
}

}  // namespace

Irradiance light_surfaces(const Stage& stage, const Cast& cast, const Surfaces& surfaces, const Rays& rays) {
  const std::size_t count = surfaces.pixels.size();
  const std::vector<glm::vec3> dark(count, glm::vec3(0));
  Irradiance out{dark, dark, dark, dark};
  light_by_lobes(surfaces, pixels_of(surfaces, Kind::prop, 0), stage_lobes(cast.context(), stage), out);
  for (std::size_t a = 0; a < cast.actors().size(); ++a)
    light_by_lobes(surfaces, pixels_of(surfaces, Kind::actor, a), cast.lobes()[a], out);

  std::vector<nook_bake_lit_mesh> meshes;
  for (const Mesh& prop : stage.props) meshes.push_back(black(prop));
  for (const PosedActor& actor : cast.actors()) meshes.push_back(black(actor.mesh));
  std::vector<glm::vec3> positions, normals;
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < count; ++i) {
    if (surfaces.pixels[i].kind == Kind::sky) continue;
    pixels.push_back(i);
    positions.push_back(surfaces.pixels[i].position_ws);
    normals.push_back(surfaces.pixels[i].normal_ws);
  }
  const Map sky = map_of(32, [&](const glm::vec3& d) { return sky_radiance(stage.sky, d); });
  const OpenIrradiance open(sky);
  const std::vector<glm::vec3> sun = trace(meshes, positions, normals, sun_map(stage.sky), rays.sun),
                               occluded = trace(meshes, positions, normals, sky, rays.sky),
                               unoccluded = trace({}, positions, normals, sky, rays.sky);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    out.sun[pixels[k]] = sun[k];
    // The same rays without surfaces have most of the noise in common, which cancels in the ratio (Heitz et
    // al. 2018, Combining Analytic Direct Illumination and Stochastic Shadows).
    out.ray_traced[pixels[k]] = occluded[k] / glm::max(unoccluded[k], glm::vec3(1e-6f));
  }
  out.sun = averaged_on_surfaces(surfaces, out.sun, 1);
  for (const int step : {1, 2, 4}) out.ray_traced = averaged_on_surfaces(surfaces, out.ray_traced, step);
  for (std::size_t k = 0; k < pixels.size(); ++k) out.ray_traced[pixels[k]] *= open.at(normals[k]);
  return out;
}

std::vector<glm::vec3> developed(const Stage& stage, const Surfaces& surfaces,
                                 const std::vector<glm::vec3>& sun, const std::vector<glm::vec3>& sky) {
  std::vector<glm::vec3> picture(surfaces.pixels.size());
  tbb::parallel_for(std::size_t(0), std::size_t(surfaces.height_px), [&](std::size_t row) {
    for (std::size_t i = row * std::size_t(surfaces.width_px); i < (row + 1) * std::size_t(surfaces.width_px);
         ++i) {
      const Pixel& pixel = surfaces.pixels[i];
      const glm::vec3 radiance = pixel.kind == Kind::sky
                                     ? sky_radiance(stage.sky, pixel.normal_ws)
                                     : pixel.albedo * (sun[i] + sky[i]) / glm::pi<float>();
      picture[i] = srgb(filmic(stage.exposure * radiance));
    }
  });
  return picture;
}

}  // namespace showcase
