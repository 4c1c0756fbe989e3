// Crowds through the public interface: the same numbers always make the same crowd, so that one can be
// evaluated on the CPU and its twin on the GPU.
#pragma once

#include <nook/nook_gl.h>

#include <functional>
#include <vector>

#include "tests/catch.h"
#include "tests/character/model_sample.h"

#define NOOK_OK_OR_FAIL(call)      \
  do {                             \
    const nook_result r_ = (call); \
    INFO(nook_last_message());     \
    REQUIRE(r_ == NOOK_OK);        \
  } while (false)

namespace nook::test {

// A context whose allocator counts, and refuses when `refuse_after` allocations have been given.
struct CountedContext {
  CountedContext();
  ~CountedContext();
  CountedContext(const CountedContext&) = delete;
  CountedContext& operator=(const CountedContext&) = delete;

  nook_context handle = nullptr;
  long allocations = 0;
  long long bytes = 0;
  long refuse_after = -1;  // -1: never
  std::vector<std::string> log;
};

// Bones turned and moved a little, and scaled, all about the same place.
std::vector<Mat3x4> random_pose(Numbers& numbers, std::size_t bones, Vec3 at = {}, float scale = 1);

nook_model load_model(nook_context context, const CharacterModel& model);

struct CrowdOptions {
  std::uint32_t instances = 9;
  nook_form form = NOOK_FORM_DEFAULT;
  bool links = true, nearest = true, ground = true, occluders = true;
  float scale = 1;       // of every bone matrix
  float spacing = 1.1f;  // metres
  Vec3 offset;           // of the whole crowd
  float cutoff_error = 0;
  float lod_error = 0;  // at a metre from the camera
  std::uint32_t lod_max_interval = 1;
  bool camera = false;
};

struct Crowd {
  Crowd(nook_context context, const std::vector<nook_model>& models,
        const std::vector<std::uint32_t>& bone_counts, const CrowdOptions& crowd_options);
  ~Crowd() { nook_scene_destroy(&scene); }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  // Poses that differ by instance, bone and frame.
  void pose(std::uint32_t frame);
  void pose_one(std::size_t index, std::uint32_t frame);
  nook_instance_id add(std::size_t index);

  CrowdOptions options;
  nook_scene scene = nullptr;
  std::vector<nook_instance_id> ids;

 private:
  std::vector<nook_model> models_;
  std::vector<std::uint32_t> bone_counts_;
};

// The models of a crowd: a body and a cloak, in turns.
struct Cast {
  explicit Cast(KernelForm form = KernelForm::nook, float gamma = 1.5f, bool levels = false);
  ~Cast();
  Cast(const Cast&) = delete;
  Cast& operator=(const Cast&) = delete;

  nook_model model_of(std::size_t index) const { return models[index % models.size()]; }

  CountedContext context;
  std::vector<nook_model> models;
  std::vector<std::uint32_t> bone_counts;
  float coarsest_error = 0;  // of the last model
};

nook_scene_info stats_of(const Crowd& crowd);
std::uint32_t file_vertices(nook_model model);
std::vector<float> cpu_ao(const Crowd& crowd, nook_model model, std::size_t index);
std::vector<float> gpu_ao(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index);
float largest_difference(const std::vector<float>& a, const std::vector<float>& b);
// Between the AO of the last nook_gl_scene_update and the AO of the CPU, which is evaluated here.
float difference_to_cpu(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index);
// The error that nook_gl.h promises for it, and that a byte of a frame buffer (1 / 255) cannot show.
constexpr float promised_difference = 2e-3f;

nook_gl_info info_of(nook_gl gl);

nook_gl create_gl(nook_context context, nook_gl_proc_fn loader, void* user, int tier,
                  nook_gl_state_mode mode = NOOK_GL_STATE_PRESERVE);

}  // namespace nook::test
