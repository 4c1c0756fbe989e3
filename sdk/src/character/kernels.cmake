# Sources of the CPU kernels with the flags of each instruction set; the tables are chosen at run time. Include it from
# sdk/CMakeLists.txt after the target exists: nook_add_kernels(target).
function(nook_add_kernels target)
  set(room ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  target_sources(${target} PRIVATE
    ${room}/linear_layer.cpp
    ${room}/linear_layer_order.cpp
    ${room}/shadow_kernels.cpp
    ${room}/shadow_kernels_rest.cpp
    ${room}/shadow_kernels_scalar.cpp
    ${room}/shadow_kernels_scatter.cpp)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    return()
  endif()
  # sqrt without errno is one instruction.
  set(math -fno-math-errno -fno-trapping-math)
  set_source_files_properties(${room}/shadow_kernels_scalar.cpp TARGET_DIRECTORY ${target}
                              PROPERTIES COMPILE_OPTIONS "${math}")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
    # Products and sums become one instruction where there is one.
    set(fused ${math} -ffp-contract=fast)
    # gcc's own header passes undefined registers to the AVX-512 instructions, and then warns of them (gcc bug 105593).
    set(undefined "$<$<CXX_COMPILER_ID:GNU>:;-Wno-maybe-uninitialized;-Wno-uninitialized>")
    target_sources(${target} PRIVATE
      ${room}/shadow_kernels_sse2.cpp
      ${room}/shadow_kernels_avx2.cpp
      ${room}/shadow_kernels_avx512.cpp)
    set_source_files_properties(${room}/shadow_kernels.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES COMPILE_DEFINITIONS NOOK_X86_KERNELS)
    # The scalar table is the yardstick of the others: what a compiler makes of the formulas one number at a time.
    set_source_files_properties(${room}/shadow_kernels_scalar.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES COMPILE_OPTIONS
                                "${math};-fno-tree-vectorize;-fno-tree-slp-vectorize")
    set_source_files_properties(${room}/shadow_kernels_sse2.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES COMPILE_OPTIONS "${math};-msse2")
    set_source_files_properties(${room}/shadow_kernels_avx2.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES COMPILE_OPTIONS "${fused};-mavx2;-mfma")
    set_source_files_properties(${room}/shadow_kernels_avx512.cpp TARGET_DIRECTORY ${target}
                                PROPERTIES COMPILE_OPTIONS "${fused};-mavx512f;-mfma;-mprefer-vector-width=512${undefined}")
  endif()
endfunction()
