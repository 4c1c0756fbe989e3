// A crowd of one model for timings. The bodies stand on a grid, and their poses change every frame.
#pragma once

#include <nook/nook_gl.h>

#include <filesystem>
#include <vector>

#include "bakers/measure/nnao/network_pass.h"

namespace nook::lab {

class Crowd {
 public:
  // Places `count` bodies on the ground y = 0, on a square grid that is centred at the origin. `spacing` is
  // the grid's spacing in metres.
  Crowd(const measure::NookGl& gl, const std::filesystem::path& model, std::uint32_t count, float spacing);
  ~Crowd();
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  // Rotates every body a little further, and links each body to its `k` nearest neighbours. With 0, nothing
  // is linked.
  void pose(std::uint32_t k);
  nook_scene scene() const { return scene_; }
  const std::vector<nook_instance_id>& bodies() const { return bodies_; }
  std::uint32_t vertex_count() const { return vertex_count_; }  // vertices in the file

 private:
  nook_model model_ = nullptr;
  nook_scene scene_ = nullptr;
  std::vector<nook_instance_id> bodies_;
  std::uint32_t bone_count_ = 0, vertex_count_ = 0, frame_ = 0;
  float spacing_;
};

}  // namespace nook::lab
