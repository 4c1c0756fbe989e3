// Checks the host's textures and target of a frame before anything is drawn.
#pragma once

#include <nook/nook_nnao.h>

#include "sdk/src/gl/device.h"
#include "sdk/src/gl/nnao/nnao_frame.h"

namespace nook::gl {

// The names, kinds and sizes of a frame's images. The pass queries OpenGL about the images only if one of
// these fields has changed.
struct HostImages {
  int width = 0, height = 0;
  int layers = 0;   // layers of texture arrays; 0: 2D textures
  int samples = 0;  // samples of the depth texture; 0: it is not a multisample texture
  int normal_samples = 0;
  // False for the world pass, whose descriptor cannot declare multisample textures.
  bool may_have_samples = true;
  nook_depth_kind depth_kind = 0;
  nook_gbuffer_ao layer = 0;
  nook_target target = 0;
  std::uint32_t depth = 0, normal = 0, layer_texture = 0, motion = 0, ao = 0, target_name = 0;

  bool operator==(const HostImages&) const = default;
};
// `pass` is the host's descriptor of the pass that will read the images.
HostImages images_of(const NnaoFrame& frame, const nook_nnao_desc& pass);

// Throws Failure(NOOK_ERROR_UNSUPPORTED) if this OpenGL context does not support the kinds of images that the
// pass uses.
void check_images_of(const Functions& gl, const nook_nnao_desc& pass);

// The results of OpenGL queries about the images of a frame.
struct ImageFacts {
  std::uint32_t answers = 0;  // checksum of the sizes and formats that OpenGL has returned
  int depth_bits = 0;         // number of bits of the depth channel; 0: unknown
  bool normalised_normals = false;

  bool operator==(const ImageFacts&) const = default;
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless every image exists and has a suitable size and format,
// and no input is the target. `own_texture` is the pass's own texture. `target_framebuffer` is a framebuffer
// without attachments, to which the function attaches textures to test them. Changes these OpenGL bindings:
// the 2D texture of unit 0, texture arrays and multisample textures of unit 1, and the draw framebuffer.
// Leaves no OpenGL error behind.
ImageFacts check_images(const Device& device, const HostImages& images, std::uint32_t own_texture,
                        std::uint32_t target_framebuffer);

}  // namespace nook::gl
