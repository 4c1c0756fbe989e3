#include "bakers/character/judgement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "bakers/character/export_model.h"
#include "bakers/character/fit_state.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/torn_edges.h"

namespace nook::bake {
namespace {

constexpr std::size_t wished_poses = 60, least_of_clip = 4, most_poses = 240;
// Rays per vertex, over all poses together. A standard bake fits to about ten times as many rays.
constexpr std::size_t most_rays = 6000, least_rays = 2000;
constexpr double visible_truth = double(hidden_below);
// A clip counts as worse than a static bake only if its squared error is larger by at least this value. The
// value is the square of one step of an 8-bit image.
constexpr double least_excess = 1.0 / (255.0 * 255.0);
constexpr double torn_limit = 5e-4;

std::vector<std::size_t> other_clips(const ImportedCharacter& character, const Recipe& recipe) {
  std::vector<std::size_t> clips;
  for (const std::size_t clip : motion_clips(character))
    if (std::find(recipe.clips.begin(), recipe.clips.end(), clip) == recipe.clips.end())
      clips.push_back(clip);
  return clips;
}

// The fitted frames of a clip are at (i + 0.5) / samples of its duration, so i / samples is halfway between
// two frames.
void add_between_frames(const ImportedCharacter& character, std::size_t clip, std::size_t samples,
                        std::size_t count, JudgedPoses& out) {
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t i = samples > 1 ? 1 + j * (samples - 1) / count : 0;
    const float share = samples > 1 ? float(i) / float(samples) : 0.0f;
    out.poses.push_back(sample_clip(character, clip, character.clips[clip].duration_s * share));
    out.clip.push_back(out.clips.size());
  }
}

}  // namespace

const char* text_of(JudgedPoses::Source source) {
  switch (source) {
    case JudgedPoses::Source::other_clips:
      return "poses of clips that were not fitted";
    case JudgedPoses::Source::between_frames:
      return "poses between the fitted poses of its clips";
    case JudgedPoses::Source::turned:
      return "turns";
    case JudgedPoses::Source::recorded:
      return "recorded poses that were not fitted";
    case JudgedPoses::Source::generated:
      break;
  }
  return "generated poses";
}

JudgedPoses judged_poses(const ImportedCharacter& character, const Recipe& recipe) {
  JudgedPoses out;
  if (character.mesh.bones.size() == 1 && character.clips.empty()) {
    out.source = JudgedPoses::Source::turned;
    out.poses = turned_poses(8, 0.25f);
    return out;
  }
  const std::vector<std::size_t> others = other_clips(character, recipe);
  const std::vector<std::size_t>& clips = others.empty() ? recipe.clips : others;
  if (clips.empty()) {
    out.poses =
        automatic_poses(character, recipe, wished_poses, mix_bits(recipe.settings.seed ^ 0x6a75646765ull));
    return out;
  }
  const std::size_t each = std::max(least_of_clip, wished_poses / clips.size());
  out.source = others.empty() ? JudgedPoses::Source::between_frames : JudgedPoses::Source::other_clips;
  for (const std::size_t clip : clips) {
    add_between_frames(character, clip, others.empty() ? recipe.samples_per_clip : 2 * each, each, out);
    out.clips.push_back(character.clips[clip].name);
  }
  thin_out(out.poses, most_poses);
  thin_out(out.clip, most_poses);
  return out;
}

