# Every x86-64 processor has SSE2.
nook_target_is(isa_built "defined(__x86_64__) || defined(_M_X64)")
set(isa_flags -msse2)
