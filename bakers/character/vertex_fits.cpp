#include "bakers/character/vertex_fits.h"

#include <algorithm>
#include <cmath>

#include "bakers/character/blend_weights.h"
#include "bakers/character/body_scale.h"
#include "bakers/character/export_model.h"
#include "bakers/character/initialise.h"
#include "bakers/character/linear_fit.h"
#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/raytrace/stand_ins.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr std::size_t max_candidates = 40;  // key points that a vertex may use, as in a bake
constexpr std::uint32_t rest_rays = 1024;

LinearLayerFit fitted_layer(const CharacterModel& model, const FitState& state, const SkinnedMesh& mesh,
                            std::span<const Vec3> normal, const TrainingSet& set) {
  Candidates candidates;
  candidates.count = std::min(max_candidates, model.key_points.size());
  NearKeyPoints near = nearest_key_points(mesh, normal, model.key_points, candidates.count);
  candidates.key_point = std::move(near.key_point);
  candidates.nearness = std::move(near.nearness);
  LinearFitSettings settings;
  settings.entries = model.influences;
  return fit_linear_layer(shadows_of(state, set.poses), state.structure.padded_count(), set, candidates,
                          settings);
}

// Copies everything that all meshes of the rig share, including caster weights and the positions at which
// other casters darken key points.
void take_rig(const CharacterModel& model, CharacterModel& out) {
  out.kernel = model.kernel;
  out.bone_names = model.bone_names;
  out.spheres = model.spheres;
  out.key_points = model.key_points;
  out.levels = model.levels;
  out.world_casters = model.world_casters;
  out.bounding_radius = model.bounding_radius;
  out.bounding_centre = model.bounding_centre;
  out.root_bone = model.root_bone;
  out.recipe = model.recipe;
}

CharacterModel refit_in_metres(const CharacterModel& model, const SkinnedMesh& mesh,
                               std::span<const Pose> poses, const RefitSettings& settings,
                               const Progress& progress) {
  TrainingSet set;
  set.poses.assign(poses.begin(), poses.end());
  const StandIns stand_ins = choose_stand_ins(mesh, poses, settings.seed, progress);
  set.targets = trace_character_ao(mesh, poses, settings.rays, settings.seed, progress, stand_ins);
  set.vertex_weight.assign(mesh.vertex_count(), 1.0f);
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);

  FitState state = state_of_model(model);
  state.linear = fitted_layer(model, state, mesh, normal, set);
  const std::vector<Pose> rest{Pose(mesh.bones.size())};
  const AoTargets rest_ao = trace_character_ao(mesh, rest, rest_rays, settings.seed, {}, stand_ins);
  std::vector<float> static_ao;
  for (const std::uint16_t v : rest_ao.row(0)) static_ao.push_back(float(v) * AoTargets::scale);
  CharacterModel out = export_model(state, mesh, area, normal, static_ao);
  take_rig(model, out);
  fit_blend_weights(out, mesh, poses);
  return out;
}

}  // namespace

CharacterModel refit_vertices(const CharacterModel& model, const SkinnedMesh& mesh,
                              std::span<const Pose> poses, const RefitSettings& settings,
                              const Progress& progress) {
  const float scale = scale_to_person(mesh);
  CharacterModel in_metres = model;
  scale_model(in_metres, scale);
  CharacterModel out =
      refit_in_metres(in_metres, scaled(mesh, scale), scaled(poses, scale), settings, progress);
  scale_model(out, 1 / scale);
  return out;
}

