// What the showcase draws: props that stand still, characters in their poses, a camera, a sky and a sun.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "samples/crowd/camera.h"

namespace showcase {

// Eight bits of sRGB for each channel. Rows run from top to bottom, as in glTF.
struct Texture {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;
};

inline constexpr int no_texture = -1;

// Holds triangles in world space and metres. A mesh has one texture or none; colours belong to vertices.
struct Mesh {
  std::vector<glm::vec3> positions_ws, normals_ws;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> colours;  // linear; multiplied by the texture
  std::vector<std::uint32_t> triangles;
  int texture = no_texture;
};

// A box that acts as a wall for the probes: light from behind the box does not reach them.
struct Wall {
  glm::vec3 low_ws, high_ws;
};

struct Actor {
  std::filesystem::path character, model;  // a .glb file, and what `nook bake character` made from it
  std::vector<std::string> without;        // meshes that the bake left out
  std::string clip;
  float time_s = 0;
  glm::vec3 place_ws{0};
  float yaw_rad = 0;
  glm::vec3 shirt{0.6f};  // for the built-in character, which has no texture
};

// A sky that is bluer towards the top and brighter on the sun's side, with ground below the horizon.
struct Sky {
  glm::vec3 zenith, horizon, ground;
  float glow = 0;  // added radiance around the sun, a wide lobe
  glm::vec3 to_sun{0, 1, 0};
  float sun_degrees = 2;  // full angle
  glm::vec3 sun;          // irradiance of a surface that faces the sun
};

struct Stage {
  std::vector<Mesh> props;
  std::vector<Texture> textures;
  std::vector<Wall> walls;
  std::vector<Actor> actors;
  std::map<std::string, crowd::Camera> shots;
  crowd::Camera camera;   // one of the shots
  glm::vec3 probe_ws{0};  // the place of the probe that lights the props
  Sky sky;
  float radius_m = 1;  // of the screen-space pass
  float exposure = 1;
};

// Reads a stage from a JSON file. Paths of props and characters are relative to `assets`, and models to
// `models`. Throws std::runtime_error with a text that names the file.
Stage read_stage(const std::filesystem::path& file, const std::filesystem::path& assets,
                 const std::filesystem::path& models);

// Makes a street corner. It needs no files except the built-in character and its model.
Stage street_corner(const std::filesystem::path& character, const std::filesystem::path& model);

}  // namespace showcase
