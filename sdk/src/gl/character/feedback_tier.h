// The tier for OpenGL 3.3: the CPU computes shadows at key points, and transform feedback computes vertices
// on the GPU.
#pragma once

#include "sdk/src/gl/character/feedback_scene.h"
#include "sdk/src/gl/character/tier.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

class FeedbackTier final : public Tier {
 public:
  // Creates a framebuffer and a transform-feedback object. Throws Failure.
  explicit FeedbackTier(Device& device);

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
  struct Program {
    Object object;
    GLint first_key_point = -1, key_point_count = -1, self = -1, hidden = -1;
  };
  // The source and the destination of a draw.
  struct Target {
    const Program* programs;  // for one and two quads of influences
    TexelTable* page;
    const Buffer* out;
    std::uint32_t channels;
  };
  Program make_program(int quads, bool lit);
  void draw_scene(FeedbackScene& placed) const;
  // Evaluates all places of a chunk that are waiting. Each iteration evaluates as many places as fit into a
  // page.
  template <class Kind>
  void draw_chunk(const FeedbackScene& placed, const FeedbackChunk& chunk, const Target& target) const;
  // Draws the places in [first, end) that are waiting. The page must contain their shadows in the same order.
  void draw_page(const FeedbackScene& placed, const FeedbackChunk& chunk, std::uint32_t first,
                 std::uint32_t end, const Program& program, const Target& target) const;
  // Draws the places [first, end) of a chunk. All of them must be evaluated in this update.
  void draw(const FeedbackChunk& chunk, std::uint32_t first, std::uint32_t end, const Target& target) const;

  Device& device_;
  Program programs_[2], lit_programs_[2];  // for one and two quads of influences
  FeedbackTarget target_;
  List<FeedbackModel> models_;
  List<FeedbackScene> scenes_;  // destroyed before the models that their chunks use
};

}  // namespace nook::gl
