// Meshes of less detail: what resampled and refitted vertices give against ray tracing and closed forms.
#include <cmath>

#include "bakers/character/character_bake.h"
#include "bakers/character/export_model.h"
#include "bakers/character/vertex_fits.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/lod_error.h"
#include "sdk/src/character/host_vertices.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;

namespace {

// A draft of the tube with bind data of its own space.
CharacterModel baked_tube(const SkinnedMesh& mesh) {
  BakeSettings settings;
  settings.spheres = 8;
  settings.key_points = 24;
  settings.rays = 64;
  settings.steps = 200;
  CharacterModel model = bake_character(mesh, tube_poses(mesh, 24), settings).model;
  ImportedCharacter character;
  character.mesh = mesh;
  character.rest_from_primitive.resize(1);
  model.bind = bind_data_of(character);
  model.rest = rest_surface_of(mesh);
  return model;
}

HostVertices host_of(const std::vector<Vec3>& position, const std::vector<Vec3>& normal) {
  HostVertices host;
  host.count = std::uint32_t(position.size());
  host.position = {&position[0].x, sizeof(Vec3)};
  host.normal = {&normal[0].x, sizeof(Vec3)};
  host.in_rest_space = true;
  return host;
}

}  // namespace

TEST_CASE("a mesh resampled at its own vertices keeps its AO, and between vertices AO is interpolated") {
  const SkinnedMesh mesh = bending_tube();
  const CharacterModel model = baked_tube(mesh);
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  const Pose pose = tube_poses(mesh, 3)[2];
  const std::vector<float> ao = predict_ao(model, pose);

  const CharacterModel same = resampled(model, host_of(mesh.position, normal), default_memory());
  const std::vector<float> ao_same = predict_ao(same, pose);
  // The baked vertex at the place has all of the weight but for a millionth.
  for (std::size_t i = 0; i < ao.size(); ++i) CHECK(std::abs(ao_same[i] - ao[i]) < 1e-5f);

  std::vector<Vec3> middle, middle_normal;
  for (const auto& t : mesh.triangle) {
    middle.push_back((mesh.position[t[0]] + mesh.position[t[1]] + mesh.position[t[2]]) * (1 / 3.0f));
    middle_normal.push_back(normalised(normal[t[0]] + normal[t[1]] + normal[t[2]]));
  }
  const std::vector<float> ao_middle =
      predict_ao(resampled(model, host_of(middle, middle_normal), default_memory()), pose);
  // The three nearest vertices need not be the triangle's corners; a step of the tube's rings bounds the
  // difference, and the mean over all triangles is far below it.
  double sum = 0;
  for (std::size_t t = 0; t < middle.size(); ++t) {
    const auto& c = mesh.triangle[t];
    sum += std::abs(double(ao_middle[t]) - double(ao[c[0]] + ao[c[1]] + ao[c[2]]) / 3);
  }
  CHECK(sum / double(middle.size()) < 0.02);
}

TEST_CASE("vertices refitted to a coarser mesh have a smaller error than vertices resampled by position") {
  const SkinnedMesh mesh = bending_tube(36, 16);
  const CharacterModel model = baked_tube(mesh);
  const LodMesh lod = simplified(mesh, 0.25);
  CHECK(lod.mesh.triangle.size() <= mesh.triangle.size() / 3);
  const std::vector<Pose> training = tube_poses(mesh, 16);
  // Between the angles of the training poses.
  std::vector<Pose> measured = tube_poses(mesh, 11);
  const LodRow row = measure_lod(lod, model, training, {128, 3}, measured, 256, 7);
  CHECK(row.vertices == lod.mesh.vertex_count());
  CHECK(row.refitted.model.mse < row.nearest.model.mse);
  CHECK(row.refitted.model.mse < row.refitted.oracle.mse);
}

TEST_CASE("a refit keeps what does not depend on vertices, and gives the same bits again") {
  const SkinnedMesh mesh = bending_tube();
  const CharacterModel model = baked_tube(mesh);
  const LodMesh lod = simplified(mesh, 0.5);
  const std::vector<Pose> poses = tube_poses(mesh, 8);
  const CharacterModel a = refit_vertices(model, lod.mesh, poses, {32, 5});
  const CharacterModel b = refit_vertices(model, lod.mesh, poses, {32, 5});
  CHECK(a.alpha == b.alpha);
  CHECK(a.bias == b.bias);
  CHECK(a.vertex_count() == lod.mesh.vertex_count());
  REQUIRE(a.spheres.size() == model.spheres.size());
  for (std::size_t s = 0; s < a.spheres.size(); ++s)
    CHECK(a.spheres[s].caster_weight == model.spheres[s].caster_weight);
  CHECK(a.levels.size() == model.levels.size());
  CHECK_THROWS(
      refit_vertices(model, lod.mesh, poses, {32, 5}, [](std::size_t, std::size_t) { return false; }));
}
