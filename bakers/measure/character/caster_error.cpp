#include "bakers/measure/character/caster_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/character/rotation.h"
#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

// Turns the pose about the vertical axis through the body's centre, then moves it along the ground.
Pose placed(const Pose& pose, Vec3 centre, float yaw_radians, Vec3 move) {
  Mat3x4 place = rotation_about(centre, {0, yaw_radians, 0});
  place.m[3] += move.x;
  place.m[7] += move.y;
  place.m[11] += move.z;
  Pose out;
  for (const Mat3x4& m : pose) out.push_back(place * m);
  return out;
}

// Returns the AO of a receiver with one linked caster, for each welded vertex.
class LinkedPair {
 public:
  LinkedPair(const CharacterModel& model, nook_form combine, float far_error)
      : memory_(default_memory()),
        scene_(settings(combine, far_error), Parallel{}, memory_),
        welded_to_file_(model.vertex_count()) {
    const Ref<const LoadedModel> loaded =
        Owned<LoadedModel>::make(memory_, Ref<const RefCounted>(), CharacterModel(model), memory_);
    receiver_ = add_instance(scene_, loaded);
    caster_ = add_instance(scene_, loaded);
    link(scene_, receiver_, caster_);
    file_ao_.resize(model.file_to_welded.size());
    for (std::size_t i = 0; i < file_ao_.size(); ++i) welded_to_file_[model.file_to_welded[i]] = i;
  }

  void pose(const BodyPair& pair) {
    set_pose(scene_, receiver_, pair.receiver);
    set_pose(scene_, caster_, pair.caster);
  }
  std::vector<float> ao_by(std::uint32_t terms) {
    scene_.terms = terms;
    update(scene_);
    read_ao(scene_, instance_of(scene_, receiver_), file_ao_.data(), sizeof(float));
    std::vector<float> ao;
    for (const std::size_t file : welded_to_file_) ao.push_back(file_ao_[file]);
    return ao;
  }
  std::vector<float> together() { return ao_by(NOOK_TERM_SELF | NOOK_TERM_LINKS); }
  std::vector<float> darkening() {
    std::vector<float> dark = ao_by(NOOK_TERM_SELF);
    const std::vector<float> with_caster = together();
    for (std::size_t i = 0; i < dark.size(); ++i) dark[i] -= with_caster[i];
    return dark;
  }

 private:
  static SceneSettings settings(nook_form combine, float far_error) {
    SceneSettings s;
    s.form = combine;
    s.cutoff_error = 0;
    s.far_error = far_error;
    return s;
  }

  Memory* memory_;
  Scene scene_;
  std::vector<std::size_t> welded_to_file_;
  std::vector<float> file_ao_;
  nook_instance_id receiver_ = 0, caster_ = 0;
};

// Returns true for each vertex of the receiver that lies outside the caster. If a vertex is inside a closed
// body, nearly all rays in all directions hit that body. A few rays escape through openings at hair and
// cuffs.
std::vector<bool> outside_caster(const SkinnedMesh& mesh, const BodyPair& pair, std::uint64_t seed) {
  constexpr float covered = 0.1f;
  constexpr std::uint32_t rays = 64;
  TriangleSoup soup;
  skin_positions(mesh, pair.caster, soup.position);
  soup.triangle = mesh.triangle;
  const RayScene caster(soup);
  std::vector<Vec3> position, normal, behind;
  skin_positions(mesh, pair.receiver, position);
  posed_normals(mesh, pair.receiver, position, normal);
  for (const Vec3 n : normal) behind.push_back(-n);
  AoSettings settings{rays, seed};
  settings.origin_offset = ray_origin_offset(mesh.position);
  const std::vector<float> before = trace_ao(caster, {position, normal}, settings),
                           after = trace_ao(caster, {position, behind}, settings);
  std::vector<bool> outside(position.size());
  for (std::size_t i = 0; i < outside.size(); ++i) outside[i] = before[i] > covered || after[i] > covered;
  return outside;
}

