// Poses that the host leaves on the GPU: they give the AO of the same poses on the CPU, in every layout, and
// whatever cannot follow them says so.
#include <nook/experimental/nook_calibration.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_gl_poses.h>
#include <nook/experimental/nook_world_sample.h>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "platform/file_bytes.h"
#include "sdk/src/character/bone_axes.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/floats.h"
#include "tests/gl/crowd.h"
#include "tests/gl/poison.h"
#include "tests/gl/test_context.h"
#include "tests/gl/traced_loader.h"
#include "tests/gl/world_scene.h"
#include "tests/pose_of_rows.h"

using namespace nook;
using namespace nook::test;

namespace {

// A buffer of the host.
class HostBuffer {
 public:
  HostBuffer(const GladGLContext& gl, const std::vector<std::uint32_t>& words) : gl_(gl) {
    gl.GenBuffers(1, &name_);
    set(words);
  }
  ~HostBuffer() { gl_.DeleteBuffers(1, &name_); }
  HostBuffer(const HostBuffer&) = delete;
  HostBuffer& operator=(const HostBuffer&) = delete;

  GLuint name() const { return name_; }
  void set(const std::vector<std::uint32_t>& words) {
    gl_.BindBuffer(GL_ARRAY_BUFFER, name_);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(words.size() * 4), words.data(), GL_DYNAMIC_DRAW);
    gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
  }

 private:
  const GladGLContext& gl_;
  GLuint name_ = 0;
};

// Transforms as the host has them, and what they are.
struct Transforms {
  nook_pose_kind kind = NOOK_POSE_SKINNING;
  nook_transform_layout layout = NOOK_TRANSFORM_COLUMNS_4X4;
  nook_format format = NOOK_FORMAT_FLOAT;
  std::uint32_t skin = 1;
  std::uint32_t stride = 0;  // bytes; 0: tightly packed
  std::vector<std::int32_t> transform_of_bone;
  std::uint32_t count = 5;  // for one instance
  std::uint32_t flags = 0;
};

std::uint32_t numbers_of(nook_transform_layout layout) {
  constexpr std::uint32_t numbers[] = {12, 16, 16, 12, 8, 10};
  return numbers[layout];
}

// A rotation, one scale and a translation, which every layout can hold but dual quaternions, whose scale
// is 1.
struct Motion {
  float turn[4];  // unit quaternion x y z w
  float scale;
  Vec3 move;
};

Motion random_motion(Numbers& numbers, bool scales) {
  const Vec3 axis = numbers.direction();
  const float half = numbers.between(-0.5f, 0.5f), s = std::sin(half);
  return {{axis.x * s, axis.y * s, axis.z * s, std::cos(half)},
          scales ? numbers.between(0.8f, 1.2f) : 1,
          numbers.place(0.1f)};
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

// The poses of a crowd in one array, which both halves get.
struct CrowdPoses {
  Transforms transforms;
  std::vector<float> numbers;
  std::vector<std::array<float, 12>> places;
  std::uint32_t gap = 0;  // more unused transforms between instances

  std::uint32_t bytes_of_one() const {
    return numbers_of(transforms.layout) * (transforms.format == NOOK_FORMAT_HALF ? 2 : 4);
  }
  std::uint32_t stride() const { return transforms.stride ? transforms.stride : bytes_of_one(); }

  // `before` words of garbage come first, and between instances lie unused transforms.
  std::vector<std::uint32_t> words(std::size_t before) const {
    const std::size_t one = numbers_of(transforms.layout), count = numbers.size() / one;
    constexpr std::uint32_t garbage = 0x7fc00000u;  // NaN
    std::vector<std::uint32_t> out(before + first_transform(count / transforms.count) * stride() / 4,
                                   garbage);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < one; ++k) {
        char* const at = reinterpret_cast<char*>(out.data() + before) +
                         (first_transform(i / transforms.count) + i % transforms.count) * stride();
        if (transforms.format == NOOK_FORMAT_HALF) {
          const std::uint16_t half = to_half(numbers[i * one + k]);
          std::memcpy(at + 2 * k, &half, 2);
        } else {
          std::memcpy(at + 4 * k, &numbers[i * one + k], 4);
        }
      }
    return out;
  }
  std::uint32_t first_transform(std::size_t instance) const {
    return static_cast<std::uint32_t>(instance) * (transforms.count + 1 + gap);
  }
};

