// A context holds the host's callbacks. Every object that is created from a context keeps the context alive.
#pragma once

#include <nook/nook.h>

#include "sdk/src/core/compiler.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/core/ref.h"

namespace nook {

class Context : public RefCounted {
 public:
  explicit Context(const nook_context_desc& desc) noexcept
      : memory_(desc.allocator),
        log_(desc.log),
        log_user_(desc.log_user),
        parallel_{desc.parallel_for, desc.parallel_for_user},
        isa_(desc.isa),
        units_per_metre_(desc.units_per_metre) {}

  Memory* memory() noexcept { return &memory_; }
  const Parallel& parallel() const noexcept { return parallel_; }
  // Returns NOOK_ISA_AUTO, or the instruction set that the host chose. This processor supports the chosen
  // set.
  nook_isa isa() const noexcept { return isa_; }
  // Returns the length of one metre in the host's unit.
  float units_per_metre() const noexcept { return units_per_metre_; }
  // Logs a printf-style text, truncated to 512 characters. Does nothing if the host set no log.
  void log(nook_log_severity severity, const char* format, ...) const noexcept NOOK_PRINTF(3, 4);

 protected:
  const nook_allocator& allocator() const noexcept { return memory_.allocator(); }

 private:
  HostMemory memory_;
  nook_log_fn log_;
  void* log_user_;
  Parallel parallel_;
  nook_isa isa_;
  float units_per_metre_;
};

}  // namespace nook
