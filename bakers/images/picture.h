// Draws a body with ray casting, coloured by a value at each vertex, for example the error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "bakers/probe/map_light.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// 8-bit RGB. The first row is the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

using Colour = std::array<float, 3>;  // display values in [0, 1]

Colour grey(float value);     // black at 0, white at 1
Colour viridis(float value);  // perceptually uniform from dark violet (0) to yellow (1)

enum class BodySide { front, back };  // seen from +z (front) or from -z (back), +y up

// An orthographic view of a body. +y is up in the picture. If the view is along y, -z is up.
struct BodyCamera {
  Vec3 centre_ws;  // the point in the middle of the picture
  Vec3 towards;    // view direction, unit length
  float metres_per_pixel = 1;
};

// Stores the triangle that is visible at each sample of an orthographic picture. The constructor casts the
// rays. You can then draw the view several times, with different values.
class BodyView {
 public:
  // The body fills the picture except for a margin. The front and back views of a body have the same scale.
  BodyView(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> positions_ws,
           BodySide side, int width, int height);

  BodyView(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> positions_ws,
           const BodyCamera& camera, int width, int height);

  // Interpolates the vertices' values and converts them to colours. `relief` (0 to 1) sets how much surfaces
  // darken at grazing angles.
  Picture draw(std::span<const float> vertex_value, Colour (*colour)(float), float relief = 0) const;

 private:
  static constexpr int samples = 3;  // samples per side of a pixel

  struct Hit {
    std::uint32_t triangle;
    float u, v;
    float cosine;  // cosine of the angle between the view direction and the face's normal
  };
  static constexpr std::uint32_t nothing = ~0u;

  void cast(std::span<const Vec3> positions_ws, const BodyCamera& camera);

  int width_, height_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Hit> hits_;  // samples^2 for each pixel
};

Picture side_by_side(std::span<const Picture> pictures);

// Returns the bytes of a .png file. Throws Failure(INTERNAL) with the reason.
std::vector<std::byte> png_bytes(const Picture& picture);

// Throws std::runtime_error with the reason if the file cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace nook::bake

namespace nook::bake::probe {

// Compares a map with a probe that was fitted to it.

// Draws four latitude-longitude panels in a row. Each panel is panel_width wide and half as high:
//   1. the map;
//   2. the probe's radiance;
//   3. its irradiance over pi, which is how a white surface would look;
//   4. the luminance of its radiance error, e / (e + the map's mean luminance), from violet (0) over green to
//      yellow (large).
// The first three panels have the same exposure, which depends on the map's mean luminance.
Picture map_picture(const Environment& map, const Basis& basis, std::span<const Vec3> coefficients,
                    std::uint32_t panel_width = 512);

}  // namespace nook::bake::probe