CrowdPoses random_poses(const Transforms& transforms, std::size_t instances, Vec3 offset = {}) {
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

// To the bit as the CPU has it. The ground's sphere is as large as the body times 11,000, and so follows the
// last bit of the scale by a millimetre.
float largest_scale(const std::vector<Mat3x4>& bones) {
  float longest_squared = 0;
  for (const Mat3x4& m : bones) longest_squared = std::max(longest_squared, axes_of(m).longest_squared);
  return std::sqrt(longest_squared);
}

// The bones that an instance has on the CPU, from its record, which ends with them.
std::vector<Mat3x4> bones_of(const Crowd& crowd, nook_instance_id id) {
  std::size_t size = 0;
  NOOK_OK_OR_FAIL(nook_scene_record_pose(crowd.scene, id, nullptr, &size));
  std::vector<unsigned char> record(size);
  NOOK_OK_OR_FAIL(nook_scene_record_pose(crowd.scene, id, record.data(), &size));
  std::vector<Mat3x4> bones(5);
  std::memcpy(bones.data(), record.data() + size - 5 * sizeof(Mat3x4), 5 * sizeof(Mat3x4));
  return bones;
}

// What the host tells of an instance but its scale, from its twin on the CPU.
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

struct Call {
  nook_pose_desc desc;
  nook_gl_poses poses{};

  Call(const CrowdPoses& from, GLuint buffer, std::uint64_t offset, std::uint64_t size)
      : desc(desc_of(from.transforms)) {
    desc.stride = from.transforms.stride;
    poses.struct_size = sizeof poses;
    poses.format = from.transforms.format;
    poses.buffer = buffer;
    poses.offset = offset;
    poses.size = size;
  }
  nook_result operator()(nook_gl gl, const Crowd& crowd,
                         const std::vector<nook_gl_instance_pose>& instances) {
    poses.pose = &desc;
    return nook_gl_scene_set_poses(gl, crowd.scene, &poses, instances.data(),
                                   static_cast<std::uint32_t>(instances.size()));
  }
};

// Twins of one model, whose poses come from the CPU and from the GPU, both evaluated on the same tier.
struct Twins {
  Twins(platform::Context& of, const CrowdOptions& options = {}, nook_gl_proc_fn loader = nullptr,
        void* user = nullptr, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE, SampleSize size = {})
      : context(of),
        model(load_model(host.handle, sample_model(31, size))),
        on_cpu(host.handle, {model}, {5}, options),
        on_gpu(host.handle, {model}, {5}, options),
        gl(create_gl(host.handle, loader ? loader : platform::Context::loader, loader ? user : &of, 0,
                     mode)) {}
  ~Twins() {
    nook_gl_destroy(&gl);
    nook_model_destroy(&model);
  }

  // Sets the poses of the twin on the GPU, with bounds from the twin on the CPU.
  void set(const CrowdPoses& poses) {
    constexpr std::size_t before = 3;  // no alignment of storage buffers divides it
    const std::vector<std::uint32_t> words = poses.words(before);
    const HostBuffer buffer(context.gl(), words);
    const auto instances = told(on_gpu, on_cpu, model, poses);
    Call call(poses, buffer.name(), 4 * before, 4 * (words.size() - before));
    NOOK_OK_OR_FAIL(call(gl, on_gpu, instances));
  }
  // The largest difference of AO after both have the poses.
  float difference(const CrowdPoses& poses) {
    pose_on_cpu(on_cpu, poses);
    set(poses);
    return difference();
  }
  float difference() {
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_cpu.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
    float largest = 0;
    for (std::size_t i = 0; i < on_cpu.ids.size(); ++i)
      largest =
          std::max(largest, largest_difference(gpu_ao(gl, on_gpu, model, i), gpu_ao(gl, on_cpu, model, i)));
    return largest;
  }

  platform::Context& context;
  CountedContext host;
  nook_model model;
  Crowd on_cpu, on_gpu;
  nook_gl gl;
};

// Of random numbers, key points lie inside spheres, and skinning matrices are 100 times as large as the body:
// the samples differ by 4e-5.
constexpr float bound_of_samples = 1e-4f;

// The difference of AO over vertices.
struct Error {
  float largest = 0;
  double squares = 0;
  std::size_t count = 0;
  double rms() const { return std::sqrt(squares / double(count)); }
  void add(const std::vector<float>& a, const std::vector<float>& b) {
    largest = std::max(largest, largest_difference(a, b));
    for (std::size_t i = 0; i < a.size(); ++i) squares += double(a[i] - b[i]) * double(a[i] - b[i]);
    count += a.size();
  }
};

// A quaternion of a rotation, by the largest of its components (Shepperd 1978).
Motion motion_of(const Affine& m) {
  const auto& a = m.m;
  const double trace = a[0] + a[5] + a[10];
  const double squares[4] = {1 + 2 * a[0] - trace, 1 + 2 * a[5] - trace, 1 + 2 * a[10] - trace, 1 + trace};
  const auto k = std::max_element(squares, squares + 4) - squares;
  const double xy = a[1] + a[4], xz = a[2] + a[8], yz = a[6] + a[9];
  const double wx = a[9] - a[6], wy = a[2] - a[8], wz = a[4] - a[1];
  const double rows[4][4] = {
      {squares[0], xy, xz, wx}, {xy, squares[1], yz, wy}, {xz, yz, squares[2], wz}, {wx, wy, wz, squares[3]}};
  Motion motion{{}, 1, {float(a[3]), float(a[7]), float(a[11])}};
  for (int i = 0; i < 4; ++i) motion.turn[i] = float(rows[k][i] / (2 * std::sqrt(squares[k])));
  return motion;
}

Affine small_turn(Numbers& numbers) {
  Trs trs;
  const Vec3 axis = numbers.direction();
  const double half = numbers.between(-0.05f, 0.05f), s = std::sin(half);
  trs.rotation = {axis.x * s, axis.y * s, axis.z * s, std::cos(half)};
  return to_affine(trs);
}

// A baked body of a metre scale, whose joints turn a little in their places.
struct Mannequin {
  explicit Mannequin(nook_model model) {
    nook_model_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_model_describe(model, &info));
    bones = info.bone_count;
    // Identities in place of joints give what joints are multiplied with.
    const std::vector<Mat3x4> joints(bones, Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}});
    nook_pose_desc desc = pose_of_rows(joints.data()->m, bones);
    desc.kind = NOOK_POSE_JOINT_TO_WORLD;
    node_from_rest.resize(bones);
    NOOK_OK_OR_FAIL(nook_model_convert_pose(model, &desc, node_from_rest.data()->m, bones));
    skin.struct_size = sizeof skin;
    NOOK_OK_OR_FAIL(nook_model_describe_skin(model, 0, &skin));
    REQUIRE(skin.joint_count == bones);
  }

  CrowdPoses poses(nook_pose_kind kind, nook_transform_layout layout, std::size_t instances) const {
    Transforms transforms;
    transforms.kind = kind;
    transforms.layout = layout;
    transforms.skin = skin.file_index;
    transforms.count = bones;
    CrowdPoses out{transforms, {}, {}, 0};
    Numbers numbers(9);
    Mat3x4 mesh;
    std::copy_n(skin.rest_from_mesh_3x4, 12, mesh.m);
    for (std::size_t i = 0; i < instances; ++i) {
      for (std::uint32_t b = 0; b < bones; ++b) {
        const Affine node = to_double(node_from_rest[b]);
        const Affine joint = inverse(node) * small_turn(numbers);
        const Affine transform = kind == NOOK_POSE_JOINT_TO_WORLD  ? joint
                                 : kind == NOOK_POSE_REST_TO_WORLD ? joint * node
                                                                   : joint * node * to_double(mesh);
        for (const float number : written(motion_of(transform), layout)) out.numbers.push_back(number);
      }
      const float x = 2.2f * static_cast<float>(i % 3) + 5, z = 2.2f * static_cast<float>(i / 3) + 5;
      out.places.push_back({0, 0, 1, x, 0, 1, 0, 0, -1, 0, 0, z});
    }
    return out;
  }

  std::uint32_t bones = 0;
  std::vector<Mat3x4> node_from_rest;
  nook_skin_info skin{};
};

