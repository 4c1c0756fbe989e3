// Measures how much a model's AO changes from frame to frame at 60 Hz, compared with ray tracing.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bakers/import/gltf.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

inline constexpr double motion_frames_per_second = 60;
// A step is the change of AO from one frame to the next. If a step of the model exceeds the ray-traced step
// by more than this value, the user may see flicker.
inline constexpr double visible_step = 0.02;

struct MotionErrors {
  std::size_t frames = 0, vertex_frames = 0;        // number of steps, and number of steps times vertices
  double largest_step = 0, largest_step_truth = 0;  // the largest step of any vertex
  double largest_beyond = 0;  // the largest amount by which a step of the model exceeds the ray-traced step
  double share_beyond = 0;    // fraction of vertex-frames in which the excess is more than visible_step
  std::string worst_clip;     // the clip with the largest excess
};

// Adds the steps between the frames of one run of consecutive frames. `model` and `truth` have one row of AO
// per frame. `clip` is the name of the clip that contains the run.
void add_steps(std::span<const float> model, std::span<const float> truth, std::size_t vertices,
               const std::string& clip, MotionErrors& errors);

// Measures about most_frames frames. Each clip contributes one run of at least 8 frames from its middle. All
// frames use the same ray directions relative to the normals. A ray-traced step is therefore caused by motion
// and not by noise.
MotionErrors measure_motion(const bake::ImportedCharacter& character, const CharacterModel& model,
                            std::span<const std::size_t> clips, std::size_t most_frames, std::uint32_t rays,
                            std::uint64_t seed, const bake::Progress& progress = {});

}  // namespace nook::measure
