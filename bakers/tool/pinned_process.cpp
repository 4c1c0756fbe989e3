#include "bakers/tool/pinned_process.h"

#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "bakers/raytrace/instruction_set.h"

namespace nook::tool {
namespace {

// Without these features glibc takes the paths of its mathematics for SSE. Level 3 needs no pin: glibc has no
// paths of its mathematics beyond AVX2 and FMA, which every processor of the level has.
constexpr const char* tunables_variable = "GLIBC_TUNABLES";
constexpr const char* tunables_of_v2 = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4";

std::optional<std::string> asked_isa(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "bake") return std::nullopt;
  std::optional<std::string> asked;
  for (int i = 2; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.starts_with("--isa="))
      asked = argument.substr(6);
    else if (argument == "--isa" && i + 1 < argc)
      asked = argv[i + 1];
  }
  return asked;
}

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

void pin_process(int argc, char** argv) {
  const std::string before = environment(bake::isa_variable);
  const std::string isa = asked_isa(argc, argv).value_or(before);
  const std::string tunables = environment(tunables_variable);
  const bool needs_tunables = isa == "x86-64-v2" && tunables.find(tunables_of_v2) == std::string::npos;
  if (isa == before && !needs_tunables) return;
  setenv(bake::isa_variable, isa.c_str(), 1);
  if (needs_tunables)
    setenv(tunables_variable, (tunables.empty() ? tunables_of_v2 : tunables + ":" + tunables_of_v2).c_str(),
           1);
  execv("/proc/self/exe", argv);
  // The process goes on as it was.
  before.empty() ? unsetenv(bake::isa_variable) : setenv(bake::isa_variable, before.c_str(), 1);
}

}  // namespace nook::tool