bool says(const char* text) {
  return std::string_view(nook_last_message()).find(text) != std::string_view::npos;
}

}  // namespace

// Leaves a test case where the context has no compute shaders, which has a test of its own.
#define NOOK_NEED_COMPUTE(context) \
  NOOK_NEED_CONTEXT(context);      \
  if (!computes(tiers_of(context).front())) return

TEST_CASE("poses on the GPU give the AO of poses on the CPU, in every kind and layout") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  for (const nook_pose_kind kind : {NOOK_POSE_REST_TO_WORLD, NOOK_POSE_JOINT_TO_WORLD, NOOK_POSE_SKINNING})
    for (nook_transform_layout layout = NOOK_TRANSFORM_ROWS_3X4; layout <= NOOK_TRANSFORM_TRS; ++layout)
      for (const std::uint32_t stride : {0u, 72u}) {
        INFO("kind " << kind << ", layout " << layout << ", stride " << stride);
        Transforms transforms;
        transforms.kind = kind;
        transforms.layout = layout;
        transforms.stride = stride;
        const float largest = twins.difference(random_poses(transforms, twins.on_gpu.ids.size()));
        CAPTURE(largest);
        CHECK(largest <= bound_of_samples);
      }
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("poses on the GPU give the AO of a baked body, as floats and as half floats") {
  NOOK_NEED_COMPUTE(context);
  CountedContext host;
  const std::vector<unsigned char> bytes = platform::read_file(NOOK_MANNEQUIN);
  nook_model model = nullptr;
  NOOK_OK_OR_FAIL(nook_model_load(host.handle, bytes.data(), bytes.size(), &model));
  nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, 0);
  const Mannequin body(model);
  {
    Crowd on_cpu(host.handle, {model}, {body.bones}, {}), on_gpu(host.handle, {model}, {body.bones}, {});
    Error floats, halves, far_halves;
    for (const nook_pose_kind kind : {NOOK_POSE_REST_TO_WORLD, NOOK_POSE_JOINT_TO_WORLD, NOOK_POSE_SKINNING})
      for (nook_transform_layout layout = NOOK_TRANSFORM_ROWS_3X4; layout <= NOOK_TRANSFORM_TRS; ++layout)
        for (const nook_format format : {NOOK_FORMAT_FLOAT, NOOK_FORMAT_HALF}) {
          CrowdPoses poses = body.poses(kind, layout, on_cpu.ids.size());
          pose_on_cpu(on_cpu, poses);
          const auto instances = told(on_gpu, on_cpu, model, poses);
          poses.transforms.format = format;
          const std::vector<std::uint32_t> words = poses.words(1);
          const HostBuffer buffer(context.gl(), words);
          Call call(poses, buffer.name(), 4, 4 * (words.size() - 1));
          NOOK_OK_OR_FAIL(call(gl, on_gpu, instances));
          NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_cpu.scene));
          NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, on_gpu.scene));
          Error error;
          for (std::size_t i = 0; i < on_cpu.ids.size(); ++i)
            error.add(gpu_ao(gl, on_gpu, model, i), gpu_ao(gl, on_cpu, model, i));
          INFO("kind " << kind << ", layout " << layout << ", format " << format << ", largest "
                       << 1e6f * error.largest << "e-6, rms " << 1e6 * error.rms() << "e-6");
          // A half has 11 bits. In matrices from rest space or the mesh's, the last one turns a hand by half
          // a millimetre; joints and quaternions keep more.
          const bool is_half = format == NOOK_FORMAT_HALF;
          const bool has_lever =
              is_half && kind != NOOK_POSE_JOINT_TO_WORLD && layout < NOOK_TRANSFORM_DUAL_QUATERNION;
          CHECK(error.rms() <= (is_half ? 4e-3 : 1e-5));
          // The CPU rounds matrices to floats in the world, 10 m from its origin here: to 5e-7 m.
          CHECK(error.largest <= (has_lever ? 0.05f : is_half ? 4e-3f : 1e-4f));
          Error& worst = has_lever ? far_halves : is_half ? halves : floats;
          worst = worst.largest < error.largest ? error : worst;
        }
    const auto tell = [](const char* what, const Error& error) {
      std::printf("poses on the GPU, %s: AO differs by %.1e at most, %.1e rms\n", what, double(error.largest),
                  error.rms());
    };
    tell("floats", floats);
    tell("half floats of joints, or with quaternions", halves);
    tell("half floats of other matrices", far_halves);
  }
  nook_gl_destroy(&gl);
  nook_model_destroy(&model);
}