namespace {

// Weight of each of the two known observations of a vertex. A traced pose has the weight 1. Traced
// observations are noisy, and the occluded direction depends on more than AO, so about ten poses with
// different AO should outweigh the known observations.
constexpr double known_weight = 0.1;

Mat3x4 blended_bones(const SkinWeights& weights, const Pose& pose) {
  Mat3x4 sum;
  for (float& element : sum.m) element = 0;
  for (int b = 0; b < SkinWeights::max_bones; ++b)
    if (weights.weight[b] > 0)
      for (int i = 0; i < 12; ++i) sum.m[i] += weights.weight[b] * pose[weights.bone[b]].m[i];
  return sum;
}

// Turns v back: multiplies it by the transpose of the matrix, without the matrix's scale.
Vec3 turned_back(const Mat3x4& turn, Vec3 v) {
  const float* m = turn.m;
  const Vec3 back{m[0] * v.x + m[4] * v.y + m[8] * v.z, m[1] * v.x + m[5] * v.y + m[9] * v.z,
                  m[2] * v.x + m[6] * v.y + m[10] * v.z};
  return normalised(back) * length(v);
}

}  // namespace

void OccludedLine::add(float ao, Vec3 occluded, double weight) {
  const double open = double(ao), dark = 1 - open,
               v[3] = {double(occluded.x), double(occluded.y), double(occluded.z)};
  dark_dark_ += weight * dark * dark;
  dark_open_ += weight * dark * open;
  open_open_ += weight * open * open;
  for (int i = 0; i < 3; ++i) {
    dark_[i] += weight * dark * v[i];
    open_[i] += weight * open * v[i];
  }
}

OccludedEnds OccludedLine::ends(Vec3 normal_rest) const {
  OccludedLine all = *this;
  all.add(0, open_hemisphere * normal_rest, known_weight);
  all.add(1, {}, known_weight);
  const double determinant = all.dark_dark_ * all.open_open_ - all.dark_open_ * all.dark_open_;
  const auto solve = [&](int i, bool dark) {
    const double value = dark ? all.open_open_ * all.dark_[i] - all.dark_open_ * all.open_[i]
                              : all.dark_dark_ * all.open_[i] - all.dark_open_ * all.dark_[i];
    return float(std::fmin(std::fmax(value / determinant, -1.0), 1.0));
  };
  return {{solve(0, true), solve(1, true), solve(2, true)},
          {solve(0, false), solve(1, false), solve(2, false)}};
}

OccludedSample trace_occluded(const SkinnedMesh& mesh, const Pose& pose,
                              const OccludedFitSettings& settings) {
  TriangleSoup soup;
  skin_positions(mesh, pose, soup.position);
  soup.triangle = mesh.triangle;
  std::vector<Vec3> normal;
  posed_normals(mesh, pose, soup.position, normal);
  AoSettings ao;
  ao.rays = settings.rays;
  ao.seed = settings.seed;
  ao.origin_offset = ray_origin_offset(mesh.position);
  const RayScene scene(soup);
  Openness open = trace_openness(scene, {soup.position, normal}, ao);
  OccludedSample sample{std::move(open.ao), std::move(open.direction)};
  for (std::size_t v = 0; v < sample.occluded.size(); ++v) {
    const Vec3 occluded = open_hemisphere * normal[v] - sample.ao[v] * sample.occluded[v];
    sample.occluded[v] = turned_back(blended_bones(mesh.weights[v], pose), occluded);
  }
  return sample;
}

std::vector<OccludedEnds> fit_occluded(const SkinnedMesh& mesh, std::span<const Pose> poses,
                                       const OccludedFitSettings& settings, const Progress& progress) {
  if (poses.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there are no poses to fit bent normals to (need at least 1)");
  std::vector<OccludedLine> line(mesh.vertex_count());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    OccludedFitSettings of_pose = settings;
    of_pose.seed = mix_bits(settings.seed + p);
    const OccludedSample sample = trace_occluded(mesh, poses[p], of_pose);
    for (std::size_t v = 0; v < line.size(); ++v) line[v].add(sample.ao[v], sample.occluded[v]);
    if (progress && !progress(p + 1, poses.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu poses done)", p + 1,
                    poses.size());
  }
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  std::vector<OccludedEnds> ends;
  for (std::size_t v = 0; v < line.size(); ++v) ends.push_back(line[v].ends(normal[v]));
  return ends;
}

}  // namespace nook::bake
