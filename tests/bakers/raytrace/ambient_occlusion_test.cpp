// The ray tracer against closed forms: it is the ground truth of everything else.
#include "bakers/raytrace/ambient_occlusion.h"

#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "bakers/raytrace/stand_ins.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/bakers/raytrace/sphere_soup.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

float ao_of(const TriangleSoup& soup, Vec3 position, Vec3 normal, AoSettings settings) {
  return trace_ao(soup, {{&position, 1}, {&normal, 1}}, settings)[0];
}

}  // namespace

TEST_CASE("a sphere above a surface darkens it by cos(theta) r^2 / d^2") {
  const float radius = 0.5f;
  AoSettings settings;
  settings.rays = 16384;
  for (float tilt : {0.0f, 0.5f, 0.9f}) {
    const float distance = 2;
    const Vec3 direction{std::sin(tilt), std::cos(tilt), 0};
    const TriangleSoup soup = sphere_soup(distance * direction, radius, 64);
    const float expected = 1 - std::cos(tilt) * radius * radius / (distance * distance);
    // 16,384 stratified rays: standard error near 1e-3; the facets cover 0.1 % less than the sphere.
    CHECK(std::abs(ao_of(soup, {0, 0, 0}, {0, 1, 0}, settings) - expected) < 4e-3f);
  }
}

TEST_CASE("half-spaces and empty skies are exact") {
  TriangleSoup wall;
  wall.position = {{0, -1000, -1000}, {0, 1000, -1000}, {0, 1000, 1000}, {0, -1000, 1000}};
  wall.triangle = {{0, 1, 2}, {0, 2, 3}};
  AoSettings settings;
  settings.rays = 4096;
  // A wall close beside a surface hides half of its hemisphere, whichever side its triangles face.
  CHECK(std::abs(ao_of(wall, {0.01f, 0, 0}, {0, 1, 0}, settings) - 0.5f) <
        0.01f);  // standard error 4e-3 unstratified
  CHECK(std::abs(ao_of(wall, {-0.01f, 0, 0}, {0, 1, 0}, settings) - 0.5f) < 0.01f);
  CHECK(ao_of(wall, {1, 0, 0}, {1, 0, 0}, settings) == 1.0f);
  CHECK(ao_of(wall, {1, 0, 0}, {-1, 0, 0}, settings) < 2e-3f);  // rays past the edge 1,000 m away
  settings.radius = 0.5f;
  CHECK(ao_of(wall, {1, 0, 0}, {-1, 0, 0}, settings) == 1.0f);
}

TEST_CASE("stratified directions are cosine-weighted") {
  const HemispherePatterns patterns(64, 3);
  double mean_z = 0, mean_x = 0, mean_z2 = 0;
  const double count = 64.0 * HemispherePatterns::pattern_count;
  for (std::uint32_t p = 0; p < HemispherePatterns::pattern_count; ++p)
    for (std::uint32_t i = 0; i < 64; ++i) {
      const Vec3 d = patterns.pattern(p)[i];
      CHECK(std::abs(length(d) - 1) < 1e-5f);
      mean_z += double(d.z) / count;
      mean_x += double(d.x) / count;
      mean_z2 += double(d.z) * double(d.z) / count;
    }
  // For a density of cos / pi: E[z] = 2/3, E[z^2] = 1/2. 16,384 stratified samples: errors far below 2e-3.
  CHECK(std::abs(mean_z - 2.0 / 3) < 2e-3);
  CHECK(std::abs(mean_z2 - 0.5) < 2e-3);
  CHECK(std::abs(mean_x) < 4e-3);
}

TEST_CASE("targets of a character do not depend on threads, and their noise is what is stated") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 12);
  AoTargets one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = trace_character_ao(mesh, poses, 64, 9);
  }
  const AoTargets many = trace_character_ao(mesh, poses, 64, 9);
  CHECK(one.value == many.value);
  CHECK(measure_noise_floor(mesh, poses, many, 64, 9) < 5e-4);  // 2.7e-4 is usual for 64 stratified rays
  const AoTargets fine = trace_character_ao(mesh, poses, 1024, 10);
  double square = 0;
  for (std::size_t i = 0; i < fine.value.size(); ++i) {
    const double d = (double(fine.value[i]) - double(many.value[i])) * double(AoTargets::scale);
    square += d * d / double(fine.value.size());
  }
  // The error against nearly exact values is the stated floor, within the scatter of 3,500 samples.
  CHECK(square < 1.5 * measure_noise_floor(mesh, poses, many, 64, 9) + 2e-5);
}

