#include "bakers/measure/character/casters.h"

#include <cmath>
#include <numbers>

#include "bakers/character/rotation.h"
#include "bakers/import/skinning.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// The pose turned about the vertical axis through the body's centre, then moved along the ground.
Pose placed(const Pose& pose, Vec3 centre, float yaw_radians, Vec3 move) {
  Mat3x4 place = rotation_about(centre, {0, yaw_radians, 0});
  place.m[3] += move.x;
  place.m[7] += move.y;
  place.m[11] += move.z;
  Pose out;
  for (const Mat3x4& m : pose) out.push_back(place * m);
  return out;
}

double weighted_mean(std::span<const float> value, std::span<const float> weight) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    sum += double(value[i]) * double(weight[i]);
    total += double(weight[i]);
  }
  return sum / total;
}

// Mean darkening of a receiver by one linked caster, by the runtime itself. Nothing is culled.
class ModelDarkening {
 public:
  ModelDarkening(const CharacterModel& model, nook_combine combine, float far_error,
                 std::span<const float> area)
      : memory_(default_memory()), scene_(settings(combine, far_error), Parallel{}, memory_) {
    const Ref<const LoadedModel> loaded =
        Owned<LoadedModel>::make(memory_, Ref<const RefCounted>(), CharacterModel(model), memory_);
    receiver_ = add_instance(scene_, loaded);
    caster_ = add_instance(scene_, loaded);
    link(scene_, receiver_, caster_);
    for (std::uint32_t w : model.file_to_welded) file_area_.push_back(area[w]);
  }

  double measure(const Pose& receiver, const Pose& caster) {
    set_pose(scene_, receiver_, receiver);
    set_pose(scene_, caster_, caster);
    return weighted_mean(ao_by(NOOK_TERM_SELF), file_area_) -
           weighted_mean(ao_by(NOOK_TERM_SELF | NOOK_TERM_LINKS), file_area_);
  }
  // Mean over vertices of the squared difference from another form in the poses of both.
  double squared_difference(ModelDarkening& other) {
    std::vector<float> squared = ao_by(NOOK_TERM_SELF | NOOK_TERM_LINKS);
    const std::vector<float> reference = other.ao_by(NOOK_TERM_SELF | NOOK_TERM_LINKS);
    for (std::size_t i = 0; i < squared.size(); ++i) {
      const float difference = squared[i] - reference[i];
      squared[i] = difference * difference;
    }
    return weighted_mean(squared, file_area_);
  }

 private:
  static SceneSettings settings(nook_combine combine, float far_error) {
    SceneSettings s;
    s.combine = combine;
    s.cutoff_error = 0;
    s.far_error = far_error;
    return s;
  }

  // Over file vertices; those that seams repeat count again, which shifts a mean over the whole body by
  // nothing that matters beside a bound of 20 %.
  std::vector<float> ao_by(std::uint32_t terms) {
    scene_.terms = terms;
    update(scene_);
    std::vector<float> ao(file_area_.size());
    read_ao(scene_, instance_of(scene_, receiver_), ao.data(), sizeof(float));
    return ao;
  }

  Memory* memory_;
  Scene scene_;
  std::vector<float> file_area_;
  nook_instance_id receiver_ = 0, caster_ = 0;
};

}  // namespace

std::vector<CasterRow> measure_casters(const SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const Pose> poses, const CasterStudy& study,
                                       const Progress& progress) {
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const float offset = ray_origin_offset(mesh.position);
  ModelDarkening composed(model, NOOK_COMBINE_COMPOSED, 0, area), paper(model, NOOK_COMBINE_PAPER, 0, area),
      grouped(model, NOOK_COMBINE_COMPOSED, SceneSettings().far_error, area);
  std::vector<CasterRow> rows;
  std::size_t done = 0;
  const std::size_t total = study.distances_m.size() * poses.size() * study.bearings;
  for (float distance : study.distances_m) {
    CasterRow by_composed{distance, "composed", 0, 0}, by_paper{distance, "paper", 0, 0};
    for (std::size_t p = 0; p < poses.size(); ++p) {
      const Pose& own = poses[p];
      const Pose& other = poses[(p + 1) % poses.size()];
      std::vector<Vec3> position, normal, caster_position;
      skin_positions(mesh, own, position);
      vertex_normals(mesh.triangle, position, normal);
      const Vec3 centre = transform_point(other[model.root_bone], model.bounding_centre);
      for (std::size_t b = 0; b < study.bearings; ++b) {
        if (progress && !progress(done++, total))
          throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring casters");
        const float bearing =
            2 * std::numbers::pi_v<float> * (float(b) + 0.5f * float(p % 2)) / float(study.bearings);
        const Vec3 own_centre = transform_point(own[model.root_bone], model.bounding_centre);
        const Vec3 move = Vec3{own_centre.x - centre.x, 0, own_centre.z - centre.z} +
                          distance * Vec3{std::sin(bearing), 0, std::cos(bearing)};
        const Pose caster = placed(other, centre, 2.4f * float(b + p), move);
        skin_positions(mesh, caster, caster_position);
        // Traced by the difference of two scenes under the same rays: noise of the self-shadow cancels.
        TriangleSoup soup{position, mesh.triangle};
        AoSettings rays{study.rays, study.seed + 31 * done};
        rays.origin_offset = offset;
        const std::vector<float> alone = trace_ao(soup, {position, normal}, rays);
        const auto first = std::uint32_t(position.size());
        soup.position.insert(soup.position.end(), caster_position.begin(), caster_position.end());
        for (const auto& t : mesh.triangle)
          soup.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
        const std::vector<float> together = trace_ao(soup, {position, normal}, rays);
        const double traced = weighted_mean(alone, area) - weighted_mean(together, area);
        by_composed.darkening_traced += traced / double(poses.size() * study.bearings);
        by_composed.darkening += composed.measure(own, caster) / double(poses.size() * study.bearings);
        grouped.measure(own, caster);
        by_composed.change_of_groups +=
            grouped.squared_difference(composed) / double(poses.size() * study.bearings);
        by_paper.darkening += paper.measure(own, caster) / double(poses.size() * study.bearings);
      }
    }
    by_composed.change_of_groups = std::sqrt(by_composed.change_of_groups);
    by_paper.darkening_traced = by_composed.darkening_traced;
    rows.push_back(by_composed);
    rows.push_back(by_paper);
  }
  return rows;
}

}  // namespace nook::bake
