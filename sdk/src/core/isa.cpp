#include "sdk/src/core/isa.h"

#include <cstdio>

#include "sdk/src/core/failure.h"

namespace nook {
namespace {

Isa best_isa() {
  Isa best = Isa::scalar;
  for (const Isa isa : all_isas)
    if (isa_available(isa)) best = isa;
  return best;
}

[[noreturn]] void fail_unavailable(Isa asked) {
  char there[128] = "";
  std::size_t length = 0;
  for (const Isa isa : all_isas) {
    if (!isa_available(isa)) continue;
    const int added =
        std::snprintf(there + length, sizeof there - length, "%s%s", length ? ", " : "", isa_name(isa));
    if (added < 0 || length + static_cast<std::size_t>(added) >= sizeof there) break;
    length += static_cast<std::size_t>(added);
  }
  throw Failure(NOOK_ERROR_UNSUPPORTED,
                "this processor or this build of Nook does not support the instruction set (got isa %d, %s; "
                "need one of %s); use NOOK_ISA_AUTO",
                static_cast<int>(asked), isa_name(asked), there);
}

}  // namespace

bool isa_available(Isa isa) {
  switch (isa) {
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  case Isa::name:                                \
    return (built) && (runs);
#include "sdk/src/core/isa_list.inl"
  }
  return false;
}

Isa choose_isa(nook_isa asked) {
  if (asked == NOOK_ISA_AUTO) return best_isa();
  const Isa isa = static_cast<Isa>(asked);
  if (!isa_name(isa))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "isa is unknown (got %d, need %d to %d)",
                  static_cast<int>(asked), static_cast<int>(NOOK_ISA_AUTO), static_cast<int>(last_isa()));
  if (!isa_available(isa)) fail_unavailable(isa);
  return isa;
}

}  // namespace nook
