#include "bakers/measure/character/rig_report.h"

#include <algorithm>

#include "bakers/character/auto_poses.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/recipe.h"
#include "bakers/character/rig_geometry.h"
#include "bakers/character/torn_edges.h"

namespace nook::measure {

namespace {

using namespace bake;
using Row = nlohmann::ordered_json;

constexpr const char* side_names[] = {"", "left", "right"};

Row name_or_nothing(const SkinnedMesh& mesh, std::int32_t bone) {
  return bone >= 0 ? Row(mesh.bones[std::size_t(bone)].name) : Row();
}

}  // namespace

nlohmann::ordered_json bone_rows(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  const std::vector<Joint> joints = joint_roles(mesh, corrections);
  const BodyTree tree = body_tree(mesh, joints);
  const BodySides sides = body_sides(mesh, tree.parent);
  std::vector<std::size_t> vertices(mesh.bones.size(), 0);
  for (const SkinWeights& w : mesh.weights) ++vertices[w.bone[0]];
  Row rows = Row::array();
  for (std::size_t b = 0; b < joints.size(); ++b) {
    Row row;
    row["bone"] = mesh.bones[b].name;
    row["role"] = name_of(joints[b].role);
    row["side"] = side_names[std::size_t(joints[b].side)];
    row["limb"] = joints[b].limb >= 0 ? Row(joints[b].limb) : Row();
    const bool own = sides.partner[b] == std::int32_t(b);
    row["partner"] = own ? Row("in the middle") : name_or_nothing(mesh, sides.partner[b]);
    row["parent"] = name_or_nothing(mesh, tree.parent[b]);
    row["moved"] = tree.parent[b] != mesh.bones[b].parent;
    row["vertices"] = vertices[b];
    rows.push_back(std::move(row));
  }
  return rows;
}

nlohmann::ordered_json torn_edge_rows(const ImportedCharacter& character, const RigCorrections& corrections,
                                      std::uint64_t seed) {
  constexpr std::size_t automatic_count = 60;
  const SkinnedMesh& mesh = character.mesh;
  const std::vector<Joint> joints = joint_roles(mesh, corrections);
  const double of_clips = torn_by_clips(character);
  const std::vector<Pose> made =
      auto_poses(mesh, vertex_areas(mesh, mesh.position), automatic_count, seed, corrections, of_clips);
  Row row;
  row["plan"] = is_person(mesh, joints) ? "person" : "by geometry";
  row["bones_without_role"] =
      std::count_if(joints.begin(), joints.end(), [](const Joint& j) { return j.role == JointRole::other; });
  row["automatic_poses"] = made.size();
  row["torn_edges"] = torn_share(mesh, made);
  row["torn_edges_of_clips"] = motion_clips(character).empty() ? Row() : Row(of_clips);
  return Row::array({row});
}

}  // namespace nook::measure
