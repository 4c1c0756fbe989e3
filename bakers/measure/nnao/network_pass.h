// The library's own pass, through its public interface.
#pragma once

#include <nook/nook_nnao.h>

#include <cstddef>
#include <span>

#include "bakers/measure/nnao/baseline_pass.h"
#include "platform/platform.h"

namespace nook::measure {

// Owns what belongs to one OpenGL context.
class NookGl {
 public:
  explicit NookGl(platform::Context& context);
  ~NookGl();
  NookGl(const NookGl&) = delete;
  NookGl& operator=(const NookGl&) = delete;

  nook_gl get() const { return gl_; }

 private:
  nook_context context_ = nullptr;
  nook_gl gl_ = nullptr;
};

class NetworkPass {
 public:
  // network empty: the embedded one.
  NetworkPass(const NookGl& gl, int width, int height, int taps, std::span<const std::byte> network,
              float blur_sharpness);
  ~NetworkPass();
  NetworkPass(const NetworkPass&) = delete;
  NetworkPass& operator=(const NetworkPass&) = delete;

  // Returns the pass's texture (R8).
  GLuint draw(const GpuView& view, const AoRequest& request, bool blurred);
  bool horizon_form() const { return info_.horizon_form != 0; }

  // Texture fetches for each pixel: depth and normal into the surface buffer; its texel there, one depth for
  // each tap (the paper's form: a normal and four texels of its filter too); depth and AO of the resolve.
  int fetches(bool blurred) const;

 private:
  nook_nnao pass_ = nullptr;
  nook_nnao_info info_{};
};

}  // namespace nook::measure
