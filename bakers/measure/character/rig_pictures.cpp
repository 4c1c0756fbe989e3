#include "bakers/measure/character/rig_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace nook::measure {
namespace {

using namespace bake;

constexpr int width_px = 560, height_px = 560;
constexpr std::size_t side_count = 2;

// The roles of bones in the same limb have similar hues.
constexpr std::array<Colour, joint_role_count> colours{{
    {0.60f, 0.60f, 0.60f},  // other
    {0.30f, 0.30f, 0.85f},  // pelvis
    {0.40f, 0.55f, 0.95f},  // spine
    {0.45f, 0.80f, 0.95f},  // neck
    {0.75f, 0.90f, 0.98f},  // head
    {0.45f, 0.65f, 0.30f},  // clavicle
    {0.55f, 0.80f, 0.25f},  // upper_arm
    {0.70f, 0.90f, 0.35f},  // forearm
    {0.95f, 0.85f, 0.30f},  // hand
    {0.98f, 0.70f, 0.30f},  // finger
    {0.90f, 0.60f, 0.20f},  // thumb
    {0.80f, 0.30f, 0.25f},  // thigh
    {0.90f, 0.45f, 0.35f},  // calf
    {0.55f, 0.20f, 0.15f},  // foot
    {0.75f, 0.35f, 0.50f},  // toe
    {0.90f, 0.40f, 0.30f},  // leg
    {0.60f, 0.85f, 0.30f},  // arm
    {0.25f, 0.75f, 0.60f},  // wing
    {0.65f, 0.40f, 0.85f},  // tail
    {0.95f, 0.55f, 0.75f},  // jaw
    {0.98f, 0.75f, 0.85f},  // ear
    {0.35f, 0.25f, 0.10f},  // prop
    {0.80f, 0.80f, 0.65f},  // helper
    {0.20f, 0.20f, 0.20f},  // control
}};

// The picture is drawn with one value per face, (role * side_count + side) / pairs. The value selects the
// colour.
constexpr float pairs = float(joint_role_count * side_count);

Colour colour_of_value(float value) {
  const auto pair = std::min(std::size_t(std::max(0.0f, value) * pairs), std::size_t(pairs) - 1);
  Colour colour = colours[pair / side_count];
  if (pair % side_count)
    for (float& c : colour) c *= 0.75f;
  return colour;
}

// A copy of the mesh in which faces do not share corners, so that colours change sharply at edges.
struct ColouredFaces {
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Vec3> position;
  std::vector<float> value;
};

ColouredFaces coloured_faces(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  ColouredFaces faces;
  for (const auto& t : mesh.triangle) {
    const Joint& joint = joints[mesh.weights[t[0]].bone[0]];
    const float value =
        (float(joint.role) * side_count + (joint.side == Side::right ? 1.0f : 0.0f) + 0.5f) / pairs;
    const auto first = std::uint32_t(faces.position.size());
    faces.triangle.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) {
      faces.position.push_back(mesh.position[v]);
      faces.value.push_back(value);
    }
  }
  return faces;
}

}  // namespace

Colour colour_of(JointRole role) {
  return colours[std::size_t(role)];
}

void write_rig_picture(const std::filesystem::path& directory, const SkinnedMesh& mesh,
                       std::span<const Joint> joints) {
  const ColouredFaces faces = coloured_faces(mesh, joints);
  Vec3 low = mesh.position.front(), high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::vector<Picture> panels;
  for (const Vec3 towards : {Vec3{0.8f, 0.35f, 0.6f}, Vec3{-0.8f, 0.35f, -0.6f}}) {
    const BodyCamera camera{0.5f * (low + high), normalised(towards), 1.05f * length(high - low) / width_px};
    panels.push_back(BodyView(faces.triangle, faces.position, camera, width_px, height_px)
                         .draw(faces.value, colour_of_value, 0.5f));
  }
  std::filesystem::create_directories(directory);
  write_png(directory / "rig.png", side_by_side(panels));
}

}  // namespace nook::measure
