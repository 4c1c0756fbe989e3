// A stage that needs no file: a corner of a street, made of boxes and surfaces of revolution.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "samples/showcase/stage.h"

namespace showcase {
namespace {

const glm::vec3 plaster(0.62f, 0.53f, 0.41f), stone(0.47f, 0.45f, 0.42f), wood(0.33f, 0.19f, 0.10f),
    paint(0.10f, 0.22f, 0.24f), clay(0.50f, 0.23f, 0.14f), leaves(0.13f, 0.26f, 0.08f),
    iron(0.10f, 0.10f, 0.11f), asphalt(0.16f, 0.16f, 0.17f);

void add_quad(Mesh& mesh, const glm::vec3 (&corners)[4], const glm::vec3& normal, const glm::vec3& colour) {
  const auto first = std::uint32_t(mesh.positions_ws.size());
  for (const glm::vec3& corner : corners) {
    mesh.positions_ws.push_back(corner);
    mesh.normals_ws.push_back(normal);
    mesh.uvs.emplace_back(0);
    mesh.colours.push_back(colour);
  }
  for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.triangles.push_back(first + k);
}

void add_box(Mesh& mesh, const glm::vec3& low, const glm::vec3& high, const glm::vec3& colour) {
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      glm::vec3 corners[4], normal(0);
      for (int k = 0; k < 4; ++k) {
        corners[k][axis] = upper ? high[axis] : low[axis];
        corners[k][u] = k == 1 || k == 2 ? high[u] : low[u];
        corners[k][v] = k >= 2 ? high[v] : low[v];
      }
      normal[axis] = upper ? 1.0f : -1.0f;
      add_quad(mesh, corners, normal, colour);
    }
}

// A ring of a surface of revolution: its height and its radius.
struct Ring {
  float y_m, radius_m;
};

void add_turned(Mesh& mesh, const glm::vec3& foot, const std::vector<Ring>& rings, const glm::vec3& colour) {
  constexpr std::uint32_t sides = 32;
  const auto first = std::uint32_t(mesh.positions_ws.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring &before = rings[r == 0 ? 0 : r - 1], &after = rings[std::min(r + 1, rings.size() - 1)];
    const glm::vec2 outward =
        glm::normalize(glm::vec2(after.y_m - before.y_m, before.radius_m - after.radius_m));
    for (std::uint32_t s = 0; s <= sides; ++s) {
      const float turn = glm::two_pi<float>() * float(s) / float(sides);
      const glm::vec3 radial(std::cos(turn), 0, std::sin(turn));
      mesh.positions_ws.push_back(foot + rings[r].radius_m * radial + glm::vec3(0, rings[r].y_m, 0));
      mesh.normals_ws.push_back(glm::normalize(outward.x * radial + glm::vec3(0, outward.y, 0)));
      mesh.uvs.emplace_back(0);
      mesh.colours.push_back(colour);
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r)
    for (std::uint32_t s = 0; s < sides; ++s) {
      const std::uint32_t a = first + r * (sides + 1) + s, b = a + sides + 1;
      for (const std::uint32_t k : {a, b, a + 1, a + 1, b, b + 1}) mesh.triangles.push_back(k);
    }
}

void add_ball(Mesh& mesh, const glm::vec3& centre, float radius_m, const glm::vec3& colour) {
  std::vector<Ring> rings;
  for (int i = 0; i <= 16; ++i) {
    const float polar = glm::pi<float>() * float(i) / 16;
    rings.push_back({-radius_m * std::cos(polar), radius_m * std::sin(polar)});
  }
  add_turned(mesh, centre, rings, colour);
}

// Returns a number from 0 to 1 that looks random, for the colours of slabs.
float mixed(int x, int z) {
  const auto hash = std::uint32_t(x * 73856093) ^ std::uint32_t(z * 19349663);
  return float((hash * 2654435761u) >> 16) / 65536.0f;
}

// Slabs with open joints, whose upper sides are at y = 0.
Mesh pavement() {
  constexpr float slab_m = 0.6f, joint_m = 0.012f;
  Mesh mesh;
  for (int x = -12; x < 12; ++x)
    for (int z = -6; z < 4; ++z) {
      const glm::vec3 low(float(x) * slab_m, -0.1f, float(z) * slab_m - 0.6f);
      add_box(mesh, low, low + glm::vec3(slab_m - joint_m, 0.1f, slab_m - joint_m),
              stone * (0.86f + 0.28f * mixed(x, z)));
    }
  add_box(mesh, {-30, -0.12f, -30}, {30, -0.02f, 1.8f}, 0.5f * stone);
  add_box(mesh, {-30, -0.30f, 1.8f}, {30, 0, 1.98f}, 1.2f * stone);  // kerb
  add_box(mesh, {-30, -0.34f, 1.98f}, {30, -0.14f, 30}, asphalt);
  return mesh;
}

Mesh house() {
  Mesh mesh;
  const float face = -1.5f, back = -2.1f, top = 4.2f;
  add_box(mesh, {-8, 0, back}, {0.35f, top, face}, plaster);
  add_box(mesh, {1.45f, 0, back}, {8, top, face}, plaster);
  // Overlaps its neighbours. If an edge ended in the middle of another edge, there would be gaps.
  add_box(mesh, {0.30f, 2.25f, back}, {1.50f, top, face}, plaster);
  add_box(mesh, {0.35f, 0, back}, {1.45f, 2.25f, back + 0.22f}, paint);  // door
  for (const float x : {0.47f, 0.97f})
    for (const float y : {0.3f, 1.25f})
      add_box(mesh, {x, y, back + 0.22f}, {x + 0.36f, y + 0.75f, back + 0.255f}, paint);  // its panels
  add_box(mesh, {0.25f, 0, face}, {0.35f, 2.35f, face + 0.05f}, stone);                   // frame
  add_box(mesh, {1.45f, 0, face}, {1.55f, 2.35f, face + 0.05f}, stone);
  add_box(mesh, {0.25f, 2.25f, face}, {1.55f, 2.40f, face + 0.08f}, stone);
  add_box(mesh, {0.15f, 0, back}, {1.65f, 0.14f, face + 0.36f}, stone);      // step
  add_box(mesh, {-8, 0, face}, {0.15f, 0.35f, face + 0.05f}, 0.8f * stone);  // plinth
  add_box(mesh, {1.65f, 0, face}, {8, 0.35f, face + 0.05f}, 0.8f * stone);
  add_box(mesh, {-1.95f, 1.0f, face}, {-0.75f, 1.1f, face + 0.14f}, stone);  // window sill
  add_box(mesh, {-1.85f, 1.1f, face}, {-0.85f, 2.3f, face + 0.03f}, 0.5f * paint);
  for (const float x : {-1.87f, -1.37f, -0.87f})
    add_box(mesh, {x, 1.1f, face}, {x + 0.05f, 2.3f, face + 0.06f}, wood);
  for (const float y : {1.1f, 1.68f, 2.25f})
    add_box(mesh, {-1.87f, y, face}, {-0.82f, y + 0.05f, face + 0.06f}, wood);
  return mesh;
}

Mesh bench(float x, float z) {
  Mesh mesh;
  for (int k = 0; k < 3; ++k)
    add_box(mesh, {x - 0.75f, 0.41f, z + 0.15f * float(k)}, {x + 0.75f, 0.45f, z + 0.15f * float(k) + 0.13f},
            wood);
  for (int k = 0; k < 2; ++k)
    add_box(mesh, {x - 0.75f, 0.60f + 0.17f * float(k), z - 0.06f},
            {x + 0.75f, 0.73f + 0.17f * float(k), z - 0.02f}, wood);
  for (const float side : {-0.62f, 0.56f}) {
    add_box(mesh, {x + side, 0, z - 0.02f}, {x + side + 0.06f, 0.41f, z + 0.04f}, iron);
    add_box(mesh, {x + side, 0, z + 0.36f}, {x + side + 0.06f, 0.41f, z + 0.42f}, iron);
    add_box(mesh, {x + side, 0.41f, z - 0.08f}, {x + side + 0.06f, 0.92f, z - 0.06f}, iron);
  }
  return mesh;
}

Mesh pots() {
  Mesh mesh;
  const std::vector<Ring> pot = {{0, 0},         {0, 0.17f},     {0.30f, 0.24f}, {0.34f, 0.27f},
                                 {0.40f, 0.27f}, {0.40f, 0.23f}, {0.34f, 0.22f}, {0.34f, 0}};
  for (const glm::vec3& foot : {glm::vec3(2.05f, 0, -1.1f), glm::vec3(-0.35f, 0, -1.1f)}) {
    add_turned(mesh, foot, pot, clay);
    add_ball(mesh, foot + glm::vec3(0, 0.58f, 0), 0.27f, leaves);
    add_ball(mesh, foot + glm::vec3(0.1f, 0.85f, 0.04f), 0.19f, 1.2f * leaves);
  }
  for (const float x : {-2.9f, -1.25f, 2.75f})
    add_turned(mesh, {x, 0, 1.45f},
               {{0, 0.1f},
                {0.05f, 0.1f},
                {0.05f, 0.065f},
                {0.85f, 0.055f},
                {0.85f, 0.075f},
                {0.93f, 0.06f},
                {0.96f, 0}},
               iron);
  return mesh;
}

Actor actor(const std::filesystem::path& character, const std::filesystem::path& model, const char* clip,
            float time_s, const glm::vec3& place_ws, float yaw_degrees, const glm::vec3& shirt) {
  return {character, model, {}, clip, time_s, place_ws, glm::radians(yaw_degrees), shirt};
}

}  // namespace

Stage street_corner(const std::filesystem::path& character, const std::filesystem::path& model) {
  Stage stage;
  stage.props = {pavement(), house(), bench(-1.75f, -0.95f), pots()};
  stage.walls = {{{-8, 0, -2.1f}, {8, 4.2f, -1.5f}}};
  stage.actors = {actor(character, model, "Walk", 0.2f, {0.75f, 0, 0.35f}, 60, {0.58f, 0.25f, 0.17f}),
                  actor(character, model, "Wave", 0.5f, {-0.5f, 0, 0.05f}, 20, {0.36f, 0.47f, 0.33f}),
                  actor(character, model, "Crouch", 0.3f, {1.75f, 0, -0.35f}, -30, {0.64f, 0.55f, 0.40f}),
                  actor(character, model, "Sit", 0.5f, {-1.8f, 0, -0.72f}, 15, {0.20f, 0.30f, 0.45f})};
  stage.shots = {{"whole", {{-0.6f, 1.6f, 6.0f}, {0.05f, 0.92f, -0.4f}, glm::radians(29.0f)}},
                 {"feet", {{-0.2f, 0.9f, 3.4f}, {0.75f, 0.15f, 0.35f}, glm::radians(16.0f)}},
                 {"hands", {{0.9f, 1.3f, 3.4f}, {1.75f, 0.75f, -0.1f}, glm::radians(13.0f)}}};
  stage.probe_ws = {0, 1, 0.3f};
  stage.sky.zenith = {0.34f, 0.52f, 0.95f};
  stage.sky.horizon = {0.92f, 0.95f, 1.0f};
  stage.sky.ground = {0.30f, 0.27f, 0.23f};
  stage.sky.glow = 1.2f;
  stage.sky.to_sun = glm::normalize(glm::vec3(-0.75f, 0.62f, 0.45f));
  stage.sky.sun = {4.2f, 3.6f, 2.8f};
  stage.radius_m = 0.6f;
  stage.exposure = 0.65f;
  return stage;
}

}  // namespace showcase
