#include "bakers/raytrace/instruction_set.h"

#include <cstdlib>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

#if defined(__x86_64__)

constexpr const char* level_names[] = {"x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4"};

// Tests the features that the clones and Embree use. A processor of a lower level lacks at least one of them.
IsaLevel best_level() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return IsaLevel::v4;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return IsaLevel::v3;
  return __builtin_cpu_supports("sse4.2") ? IsaLevel::v2 : IsaLevel::baseline;
}

std::string name_of(IsaLevel level) {
  return level_names[std::size_t(level)];
}

#else

IsaLevel best_level() {
  return IsaLevel::baseline;
}

std::string name_of(IsaLevel) {
#if defined(__aarch64__)
  return "aarch64";
#else
  return "generic";
#endif
}

#endif

}  // namespace

IsaLevel isa_level_of(std::string_view name) {
  if (name == "native") return best_level();
  const IsaLevel asked = name == "x86-64-v2"   ? IsaLevel::v2
                         : name == "x86-64-v3" ? IsaLevel::v3
                                               : IsaLevel::baseline;
  if (asked == IsaLevel::baseline)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the instruction set is unknown (got %.40s, need native, x86-64-v2 or x86-64-v3)",
                  std::string(name).c_str());
  if (asked > best_level())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "this processor lacks the instruction set (got %s, the processor has %s); "
                  "choose a lower one, or bake elsewhere",
                  std::string(name).c_str(), name_of(best_level()).c_str());
  return asked;
}

IsaLevel isa_level() {
  // Stored in a static variable, because inner loops call this function.
  static const IsaLevel level = [] {
    const char* const pinned = std::getenv(isa_variable);
    return pinned && *pinned ? isa_level_of(pinned) : best_level();
  }();
  return level;
}

std::string isa_level_name() {
  return name_of(isa_level());
}

Isa kernel_isa() {
#if defined(__x86_64__)
  const Isa sets[] = {Isa::sse2, Isa::sse2, Isa::avx2, Isa::avx512};
  const Isa wanted = sets[std::size_t(isa_level())];
  return isa_available(wanted) ? wanted : choose_isa(NOOK_ISA_AUTO);
#else
  return choose_isa(NOOK_ISA_AUTO);
#endif
}

const char* embree_isa() {
  switch (isa_level()) {
    case IsaLevel::v2:
      return ",isa=sse4.2";
    case IsaLevel::v3:
      return ",isa=avx2";
    default:
      return "";
  }
}

}  // namespace nook::bake