TEST_CASE("bones read back are those that the CPU converts, uneven ones projected") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  Transforms transforms;
  transforms.kind = NOOK_POSE_JOINT_TO_WORLD;
  transforms.layout = NOOK_TRANSFORM_TRS;
  CrowdPoses poses = random_poses(transforms, twins.on_gpu.ids.size());
  // Uneven, mirrored, flat, and nothing: for each instance another bone.
  const float scales[][3] = {{1, 2, 0.5f}, {-1, 1, 1}, {1, -0.7f, 1.3f}, {1, 1, 0}, {0, 0, 0}, {-1, -1, -1}};
  for (std::size_t i = 0; i < poses.places.size(); ++i)
    std::copy_n(scales[i % std::size(scales)], 3, poses.numbers.data() + (i * 5 + i % 5) * 10 + 7);
  const float largest = twins.difference(poses);
  for (std::size_t i = 0; i < poses.places.size(); ++i) {
    INFO("instance " << i);
    const std::vector<Mat3x4> wanted = converted(twins.model, poses, i);
    std::vector<Mat3x4> got(5);
    NOOK_OK_OR_FAIL(
        nook_gl_scene_read_pose(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[i], got.data()->m, 5));
    for (std::size_t b = 0; b < 5; ++b)
      for (int k = 0; k < 12; ++k) {
        INFO("bone " << b << ", element " << k);
        // Floats against doubles, over three products of numbers of a few metres.
        CHECK(std::abs(got[b].m[k] - wanted[b].m[k]) < 4e-6f);
      }
  }
  CAPTURE(largest);
  CHECK(largest <= bound_of_samples);
}

TEST_CASE("poses of several skins come in calls that leave out bones") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  Transforms all, one;
  one.skin = 3;  // of the first bone alone
  one.count = 1;
  one.flags = NOOK_POSE_FLAG_PARTIAL;
  Transforms mapped;
  mapped.kind = NOOK_POSE_JOINT_TO_WORLD;
  mapped.count = 7;
  mapped.transform_of_bone = {6, -1, 0, 3, -1};
  mapped.flags = NOOK_POSE_FLAG_PARTIAL;
  std::vector<std::vector<Mat3x4>> bones;
  for (const nook_instance_id id : twins.on_cpu.ids) bones.push_back(bones_of(twins.on_cpu, id));
  // The first call already leaves out bones, which keep what the CPU has.
  int round = 0;
  for (const Transforms* transforms : {&one, &all, &mapped, &one, &mapped}) {
    INFO("round " << round);
    const CrowdPoses poses =
        random_poses(*transforms, twins.on_gpu.ids.size(), {0, 0.1f * static_cast<float>(round++), 0});
    pose_on_cpu(twins.on_cpu, poses);
    std::vector<nook_gl_instance_pose> instances;
    const std::vector<std::uint32_t> words = poses.words(1);
    const HostBuffer buffer(context.gl(), words);
    for (std::size_t i = 0; i < poses.places.size(); ++i) {
      const nook_pose_desc desc = pose_of(poses, i);
      NOOK_OK_OR_FAIL(nook_model_convert_pose(twins.model, &desc, bones[i].data()->m, 5));
      instances.push_back(told_of(twins.on_gpu, twins.on_cpu, poses, i));
      instances.back().scale = largest_scale(bones[i]);
    }
    Call call(poses, buffer.name(), 4, 4 * (words.size() - 1));
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
    CHECK(twins.difference() <= bound_of_samples);
  }
}

