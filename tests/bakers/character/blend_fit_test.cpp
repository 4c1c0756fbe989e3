// Blend weights on a bending tube, in poses that their fit has not seen.
#include "bakers/character/blend_weights.h"

#include <cmath>

#include "bakers/character/character_bake.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/kernel.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

struct Tube {
  SkinnedMesh mesh = bending_tube();
  CharacterModel model;

  Tube() {
    BakeSettings settings;
    settings.spheres = 16;
    settings.key_points = 60;
    settings.rays = 32;
    settings.steps = 100;
    model = bake_character(mesh, tube_poses(mesh, 60), settings).model;
  }
};

Vec3 posed_normal(const KeyPoint& point, const Pose& pose) {
  Vec3 normal;
  for (int b = 0; b < KeyPoint::max_bones; ++b)
    normal += transform_vector(pose[point.bone[b]], point.surface_normal) * point.weight[b];
  return normalised(normal);
}

// Mean square of the difference between what a plane below takes from a vertex, (1 - cos) / 2, and what is
// blended for it.
double plane_error(const Tube& tube, const nook::Vector<float>& weight, const Pose& pose) {
  const CharacterModel& model = tube.model;
  std::vector<Vec3> position, normal;
  skin_positions(tube.mesh, pose, position);
  vertex_normals(tube.mesh.triangle, position, normal);
  double sum = 0;
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    double blended = 0;
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e)
      blended +=
          double(weight[e]) * 0.5 * (1 - double(posed_normal(model.key_points[model.influence[e]], pose).y));
    const double error = blended - 0.5 * (1 - double(normal[i].y));
    sum += error * error;
  }
  return sum / double(model.vertex_count());
}

// The same for spheres near the tube: mean square of the difference of shares, in units of the share of a
// surface that faces the sphere.
double sphere_error(const Tube& tube, const nook::Vector<float>& weight, const Pose& pose) {
  const CharacterModel& model = tube.model;
  std::vector<Vec3> position, normal;
  skin_positions(tube.mesh, pose, position);
  vertex_normals(tube.mesh.triangle, position, normal);
  constexpr float radius = 0.1f;
  const auto share = [&](Vec3 centre, Vec3 at, Vec3 facing) {
    const Vec3 d = (centre - at) * (1 / radius);
    return double(form_factor_exact(dot(d, facing), dot(d, d)));
  };
  double sum = 0;
  for (std::size_t i = 0; i < model.vertex_count(); ++i)
    for (int s = 0; s < 8; ++s) {
      const float turn = 0.785398f * float(s), distance = 0.2f + 0.1f * float(s % 4);
      const Vec3 centre = position[i] + distance * Vec3{0.6f, 0.8f * std::cos(turn), 0.8f * std::sin(turn)};
      double blended = 0;
      for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) {
        const KeyPoint& point = model.key_points[model.influence[e]];
        Vec3 at;
        for (int b = 0; b < KeyPoint::max_bones; ++b)
          at += transform_point(pose[point.bone[b]], point.surface_position) * point.weight[b];
        blended += double(weight[e]) * share(centre, at, posed_normal(point, pose));
      }
      const double error = (blended - share(centre, position[i], normal[i])) * std::pow(distance / radius, 2);
      sum += error * error;
    }
  return sum / double(8 * model.vertex_count());
}

}  // namespace

TEST_CASE("blend weights sum to one exactly and belong to entries in use") {
  const Tube tube;
  const CharacterModel& model = tube.model;
  REQUIRE(model.blend.size() == model.alpha.size());
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    float sum = 0;
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) {
      if (model.alpha[e] == 0) CHECK(model.blend[e] == 0);
      sum += model.blend[e];
    }
    CHECK(sum == 1.0f);  // whole sixteenths
  }
}

TEST_CASE("the darkening by a plane and by near spheres is blended better than by the shares of alpha") {
  const Tube tube;
  const CharacterModel& model = tube.model;
  nook::Vector<float> share(model.alpha);
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    float sum = 0;
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) sum += model.alpha[e];
    for (std::size_t e = i * model.influences; e < (i + 1) * model.influences; ++e) share[e] /= sum;
  }
  for (const float angle : {0.35f, 1.1f, 1.7f}) {
    const JointRotation joint{1, {0, angle * 0.8f, angle * 0.6f}};
    const Pose pose = turn_joints(tube.mesh, {&joint, 1});
    const double fitted = plane_error(tube, model.blend, pose), by_alpha = plane_error(tube, share, pose);
    INFO("angle " << angle << " fitted " << fitted << " by alpha " << by_alpha);
    // The fit of self-shadow chooses the entries of a vertex. With these, the share is 0.33 to 0.37.
    CHECK(fitted < 0.4 * by_alpha);
    const double near = sphere_error(tube, model.blend, pose),
                 near_by_alpha = sphere_error(tube, share, pose);
    INFO("spheres " << near << " by alpha " << near_by_alpha);
    CHECK(near < 0.5 * near_by_alpha);
    // A sixteenth's rounding is made up by the other entries; 60 key points, most of them at the bend, leave
    // a few hundredths.
    CHECK(std::sqrt(fitted) < 0.08);
  }
}
