# Sources of the fits' kernels with the flags of each instruction set; the tables are chosen at run time. Include it from
# sdk/CMakeLists.txt after the target exists: nook_add_probe_kernels(target).
function(nook_add_probe_kernels target)
  set(room ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  target_sources(${target} PRIVATE ${room}/fit_kernels.cpp ${room}/fit_kernels_scalar.cpp)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" OR
     NOT (CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64" AND CMAKE_SIZEOF_VOID_P EQUAL 8))
    return()
  endif()
  set(math -O3 -fno-math-errno -fno-trapping-math)
  # Products and sums become one instruction where there is one.
  set(fused ${math} -ffp-contract=fast)
  # gcc's own header passes undefined registers to the AVX-512 instructions, and then warns of them (gcc bug 105593).
  set(undefined "$<$<CXX_COMPILER_ID:GNU>:;-Wno-maybe-uninitialized;-Wno-uninitialized>")
  target_sources(${target} PRIVATE
    ${room}/fit_kernels_sse2.cpp
    ${room}/fit_kernels_avx2.cpp
    ${room}/fit_kernels_avx512.cpp)
  set_source_files_properties(${room}/fit_kernels.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_DEFINITIONS NOOK_X86_KERNELS)
  # The scalar table is the yardstick of the others: what a compiler makes of the formulas one number at a time.
  set_source_files_properties(${room}/fit_kernels_scalar.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${math};-fno-tree-vectorize;-fno-tree-slp-vectorize")
  set_source_files_properties(${room}/fit_kernels_sse2.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${math};-msse2")
  set_source_files_properties(${room}/fit_kernels_avx2.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${fused};-mavx2;-mfma")
  set_source_files_properties(${room}/fit_kernels_avx512.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${fused};-mavx512f;-mfma;-mprefer-vector-width=512${undefined}")
endfunction()
