// Code that JavaScript needs in addition to the library's own functions: the loader of WebGL functions, a
// log, and two tables in memory. The tables have the layouts of structs and the values of constants.
#include <emscripten.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_lod.h>
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_character.h>
#include <nook/nook_gl.h>
#include <nook/nook_material.h>
#include <nook/nook_nnao.h>
#include <nook/nook_probe.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "sdk/src/gl/functions.h"

namespace {

// One member of a struct. Every column has 32 bits, so that JavaScript reads the table as words.
struct Field {
  const char* of;         // the struct
  const char* name;       // empty: the struct itself, whose size is offset
  std::uint32_t offset;   // bytes
  char type[4];           // i, u, f, d; w: 64 bits; p: address or size; s: text inside; t: address of text
  std::uint32_t count;    // above 1 in arrays
  const char* constants;  // the group of constants whose values the field takes, or null
};

template <class T>
constexpr char type_of() {
  if constexpr (std::is_array_v<T>)
    return std::is_same_v<std::remove_extent_t<T>, char> ? 's' : type_of<std::remove_extent_t<T>>();
  else if constexpr (std::is_same_v<T, const char*>)
    return 't';
  else if constexpr (std::is_same_v<T, float>)
    return 'f';
  else if constexpr (std::is_same_v<T, double>)
    return 'd';
  else if constexpr (std::is_pointer_v<T> || std::is_same_v<T, std::size_t>)
    return 'p';
  else if constexpr (sizeof(T) == 8)
    return 'w';
  else
    return std::is_signed_v<T> ? 'i' : 'u';
}

template <class S>
S member_of();

template <class T>
constexpr std::uint32_t count_of() {
  if constexpr (std::is_array_v<T>) return std::extent_v<T>;
  return 1;
}

#define STRUCT(s) {#s, "", sizeof(s), {}, 1, nullptr},
#define CHOICE(s, f, constants)             \
  {#s,                                      \
   #f,                                      \
   offsetof(s, f),                          \
   {type_of<decltype(member_of<s>().f)>()}, \
   count_of<decltype(member_of<s>().f)>(),  \
   constants},
#define MEMBER(s, f) CHOICE(s, f, nullptr)
#define CONSTANT(name, group)
const Field fields[] = {
#include "layouts.inc"
    {nullptr, nullptr, 0, {}, 0, nullptr}};
#undef STRUCT
#undef CHOICE
#undef CONSTANT

struct Constant {
  const char* name;
  const char* group;  // the type of the fields that take the constant
  std::int32_t value;
};

#define STRUCT(s)
#define CHOICE(s, f, constants)
#define CONSTANT(name, group) {#name, group, name},
const Constant constants[] = {
#include "layouts.inc"
    {nullptr, nullptr, 0}};

}  // namespace

// Emscripten's WebGL 2 functions, with the types from the library's own table.
#define DECLARE(name) std::remove_pointer_t<decltype(GladGLContext::name)> gl##name;
#define OF_WEBGL(X)           \
  NOOK_GL_FUNCTIONS_COMMON(X) \
  NOOK_GL_FUNCTIONS_ES30(X)   \
  X(BindTransformFeedback)    \
  X(DeleteTransformFeedbacks) X(GenTransformFeedbacks) X(GetBufferSubData) X(GetStringi)
extern "C" {
OF_WEBGL(DECLARE)
}

namespace {

void* get_proc(void*, const char* name) {
#define ENTRY(entry) \
  if (std::strcmp(name, "gl" #entry) == 0) return reinterpret_cast<void*>(&gl##entry);
  OF_WEBGL(ENTRY)
  return nullptr;
}

// JavaScript sets Module.nookLog.
EM_JS(void, log_line, (int severity, const char* text), { Module.nookLog(severity, UTF8ToString(text)); });

void log(void*, nook_log_severity severity, const char* text) {
  log_line(severity, text);
}

}  // namespace

extern "C" {
EMSCRIPTEN_KEEPALIVE const Field* nook_web_fields() {
  return fields;
}
EMSCRIPTEN_KEEPALIVE const Constant* nook_web_constants() {
  return constants;
}
EMSCRIPTEN_KEEPALIVE nook_gl_proc_fn nook_web_get_proc() {
  return get_proc;
}
EMSCRIPTEN_KEEPALIVE nook_log_fn nook_web_log() {
  return log;
}
}
