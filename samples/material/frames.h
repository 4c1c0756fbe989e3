// Draws the pictures of one material.
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
  bool is_one_sided = false;  // true: the insides of the surfaces are not drawn
};

// Draws all passes of a frame. Without `silhouettes`, it ignores the visibility of the meso-structure.
void draw_frame(const Stage& stage, const MaterialProgram& program, const View& view, bool silhouettes);

struct FrameRequest {
  std::uint32_t frames = 1;
  std::filesystem::path out;
  // The pictures are name_000.png and so on, and name_flat.png, which is the first one without silhouettes.
  std::string name;
};

// The times of a frame between two calls of glFinish, the minimum over all frames.
struct FrameTimes {
  double ms = 0;
  // The CPU time of the process, over all threads. For a software renderer, it does not depend on other
  // processes.
  double cpu_ms = 0;
};

FrameTimes draw_frames(const Stage& stage, const MaterialProgram& program, const FrameRequest& request,
                       const std::function<void(std::uint32_t)>& progress);

}  // namespace material
