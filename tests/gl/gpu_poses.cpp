#include "tests/gl/gpu_poses.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/core/floats.h"

namespace nook::test {
namespace {

std::uint32_t numbers_of(nook_transform_layout layout) {
  constexpr std::uint32_t numbers[] = {12, 16, 16, 12, 8, 10};
  return numbers[layout];
}

Motion random_motion(Numbers& numbers, bool scales) {
  const Vec3 axis = numbers.direction();
  const float half = numbers.between(-0.5f, 0.5f), s = std::sin(half);
  return {{axis.x * s, axis.y * s, axis.z * s, std::cos(half)},
          scales ? numbers.between(0.8f, 1.2f) : 1,
          numbers.place(0.1f)};
}

nook_pose_desc desc_of(const Transforms& t) {
  nook_pose_desc desc;
  NOOK_OK_OR_FAIL(nook_pose_desc_init(&desc));
  desc.kind = t.kind;
  desc.layout = t.layout;
  desc.skin = t.skin;
  desc.transform_count = t.count;
  desc.flags = t.flags;
  if (!t.transform_of_bone.empty()) {
    desc.transform_of_bone = t.transform_of_bone.data();
    desc.bone_count = static_cast<std::uint32_t>(t.transform_of_bone.size());
  }
  return desc;
}

}  // namespace

HostBuffer::HostBuffer(const GladGLContext& gl, std::span<const std::byte> bytes) : gl_(gl) {
  gl.GenBuffers(1, &name_);
  gl.BindBuffer(GL_ARRAY_BUFFER, name_);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_DYNAMIC_DRAW);
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

std::vector<float> written(const Motion& m, nook_transform_layout layout) {
  const float x = m.turn[0], y = m.turn[1], z = m.turn[2], w = m.turn[3], s = m.scale;
  const float r[9] = {
      s * (1 - 2 * (y * y + z * z)), s * 2 * (x * y - z * w),       s * 2 * (x * z + y * w),
      s * 2 * (x * y + z * w),       s * (1 - 2 * (x * x + z * z)), s * 2 * (y * z - x * w),
      s * 2 * (x * z - y * w),       s * 2 * (y * z + x * w),       s * (1 - 2 * (x * x + y * y))};
  const Vec3 t = m.move;
  switch (layout) {
    case NOOK_TRANSFORM_ROWS_3X4:
      return {r[0], r[1], r[2], t.x, r[3], r[4], r[5], t.y, r[6], r[7], r[8], t.z};
    case NOOK_TRANSFORM_ROWS_4X4:
      return {r[0], r[1], r[2], t.x, r[3], r[4], r[5], t.y, r[6], r[7], r[8], t.z, 0, 0, 0, 1};
    case NOOK_TRANSFORM_COLUMNS_4X4:
      return {r[0], r[3], r[6], 0, r[1], r[4], r[7], 0, r[2], r[5], r[8], 0, t.x, t.y, t.z, 1};
    case NOOK_TRANSFORM_COLUMNS_4X3:
      return {r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8], t.x, t.y, t.z};
    case NOOK_TRANSFORM_DUAL_QUATERNION:
      // The dual part is half the product of the translation, as a quaternion, and the rotation.
      return {x,
              y,
              z,
              w,
              0.5f * (t.x * w + t.y * z - t.z * y),
              0.5f * (-t.x * z + t.y * w + t.z * x),
              0.5f * (t.x * y - t.y * x + t.z * w),
              -0.5f * (t.x * x + t.y * y + t.z * z)};
    default:
      return {t.x, t.y, t.z, x, y, z, w, s, s, s};
  }
}

std::vector<std::uint32_t> CrowdPoses::words(std::size_t before) const {
  const std::size_t one = numbers_of(transforms.layout), count = numbers.size() / one;
  const bool is_half = transforms.format == NOOK_FORMAT_HALF;
  const std::size_t stride = transforms.stride ? transforms.stride : one * (is_half ? 2 : 4);
  constexpr std::uint32_t garbage = 0x7fc00000u;  // NaN
  std::vector<std::uint32_t> out(before + first_transform(count / transforms.count) * stride / 4, garbage);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < one; ++k) {
      char* const at = reinterpret_cast<char*>(out.data() + before) +
                       (first_transform(i / transforms.count) + i % transforms.count) * stride;
      if (is_half) {
        const std::uint16_t half = to_half(numbers[i * one + k]);
        std::memcpy(at + 2 * k, &half, 2);
      } else {
        std::memcpy(at + 4 * k, &numbers[i * one + k], 4);
      }
    }
  return out;
}

CrowdPoses random_poses(const Transforms& transforms, std::size_t instances, Vec3 offset) {
  CrowdPoses poses{transforms, {}, {}};
  Numbers numbers(77);
  const bool scales = transforms.layout != NOOK_TRANSFORM_DUAL_QUATERNION;
  const auto side = static_cast<std::size_t>(1 + std::sqrt(double(instances)));
  for (std::size_t i = 0; i < instances; ++i) {
    for (std::uint32_t t = 0; t < transforms.count; ++t)
      for (const float number : written(random_motion(numbers, scales), transforms.layout))
        poses.numbers.push_back(number);
    const Mat3x4 turned = random_frame(numbers, 1);
    std::array<float, 12> place;
    std::copy_n(turned.m, 12, place.begin());
    place[3] += offset.x + 1.1f * static_cast<float>(i % side);
    place[7] += offset.y;
    place[11] += offset.z + 1.1f * static_cast<float>(i / side);
    poses.places.push_back(place);
  }
  return poses;
}

