# Sources of the CPU kernels with the flags of each instruction set; the tables are chosen at run time. Sets
# NOOK_KERNEL_SOURCES (relative to sdk/) and NOOK_KERNEL_DEFINITIONS.
set(NOOK_KERNEL_SOURCES
  src/character/linear_layer.cpp
  src/character/shadow_kernels.cpp
  src/character/shadow_kernels_rest.cpp
  src/character/shadow_kernels_scalar.cpp)
set(NOOK_KERNEL_DEFINITIONS)