TEST_CASE("a pose that is not finite opens its instance and casts nothing") {
  NOOK_NEED_COMPUTE(context);
  for (const nook_form form : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER}) {
    CrowdOptions options;
    options.nearest = false;
    options.form = form;
    Twins twins(context, options);
    const CrowdPoses good = random_poses({}, twins.on_gpu.ids.size());
    constexpr std::size_t bad = 4;
    const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
    NOOK_OK_OR_FAIL(nook_scene_set_light(twins.on_gpu.scene, twins.on_gpu.ids[bad], &lobe, 1));
    for (const float number : {NAN, INFINITY, 1e30f}) {
      INFO("form " << form << ", number " << number);
      CHECK(twins.difference(good) <= bound_of_samples);
      CrowdPoses poses = good;
      poses.numbers[(bad * 5 + 3) * 16 + 2] = number;
      // The twin has good poses, from which the bounds come, and no link to the bad one.
      NOOK_OK_OR_FAIL(
          nook_scene_unlink(twins.on_cpu.scene, twins.on_cpu.ids[bad + 1], twins.on_cpu.ids[bad]));
      const std::vector<std::uint32_t> words = poses.words(0);
      const HostBuffer buffer(context.gl(), words);
      Call call(poses, buffer.name(), 0, 4 * words.size());
      NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, told(twins.on_gpu, twins.on_cpu, twins.model, good)));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_cpu.scene));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
      for (std::size_t i = 0; i < twins.on_gpu.ids.size(); ++i) {
        const std::vector<float> ao = gpu_ao(twins.gl, twins.on_gpu, twins.model, i);
        if (i == bad)
          for (const float value : ao) CHECK(value == 1.0f);
        else
          CHECK(largest_difference(ao, gpu_ao(twins.gl, twins.on_cpu, twins.model, i)) <= bound_of_samples);
      }
      std::vector<float> rgb(3 * std::size_t(file_vertices(twins.model)));
      NOOK_OK_OR_FAIL(nook_gl_scene_read(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[bad],
                                         NOOK_CHANNEL_DIRECTIONAL_AO, rgb.data(),
                                         file_vertices(twins.model)));
      for (const float value : rgb) CHECK(value == 1.0f);
      NOOK_OK_OR_FAIL(nook_scene_link(twins.on_cpu.scene, twins.on_cpu.ids[bad + 1], twins.on_cpu.ids[bad]));
    }
    // The next pose is good again.
    CHECK(twins.difference(good) <= bound_of_samples);
  }
}

TEST_CASE("instances that are not in a call keep their last pose, and turns of update too") {
  NOOK_NEED_COMPUTE(context);
  CrowdOptions options;
  options.camera = true;
  options.lod_max_interval = 3;
  Twins twins(context, options);
  const std::size_t count = twins.on_gpu.ids.size();
  CHECK(twins.difference(random_poses({}, count)) <= bound_of_samples);
  for (std::size_t first = 0; first < count; first += 2) {
    INFO("instances from " << first << " on");
    CrowdPoses poses = random_poses({}, count, {0, 0, 0.1f * static_cast<float>(first + 1)});
    std::reverse(poses.places.begin(), poses.places.begin() + 2);
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    for (std::size_t i = first; i < std::min(first + 2, count); ++i) {
      const nook_pose_desc desc = pose_of(poses, i);
      NOOK_OK_OR_FAIL(nook_scene_set_pose(twins.on_cpu.scene, twins.on_cpu.ids[i], &desc));
    }
    std::vector<nook_gl_instance_pose> some = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
    some.erase(some.begin() + static_cast<long>(std::min(first + 2, count)), some.end());
    some.erase(some.begin(), some.begin() + static_cast<long>(first));
    Call call(poses, buffer.name(), 0, 4 * words.size());
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, some));
    CHECK(twins.difference() <= bound_of_samples);
  }
  // One goes back to the CPU, and comes again.
  pose_on_cpu(twins.on_gpu, random_poses({}, count, {1, 0, 0}));
  pose_on_cpu(twins.on_cpu, random_poses({}, count, {1, 0, 0}));
  CHECK(twins.difference() <= bound_of_samples);
  for (const Crowd* crowd : {&twins.on_gpu, &twins.on_cpu}) NOOK_OK_OR_FAIL(nook_scene_update(crowd->scene));
  CHECK(twins.difference(random_poses({}, count)) <= bound_of_samples);
}

TEST_CASE("a range beyond a storage block is read in pieces") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  trace.limits[GL_MAX_SHADER_STORAGE_BLOCK_SIZE] = 1 << 24;
  Twins twins(context, {}, Trace::loader, &trace);
  CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  poses.gap = 61234;  // 3.9 MB between instances, 35 MB in all
  CHECK(twins.difference(poses) <= bound_of_samples);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("instances of several chunks get their poses in one call, in any order") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  trace.limits[GL_MAX_SHADER_STORAGE_BLOCK_SIZE] = 1 << 24;
  CrowdOptions options;
  options.instances = 45;
  options.links = false;
  // 840 KB of a buffer each, with a light: 19 in a chunk of 16 MiB.
  Twins twins(context, options, Trace::loader, &trace, NOOK_GL_STATE_PRESERVE, {5, 4, 20, 70000, 10, 2});
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  pose_on_cpu(twins.on_cpu, poses);
  const std::vector<std::uint32_t> words = poses.words(0);
  const HostBuffer buffer(context.gl(), words);
  std::vector<nook_gl_instance_pose> instances = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
  std::rotate(instances.begin(), instances.begin() + 20, instances.end());
  for (std::size_t i = 0; i + 7 < instances.size(); i += 2) std::swap(instances[i], instances[i + 7]);
  Call call(poses, buffer.name(), 0, 4 * words.size());
  trace.reset();
  NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
  CHECK(trace.calls("glDispatchCompute") == 3);
  CHECK(twins.difference() <= bound_of_samples);
}