nook_pose_desc pose_of(const CrowdPoses& poses, std::size_t i) {
  nook_pose_desc desc = desc_of(poses.transforms);
  desc.transforms = poses.numbers.data() + i * poses.transforms.count * numbers_of(desc.layout);
  desc.place_3x4 = poses.places[i].data();
  return desc;
}

void pose_on_cpu(const Crowd& crowd, const CrowdPoses& poses) {
  for (std::size_t i = 0; i < crowd.ids.size(); ++i) {
    const nook_pose_desc desc = pose_of(poses, i);
    NOOK_OK_OR_FAIL(nook_scene_set_pose(crowd.scene, crowd.ids[i], &desc));
  }
}

std::vector<Mat3x4> converted(nook_model model, const CrowdPoses& poses, std::size_t i) {
  const nook_pose_desc desc = pose_of(poses, i);
  nook_model_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_model_describe(model, &info));
  std::vector<Mat3x4> bones(info.bone_count);
  NOOK_OK_OR_FAIL(nook_model_convert_pose(model, &desc, bones.data()->m, info.bone_count));
  return bones;
}

float largest_scale(const std::vector<Mat3x4>& bones) {
  float longest_squared = 0;
  for (const Mat3x4& m : bones) longest_squared = std::max(longest_squared, axes_of(m).longest_squared);
  return std::sqrt(longest_squared);
}

nook_gl_instance_pose told_of(const Crowd& on_gpu, const Crowd& on_cpu, const CrowdPoses& poses,
                              std::size_t i) {
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_scene_describe_instance(on_cpu.scene, on_cpu.ids[i], &info));
  nook_gl_instance_pose pose{};
  pose.instance = on_gpu.ids[i];
  pose.first_transform = poses.first_transform(i);
  std::copy_n(info.bound_centre_ws, 3, pose.bound_centre_ws);
  pose.bound_radius = info.bound_radius;
  std::copy_n(poses.places[i].begin(), 12, pose.place_3x4);
  return pose;
}

std::vector<nook_gl_instance_pose> told(const Crowd& on_gpu, const Crowd& on_cpu, nook_model model,
                                        const CrowdPoses& poses) {
  std::vector<nook_gl_instance_pose> out;
  for (std::size_t i = 0; i < on_gpu.ids.size(); ++i) {
    out.push_back(told_of(on_gpu, on_cpu, poses, i));
    out.back().scale = largest_scale(converted(model, poses, i));
  }
  return out;
}

Call::Call(const GladGLContext& gl, const CrowdPoses& from, std::size_t before)
    : words(from.words(before)), buffer(gl, std::as_bytes(std::span(words))), desc(desc_of(from.transforms)) {
  desc.stride = from.transforms.stride;
  poses.struct_size = sizeof poses;
  poses.format = from.transforms.format;
  poses.buffer = buffer.name();
  poses.offset = 4 * before;
  poses.size = 4 * (words.size() - before);
}

nook_result Call::operator()(nook_gl gl, const Crowd& crowd,
                             const std::vector<nook_gl_instance_pose>& instances) {
  poses.pose = &desc;
  return nook_gl_scene_set_poses(gl, crowd.scene, &poses, instances.data(),
                                 static_cast<std::uint32_t>(instances.size()));
}

Twins::Twins(platform::Context& of, const CrowdOptions& options, nook_gl_proc_fn loader, void* user,
             nook_gl_state_mode mode, SampleSize size)
    : context(of),
      model(load_model(host.handle, sample_model(31, size))),
      on_cpu(host.handle, {model}, {5}, options),
      on_gpu(host.handle, {model}, {5}, options),
      gl(create_gl(host.handle, loader ? loader : platform::Context::loader, loader ? user : &of, 0, mode)) {}

Twins::~Twins() {
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}

std::vector<nook_gl_instance_pose> Twins::told_of(const CrowdPoses& poses) const {
  return told(on_gpu, on_cpu, model, poses);
}

void Twins::set(const CrowdPoses& poses) {
  Call call(context.gl(), poses, 3);  // no alignment of storage buffers divides three words
  NOOK_OK_OR_FAIL(call(gl, on_gpu, told_of(poses)));
}

float Twins::difference(const CrowdPoses& poses) {
  pose_on_cpu(on_cpu, poses);
  set(poses);
  return difference();
}

float Twins::difference() {
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_cpu.scene));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
  float largest = 0;
  for (std::size_t i = 0; i < on_cpu.ids.size(); ++i)
    largest =
        std::max(largest, largest_difference(gpu_ao(gl, on_gpu, model, i), gpu_ao(gl, on_cpu, model, i)));
  return largest;
}

double Error::rms() const {
  return std::sqrt(squares / double(count));
}

void Error::add(const std::vector<float>& a, const std::vector<float>& b) {
  largest = std::max(largest, largest_difference(a, b));
  for (std::size_t i = 0; i < a.size(); ++i) squares += double(a[i] - b[i]) * double(a[i] - b[i]);
  count += a.size();
}

bool says(const char* text) {
  return std::string_view(nook_last_message()).find(text) != std::string_view::npos;
}

}  // namespace nook::test
