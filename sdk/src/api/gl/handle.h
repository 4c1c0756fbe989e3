// The object behind the handle nook_gl.
#pragma once

#include <nook/nook_gl.h>

#include <optional>
#include <string>

#include "sdk/src/api/handles.h"
#include "sdk/src/gl/character/character_gl.h"
#include "sdk/src/gl/state_guard.h"

struct nook_gl_s : nook::RefCounted {
  nook_gl_s(nook_context_s* made_by, const nook_gl_desc& desc);

  // Runs `body`. Meanwhile a StateGuard protects the OpenGL state of `users` (touched_state.h), in the mode
  // that the host chose in nook_gl_create.
  template <class Body>
  void guarded(unsigned users, Body&& body) {
    device.need_alive();
    const nook::gl::StateGuard guard(device, users);
    body();
  }
  // Like the function above, for the OpenGL state that the evaluation of characters changes.
  template <class Body>
  void guarded(Body&& body) {
    guarded(nook::gl::character_users(device.gl), std::forward<Body>(body));
  }

  nook::gl::Device device;
  nook::String version;
  nook::String renderer;
  std::optional<nook::gl::CharacterGl> characters;
};
