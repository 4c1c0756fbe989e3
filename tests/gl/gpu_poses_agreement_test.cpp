// Poses that the host leaves on the GPU give the AO of the same poses on the CPU, in every layout.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "platform/file_bytes.h"
#include "sdk/src/core/affine.h"
#include "tests/gl/gpu_poses.h"
#include "tests/gl/traced_loader.h"
#include "tests/pose_of_rows.h"

using namespace nook;
using namespace nook::test;

namespace {

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

}  // namespace

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
          Call call(context.gl(), poses, 1);
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
    for (std::size_t i = 0; i < poses.places.size(); ++i) {
      const nook_pose_desc desc = pose_of(poses, i);
      NOOK_OK_OR_FAIL(nook_model_convert_pose(twins.model, &desc, bones[i].data()->m, 5));
      instances.push_back(told_of(twins.on_gpu, twins.on_cpu, poses, i));
      instances.back().scale = largest_scale(bones[i]);
    }
    Call call(context.gl(), poses, 1);
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
    CHECK(twins.difference() <= bound_of_samples);
  }
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
  std::vector<nook_gl_instance_pose> instances = twins.told_of(poses);
  std::rotate(instances.begin(), instances.begin() + 20, instances.end());
  for (std::size_t i = 0; i + 7 < instances.size(); i += 2) std::swap(instances[i], instances[i + 7]);
  Call call(context.gl(), poses);
  trace.reset();
  NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
  CHECK(trace.calls("glDispatchCompute") == 3);
  CHECK(twins.difference() <= bound_of_samples);
}
