#include "sdk/src/core/isa.h"

// clang-cl also takes this branch, because it does not link the library that __builtin_cpu_supports needs.
#if defined(_M_X64) && defined(_MSC_VER)
#include <intrin.h>
#define NOOK_PROCESSOR_CPUID
#elif defined(__x86_64__)
#define NOOK_PROCESSOR_BUILTIN
#endif

namespace nook {

#if defined(NOOK_PROCESSOR_BUILTIN)

bool processor_has_sse2() {
  return __builtin_cpu_supports("sse2");
}
bool processor_has_avx2_and_fma() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
bool processor_has_avx512f() {
  return __builtin_cpu_supports("avx512f");
}

#elif defined(NOOK_PROCESSOR_CPUID)

namespace {

enum Register { eax, ebx, ecx, edx };

bool has_bit(int leaf, Register result, int bit) {
  int registers[4];
  __cpuidex(registers, 0, 0);
  if (registers[eax] < leaf) return false;
  __cpuidex(registers, leaf, 0);
  return registers[result] >> bit & 1;
}

// Returns true if the operating system saves these registers on a context switch. `registers` are bits of
// XCR0.
bool saves(unsigned registers) {
  constexpr int osxsave = 27;
  return has_bit(1, ecx, osxsave) && (_xgetbv(0) & registers) == registers;
}

constexpr unsigned xmm_ymm = 0x6;
constexpr unsigned xmm_ymm_zmm = 0xe6;  // includes the mask registers

}  // namespace

bool processor_has_sse2() {
  return has_bit(1, edx, 26);
}
bool processor_has_avx2_and_fma() {
  return saves(xmm_ymm) && has_bit(7, ebx, 5) && has_bit(1, ecx, 12);
}
bool processor_has_avx512f() {
  return saves(xmm_ymm_zmm) && has_bit(7, ebx, 16);
}

#else

bool processor_has_sse2() {
  return false;
}
bool processor_has_avx2_and_fma() {
  return false;
}
bool processor_has_avx512f() {
  return false;
}

#endif

}  // namespace nook
