// docs/gl_state.md is made from the list that drives the guard. NOOK_BLESS=1 writes it anew.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.h"
#include "gl/touched_state.h"

namespace {

std::string table() {
  std::ostringstream out;
  out << "# OpenGL state that Nook touches\n\n"
         "Made from `sdk/src/gl/touched_state.h` by the test `state_table_test`; run `NOOK_BLESS=1 "
         "nook_gl_tests` to "
         "write it anew.\n\n"
         "| state | tier | what for, and the default that `NOOK_GL_STATE_DEFAULTS` leaves |\n|---|---|---|\n";
#define NOOK_X(name, tiers, what, note)                     \
  out << "| " << what << " | "                              \
      << (nook::gl::tiers == nook::gl::tier_any  ? "33, 43" \
          : nook::gl::tiers == nook::gl::tier_33 ? "33"     \
                                                 : "43")    \
      << " | " << note << " |\n";
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
  out << "\nNothing else changes: no parameter of a host's texture or sampler, no pixel-store value, no "
         "viewport, mask, "
         "blend or depth state.\n"
         "`NOOK_GL_STATE_PRESERVE` reads these once a call and puts them back; `NOOK_GL_STATE_DEFAULTS` and "
         "`NOOK_GL_STATE_HOST` read nothing.\n"
         "At each call no transform feedback without pause, no conditional rendering and no query that "
         "counts "
         "primitives or samples may be active.\n";
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