namespace {

// Two names for the part of the body that a vertex belongs to: the role of the bone with the vertex's largest
// weight, and the name of the vertex's mesh.

const char* part_of(JointRole role) {
  switch (role) {
    case JointRole::pelvis:
    case JointRole::spine:
      return "trunk";
    case JointRole::neck:
    case JointRole::head:
      return "head";
    case JointRole::clavicle:
    case JointRole::upper_arm:
    case JointRole::forearm:
      return "arms";
    case JointRole::hand:
    case JointRole::finger:
    case JointRole::thumb:
      return "hands";
    case JointRole::thigh:
    case JointRole::calf:
      return "legs";
    case JointRole::foot:
    case JointRole::toe:
      return "feet";
    default:
      return "";
  }
}

std::vector<std::string> parts_of_vertices(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  std::vector<std::string> parts;
  for (const SkinWeights& weights : mesh.weights) {
    const std::string part = part_of(joints[weights.bone[0]].role);
    parts.push_back(part.empty() ? "bone " + mesh.bones[weights.bone[0]].name : part);
  }
  return parts;
}

std::vector<std::string> meshes_of_vertices(const SkinnedMesh& mesh) {
  std::vector<std::string> names(mesh.vertex_count());
  for (const Primitive& p : mesh.primitives)
    for (std::uint32_t i = p.first_vertex; i < p.first_vertex + p.vertex_count; ++i)
      names[mesh.file_to_welded[i]] = p.mesh_name;
  return names;
}

std::vector<std::string> bones_without_role(const SkinnedMesh& mesh, std::span<const Joint> joints,
                                            std::span<const float> vertex_area) {
  constexpr double least_share = 0.02;
  std::vector<double> area(mesh.bones.size(), 0.0);
  double total = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    total += double(vertex_area[v]);
    area[mesh.weights[v].bone[0]] += double(vertex_area[v]);
  }
  std::vector<std::string> names;
  for (std::size_t b = 0; b < area.size(); ++b)
    if (joints[b].role == JointRole::other && area[b] > least_share * total)
      names.push_back(mesh.bones[b].name);
  return names;
}

// Sums over all pairs of a vertex and a pose in which the vertex is visible (traced AO of at least 0.01).
struct Sums {
  double model = 0, static_bake = 0, oracle = 0, weight = 0;

  void add(const Sums& other) {
    model += other.model;
    static_bake += other.static_bake;
    oracle += other.oracle;
    weight += other.weight;
  }
  JudgedErrors mean() const {
    return weight > 0 ? JudgedErrors{model / weight, static_bake / weight} : JudgedErrors{};
  }
};

double truth_at(const AoTargets& targets, std::size_t pose, std::size_t vertex) {
  return double(targets.row(pose)[vertex]) * double(AoTargets::scale);
}

// The model's AO in the judged poses, and two independent ray traces of the same poses, each with half of the
// rays.
struct Traced {
  AoTargets half[2];
  std::vector<float> ao;  // poses x vertices
  std::size_t vertices = 0, poses = 0;

  bool is_visible(std::size_t p, std::size_t v) const {
    return truth_at(half[0], p, v) + truth_at(half[1], p, v) >= 2 * visible_truth;
  }
  double product(std::size_t p, std::size_t v, double a, double b) const {
    return (a - truth_at(half[0], p, v)) * (b - truth_at(half[1], p, v));
  }
};

std::vector<float> model_ao(const CharacterModel& model, std::span<const Pose> poses) {
  const FitState state = state_of_model(model);
  const std::vector<float> shadows = shadows_of(state, poses);
  const std::size_t padded = state.structure.padded_count(), vertices = model.vertex_count();
  std::vector<float> ao(poses.size() * vertices);
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t v = 0; v < vertices; ++v) {
      float dark = model.bias[v];
      for (std::size_t s = v * model.influences; s < (v + 1) * model.influences; ++s)
        dark += model.alpha[s] * shadows[p * padded + model.influence[s]];
      ao[p * vertices + v] = std::clamp(1 - dark, 0.0f, 1.0f);
    }
  return ao;
}

// Returns the sums of one vertex over some poses. The oracle predicts the mean AO of the vertex. Each half of
// the rays has its own mean, so that the noise of both is independent.
Sums sums_of(const Traced& traced, const CharacterModel& model, std::size_t v,
             const std::vector<std::size_t>& poses) {
  Sums sums;
  double mean[2] = {};
  for (const std::size_t p : poses) {
    if (!traced.is_visible(p, v)) continue;
    const double ao = double(traced.ao[p * traced.vertices + v]);
    const double rest = model.static_ao.empty() ? ao : double(model.static_ao[v]);
    sums.model += traced.product(p, v, ao, ao);
    sums.static_bake += traced.product(p, v, rest, rest);
    for (int h = 0; h < 2; ++h) mean[h] += truth_at(traced.half[h], p, v);
    sums.weight += 1;
  }
  if (sums.weight == 0) return sums;
  for (const std::size_t p : poses)
    if (traced.is_visible(p, v))
      sums.oracle += traced.product(p, v, mean[0] / sums.weight, mean[1] / sums.weight);
  return sums;
}

