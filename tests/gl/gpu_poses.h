// Poses for a crowd in one array, which the CPU gets from memory and the GPU from a buffer of the host.
#pragma once

#include <nook/experimental/nook_calibration.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_gl_poses.h>

#include <array>
#include <span>
#include <vector>

#include "tests/gl/crowd.h"
#include "tests/gl/test_context.h"

// Leaves a test case where the context has no compute shaders, which has a test of its own.
#define NOOK_NEED_COMPUTE(context) \
  NOOK_NEED_CONTEXT(context);      \
  if (!computes(tiers_of(context).front())) return

namespace nook::test {

// A buffer of the host.
class HostBuffer {
 public:
  HostBuffer(const GladGLContext& gl, std::span<const std::byte> bytes);
  ~HostBuffer() { gl_.DeleteBuffers(1, &name_); }
  HostBuffer(const HostBuffer&) = delete;
  HostBuffer& operator=(const HostBuffer&) = delete;

  GLuint name() const { return name_; }

 private:
  const GladGLContext& gl_;
  GLuint name_ = 0;
};

// How the host stores transforms, and what they are.
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

// A rotation, one scale and a translation. Every layout can hold them, except dual quaternions, whose scale
// is 1.
struct Motion {
  float turn[4];  // unit quaternion x y z w
  float scale;
  Vec3 move;
};

// The numbers of a motion in a layout.
std::vector<float> written(const Motion& m, nook_transform_layout layout);

// The poses of a crowd in one array, which both halves get.
struct CrowdPoses {
  Transforms transforms;
  std::vector<float> numbers;
  std::vector<std::array<float, 12>> places;
  std::uint32_t gap = 0;  // more unused transforms between instances

  // `before` words of garbage come first, and between instances lie unused transforms.
  std::vector<std::uint32_t> words(std::size_t before) const;
  std::uint32_t first_transform(std::size_t instance) const {
    return static_cast<std::uint32_t>(instance) * (transforms.count + 1 + gap);
  }
};

CrowdPoses random_poses(const Transforms& transforms, std::size_t instances, Vec3 offset = {});
nook_pose_desc pose_of(const CrowdPoses& poses, std::size_t i);
void pose_on_cpu(const Crowd& crowd, const CrowdPoses& poses);
std::vector<Mat3x4> converted(nook_model model, const CrowdPoses& poses, std::size_t i);

// To the bit as the CPU has it. The ground's sphere is as large as the body times 11,000, and so follows the
// last bit of the scale by a millimetre.
float largest_scale(const std::vector<Mat3x4>& bones);

// What the host tells of an instance except its scale, from its twin on the CPU.
nook_gl_instance_pose told_of(const Crowd& on_gpu, const Crowd& on_cpu, const CrowdPoses& poses,
                              std::size_t i);
// What the host tells of all instances.
std::vector<nook_gl_instance_pose> told(const Crowd& on_gpu, const Crowd& on_cpu, nook_model model,
                                        const CrowdPoses& poses);

// A call of nook_gl_scene_set_poses with a buffer of its own, which tests may change before they call.
struct Call {
  // The range begins after `before` words of garbage. `from` must outlive the call.
  Call(const GladGLContext& gl, const CrowdPoses& from, std::size_t before = 0);
  nook_result operator()(nook_gl gl, const Crowd& crowd, const std::vector<nook_gl_instance_pose>& instances);

  const std::vector<std::uint32_t> words;
  const HostBuffer buffer;
  nook_pose_desc desc;
  nook_gl_poses poses{};
};

// Twins of one model, whose poses come from the CPU and from the GPU, both evaluated on the same tier.
struct Twins {
  Twins(platform::Context& of, const CrowdOptions& options = {}, nook_gl_proc_fn loader = nullptr,
        void* user = nullptr, nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE, SampleSize size = {});
  ~Twins();
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  // What the host tells of all instances, with bounds from the twin on the CPU.
  std::vector<nook_gl_instance_pose> told_of(const CrowdPoses& poses) const;
  // Sets the poses of the twin on the GPU.
  void set(const CrowdPoses& poses);
  // The largest difference of AO after both have the poses.
  float difference(const CrowdPoses& poses);
  float difference();

  platform::Context& context;
  CountedContext host;
  nook_model model;
  Crowd on_cpu, on_gpu;
  nook_gl gl;
};

// Of random numbers, key points lie inside spheres, where a rounded matrix turns a term on or off, and
// skinning matrices are 100 times as large as the body: the samples differ by 4e-5.
constexpr float bound_of_samples = 1e-4f;

// The difference of AO over vertices.
struct Error {
  float largest = 0;
  double squares = 0;
  std::size_t count = 0;
  double rms() const;
  void add(const std::vector<float>& a, const std::vector<float>& b);
};

// Returns whether the last message has the text.
bool says(const char* text);

}  // namespace nook::test
