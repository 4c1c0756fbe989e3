#include "bakers/measure/character/clip_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/character/rotation.h"
#include "bakers/import/clip.h"
#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/character_error.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

// A time in a clip of the set, and the pose that the character's file has at that time.
struct TimedPose {
  FrameMix mix;
  Pose pose;
};

// Returns the poses at the frames if `offset` is 0, and the poses halfway between frames if it is 0.5.
std::vector<TimedPose> timed_poses(const ImportedCharacter& character, const ClipSet& set, double offset,
                                   std::size_t most) {
  struct Place {
    std::size_t clip;
    double time_s;
  };
  std::vector<Place> places;
  for (std::size_t c = 0; c < set.clips.size(); ++c) {
    const ClipRange& clip = set.clips[c];
    const double last = double(clip.frame_count - 1);
    for (std::uint32_t i = 0; double(i) + offset <= last; ++i)
      places.push_back({c, last > 0 ? double(clip.duration_s) * (i + offset) / last : 0});
  }
  std::vector<TimedPose> poses;
  const std::size_t count = std::min(most, places.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Place& place = places[i * places.size() / count];
    const ClipRange& clip = set.clips[place.clip];
    poses.push_back(
        {frame_mix(clip, place.time_s, false),
         sample_clip(character, find_clip(character, std::string(clip.name)), float(place.time_s))});
  }
  return poses;
}

// Squared errors of one form over the vertex-poses of a row.
struct Sums {
  double all = 0, visible = 0;

  void add(std::span<const float> ao, std::span<const float> truth) {
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double e = double(ao[i]) - double(truth[i]), e2 = e * e;
      all += e2;
      if (double(truth[i]) >= visible_truth) visible += e2;
    }
  }
  ClipErrors mean(std::size_t values, std::size_t visible_values) const {
    return {values ? all / double(values) : 0, visible_values ? visible / double(visible_values) : 0};
  }
};

std::size_t visible_count(std::span<const float> truth) {
  return std::size_t(
      std::count_if(truth.begin(), truth.end(), [](float value) { return double(value) >= visible_truth; }));
}

double mean(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) sum += double(value);
  return sum / double(values.size());
}

// Two bodies that the runtime updates. They are posed either by baked clips or by their bones.
class Pair {
 public:
  Pair(const CharacterModel& model, const ClipSet& set)
      : memory_(default_memory()), scene_(settings(), Parallel{}, memory_) {
    const auto loaded =
        Owned<LoadedModel>::make(memory_, Ref<const RefCounted>(), CharacterModel(model), memory_);
    clips_ = Owned<LoadedClips>::make(memory_, Ref<const RefCounted>(), ClipSet(set),
                                      Ref<const LoadedModel>(loaded), memory_);
    receiver_ = add_instance(scene_, loaded);
    caster_ = add_instance(scene_, loaded);
    link(scene_, receiver_, caster_);
    file_vertex_.resize(model.vertex_count());
    for (std::size_t i = 0; i < model.file_to_welded.size(); ++i) file_vertex_[model.file_to_welded[i]] = i;
    file_ao_.resize(model.file_to_welded.size());
  }

  void pose_by_clips(const TimedPose& receiver, const TimedPose& caster, const Mat3x4& caster_place) {
    set_clip(scene_, receiver_, clips_, receiver.mix, Mat3x4{});
    set_clip(scene_, caster_, clips_, caster.mix, caster_place);
  }
  void pose_by_bones(const TimedPose& receiver, const TimedPose& caster, const Mat3x4& caster_place) {
    set_pose(scene_, receiver_, receiver.pose);
    Pose placed;
    for (const Mat3x4& bone : caster.pose) placed.push_back(caster_place * bone);
    set_pose(scene_, caster_, placed);
  }
  // Returns the AO of the receiver per welded vertex.
  std::vector<float> ao(std::uint32_t terms) {
    scene_.terms = terms;
    update(scene_);
    read_ao(scene_, instance_of(scene_, receiver_), file_ao_.data(), sizeof(float));
    std::vector<float> welded;
    for (const std::size_t i : file_vertex_) welded.push_back(file_ao_[i]);
    return welded;
  }

 private:
  static SceneSettings settings() {
    SceneSettings s;
    s.cutoff_error = s.far_error = 0;
    return s;
  }

  Memory* memory_;
  Scene scene_;
  Ref<const LoadedClips> clips_;
  std::vector<std::size_t> file_vertex_;
  std::vector<float> file_ao_;
  nook_instance_id receiver_ = 0, caster_ = 0;
};

ClipErrorRow measure_alone(const char* at, const SkinnedMesh& mesh, std::span<const TimedPose> timed,
                           Pair& pair, const ClipStudy& study, const Progress& progress) {
  std::vector<Pose> poses;
  for (const TimedPose& one : timed) poses.push_back(one.pose);
  const AoTargets targets = trace_character_ao(mesh, poses, study.rays, study.seed, progress);
  ClipErrorRow row;
  row.at = at;
  row.poses = poses.size();
  Sums clips, live;
  std::size_t visible = 0;
  std::vector<float> truth(mesh.vertex_count());
  for (std::size_t p = 0; p < timed.size(); ++p) {
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = float(targets.row(p)[i]) * AoTargets::scale;
    visible += visible_count(truth);
    pair.pose_by_clips(timed[p], timed[p], Mat3x4{});
    clips.add(pair.ao(NOOK_TERM_SELF), truth);
    pair.pose_by_bones(timed[p], timed[p], Mat3x4{});
    live.add(pair.ao(NOOK_TERM_SELF), truth);
  }
  const std::size_t values = poses.size() * truth.size();
  row.clips = clips.mean(values, visible);
  row.live = live.mean(values, visible);
  row.visible_share = double(visible) / double(std::max<std::size_t>(values, 1));
  row.noise_floor_mse = poses.empty() ? 0 : measure_noise_floor(mesh, poses, targets, study.rays, study.seed);
  return row;
}

