# Every 64-bit ARM processor has NEON.
nook_target_is(isa_built "defined(__aarch64__) || defined(_M_ARM64)")
