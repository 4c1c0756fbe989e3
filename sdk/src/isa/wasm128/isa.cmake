# WebAssembly with fixed-width SIMD, which a module uses as a whole or not at all: with it, runtimes without SIMD refuse the module.
# Chromium 91, Firefox 89, Safari 16.4 and node 16.4 were the first with it.
nook_target_is(isa_built "defined(__wasm__)")
if(isa_built)
  option(NOOK_WASM128 "Build the SIMD128 kernels of WebAssembly" ON)
  set(isa_built ${NOOK_WASM128})
endif()
set(isa_flags -msimd128)
