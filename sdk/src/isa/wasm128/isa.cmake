# WebAssembly with fixed-width SIMD. Runtimes without SIMD refuse every module that contains SIMD instructions. Fixed-width SIMD
# is available since Chromium 91, Firefox 89, Safari 16.4 and node 16.4.
nook_target_is(isa_built "defined(__wasm__)")
if(isa_built)
  option(NOOK_WASM128 "Build the SIMD128 kernels of WebAssembly" ON)
  set(isa_built ${NOOK_WASM128})
endif()
set(isa_flags -msimd128)
