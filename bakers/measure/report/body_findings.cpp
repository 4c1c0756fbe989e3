#include "bakers/measure/report/body_findings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/character_error.h"

namespace nook::report {
namespace {

using namespace bake;

enum Part { hands, feet, head, arms, legs, trunk, other, part_count };
constexpr const char* names[part_count] = {
    "hands and fingers", "feet", "head and neck", "arms", "legs", "trunk", "other parts"};

Part part_of(JointRole role) {
  switch (role) {
    case JointRole::hand:
    case JointRole::finger:
    case JointRole::thumb:
      return hands;
    case JointRole::foot:
    case JointRole::toe:
      return feet;
    case JointRole::neck:
    case JointRole::head:
    case JointRole::jaw:
    case JointRole::ear:
      return head;
    case JointRole::clavicle:
    case JointRole::upper_arm:
    case JointRole::forearm:
    case JointRole::arm:
      return arms;
    case JointRole::thigh:
    case JointRole::calf:
    case JointRole::leg:
      return legs;
    case JointRole::pelvis:
    case JointRole::spine:
      return trunk;
    case JointRole::wing:
    case JointRole::tail:
    case JointRole::prop:
    case JointRole::helper:
    case JointRole::control:
    case JointRole::other:
      break;
  }
  return other;
}

// A bone without a role belongs to the part of its parent bone.
std::vector<Part> bone_parts(const SkinnedMesh& mesh) {
  const std::vector<Joint> joints = joint_roles(mesh);
  std::vector<Part> parts(joints.size(), other);
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const std::int32_t parent = mesh.bones[b].parent;
    parts[b] = part_of(joints[b].role);
    if (parts[b] == other && parent >= 0) parts[b] = parts[std::size_t(parent)];
  }
  return parts;
}

void sort_by_share(std::vector<NamedError>& errors) {
  std::ranges::stable_sort(
      errors, [](const NamedError& a, const NamedError& b) { return a.error.square > b.error.square; });
}

// Calls see(pose, vertex, error) for each vertex in each pose, unless its ray-traced AO is black (see
// visible_truth).
template <class See>
void for_each_seen(const MeasuredBody& body, See&& see) {
  for (std::size_t t = 0; t < body.poses.size(); ++t)
    for (std::size_t i = 0; i < body.truth.vertex_count; ++i) {
      const double truth = double(body.traced(t, i));
      if (truth >= measure::visible_truth) see(t, i, double(body.model[t][i]) - truth);
    }
}

std::vector<ClipError> clip_errors(const MeasuredBody& body, const std::vector<SeenError>& pose_error) {
  std::vector<ClipError> clips;
  for (const ClipPoses& clip : body.clips) {
    ClipError found{clip.name, {}, clip.first, -1};
    for (std::size_t t = clip.first; t < clip.first + clip.count; ++t) {
      found.error.square += pose_error[t].square;
      found.error.weight += pose_error[t].weight;
      if (pose_error[t].rms() <= found.worst_rms) continue;
      found.worst_pose = t;
      found.worst_rms = pose_error[t].rms();
    }
    clips.push_back(std::move(found));
  }
  std::ranges::stable_sort(
      clips, [](const ClipError& a, const ClipError& b) { return a.error.rms() > b.error.rms(); });
  return clips;
}

float size_of(std::span<const Vec3> points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

// The places are cells of a regular grid over the rest pose, so that no neighbour search is needed.
using Cell = std::tuple<long, long, long>;

bool are_near(const Cell& a, const Cell& b) {
  return std::abs(std::get<0>(a) - std::get<0>(b)) <= 1 && std::abs(std::get<1>(a) - std::get<1>(b)) <= 1 &&
         std::abs(std::get<2>(a) - std::get<2>(b)) <= 1;
}

std::vector<std::vector<std::uint32_t>> worst_cells(const SkinnedMesh& mesh, std::span<const double> square,
                                                    std::size_t count) {
  const double side = std::max(0.05 * double(size_of(mesh.position)), 1e-9);
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 p = mesh.position[i];
    cells[{std::lround(double(p.x) / side), std::lround(double(p.y) / side), std::lround(double(p.z) / side)}]
        .push_back(i);
  }
  std::vector<std::pair<double, Cell>> order;
  for (const auto& [cell, vertices] : cells) {
    double sum = 0;
    for (const std::uint32_t i : vertices) sum += square[i];
    order.emplace_back(-sum, cell);
  }
  std::ranges::sort(order);
  std::vector<Cell> taken;
  std::vector<std::vector<std::uint32_t>> worst;
  for (const auto& [sum, cell] : order) {
    if (worst.size() == count || !(sum < 0)) break;
    if (std::ranges::any_of(taken, [&](const Cell& other_cell) { return are_near(cell, other_cell); }))
      continue;
    taken.push_back(cell);
    worst.push_back(cells[cell]);
  }
  return worst;
}

std::string main_joint(const SkinnedMesh& mesh, std::span<const std::uint32_t> vertices) {
  std::vector<float> weight(mesh.bones.size(), 0.0f);
  for (const std::uint32_t i : vertices)
    for (int s = 0; s < SkinWeights::max_bones; ++s)
      weight[mesh.weights[i].bone[s]] += mesh.weights[i].weight[s];
  return mesh.bones[std::size_t(std::ranges::max_element(weight) - weight.begin())].name;
}

Place place_of(const SkinnedMesh& mesh, const MeasuredBody& body, std::span<const float> area,
               std::vector<std::uint32_t> vertices, std::span<const double> square, double all) {
  Place place;
  place.joint = main_joint(mesh, vertices);
  double worst = -1;
  for (std::size_t t = 0; t < body.poses.size(); ++t) {
    SeenError error;
    for (const std::uint32_t i : vertices) {
      const double truth = double(body.traced(t, i));
      if (truth >= measure::visible_truth) error.add(double(body.model[t][i]) - truth, double(area[i]));
    }
    if (error.square <= worst) continue;
    worst = error.square;
    place.worst_pose = t;
    place.rms = error.rms();
  }
  for (const std::uint32_t i : vertices) place.share += square[i] / all;
  place.vertices = std::move(vertices);
  return place;
}

}  // namespace

