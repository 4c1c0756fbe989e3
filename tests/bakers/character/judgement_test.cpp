// The judgement of a bake beside truths that are known: errors without the noise of rays, torn edges, the
// worst part and clip. Steps from frame to frame are here too.
#include "bakers/character/judgement.h"
#include "bakers/character/torn_edges.h"

#include <cmath>

#include "bakers/character/character_bake.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/measure/character/motion_error.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;

namespace {

// share: of b, by which they may differ.
bool is_near(double a, double b, double share) {
  return std::abs(a - b) <= share * std::abs(b);
}

}  // namespace

TEST_CASE("errors against two tracings have no noise of rays") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  BakeSettings settings;
  settings.spheres = 8;
  settings.key_points = 24;
  settings.rays = 64;
  settings.steps = 200;
  const CharacterModel model = bake_character(mesh, tube_poses(mesh, 48), settings).model;
  const std::vector<Pose> poses = tube_poses(mesh, 30);
  const CharacterEvaluation precise = evaluate_character(mesh, model, poses, 2048, 5),
                            noisy = evaluate_character(mesh, model, poses, 16, 6);
  const VisibleErrors errors = visible_errors(mesh, model, poses, trace_character_ao(mesh, poses, 16, 7),
                                              trace_character_ao(mesh, poses, 16, 8));
  INFO(errors.by_vertices.model << " of " << precise.model.mse_visible << ", noisy "
                                << noisy.model.mse_visible);
  CHECK(noisy.model.mse_visible > 1.3 * precise.model.mse_visible);
  // 4,860 vertex-poses with a noise of 2e-3 each leave 2 % of an error of 1e-3.
  CHECK(is_near(errors.by_vertices.model, precise.model.mse_visible, 0.15));
  CHECK(is_near(errors.by_vertices.static_bake, precise.static_bake.mse_visible, 0.05));
  CHECK(is_near(errors.by_area.model, precise.model.mse_visible_area, 0.15));
  CHECK(is_near(errors.oracle, precise.oracle.mse_visible, 0.1));
}

TEST_CASE("edges that a pose tears are counted") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  const JointRotation bent{1, {0, 0, 1}};
  Pose moved(2);
  moved[1].m[3] = 5;  // metres: every edge across the joint is stretched
  CHECK(torn_share(mesh, std::vector<Pose>{Pose(2), turn_joints(mesh, {&bent, 1})}) == 0);
  // The tip's weight rises over two of 15 rows of faces, so that two or three rows of edges stretch. Each row
  // has 20 edges along the tube and across its faces. The tube has 160 edges round it and 20 at its caps.
  const double torn = torn_share(mesh, std::vector<Pose>{moved});
  CHECK(torn > 40.0 / 480);
  CHECK(torn < 80.0 / 480);
  CHECK(torn_share(mesh, {}) == 0);
}

namespace {

Judgement judged(double model, double static_bake) {
  Judgement j;
  j.poses = 60;
  j.errors.by_vertices = j.errors.by_area = {model, static_bake};
  j.errors.oracle = static_bake / 2;
  j.parts.push_back({"legs", {model, static_bake}, 0.7, 0.3});
  return j;
}

bool says(const Judgement& j, const char* text) {
  return summary_of(j).find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("the summary names the fault, its cause and its cure") {
  CHECK_FALSE(judged(0.0020, 0.01).is_poor());
  CHECK(summary_of(judged(0.0020, 0.01)).rfind("error 0.2 times the error of a static bake", 0) == 0);
  CHECK(judged(0.0026, 0.01).is_poor());
  CHECK(summary_of(judged(0.0026, 0.01)).rfind("poor: ", 0) == 0);
  CHECK(says(judged(0.0026, 0.01), "most in legs"));
  CHECK(summary_of(judged(0.02, 0.01)).rfind("worse than a static bake: ", 0) == 0);

  Judgement torn = judged(0.02, 0.01);
  torn.torn_edges = 0.033;
  CHECK(says(torn, "tear the mesh (3.3 %"));
  CHECK(says(torn, "--rig"));
  Judgement prop = judged(0.02, 0.01);
  prop.meshes = {{"Club", {}, 0.6, 0.05}, {"Orc", {}, 0.4, 0.95}};
  CHECK(says(prop, "--without Club"));
  // A good model with one clip that a static bake shows better.
  Judgement clip = judged(0.001, 0.01);
  clip.clips.push_back({"Walk", {3e-3, 1e-3}, 0, 0});
  CHECK(clip.is_poor());
  CHECK(says(clip, "worst clip Walk with 3"));
  clip.clips.front().error = {1.1e-5, 1e-5};  // by less than a step of 8 bits
  CHECK_FALSE(clip.is_poor());
}

TEST_CASE("steps from frame to frame are measured beside the steps of the truth") {
  // Two vertices in three frames.
  const std::vector<float> model{0.5f, 0.5f, 0.6f, 0.5f, 0.6f, 0.8f},
      truth{0.5f, 0.5f, 0.55f, 0.5f, 0.55f, 0.79f};
  MotionErrors errors;
  add_steps(model, truth, 2, "Walk", errors);
  add_steps(truth, truth, 2, "Run", errors);
  CHECK(errors.frames == 4);
  CHECK(errors.vertex_frames == 8);
  CHECK(is_near(errors.largest_step, 0.3, 1e-5));
  CHECK(is_near(errors.largest_step_truth, 0.29, 1e-5));
  CHECK(is_near(errors.largest_beyond, 0.05, 1e-4));
  CHECK(is_near(errors.share_beyond, 1.0 / 8, 1e-5));  // the step of 0.1 beside one of 0.05
  CHECK(errors.worst_clip == "Walk");
}