TEST_CASE("what needs bones on the CPU refuses poses on the GPU by name") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  twins.difference(poses);
  const nook_scene scene = twins.on_gpu.scene;
  const nook_instance_id id = twins.on_gpu.ids[2];
  const char* const text = "the pose of instance 1 is on the GPU";
  const char* const own = "the pose of instance 3 is on the GPU";
  CHECK(nook_scene_update(scene) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(text));
  std::vector<float> ao(file_vertices(twins.model));
  const auto count = static_cast<std::uint32_t>(ao.size());
  for (const nook_channel channel :
       {NOOK_CHANNEL_AO, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_CHANNEL_BENT_NORMAL}) {
    std::vector<float> out(4 * std::size_t(count));
    const nook_format format = channel == NOOK_CHANNEL_BENT_NORMAL ? NOOK_FORMAT_SNORM8 : NOOK_FORMAT_FLOAT;
    CHECK(nook_scene_read(scene, id, channel, format, out.data(), count, 0) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says(own));
  }
  std::uint32_t room = 0;
  CHECK(nook_scene_read_spheres(scene, id, nullptr, &room) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  CHECK(nook_scene_read_key_points(scene, id, nullptr, &room) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  std::size_t size = 0;
  CHECK(nook_scene_record_pose(scene, id, nullptr, &size) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  CHECK(nook_scene_set_model(scene, id, twins.model) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  nook_pose_desc desc = pose_of(poses, 2);
  desc.flags = NOOK_POSE_FLAG_PARTIAL;
  CHECK(nook_scene_set_pose(scene, id, &desc) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  nook_world_sample_desc sample;
  NOOK_OK_OR_FAIL(nook_world_sample_desc_init(&sample));
  const float point[3] = {0, 0, 0}, normal[3] = {0, 1, 0};
  sample.positions = point;
  sample.normals = normal;
  sample.point_count = 1;
  CHECK(nook_world_sample(scene, &sample, ao.data(), nullptr) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(text));
  // These know all that they tell.
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  CHECK(nook_scene_describe_instance(scene, id, &info) == NOOK_OK);
  CHECK(nook_scene_read_links(scene, id, nullptr, &room) == NOOK_OK);
  // An instance that is gone does not count.
  for (const nook_instance_id gone : twins.on_gpu.ids)
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(scene, gone));
  CHECK(nook_scene_update(scene) == NOOK_OK);
}

TEST_CASE("wrong poses are refused by name, and change nothing") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses good = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(good) <= bound_of_samples);
  const std::vector<std::uint32_t> words = random_poses({}, good.places.size(), {0, 1, 0}).words(0);
  const HostBuffer buffer(context.gl(), words);
  const std::vector<nook_gl_instance_pose> instances = told(twins.on_gpu, twins.on_cpu, twins.model, good);
  const auto refused = [&](const char* text, nook_result code, const auto& change) {
    INFO(text);
    Call call(good, buffer.name(), 0, 4 * words.size());
    std::vector<nook_gl_instance_pose> some = instances;
    change(call, some);
    CHECK(call(twins.gl, twins.on_gpu, some) == code);
    INFO(nook_last_message());
    CHECK(says(text));
  };
  constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;
  using Some = std::vector<nook_gl_instance_pose>;
  refused("poses.struct_size", invalid, [](Call& c, Some&) { c.poses.struct_size = 8; });
  refused("poses.format", invalid, [](Call& c, Some&) { c.poses.format = NOOK_FORMAT_UNORM8; });
  refused("textures are not supported", NOOK_ERROR_UNSUPPORTED, [](Call& c, Some&) { c.poses.texture = 1; });
  refused("poses.buffer is 0", invalid, [](Call& c, Some&) { c.poses.buffer = 0; });
  refused("multiples of 4", invalid, [](Call& c, Some&) { c.poses.offset = 2; });
  refused("multiples of 4", invalid, [](Call& c, Some&) { c.poses.size = 0; });
  refused("instances[8]", invalid, [](Call& c, Some&) { c.poses.size -= 4 * 32; });
  refused("instances[1]", invalid, [](Call&, Some& s) { s[1].first_transform = UINT32_MAX; });
  refused("NOOK_POSE_FLAG_STRICT", invalid, [](Call& c, Some&) { c.desc.flags = NOOK_POSE_FLAG_STRICT; });
  refused("poses.pose->stride", invalid, [](Call& c, Some&) { c.desc.stride = 60; });
  refused("poses.pose->stride", invalid, [](Call& c, Some&) { c.desc.stride = 66; });
  refused("transform_count", invalid, [](Call& c, Some&) { c.desc.transform_count = 4; });
  refused("desc.skin", invalid, [](Call& c, Some&) { c.desc.skin = 2; });
  const float zero[16] = {};
  refused("transforms is not NULL", invalid, [&](Call& c, Some&) { c.desc.transforms = zero; });
  const float place[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  refused("place_3x4 is not NULL", invalid, [&](Call& c, Some&) { c.desc.place_3x4 = place; });
  refused("occurs twice", invalid, [](Call&, Some& s) { s[3].instance = s[7].instance; });
  refused("instance 12345", NOOK_ERROR_INVALID_HANDLE, [](Call&, Some& s) { s[3].instance = 12345; });
  refused("the sphere of instances[3]", invalid, [](Call&, Some& s) { s[3].bound_centre_ws[1] = NAN; });
  refused("the sphere of instances[3]", invalid, [](Call&, Some& s) { s[3].bound_radius = -1; });
  refused("instances[3].scale", invalid, [](Call&, Some& s) { s[3].scale = NAN; });
  refused("instances[3].place_3x4", invalid, [](Call&, Some& s) { s[3].place_3x4[5] = INFINITY; });
  CHECK(twins.difference() <= bound_of_samples);
  float bones[60];
  CHECK(nook_gl_scene_read_pose(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[0], bones, 4) == invalid);
  CHECK(nook_gl_scene_read_pose(twins.gl, twins.on_cpu.scene, twins.on_cpu.ids[0], bones, 5) ==
        NOOK_ERROR_INVALID_HANDLE);

  // A second model in one call.
  nook_model other = load_model(twins.host.handle, sample_model(32));
  nook_instance_id stranger = 0;
  NOOK_OK_OR_FAIL(nook_scene_add_instance(twins.on_gpu.scene, other, &stranger));
  refused("another model", invalid, [&](Call&, Some& s) { s[3].instance = stranger; });
  nook_model_destroy(&other);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("a nook_gl without the poses asks for them, and gets them again") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(poses) <= bound_of_samples);
  const auto is_missing = [&](nook_gl gl) {
    const nook_result result = nook_gl_scene_update(gl, twins.on_gpu.scene);
    return result == NOOK_ERROR_INVALID_HANDLE && says("call nook_gl_scene_set_poses again");
  };
  SECTION("another nook_gl") {
    nook_gl other = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
    CHECK(is_missing(other));
    nook_gl_destroy(&other);
  }
  SECTION("a release") {
    NOOK_OK_OR_FAIL(nook_gl_scene_release(twins.gl, twins.on_gpu.scene));
    CHECK(is_missing(twins.gl));
  }
  SECTION("a lost context") {
    context.clear_current();
    NOOK_OK_OR_FAIL(nook_gl_context_lost(twins.gl));
    Call call(poses, 1, 0, 4096);
    CHECK(call(twins.gl, twins.on_gpu, told(twins.on_gpu, twins.on_cpu, twins.model, poses)) ==
          NOOK_ERROR_GL);
    nook_gl_destroy(&twins.gl);
    context.make_current();
    twins.gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
    CHECK(is_missing(twins.gl));
  }
  SECTION("a tier without compute shaders") {
    const int below = is_es(context.gl()) ? NOOK_GL_TIER_ES30 : NOOK_GL_TIER_33;
    nook_gl other = create_gl(twins.host.handle, platform::Context::loader, &context, below);
    CHECK(nook_gl_scene_update(other, twins.on_gpu.scene) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says("is on the GPU"));
    nook_gl_destroy(&other);
  }
  CHECK(twins.difference(poses) <= bound_of_samples);
}

TEST_CASE("tiers without compute shaders refuse poses on the GPU by name") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    if (computes(tier)) continue;
    CountedContext host;
    nook_model model = load_model(host.handle, sample_model(33));
    Crowd crowd(host.handle, {model}, {5}, {});
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    Transforms transforms;
    transforms.kind = NOOK_POSE_REST_TO_WORLD;
    const CrowdPoses poses = random_poses(transforms, crowd.ids.size());
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    nook_gl_instance_pose one{};
    one.instance = crowd.ids[0];
    one.bound_radius = one.scale = 1;
    Call call(poses, buffer.name(), 0, 4 * words.size());
    CHECK(call(gl, crowd, {one}) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says("play baked clips"));
    float bones[60];
    CHECK(nook_gl_scene_read_pose(gl, crowd.scene, crowd.ids[0], bones, 5) == NOOK_ERROR_UNSUPPORTED);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    nook_gl_destroy(&gl);
    nook_model_destroy(&model);
  }
}