std::vector<Sums> sums_of_vertices(const Traced& traced, const CharacterModel& model) {
  std::vector<std::size_t> all(traced.poses);
  for (std::size_t p = 0; p < all.size(); ++p) all[p] = p;
  std::vector<Sums> sums(traced.vertices);
  tbb::parallel_for(std::size_t(0), sums.size(),
                    [&](std::size_t v) { sums[v] = sums_of(traced, model, v, all); });
  return sums;
}

VisibleErrors total_of(std::span<const Sums> of_vertex, std::span<const float> area) {
  Sums sums, weighted;
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    const Sums& s = of_vertex[v];
    const double a = double(area[v]);
    sums.add(s);
    weighted.add({a * s.model, a * s.static_bake, a * s.oracle, a * s.weight});
  }
  return {sums.mean(), weighted.mean(), sums.weight > 0 ? sums.oracle / sums.weight : 0};
}

std::vector<JudgedPart> parts_by_name(std::span<const std::string> names, std::span<const Sums> sums,
                                      std::span<const float> area) {
  struct Part {
    Sums sums;
    double area = 0;
  };
  std::map<std::string, Part> parts;
  Part all;
  for (std::size_t v = 0; v < names.size(); ++v)
    for (Part* part : {&parts[names[v]], &all}) {
      part->sums.add(sums[v]);
      part->area += double(area[v]);
    }
  std::vector<JudgedPart> out;
  for (const auto& [name, part] : parts)
    out.push_back({name, part.sums.mean(), all.sums.model > 0 ? part.sums.model / all.sums.model : 0,
                   all.area > 0 ? part.area / all.area : 0});
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.share_of_error > b.share_of_error; });
  return out;
}

std::vector<JudgedPart> errors_of_clips(const Traced& traced, const CharacterModel& model,
                                        const JudgedPoses& judged) {
  std::vector<JudgedPart> out;
  for (std::size_t c = 0; c < judged.clips.size(); ++c) {
    std::vector<std::size_t> poses;
    for (std::size_t p = 0; p < judged.clip.size(); ++p)
      if (judged.clip[p] == c) poses.push_back(p);
    Sums sums;
    for (std::size_t v = 0; v < traced.vertices; ++v) sums.add(sums_of(traced, model, v, poses));
    out.push_back({judged.clips[c], sums.mean(), 0, 0});
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return a.error.over_static() > b.error.over_static();
  });
  return out;
}

Traced trace(const SkinnedMesh& mesh, const CharacterModel& model, std::span<const Pose> poses,
             std::uint32_t rays, std::uint64_t seed, const Progress& progress) {
  Traced traced;
  traced.vertices = mesh.vertex_count();
  traced.poses = poses.size();
  for (std::size_t h = 0; h < 2; ++h)
    traced.half[h] = trace_character_ao(
        mesh, poses, rays / 2, mix_bits(seed + h),
        [&](auto done, auto total) { return !progress || progress(done + h * total, 2 * total); });
  traced.ao = model_ao(model, poses);
  return traced;
}

}  // namespace

VisibleErrors visible_errors(const SkinnedMesh& mesh, const CharacterModel& model,
                             std::span<const Pose> poses, const AoTargets& first, const AoTargets& second) {
  const Traced traced{{first, second}, model_ao(model, poses), mesh.vertex_count(), poses.size()};
  return total_of(sums_of_vertices(traced, model), vertex_areas(mesh, mesh.position));
}

bool Judgement::is_poor() const {
  if (over_static() > poor_ratio) return true;
  return std::any_of(clips.begin(), clips.end(), [](const JudgedPart& clip) {
    return clip.error.model > clip.error.static_bake + least_excess;
  });
}

