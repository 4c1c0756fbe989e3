// docs/gl_state.md is made from the list that drives the guard. NOOK_BLESS=1 writes it anew.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "sdk/src/gl/touched_state.h"
#include "tests/catch.h"

namespace {

std::string names_of(unsigned users) {
  const std::pair<unsigned, const char*> all[] = {{nook::gl::tier_33, "33"},
                                                  {nook::gl::tier_43, "43"},
                                                  {nook::gl::screen, "nnao"},
                                                  {nook::gl::screen_timers, "nook_nnao_read_timings"},
                                                  {nook::gl::materials, "material"},
                                                  {nook::gl::probes, "probe"},
                                                  {nook::gl::grids, "grid"},
                                                  {nook::gl::captures, "capture"},
                                                  {nook::gl::binds, "bind"},
                                                  {nook::gl::clips, "clips"},
                                                  {nook::gl::screen_compute, "nnao, compute path"},
                                                  {nook::gl::outputs, "output"},
                                                  {nook::gl::outputs_compute, "output with a stride"},
                                                  {nook::gl::texel_uploads, "tables on OpenGL ES"},
                                                  {nook::gl::screen_reads, "nook_nnao_record"},
                                                  {nook::gl::screen_layers, "nnao with views"},
                                                  {nook::gl::screen_samples, "nnao with depth_samples"},
                                                  {nook::gl::screen_sample_layers, "nnao with both"}};
  std::string names;
  for (const auto& [user, name] : all)
    if (users & user) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

std::string table() {
  using namespace nook::gl;
  std::ostringstream out;
  out << "# OpenGL state that Nook touches\n\n"
         "The test `state_table_test` generates this page from `sdk/src/gl/touched_state.h`; `NOOK_BLESS=1 "
         "nook_gl_tests` writes it.\n\n"
         "| state | used by | purpose, and the default that `NOOK_GL_STATE_DEFAULTS` leaves |\n"
         "|---|---|---|\n";
#define NOOK_X(name, users, what, note) \
  out << "| " << what << " | " << names_of(users) << " | " << note << " |\n";
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
  out << "\n"
         "| used by | calls |\n"
         "|---|---|\n"
         "| 33, 43 | nook_gl_create and the nook_gl_scene functions of this tier; ES30 touches the same "
         "state as 33, ES31 as 43 |\n"
         "| tables on OpenGL ES | the uploads of 33, 43, probe and nook_nnao_create |\n"
         "| nnao | nook_nnao_create, nook_nnao_render, nook_nnao_record, nook_world_create and "
         "nook_world_render |\n"
         "| nnao, compute path | nook_nnao_render if nook_nnao_info.compute is 1; nook_world_render at half "
         "resolution if there are compute shaders |\n"
         "| material, clips | nook_gl_upload_material, nook_gl_upload_clips |\n"
         "| probe, grid | nook_gl_upload_probe and nook_gl_update_probe: probe with NOOK_GL_PROBE_LOBES, "
         "grid with the other forms |\n"
         "| bind | nook_gl_upload_bind; in every mode, it also leaves the program in use and the textures "
         "bound, without sampler objects |\n"
         "| capture | nook_gl_capture_create and _add; _read and _solve touch a part of this state |\n"
         "| output | nook_gl_scene_write |\n"
         "\n"
         "Nook changes no other state: no parameter of your textures and samplers, no other pixel-store "
         "value, and no depth, stencil or scissor parameter. From OpenGL 4.1 on, only the first viewport "
         "changes; from 4.0 on, only the first draw buffer.\n"
         "\n"
         "With `NOOK_GL_STATE_PRESERVE`, each call queries this state once and restores it. With "
         "`NOOK_GL_STATE_DEFAULTS` and `NOOK_GL_STATE_HOST`, calls query nothing.\n"
         "\n"
         "Objects that a call deletes, such as the buffers of a model that was replaced, are deleted after "
         "the state is restored. If you have bound such an object, OpenGL unbinds it, as if you had deleted "
         "it yourself: the binding is 0 afterwards, and no error is left.\n"
         "\n"
         "In every mode, nook_nnao_render and nook_world_render check your textures and your target with 8 "
         "to 15 queries (OpenGL ES 3.0 and WebGL 2: up to 60, through a framebuffer). They do so when they "
         "get a new set of names, kinds and sizes, and when this set first comes back. They remember the "
         "last four sets: names that rotate over 2 to 4 sets cause no query after two rounds. With "
         "`nook_gl_desc.debug`, every call queries the OpenGL context as well.\n"
         "\n"
         "Before each call, end or pause transform feedback, and end conditional rendering and every query "
         "that counts primitives or samples.\n";
  return out.str();
}

}  // namespace

TEST_CASE("the table of touched state in the documentation is the list in the code") {
  const char* bless = std::getenv("NOOK_BLESS");
  if (bless && std::string(bless) == "1") std::ofstream(NOOK_STATE_TABLE) << table();
  std::ifstream file(NOOK_STATE_TABLE);
  std::ostringstream found;
  found << file.rdbuf();
  CHECK(found.str() == table());
}
