// Runs the screen pass without the characters, and the world pass, which combines its own AO with the screen
// pass's AO. Calls both passes through the public interface, as hosts do.
#pragma once

#include <nook/nook_world.h>

#include <span>
#include <vector>

#include "bakers/measure/composite/populated_room.h"
#include "bakers/measure/composite/room_view.h"
#include "bakers/measure/nnao/network_pass.h"

namespace nook::measure {

class ShippedPass {
 public:
  ShippedPass(const GladGLContext& functions, const NookGl& gl, std::span<const std::byte> model, int width,
              int height, int taps, bool half_resolution, float radius);
  ~ShippedPass();
  ShippedPass(const ShippedPass&) = delete;
  ShippedPass& operator=(const ShippedPass&) = delete;

  // Replaces the characters of the scene.
  void pose(std::span<const Figure> figures);
  // Returns the AO of each pixel. Pixels that show a figure have AO 1.
  std::vector<float> ao(const RoomView& view);

 private:
  const GladGLContext& functions_;
  nook_context context_;
  float radius_;
  nook_model model_ = nullptr;
  nook_scene scene_ = nullptr;
  nook_nnao screen_ = nullptr;
  nook_world world_ = nullptr;
};

}  // namespace nook::measure
