// The instruction sets of the CPU kernels, from the simplest to the best. NOOK_ISA_AUTO takes the last set
// that can run. For each set, there is a folder of the same name in sdk/src/isa. It contains the set's vector
// type, kernels and compiler flags. Before you include this file, define
//   NOOK_ISA_ENTRY(name, value, built, runs)
// `name` is the name of the folder, and also part of the names of the namespace isa_name and of Isa::name.
// `value` is the value in the public header. `built` is 1 if this build has the kernels; isa.cmake in the
// folder decides this. `runs` is true if the processor can run them.

NOOK_ISA_ENTRY(scalar, NOOK_ISA_SCALAR, NOOK_BUILT_SCALAR, true)
NOOK_ISA_ENTRY(sse2, NOOK_ISA_SSE2, NOOK_BUILT_SSE2, processor_has_sse2())
NOOK_ISA_ENTRY(avx2, NOOK_ISA_AVX2, NOOK_BUILT_AVX2, processor_has_avx2_and_fma())
NOOK_ISA_ENTRY(avx512, NOOK_ISA_AVX512, NOOK_BUILT_AVX512, processor_has_avx512f())
NOOK_ISA_ENTRY(neon, NOOK_ISA_NEON, NOOK_BUILT_NEON, true)
NOOK_ISA_ENTRY(wasm128, NOOK_ISA_WASM128, NOOK_BUILT_WASM128, true)

#undef NOOK_ISA_ENTRY
