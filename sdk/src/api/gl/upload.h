// The object behind the handle nook_gl_upload: textures of one kind, and the GLSL that reads them. Its OpenGL
// objects can outlive the handle nook_gl, because the object holds a reference to the owner of nook_gl.
#pragma once

#include <nook/nook_gl.h>

#include <utility>
#include <variant>

#include "sdk/src/api/gl/handle.h"
#include "sdk/src/api/transfer_handles.h"
#include "sdk/src/gl/character/clip_textures.h"
#include "sdk/src/gl/material/material_textures.h"
#include "sdk/src/gl/probe/grid_volume.h"
#include "sdk/src/gl/probe/probe_texture.h"
#include "sdk/src/gl/transfer/transfer_textures.h"

namespace nook::api {

// An upload of a transfer in the paper's form, with the data that nook_gl_update_transfer needs.
struct PaperUpload {
  PaperUpload(gl::Device& device, nook_transfer transfer, nook_transfer_response under)
      : texture(device, transfer->transfer),
        baked(Ref<nook_transfer_s>::share(transfer)),
        response(Ref<nook_transfer_response_s>::share(under)) {}

  gl::PaperTexture texture;
  Ref<nook_transfer_s> baked;
  Ref<nook_transfer_response_s> response;
};

}  // namespace nook::api

struct nook_gl_upload_s : nook::RefCounted {
  // Constructs content of the given type from `arguments`. Meanwhile a StateGuard protects the OpenGL state
  // of `users`.
  template <class Content, class... Arguments>
  nook_gl_upload_s(std::in_place_type_t<Content>, nook_gl_s* made_by, unsigned users,
                   Arguments&&... arguments)
      : gl(made_by) {
    gl->device.report_host_errors();
    gl->guarded(users, [&] { content.emplace<Content>(gl->device, std::forward<Arguments>(arguments)...); });
  }

  // Returns NULL if the upload is of another kind.
  nook::gl::ProbeTexture* probe() { return std::get_if<nook::gl::ProbeTexture>(&content); }
  nook::gl::GridVolume* grid() { return std::get_if<nook::gl::GridVolume>(&content); }
  nook::gl::TransferTexture* vectors() { return std::get_if<nook::gl::TransferTexture>(&content); }
  nook::api::PaperUpload* paper() { return std::get_if<nook::api::PaperUpload>(&content); }

  nook_gl_s* gl;
  std::variant<std::monostate, nook::gl::ProbeTexture, nook::gl::GridVolume, nook::gl::MaterialTextures,
               nook::gl::CoordinateTexture, nook::gl::ClipTextures, nook::gl::TransferTexture,
               nook::api::PaperUpload>
      content;
};

namespace nook::api {

template <class Content, class... Arguments>
nook_gl_upload make_upload(nook_gl gl, unsigned users, Arguments&&... arguments) {
  gl->device.need_alive();
  return Owned<nook_gl_upload_s>::make(gl->device.memory, Ref<nook_gl_s>::share(gl),
                                       std::in_place_type<Content>, gl, users,
                                       std::forward<Arguments>(arguments)...)
      .detach();
}

// max_layers is the maximum number of layers of one texture array, or 0 for the limit of this OpenGL context.
// Tests set smaller limits.
nook_gl_upload upload_material(nook_gl gl, nook_material material, std::uint32_t max_layers);

}  // namespace nook::api