double SeenError::rms() const {
  return weight > 0 ? std::sqrt(square / weight) : 0;
}

std::vector<std::string> part_names() {
  return {std::begin(names), std::end(names)};
}

BodyFindings find_errors(const SkinnedMesh& mesh, const MeasuredBody& body, std::size_t max_places) {
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const std::vector<Part> part = bone_parts(mesh);
  std::vector<SeenError> vertex(mesh.vertex_count()), pose(body.poses.size());
  BodyFindings found;
  for_each_seen(body, [&](std::size_t t, std::size_t i, double error) {
    pose[t].add(error, double(area[i]));
    vertex[i].add(error, double(area[i]));
    found.all.add(error, double(area[i]));
    found.bias += error * double(area[i]);
  });
  if (found.all.weight > 0) found.bias /= found.all.weight;

  std::vector<NamedError> parts, joints;
  for (const char* name : names) parts.push_back({name, {}});
  for (const Bone& bone : mesh.bones) joints.push_back({bone.name, {}});
  std::vector<double> square;
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    const std::size_t bone = mesh.weights[i].bone[0];
    for (SeenError* sum : {&parts[std::size_t(part[bone])].error, &joints[bone].error}) {
      sum->square += vertex[i].square;
      sum->weight += vertex[i].weight;
    }
    square.push_back(vertex[i].square);
    found.vertex_rms.push_back(float(vertex[i].rms()));
  }
  std::erase_if(parts, [](const NamedError& p) { return p.error.weight == 0; });
  std::erase_if(joints, [](const NamedError& j) { return j.error.weight == 0; });
  sort_by_share(parts);
  sort_by_share(joints);
  found.parts = std::move(parts);
  found.joints = std::move(joints);
  found.clips = clip_errors(body, pose);
  for (std::vector<std::uint32_t>& cell : worst_cells(mesh, square, max_places))
    found.places.push_back(place_of(mesh, body, area, std::move(cell), square, found.all.square));
  return found;
}

}  // namespace nook::report