TEST_CASE("poses on the GPU allocate nothing in a frame, wait for nothing and query only to preserve") {
  NOOK_NEED_COMPUTE(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Trace trace(context);
    Twins twins(context, {}, Trace::loader, &trace, mode);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    const auto instances = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
    Call call(poses, buffer.name(), 0, 4 * words.size());
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    trace.reset();
    const long allocations = twins.host.allocations;
    for (int frame = 0; frame < 3; ++frame) {
      NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    }
    CHECK(twins.host.allocations == allocations);
    CHECK(trace.calls("glDispatchCompute") > 0);
    CHECK(trace.calls_that_begin("glGen") == 0);
    CHECK(trace.calls("glGetError") == 0);
    CHECK(trace.calls("glFinish") == 0);
    CHECK(trace.calls("glClientWaitSync") == 0);
    CHECK_FALSE(trace.mapped_for_reading());
    if (mode != NOOK_GL_STATE_PRESERVE)
      CHECK(trace.calls_that_begin("glGet") + trace.calls_that_begin("glIs") == 0);
  }
}

TEST_CASE("poses on the GPU keep the state contract") {
  NOOK_NEED_COMPUTE(context);
  const unsigned users = users_of_tier(tiers_of(context).front());
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Twins twins(context, {}, platform::Context::loader, &context, mode);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    const auto instances = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
    Call call(poses, buffer.name(), 0, 4 * words.size());
    float bones[60];
    const std::function<void()> steps[] = {
        [&] { NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances)); },  // makes programs and buffers
        [&] { NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances)); },
        [&] { NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene)); },
        [&] {
          NOOK_OK_OR_FAIL(
              nook_gl_scene_read_pose(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[0], bones, 5));
        }};
    for (std::size_t i = 0; i < std::size(steps); ++i) {
      INFO("step " << i);
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      steps[i]();
      if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
      if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
      CHECK(poison.untouched() == untouched);
    }
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    CHECK(twins.difference() <= bound_of_samples);
  }
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("every refused allocation of poses on the GPU gives an error and leaves everything usable") {
  NOOK_NEED_COMPUTE(context);
  int refusals = 0;
  for (long n = 0;; ++n) {
    INFO("allocation " << n);
    Twins twins(context);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    const auto instances = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
    Call call(poses, buffer.name(), 0, 4 * words.size());
    twins.host.refuse_after = n;
    const nook_result result = call(twins.gl, twins.on_gpu, instances);
    twins.host.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    CHECK(twins.difference(poses) <= bound_of_samples);
  }
  CHECK(refusals >= 3);
}

