#include "bakers/measure/character/pictures.h"

#include <algorithm>
#include <cmath>

#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/evaluate.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr int width_px = 420, height_px = 760, pair_width_px = 560;
constexpr float error_gain = 4;  // 0.25 of AO is the far end of the colour ramp

Picture draw_pose(const SkinnedMesh& mesh, const Pose& pose, std::span<const float> traced,
                  std::span<const float> predicted) {
  std::vector<Vec3> posed;
  skin_positions(mesh, pose, posed);
  std::vector<float> error(traced.size());
  for (std::size_t i = 0; i < error.size(); ++i) error[i] = error_gain * std::fabs(traced[i] - predicted[i]);
  std::vector<Picture> panels;
  for (BodySide side : {BodySide::front, BodySide::back}) {
    const BodyView view(mesh.triangle, posed, side, width_px, height_px);
    panels.push_back(view.draw(traced, grey));
    panels.push_back(view.draw(predicted, grey));
    panels.push_back(view.draw(error, viridis));
  }
  return side_by_side(panels);
}

Picture draw_rms(const SkinnedMesh& mesh, std::span<const float> vertex_rms) {
  std::vector<float> scaled(vertex_rms.begin(), vertex_rms.end());
  for (float& value : scaled) value *= error_gain;
  std::vector<Picture> panels;
  for (BodySide side : {BodySide::front, BodySide::back})
    panels.push_back(BodyView(mesh.triangle, mesh.position, side, width_px, height_px).draw(scaled, viridis));
  return side_by_side(panels);
}

// The vertices of both bodies, the receiver's first.
struct DrawnPair {
  TriangleSoup soup;
  std::vector<float> traced, predicted, error;
};

DrawnPair drawn_pair(const SkinnedMesh& mesh, const CharacterModel& model, const BodyPair& pair,
                     const CasterStudy& study) {
  DrawnPair drawn;
  for (const BodyPair& side : {pair, BodyPair{pair.caster, pair.receiver}}) {
    const auto first = std::uint32_t(drawn.soup.position.size());
    std::vector<Vec3> posed;
    skin_positions(mesh, side.receiver, posed);
    drawn.soup.position.insert(drawn.soup.position.end(), posed.begin(), posed.end());
    for (const auto& t : mesh.triangle)
      drawn.soup.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
    const std::vector<float> traced = trace_pair(mesh, side, study.rays, study.seed).together,
                             predicted = linked_ao(model, side);
    for (std::size_t i = 0; i < traced.size(); ++i) {
      drawn.traced.push_back(traced[i]);
      drawn.predicted.push_back(predicted[i]);
      drawn.error.push_back(error_gain * std::fabs(traced[i] - predicted[i]));
    }
  }
  return drawn;
}

// Holds both bodies from any side.
BodyCamera pair_camera(std::span<const Vec3> position, Vec3 towards) {
  Vec3 low = position[0], high = position[0];
  for (const Vec3 p : position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float wide = std::hypot(high.x - low.x, high.z - low.z), tall = high.y - low.y;
  constexpr float margin = 1.04f;
  return {(low + high) * 0.5f, towards,
          margin * std::max(wide / float(pair_width_px), tall / float(height_px))};
}

// Obliquely, because one body hides the other where both stand in a row.
Picture draw_pair(const DrawnPair& pair) {
  std::vector<Picture> panels;
  for (const Vec3 towards : {Vec3{0.8f, 0, 0.6f}, Vec3{-0.8f, 0, -0.6f}}) {
    const BodyView view(pair.soup.triangle, pair.soup.position, pair_camera(pair.soup.position, towards),
                        pair_width_px, height_px);
    panels.push_back(view.draw(pair.traced, grey));
    panels.push_back(view.draw(pair.predicted, grey));
    panels.push_back(view.draw(pair.error, viridis));
  }
  return side_by_side(panels);
}

}  // namespace

void write_pair_picture(const std::filesystem::path& path, const SkinnedMesh& mesh,
                        const CharacterModel& model, const BodyPair& pair, const CasterStudy& study) {
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
  write_png(path, draw_pair(drawn_pair(mesh, model, pair, study)));
}

void write_pictures(const std::filesystem::path& directory, const SkinnedMesh& mesh,
                    const CharacterModel& model, std::span<const Pose> poses, std::size_t count,
                    std::span<const float> vertex_rms, std::uint32_t rays, std::uint64_t seed) {
  std::filesystem::create_directories(directory);
  std::vector<Pose> picked;
  count = std::min(count, poses.size());
  for (std::size_t i = 0; i < count; ++i) picked.push_back(poses[(2 * i + 1) * poses.size() / (2 * count)]);
  const AoTargets targets = trace_character_ao(mesh, picked, rays, seed);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<float> traced;
    for (std::uint16_t value : targets.row(i)) traced.push_back(float(value) * AoTargets::scale);
    write_png(directory / ("pose_" + std::to_string(i) + ".png"),
              draw_pose(mesh, picked[i], traced, predict_ao(model, picked[i])));
  }
  write_png(directory / "rms.png", draw_rms(mesh, vertex_rms));
}

}  // namespace nook::measure