// Turns the caster about the vertical axis through its body, and moves it to the given distance and bearing
// from the receiver's body.
Mat3x4 place_of(const CharacterModel& model, const Pose& receiver, const Pose& caster, float distance_m,
                float bearing, float yaw) {
  const Vec3 own = transform_point(receiver[model.root_bone], model.bounding_centre),
             centre = transform_point(caster[model.root_bone], model.bounding_centre);
  Mat3x4 place = rotation_about(centre, {0, yaw, 0});
  place.m[3] += own.x - centre.x + distance_m * std::sin(bearing);
  place.m[11] += own.z - centre.z + distance_m * std::cos(bearing);
  return place;
}

ClipErrorRow measure_neighbour(const SkinnedMesh& mesh, const CharacterModel& model,
                               std::span<const TimedPose> timed, float distance_m, Pair& pair,
                               const ClipStudy& study, const Progress& progress) {
  ClipErrorRow row;
  row.at = "neighbour";
  row.distance_m = distance_m;
  row.poses = timed.size();
  const float offset = ray_origin_offset(mesh.position);
  Sums clips, live, unlinked;
  std::size_t visible = 0;
  std::vector<Vec3> position, normal, other;
  for (std::size_t p = 0; p < timed.size(); ++p) {
    if (progress && !progress(p, timed.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring neighbours");
    const TimedPose& receiver = timed[p];
    // The caster's pose is half the list away, usually in another clip. The golden angle spreads its bearings
    // and turns evenly.
    const TimedPose& caster = timed[(p + timed.size() / 2 + 1) % timed.size()];
    const float turn = std::numbers::pi_v<float> * (3 - std::sqrt(5.0f)) * float(p);
    const Mat3x4 place = place_of(model, receiver.pose, caster.pose, distance_m, turn, 1.7f * turn);
    skin_positions(mesh, receiver.pose, position);
    posed_normals(mesh, receiver.pose, position, normal);
    skin_positions(mesh, caster.pose, other);
    AoSettings rays{study.rays, study.seed + 31 * p};
    rays.origin_offset = offset;
    TriangleSoup soup{position, mesh.triangle};
    const std::vector<float> alone = trace_ao(soup, {position, normal}, rays);
    const auto first = std::uint32_t(position.size());
    for (const Vec3& at : other) soup.position.push_back(transform_point(place, at));
    for (const auto& t : mesh.triangle) soup.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
    const std::vector<float> truth = trace_ao(soup, {position, normal}, rays);
    visible += visible_count(truth);
    row.darkening_traced += mean(alone) - mean(truth);
    pair.pose_by_clips(receiver, caster, place);
    const std::vector<float> self = pair.ao(NOOK_TERM_SELF),
                             linked = pair.ao(NOOK_TERM_SELF | NOOK_TERM_LINKS);
    unlinked.add(self, truth);
    clips.add(linked, truth);
    row.darkening += mean(self) - mean(linked);
    pair.pose_by_bones(receiver, caster, place);
    const std::vector<float> live_self = pair.ao(NOOK_TERM_SELF),
                             live_linked = pair.ao(NOOK_TERM_SELF | NOOK_TERM_LINKS);
    live.add(live_linked, truth);
    row.darkening_live += mean(live_self) - mean(live_linked);
  }
  const std::size_t values = timed.size() * mesh.vertex_count();
  const double count = double(std::max<std::size_t>(timed.size(), 1));
  for (double* darkening : {&row.darkening, &row.darkening_live, &row.darkening_traced}) *darkening /= count;
  row.clips = clips.mean(values, visible);
  row.live = live.mean(values, visible);
  row.unlinked = unlinked.mean(values, visible);
  row.visible_share = double(visible) / double(std::max<std::size_t>(values, 1));
  return row;
}

}  // namespace

std::vector<ClipErrorRow> measure_clips(const ImportedCharacter& character, const CharacterModel& model,
                                        const ClipSet& set, const ClipStudy& study,
                                        const Progress& progress) {
  Pair pair(model, set);
  std::vector<ClipErrorRow> rows;
  rows.push_back(measure_alone("frames", character.mesh, timed_poses(character, set, 0, study.max_poses),
                               pair, study, progress));
  rows.push_back(measure_alone("half_way", character.mesh, timed_poses(character, set, 0.5, study.max_poses),
                               pair, study, progress));
  const std::vector<TimedPose> pairs = timed_poses(character, set, 0.5, study.max_pairs);
  for (const float distance_m : study.distances_m)
    rows.push_back(measure_neighbour(character.mesh, model, pairs, distance_m, pair, study, progress));
  return rows;
}

}  // namespace nook::measure