TEST_CASE("a map that fails leaves the poses as they were") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  Twins twins(context, {}, Trace::loader, &trace);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(poses) <= bound_of_samples);
  const CrowdPoses later = random_poses({}, twins.on_gpu.ids.size(), {0, 2, 0});
  const std::vector<std::uint32_t> words = later.words(0);
  const HostBuffer buffer(context.gl(), words);
  const auto instances = told(twins.on_gpu, twins.on_cpu, twins.model, later);
  Call call(later, buffer.name(), 0, 4 * words.size());
  trace.mapping_fails = true;
  CHECK(call(twins.gl, twins.on_gpu, instances) == NOOK_ERROR_GL);
  trace.mapping_fails = false;
  CHECK(twins.difference() <= bound_of_samples);
  // Contents that OpenGL loses once are written again.
  trace.unmapping_failures = 1;
  CHECK(twins.difference(later) <= bound_of_samples);
}

TEST_CASE("a debug context refuses a range beyond the buffer") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  nook_gl_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  desc.debug = 1;
  nook_gl gl = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_create(twins.host.handle, &desc, &gl));
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  const std::vector<std::uint32_t> words = poses.words(0);
  const HostBuffer buffer(context.gl(), words);
  Call call(poses, buffer.name(), 4, 4 * words.size());
  const auto instances = told(twins.on_gpu, twins.on_cpu, twins.model, poses);
  CHECK(call(gl, twins.on_gpu, instances) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(says("is too small"));
  call.poses.offset = 0;
  CHECK(call(gl, twins.on_gpu, instances) == NOOK_OK);
  nook_gl_destroy(&gl);
  take_debug_messages();
}

TEST_CASE("the world pass leaves out poses on the GPU and says so once") {
  NOOK_NEED_COMPUTE(context);
  using namespace nook::test::world;
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  Numbers numbers(4);
  CharacterModel made = sample_model();
  add_world_casters(made, numbers);
  nook_model model = load_model(fixture.host.handle, made);
  {
    CrowdOptions options;
    options.instances = 2;
    options.occluders = false;
    Crowd crowd(fixture.host.handle, {model}, {5}, options);
    const Camera camera = plain_camera(float(width) / height);
    const Picture picture = look(camera, still_life(), width, height);
    const View view = turned_view();
    const ScreenFrame screen =
        frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
    DarkenedFrame frame = world_frame(screen, view);
    frame.scene = crowd.scene;
    const auto casters = [&] {
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      nook_world_info info{};
      info.struct_size = sizeof info;
      NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
      return info.group_count;
    };
    const auto told_times = [&] {
      return std::count_if(fixture.host.log.begin(), fixture.host.log.end(), [](const std::string& line) {
        return line.find("1 instances have poses on the GPU") != std::string::npos;
      });
    };
    // Both bodies stand before the camera.
    Transforms transforms;
    transforms.kind = NOOK_POSE_REST_TO_WORLD;
    CrowdPoses poses = random_poses(transforms, 2);
    for (auto& place : poses.places) {
      const Vec3 at = view.to_world({0, 0, -2.5f});
      place[3] = at.x;
      place[7] = at.y;
      place[11] = at.z;
    }
    pose_on_cpu(crowd, poses);
    CHECK(casters() == 2);
    CHECK(told_times() == 0);
    const std::vector<std::uint32_t> words = poses.words(0);
    const HostBuffer buffer(context.gl(), words);
    Call call(poses, buffer.name(), 0, 4 * words.size());
    std::vector<nook_gl_instance_pose> one = told(crowd, crowd, model, poses);
    one.resize(1);
    NOOK_OK_OR_FAIL(call(fixture.gl, crowd, one));
    CHECK(casters() == 1);
    CHECK(casters() == 1);
    CHECK(told_times() == 1);
    // With a pose on the CPU it darkens again.
    pose_on_cpu(crowd, poses);
    CHECK(casters() == 2);
  }
  nook_model_destroy(&model);
}
