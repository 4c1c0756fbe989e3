# Kernels: one text compiled once for each instruction set, with its flags; the tables are chosen at run time.
# nook_add_kernels(target stem) adds stem.cpp, which chooses, and stem_scalar.cpp, and on x86 stem_sse2.cpp,
# stem_avx2.cpp and stem_avx512.cpp.
function(nook_add_kernels target stem)
  target_sources(${target} PRIVATE ${stem}.cpp ${stem}_scalar.cpp)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    return()
  endif()
  # sqrt without errno is one instruction.
  set(math -O3 -fno-math-errno -fno-trapping-math)
  set_source_files_properties(${stem}_scalar.cpp TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${math}")
  if(NOT (CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64" AND CMAKE_SIZEOF_VOID_P EQUAL 8))
    return()
  endif()
  # Products and sums become one instruction where there is one.
  set(fused ${math} -ffp-contract=fast)
  # gcc's own header passes undefined registers to the AVX-512 instructions, and then warns of them (gcc bug 105593).
  set(undefined "$<$<CXX_COMPILER_ID:GNU>:;-Wno-maybe-uninitialized;-Wno-uninitialized>")
  target_sources(${target} PRIVATE ${stem}_sse2.cpp ${stem}_avx2.cpp ${stem}_avx512.cpp)
  set_source_files_properties(${stem}.cpp TARGET_DIRECTORY ${target} PROPERTIES COMPILE_DEFINITIONS NOOK_X86_KERNELS)
  # The scalar table is the yardstick of the others: what a compiler makes of the formulas one number at a time.
  set_source_files_properties(${stem}_scalar.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${math};-fno-tree-vectorize;-fno-tree-slp-vectorize")
  set_source_files_properties(${stem}_sse2.cpp TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${math};-msse2")
  set_source_files_properties(${stem}_avx2.cpp TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${fused};-mavx2;-mfma")
  set_source_files_properties(${stem}_avx512.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${fused};-mavx512f;-mfma;-mprefer-vector-width=512${undefined}")
endfunction()