// Sums over the vertices of pairs, weighted by the area of each vertex.
struct Sums {
  double area = 0, dark = 0, traced = 0, squared = 0, none = 0;
  double darkened_area = 0, darkened_squared = 0;

  // traced_1 and traced_2 are the darkening as traced by each half of the rays. A product of errors against
  // both halves has no noise floor.
  void add(double weight, double darkening, double traced_1, double traced_2) {
    area += weight;
    dark += weight * darkening;
    traced += weight * (traced_1 + traced_2) / 2;
    const double error = (darkening - traced_1) * (darkening - traced_2);
    squared += weight * error;
    none += weight * traced_1 * traced_2;
    if ((traced_1 + traced_2) / 2 < double(CasterRow::darkened_from)) return;
    darkened_area += weight;
    darkened_squared += weight * error;
  }
  void write(CasterRow& row) const {
    if (!(area > 0)) return;  // the whole body is inside the other one
    row.darkening = dark / area;
    row.darkening_traced = traced / area;
    row.mse_over_none = none > 0 ? squared / none : 0;
    row.rms_darkened = darkened_area > 0 ? std::sqrt(std::max(darkened_squared / darkened_area, 0.0)) : 0;
  }
};

// Measures all pairs at one distance.
class CasterDistance {
 public:
  CasterDistance(const SkinnedMesh& mesh, const CharacterModel& model)
      : mesh_(mesh),
        area_(vertex_areas(mesh, mesh.position)),
        radius_m_(model.bounding_radius),
        composed_(model, NOOK_FORM_DEFAULT, 0),
        paper_(model, NOOK_FORM_PAPER, 0),
        grouped_(model, NOOK_FORM_DEFAULT, SceneSettings().far_error) {}

  void add(const BodyPair& pair, std::uint32_t rays, std::uint64_t seed) {
    const TracedPair first = trace_pair(mesh_, pair, (rays + 1) / 2, seed),
                     second = trace_pair(mesh_, pair, (rays + 1) / 2, ~seed);
    const std::vector<bool> outside = outside_caster(mesh_, pair, seed);
    for (LinkedPair* scene : {&composed_, &paper_, &grouped_}) scene->pose(pair);
    const std::vector<float> by_composed = composed_.darkening(), by_paper = paper_.darkening(),
                             exact = composed_.together(), with_groups = grouped_.together();
    for (std::size_t i = 0; i < area_.size(); ++i) {
      const double area = double(area_[i]), change = double(with_groups[i] - exact[i]);
      all_area_ += area;
      change_ += area * change * change;
      if (!outside[i]) {
        inside_area_ += area;
        continue;
      }
      const double one = double(first.alone[i] - first.together[i]),
                   two = double(second.alone[i] - second.together[i]);
      composed_sums_.add(area, double(by_composed[i]), one, two);
      paper_sums_.add(area, double(by_paper[i]), one, two);
    }
  }
  // Appends the rows for the pairs that were added since the last call.
  void finish(float distance_m, std::vector<CasterRow>& rows) {
    CasterRow by_composed, by_paper;
    by_composed.form = "composed";
    by_paper.form = "paper";
    composed_sums_.write(by_composed);
    paper_sums_.write(by_paper);
    by_composed.change_of_groups = std::sqrt(change_ / all_area_);
    for (CasterRow* row : {&by_composed, &by_paper}) {
      row->distance_m = distance_m;
      row->distance_radii = distance_m / radius_m_;
      row->share_inside = inside_area_ / all_area_;
      rows.push_back(*row);
    }
    composed_sums_ = paper_sums_ = {};
    all_area_ = inside_area_ = change_ = 0;
  }

 private:
  const SkinnedMesh& mesh_;
  std::vector<float> area_;
  float radius_m_;
  LinkedPair composed_, paper_, grouped_;
  Sums composed_sums_, paper_sums_;
  double all_area_ = 0, inside_area_ = 0, change_ = 0;
};

}  // namespace

float distance_in_metres(const CasterStudy& study, const CharacterModel& model, float distance) {
  return study.in_radii ? distance * model.bounding_radius : distance;
}

