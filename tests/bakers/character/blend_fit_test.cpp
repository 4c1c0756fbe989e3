// Blend weights on a bending tube, in poses that their fit has not seen.
#include "bakers/character/blend_fit.h"

#include <cmath>

#include "bakers/character/bake.h"
#include "bakers/import/skinning.h"
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

TEST_CASE("a plane's darkening is blended better than by the shares of alpha") {
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
    CHECK(fitted < 0.35 * by_alpha);
    // A sixteenth's rounding is made up by the other entries; a tube of 60 key points leaves a few
    // hundredths.
    CHECK(std::sqrt(fitted) < 0.06);
  }
}
