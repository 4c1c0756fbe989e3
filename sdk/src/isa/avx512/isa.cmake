# AVX-512F, on x86-64. The compiler may combine products and sums into FMA instructions. gcc's own header passes undefined
# registers to AVX-512 instructions, and gcc then warns about them (gcc bug 105593).
nook_target_is(isa_built "defined(__x86_64__) || defined(_M_X64)")
set(isa_flags -ffp-contract=fast -mavx512f -mfma -mprefer-vector-width=512
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-uninitialized>")
set(isa_flags_msvc /arch:AVX512)
