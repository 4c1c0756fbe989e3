// Measures the motion of AO: how much a model's AO changes from frame to frame at 60 Hz, beside ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bakers/import/gltf.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

inline constexpr double motion_frames_per_second = 60;
// A step that exceeds the ray-traced step by more than this may be seen as a flicker.
inline constexpr double visible_step = 0.02;

struct MotionErrors {
  std::size_t frames = 0, vertex_frames = 0;        // steps, and steps times vertices
  double largest_step = 0, largest_step_truth = 0;  // of any vertex
  double largest_beyond = 0;  // the largest amount by which a step is beyond the truth's
  double share_beyond = 0;    // of vertex-frames, whose step is beyond the truth's by more than visible_step
  std::string worst_clip;     // of the largest amount
};

// Adds the steps between frames: rows of AO, one for each frame of one run, of the model and of the truth.
// clip names the run.
void add_steps(std::span<const float> model, std::span<const float> truth, std::size_t vertices,
               const std::string& clip, MotionErrors& errors);

// About most_frames frames in runs of at least 8, one run from the middle of each clip. Each frame is traced
// with the same rays about the normals, so that a step of the truth is motion and not noise.
MotionErrors measure_motion(const bake::ImportedCharacter& character, const CharacterModel& model,
                            std::span<const std::size_t> clips, std::size_t most_frames, std::uint32_t rays,
                            std::uint64_t seed, const bake::Progress& progress = {});

}  // namespace nook::measure
