// C++17 wrappers of the C headers: handles destroy their objects, and failed calls throw nook::Error. This
// header is all of them; each nook_X.hpp wraps nook_X.h and can be included alone.
#ifndef NOOK_NOOK_HPP
#define NOOK_NOOK_HPP

#include "nook_character.hpp"
#include "nook_clips.hpp"
#include "nook_debug.hpp"
#include "nook_material.hpp"
#include "nook_nnao_recording.hpp"
#include "nook_probe.hpp"
#include "nook_synthesis.hpp"
#include "nook_transfer.hpp"
#include "nook_world.hpp"
// A library without its OpenGL half (NOOK_GL=OFF) is installed without these headers.
#if __has_include("nook_gl.h")
#include "nook_gl.hpp"
#include "nook_gl_clips.h"
#include "nook_gl_material.hpp"
#include "nook_gl_probe.hpp"
#include "nook_gl_synthesis.hpp"
#include "nook_gl_transfer.hpp"
#include "nook_gl_world.hpp"
#include "nook_nnao.hpp"
#include "nook_nnao_stages.hpp"
#endif

#endif
