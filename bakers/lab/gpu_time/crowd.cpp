#include "bakers/lab/gpu_time/crowd.h"

#include <cmath>

#include "platform/file_bytes.h"
#include "sdk/src/core/vec.h"

namespace nook::lab {

using namespace measure;

Crowd::Crowd(const NookGl& gl, const std::filesystem::path& model, std::uint32_t count, float spacing)
    : spacing_(spacing) {
  const std::vector<unsigned char> bytes = platform::read_file(model);
  succeed(nook_model_load(gl.context(), bytes.data(), bytes.size(), &model_));
  nook_model_info info{};
  info.struct_size = sizeof info;
  succeed(nook_model_describe(model_, &info));
  bone_count_ = info.bone_count;
  vertex_count_ = info.file_vertex_count;
  nook_scene_desc desc;
  succeed(nook_scene_desc_init(&desc));
  succeed(nook_scene_create(gl.context(), &desc, &scene_));
  const float ground[4] = {0, 1, 0, 0};
  for (std::uint32_t i = 0; i < count; ++i) {
    succeed(nook_scene_add_instance(scene_, model_, &bodies_.emplace_back()));
    succeed(nook_scene_set_ground(scene_, bodies_.back(), ground));
  }
}

Crowd::~Crowd() {
  nook_scene_destroy(&scene_);
  nook_model_destroy(&model_);
}

void Crowd::pose(std::uint32_t k) {
  ++frame_;
  const auto side = std::uint32_t(std::ceil(std::sqrt(double(bodies_.size()))));
  std::vector<Mat3x4> bones(bone_count_);
  nook_pose_desc pose;
  succeed(nook_pose_desc_init(&pose));
  pose.kind = NOOK_POSE_REST_TO_WORLD;
  pose.layout = NOOK_TRANSFORM_ROWS_3X4;
  pose.transforms = bones.front().m;
  pose.transform_count = bone_count_;
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const float angle = 0.01f * float(frame_) + float(i), c = std::cos(angle), s = std::sin(angle);
    const float x = (float(i % side) - 0.5f * float(side - 1)) * spacing_,
                z = (float(i / side) - 0.5f * float(side - 1)) * spacing_;
    for (Mat3x4& bone : bones) bone = {{c, 0, s, x, 0, 1, 0, 0, -s, 0, c, z}};
    succeed(nook_scene_set_pose(scene_, bodies_[i], &pose));
  }
  if (k > 0) succeed(nook_scene_link_nearest(scene_, k, 4 * spacing_));
}

}  // namespace nook::lab
