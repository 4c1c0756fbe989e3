// The pictures of one material.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "platform/render_target.h"
#include "samples/material/material_program.h"
#include "samples/material/mesh.h"

namespace material {

struct Stage {
  platform::Context& context;
  const std::vector<Mesh>& meshes;
  const platform::RenderTarget& target;
  float aspect = 1;
};

// Draws all passes of a frame; without the visibility of the meso-structure where `silhouettes` is false.
void draw_frame(const Stage& stage, const MaterialProgram& program, const View& view, bool silhouettes);

struct FrameRequest {
  std::uint32_t frames = 1;
  std::filesystem::path out;
  std::string name;  // pictures are name_000.png and on, and name_flat.png, the first without silhouettes
};

// Of a frame between two glFinish, the least of all frames.
struct FrameTimes {
  double ms = 0;
  // The process's, over all threads: what a software renderer costs whatever else runs on the machine.
  double cpu_ms = 0;
};

FrameTimes draw_frames(const Stage& stage, const MaterialProgram& program, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

}  // namespace material
