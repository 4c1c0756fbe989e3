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
// If a step of the model exceeds the ray-traced step by more than this, the user may see it as flicker.
inline constexpr double visible_step = 0.02;

struct MotionErrors {
  std::size_t frames = 0, vertex_frames = 0;        // steps, and steps times vertices
  double largest_step = 0, largest_step_truth = 0;  // of any vertex
  double largest_beyond = 0;  // the largest excess of a step of the model over the step of the truth
  double share_beyond = 0;    // share of vertex-frames with an excess of more than visible_step
  std::string worst_clip;     // the clip with the largest excess
};

// Adds the steps between the frames of one run. `model` and `truth` have one row of AO per frame. `clip` is
// the clip that the run is from.
void add_steps(std::span<const float> model, std::span<const float> truth, std::size_t vertices,
               const std::string& clip, MotionErrors& errors);

// Measures about most_frames frames. Each clip contributes one run of at least 8 frames from its middle.
// Every frame uses the same ray directions relative to the normals, so that a step of the truth is motion and
// not noise.
MotionErrors measure_motion(const bake::ImportedCharacter& character, const CharacterModel& model,
                            std::span<const std::size_t> clips, std::size_t most_frames, std::uint32_t rays,
                            std::uint64_t seed, const bake::Progress& progress = {});

}  // namespace nook::measure