namespace {

void add_part(SkinnedMesh& mesh, const TriangleSoup& part) {
  const auto first = std::uint32_t(mesh.position.size());
  mesh.position.insert(mesh.position.end(), part.position.begin(), part.position.end());
  for (const auto& t : part.triangle) mesh.triangle.push_back({first + t[0], first + t[1], first + t[2]});
}

// A rod of four sides without caps along x. All its vertices are at its ends.
TriangleSoup rod(float from, float to, float half_width) {
  TriangleSoup soup;
  for (const float x : {from, to})
    for (const auto& [y, z] : {std::pair{1.0f, 1.0f}, {-1.0f, 1.0f}, {-1.0f, -1.0f}, {1.0f, -1.0f}})
      soup.position.push_back({x, half_width * y, half_width * z});
  for (std::uint32_t s = 0; s < 4; ++s) {
    const std::uint32_t next = (s + 1) % 4;
    soup.triangle.push_back({s, next, 4 + s});
    soup.triangle.push_back({next, 4 + next, 4 + s});
  }
  return soup;
}

}  // namespace

TEST_CASE(
    "a hidden vertex takes the AO of the visible parts of its triangles, and a buried one stays black") {
  SkinnedMesh mesh;
  mesh.bones.resize(1);
  add_part(mesh, rod(0, 2, 0.05f));
  add_part(mesh, sphere_soup({0, 0, 0}, 0.2f, 16));
  add_part(mesh, sphere_soup({2, 0, 0}, 0.2f, 16));
  const std::size_t buried = mesh.position.size();
  add_part(mesh, sphere_soup({2, 0, 0}, 0.1f, 8));  // inside the second sphere
  SkinWeights weights;
  weights.weight[0] = 1;
  mesh.weights.assign(mesh.position.size(), weights);
  const std::vector<Pose> poses(1, Pose(1));
  const StandIns stand_ins = choose_stand_ins(mesh, poses, 5);
  const AoTargets own = trace_character_ao(mesh, poses, 256, 5);
  const AoTargets shown = trace_character_ao(mesh, poses, 256, 5, {}, stand_ins);

  // Along the rod, the spheres darken its sides by 0 to 0.04 at the points that stand in.
  const Vec3 middle{1, 0.05f, 0.05f};
  AoSettings settings;
  settings.rays = 1024;
  settings.origin_offset = 1e-4f;
  const float truth = ao_of({mesh.position, mesh.triangle}, middle, normalised(Vec3{0, 1, 1}), settings);
  CHECK(truth > 0.9f);
  for (std::size_t v = 0; v < 8; ++v) {
    CHECK(own.value[v] == 0);
    CHECK(stand_ins.of(v).size() > 0);
    CHECK(stand_ins.of(v).size() <= 4);
    CHECK(std::abs(float(shown.value[v]) * AoTargets::scale - truth) < 0.06f);
  }
  for (std::size_t v = 8; v < mesh.vertex_count(); ++v) {
    if (v >= buried) CHECK(shown.value[v] == 0);
    if (own.value[v] > 0.01 * 65535) CHECK(shown.value[v] == own.value[v]);
  }

  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(trace_character_ao(mesh, poses, 256, 5, {}, choose_stand_ins(mesh, poses, 5)).value == shown.value);

  std::size_t calls = 0;
  const StandIns told = choose_stand_ins(mesh, poses, 5, [&](std::size_t done, std::size_t total) {
    ++calls;
    return done == 0 && total == poses.size();
  });
  CHECK(calls > 1);
  CHECK(told.first == stand_ins.first);
  CHECK_THROWS_AS(choose_stand_ins(mesh, poses, 5, [](std::size_t, std::size_t) { return false; }), Failure);
}

TEST_CASE("progress can cancel") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 12);
  CHECK_THROWS(
      trace_character_ao(mesh, poses, 16, 9, [](std::size_t done, std::size_t) { return done < 3; }));
}
