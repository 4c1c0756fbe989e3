# AVX2 and FMA, on x86-64. The compiler may combine products and sums into FMA instructions.
nook_target_is(isa_built "defined(__x86_64__) || defined(_M_X64)")
set(isa_flags -ffp-contract=fast -mavx2 -mfma)
set(isa_flags_msvc /arch:AVX2)