BodyPair body_pair(const CharacterModel& model, std::span<const Pose> poses, std::size_t p,
                   std::size_t bearing, std::size_t bearings, float distance_m) {
  const Pose& own = poses[p];
  const Pose& other = poses[(p + 1) % poses.size()];
  const Vec3 centre = transform_point(other[model.root_bone], model.bounding_centre),
             own_centre = transform_point(own[model.root_bone], model.bounding_centre);
  const float angle =
      2 * std::numbers::pi_v<float> * (float(bearing) + 0.5f * float(p % 2)) / float(bearings);
  const Vec3 move = Vec3{own_centre.x - centre.x, 0, own_centre.z - centre.z} +
                    distance_m * Vec3{std::sin(angle), 0, std::cos(angle)};
  return {own, placed(other, centre, 2.4f * float(bearing + p), move)};
}

BodyPair body_pair(const CharacterModel& model, const Pose& receiver, const Pose& caster, Vec3 offset,
                   float yaw_radians) {
  const Vec3 centre = transform_point(caster[model.root_bone], model.bounding_centre);
  return {receiver,
          placed(caster, centre, yaw_radians,
                 transform_point(receiver[model.root_bone], model.bounding_centre) + offset - centre)};
}

TracedPair trace_pair(const SkinnedMesh& mesh, const BodyPair& pair, std::uint32_t rays, std::uint64_t seed) {
  TriangleSoup soup, caster;
  std::vector<Vec3> normal;
  skin_positions(mesh, pair.receiver, soup.position);
  skin_positions(mesh, pair.caster, caster.position);
  soup.triangle = caster.triangle = mesh.triangle;
  posed_normals(mesh, pair.receiver, soup.position, normal);
  const std::vector<Vec3> position = soup.position;
  AoSettings settings{rays, seed};
  settings.origin_offset = ray_origin_offset(mesh.position);
  TracedPair traced;
  traced.alone = trace_ao(soup, {position, normal}, settings);
  const auto first = std::uint32_t(position.size());
  soup.position.insert(soup.position.end(), caster.position.begin(), caster.position.end());
  for (const auto& t : mesh.triangle) soup.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
  traced.together = trace_ao(soup, {position, normal}, settings);
  return traced;
}

std::vector<float> linked_ao(const CharacterModel& model, const BodyPair& pair) {
  LinkedPair linked(model, NOOK_FORM_DEFAULT, 0);
  linked.pose(pair);
  return linked.together();
}

std::vector<CasterRow> measure_casters(const SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const Pose> poses, const CasterStudy& study,
                                       const Progress& progress) {
  CasterDistance measured(mesh, model);
  std::vector<CasterRow> rows;
  std::size_t done = 0;
  const std::size_t total = study.distances.size() * poses.size() * study.bearings;
  for (const float distance : study.distances) {
    const float distance_m = distance_in_metres(study, model, distance);
    for (std::size_t p = 0; p < poses.size(); ++p)
      for (std::size_t b = 0; b < study.bearings; ++b) {
        if (progress && !progress(done++, total))
          throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring casters");
        measured.add(body_pair(model, poses, p, b, study.bearings, distance_m), study.rays,
                     study.seed + 31 * (done + 1));
      }
    measured.finish(distance_m, rows);
  }
  return rows;
}

std::vector<CasterRow> measure_pair(const SkinnedMesh& mesh, const CharacterModel& model,
                                    const BodyPair& pair, const CasterStudy& study) {
  CasterDistance measured(mesh, model);
  const auto centre = [&](const Pose& pose) {
    return transform_point(pose[model.root_bone], model.bounding_centre);
  };
  const Vec3 apart = centre(pair.caster) - centre(pair.receiver);
  measured.add(pair, study.rays, study.seed);
  measured.add({pair.caster, pair.receiver}, study.rays, study.seed + 1);
  std::vector<CasterRow> rows;
  measured.finish(std::hypot(apart.x, apart.z), rows);
  return rows;
}

}  // namespace nook::measure
