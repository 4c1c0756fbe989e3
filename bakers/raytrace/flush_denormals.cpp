#include "bakers/raytrace/flush_denormals.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <pmmintrin.h>
#elif defined(_M_ARM64)
#include <intrin.h>
#endif

namespace nook::bake {
namespace {

// The register that holds the mode, and its bits that flush inputs and results.
#if defined(__SSE2__) || defined(_M_X64)

constexpr std::uint64_t flush_bits = _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON;

std::uint64_t floating_point_mode() {
  return _mm_getcsr();
}
void set_floating_point_mode(std::uint64_t mode) {
  _mm_setcsr(unsigned(mode));
}

#elif defined(__aarch64__) || defined(_M_ARM64)

// FPCR.FZ. No header of GCC and Clang names this register, so they take it by assembly.
constexpr std::uint64_t flush_bits = std::uint64_t(1) << 24;

std::uint64_t floating_point_mode() {
#if defined(_M_ARM64)
  return std::uint64_t(_ReadStatusReg(ARM64_FPCR));
#else
  std::uint64_t mode;
  __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
  return mode;
#endif
}
void set_floating_point_mode(std::uint64_t mode) {
#if defined(_M_ARM64)
  _WriteStatusReg(ARM64_FPCR, __int64(mode));
#else
  __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
#endif
}

#else

constexpr std::uint64_t flush_bits = 0;

std::uint64_t floating_point_mode() {
  return 0;
}
void set_floating_point_mode(std::uint64_t) {}

#endif

}  // namespace

FlushDenormals::FlushDenormals() : saved_(floating_point_mode()) {
  set_floating_point_mode(saved_ | flush_bits);
}

FlushDenormals::~FlushDenormals() {
  set_floating_point_mode(saved_);
}

}  // namespace nook::bake