Judgement judge_model(const ImportedCharacter& character, const CharacterModel& model, const Recipe& recipe,
                      const JudgedPoses& judged, std::uint64_t seed, const Progress& progress) {
  const SkinnedMesh& mesh = character.mesh;
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  Judgement out;
  out.source = judged.source;
  out.poses = judged.poses.size();
  const std::size_t fitted =
      recipe.auto_poses + recipe.clips.size() * recipe.samples_per_clip + recipe.variant_poses;
  const std::size_t affordable = std::clamp(fitted * recipe.settings.rays / 8, least_rays, most_rays);
  out.rays = std::uint32_t(std::clamp<std::size_t>(affordable / out.poses, 16, 128)) / 2 * 2;
  const Traced traced = trace(mesh, model, judged.poses, out.rays, seed, progress);
  const std::vector<Sums> of_vertex = sums_of_vertices(traced, model);
  out.errors = total_of(of_vertex, area);
  out.clips = errors_of_clips(traced, model, judged);
  const std::vector<Joint> joints = joint_roles(mesh, recipe.rig);
  out.parts = parts_by_name(parts_of_vertices(mesh, joints), of_vertex, area);
  out.meshes = parts_by_name(meshes_of_vertices(mesh), of_vertex, area);
  out.bones_without_role = bones_without_role(mesh, joints, area);
  out.torn_by_clips = torn_by_clips(character);
  if (recipe.auto_poses > 0)
    out.torn_edges = torn_share(
        mesh,
        automatic_poses(character, recipe, std::min(recipe.auto_poses, wished_poses), recipe.settings.seed));
  return out;
}

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string figures(const Judgement& j) {
  std::string text = "error " + number(j.over_static()) + " times the error of a static bake (" +
                     number(j.errors.by_area.over_static()) + " if weighted by area), " +
                     number(j.over_oracle()) + " times the error of the best static bake, on " +
                     std::to_string(j.poses) + " " + text_of(j.source);
  if (!j.clips.empty())
    text += "; worst clip " + j.clips.front().name + " with " + number(j.clips.front().error.over_static());
  return text;
}

std::string names_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i ? ", " : "") + names[i];
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

// Returns a mesh, for example a prop, whose share of the error is much larger than its share of the area.
// Returns null if there is no such mesh.
const JudgedPart* outlying_mesh(const Judgement& j) {
  if (j.meshes.size() < 2) return nullptr;
  const JudgedPart& worst = j.meshes.front();
  return worst.share_of_error > 0.3 && worst.share_of_error > 3 * worst.share_of_area ? &worst : nullptr;
}

std::string cause(const Judgement& j) {
  if (j.torn_edges > j.torn_by_clips + torn_limit)
    return "generated poses tear the mesh (" + number(100 * j.torn_edges) +
           " % of its edges), because the bake misinterprets the rig";
  if (!j.bones_without_role.empty())
    return "the bake could not tell the role of these bones, so generated poses may move them wrongly: " +
           names_of(j.bones_without_role);
  if (const JudgedPart* mesh = outlying_mesh(j))
    return "the mesh " + mesh->name + " has " + number(100 * mesh->share_of_error) + " % of the error";
  return "the measured motion differs from the fitted poses, most in " + j.parts.front().name + " (" +
         number(100 * j.parts.front().share_of_error) + " % of the error)";
}

std::string cure(const Judgement& j) {
  std::string text = j.source == JudgedPoses::Source::between_frames
                         ? "use --preset production"
                         : "fit the clips that the game plays (--poses all), or fit to poses that you "
                           "recorded in the game (--calibrate)";
  if (const JudgedPart* mesh = outlying_mesh(j))
    text += ", or leave this mesh out (--without " + mesh->name + ")";
  if (j.torn_edges > j.torn_by_clips + torn_limit || !j.bones_without_role.empty())
    text += ", or name the roles of the bones (--rig)";
  return text;
}

}  // namespace

std::string summary_of(const Judgement& judgement) {
  if (!judgement.is_poor()) return figures(judgement);
  const bool is_worse = judgement.over_static() > 1;
  return std::string(is_worse ? "worse than a static bake: " : "poor: ") + figures(judgement) +
         ". Cause: " + cause(judgement) + ". Cure: " + cure(judgement);
}

}  // namespace nook::bake
