// C++17 wrappers of the C headers: handles destroy their objects, and failed calls throw nook::Error. This
// header includes all stable wrappers. nook_gl.hpp and nook_nnao.hpp also include the experimental headers
// that their members need. Each nook_X.hpp wraps nook_X.h, and you can include it alone.
#ifndef NOOK_NOOK_HPP
#define NOOK_NOOK_HPP

#include "nook_character.hpp"
#include "nook_clips.hpp"
#include "nook_material.hpp"
#include "nook_probe.hpp"
// A library built without OpenGL (NOOK_GL=OFF) is installed without these headers.
#if __has_include("nook_gl.h")
#include "nook_gl.hpp"
#include "nook_nnao.hpp"
#include "nook_world.hpp"
#endif

#endif
