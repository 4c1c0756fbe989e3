// The tier for OpenGL 4.3 and OpenGL ES 3.1: compute shaders evaluate the spheres, shadows and vertices of a
// scene.
#pragma once

#include "sdk/src/gl/character/compute_scene.h"
#include "sdk/src/gl/character/tier.h"
#include "shaders/character/layout.h"

namespace nook::gl {

class ComputeTier final : public Tier {
 public:
  explicit ComputeTier(Device& device);

  void prepare(const Scene& scene) override;
  void update(Scene& scene) override;
  void set_poses(Scene& scene, const PoseBatch& batch) override;
  void read_pose(const Scene& scene, nook_instance_id instance, std::span<Mat3x4> bones) const override;
  void set_streaming(const Scene& scene, std::uint32_t fade_updates) override;
  bool is_streaming(const Scene& scene) const override;
  StreamLeft prepare_within(const Scene& scene, const Budget& budget) override;
  VertexValues place(const Scene& scene, nook_instance_id instance) const override;
  PooledView pooled_view(const Scene& scene, nook_instance_id instance) const override;
  PoolCount pool_count(const Scene& scene) const override;
  PoolTablePlace pool_table(const Scene& scene, const LoadedModel& model,
                            std::span<GLuint> ao_buffers) override;
  LightPlace light_place(const Scene& scene, nook_instance_id instance) const override;
  void read(const VertexValues& values, float* out) const override;
  ModelMemory memory_of(const LoadedModel& model) const override;
  void release(const Scene& scene) override;

 private:
  // Compiles the programs that the models and lights of the scene need and that do not exist yet.
  void make_programs(const ComputeScene& placed);
  void make_form_programs(int form, bool lit);
  void make_light_programs();
  void make_clip_program();
  void make_spread_program();
  void make_pose_programs();
  // The data of the scene's update that the passes need.
  struct Update {
    const ComputeScene& placed;
    bool composed;  // true for NOOK_FORM_DEFAULT
  };
  void run(const Update& update) const;
  // Copies poses that are on the GPU to the stream, from which the passes read bones.
  void place_poses(const Update& update) const;
  // Decodes the bones of clips into the stream (compute_clips.cpp).
  void decode_clips(const Update& update) const;
  // For each chunk whose `count` is above 0, binds the chunk's stream and calls `dispatch`, which must write
  // bones. The passes that follow see these bones.
  template <class Dispatch>
  void write_bones(const Update& update, const Object& program, std::uint32_t ComputeChunk::Frame::*count,
                   const Dispatch& dispatch) const {
    const Functions& gl = device_.gl;
    bool any = false;
    for (const ComputeChunk& chunk : update.placed.chunks) {
      if (chunk.frame.*count == 0) continue;
      if (!any) gl.UseProgram(program.name());
      any = true;
      bind_piece(gl, NOOK_BINDING_STREAM, update.placed.stream, chunk.frame.offset, chunk.frame.bytes);
      dispatch(chunk);
    }
    if (any) gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  void run_spheres(const Update& update) const;
  void run_key_points(const Update& update, const ComputeChunk& chunk) const;
  void spread_levels(const Update& update, const ComputeChunk& chunk) const;
  void blend_vertices(const Update& update, const ComputeChunk& chunk, const Buffer& key_points,
                      const Buffer& out) const;
  void run_shadows(const Update& update) const;
  void run_spread(const Update& update) const;
  void run_vertices(const Update& update) const;
  // The next three functions are the passes for instances with a light.
  void run_colours(const Update& update) const;
  void run_colours_spread(const Update& update) const;
  void run_lit_vertices(const Update& update) const;

  Device& device_;
  // The passes over poses on the GPU (compute_poses.cpp).
  void make_pose_objects(ComputeScene& placed);
  void convert_poses(const ComputeScene& placed, const PoseBatch& batch, const PoseWindows& windows) const;

  Object spheres_;
  Object shadows_[kernel_form_count];  // its OpenGL name is 0 until a model needs it
  Object spread_;                      // its OpenGL name is 0 until a model has levels of detail
  Object vertices_;
  Object colours_[kernel_form_count];  // its OpenGL name is 0 until an instance has a light
  Object colours_spread_;
  Object lit_vertices_, grey_vertices_;
  Object convert_poses_, place_poses_;  // their OpenGL names are 0 until a pose is on the GPU
  Object decode_clips_;                 // its OpenGL name is 0 until clips are on the GPU
  List<ComputeModel> models_;
  List<ComputeScene> scenes_;  // destroyed before the models that their chunks use
};

}  // namespace nook::gl
