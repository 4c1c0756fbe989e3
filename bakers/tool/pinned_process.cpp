#include "bakers/tool/pinned_process.h"

#include <unistd.h>

#include <cstdlib>
#include <optional>
#include <string_view>

#include "bakers/raytrace/instruction_set.h"

namespace nook::tool {
namespace {

// If these processor features are turned off, glibc uses the SSE versions of its math functions. x86-64 level
// 3 does not need this, because glibc has no versions beyond AVX2 and FMA, and every processor of level 3 has
// both.
constexpr const char* tunables_variable = "GLIBC_TUNABLES";
constexpr const char* tunables_of_v2 = "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4";

// The default instruction set of plans. Other processor families have only one instruction set each.
#if defined(__x86_64__)
constexpr const char* isa_of_plans = "x86-64-v3";
#else
constexpr const char* isa_of_plans = "native";
#endif

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

// Returns the instruction set that the arguments ask for. The first word is the command.
std::optional<std::string> asked_isa(const std::vector<std::string>& words) {
  if (words.empty() || (words[0] != "bake" && words[0] != "plan" && words[0] != "build")) return std::nullopt;
  std::optional<std::string> asked;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].starts_with("--isa="))
      asked = words[i].substr(6);
    else if (words[i] == "--isa" && i + 1 < words.size())
      asked = words[i + 1];
  }
  if (!asked && words[0] != "bake" && environment(bake::isa_variable).empty()) asked = isa_of_plans;
  return asked;
}

// Returns true if the environment had to be changed.
bool pin_environment(const std::string& isa) {
  const std::string tunables = environment(tunables_variable);
  const bool needs_tunables = isa == "x86-64-v2" && tunables.find(tunables_of_v2) == std::string::npos;
  if (isa == environment(bake::isa_variable) && !needs_tunables) return false;
  setenv(bake::isa_variable, isa.c_str(), 1);
  if (needs_tunables)
    setenv(tunables_variable, (tunables.empty() ? tunables_of_v2 : tunables + ":" + tunables_of_v2).c_str(),
           1);
  return true;
}

}  // namespace

void pin_process(int argc, char** argv) {
  const std::string before = environment(bake::isa_variable);
  const std::vector<std::string> words(argv + (argc > 0), argv + argc);
  if (!pin_environment(asked_isa(words).value_or(before))) return;
  execv("/proc/self/exe", argv);
  // The program could not be started again. Restores the environment and continues.
  before.empty() ? unsetenv(bake::isa_variable) : setenv(bake::isa_variable, before.c_str(), 1);
}

void pin_children(const std::vector<std::string>& words) {
  if (const std::optional<std::string> isa = asked_isa(words)) pin_environment(*isa);
}

std::string pinned_isa() {
  const std::string isa = environment(bake::isa_variable);
  return isa.empty() ? "native" : isa;
}

}  // namespace nook::tool
