// Packs AO in [0, 1] as values of 32, 16 or 8 bits. NOOK_VALUES_PER_WORD is 1, 2 or 4.
uint nook_half(float value) {
  uint bits = floatBitsToUint(value);
  // Below 2^-14, half floats have steps of 2^-24.
  if (bits < 0x38800000u) return uint(floor(value * 16777216.0 + 0.5));
  // Rounds to the nearest half float, ties to even.
  return (bits - 0x38000000u + 0xfffu + ((bits >> 13) & 1u)) >> 13;
}

uint nook_packed(float value) {
#if NOOK_VALUES_PER_WORD == 1
  return floatBitsToUint(value);
#elif NOOK_VALUES_PER_WORD == 2
  return nook_half(value);
#else
  return uint(floor(value * 255.0 + 0.5));
#endif
}
