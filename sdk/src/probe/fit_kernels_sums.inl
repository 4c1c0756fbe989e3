// Sums of products over the samples of a chunk. A part of fit_kernels_impl.inl.

// Returns four sums, each over the lanes of one vector.
NOOK_INLINE Four sums_of(Float first, Float second, Float third, Float fourth) {
  Four a = folded(first), b = folded(second), c = folded(third), d = folded(fourth);
  transpose(a, b, c, d);
  return (a + b) + (c + d);
}

// For each of `Left` vectors, adds the sum of its lanes to `sums`.
template <std::uint32_t Left>
NOOK_INLINE void add_sums(const Float (&total)[Left], double* sums) {
  float sum_of[Left];
  if constexpr (Left == 4)
    store(sum_of, sums_of(total[0], total[1], total[2], total[3]));
  else
    sum_of[0] = sum(total[0]);
  for (std::uint32_t i = 0; i < Left; ++i) sums[i] += double(sum_of[i]);
}

// Computes a tile of Left x Right sums in registers. There must be at least one vector of samples.
template <std::uint32_t Left, std::uint32_t Right>
void block_products(const float* left, const float* right, std::uint32_t end, double* sums,
                    std::uint32_t stride) {
  Float total[Right][Left];
  for (auto& row : total)
    for (Float& entry : row) entry = broadcast(0.0f);
  std::uint32_t k = 0;
  do {
    Float b[Right];
    for (std::uint32_t j = 0; j < Right; ++j) b[j] = load(right + j * sample_chunk + k);
    for (std::uint32_t i = 0; i < Left; ++i) {
      const Float a = load(left + i * sample_chunk + k);
      for (std::uint32_t j = 0; j < Right; ++j) total[j][i] = fma(a, b[j], total[j][i]);
    }
    k += width;
  } while (k < end);
  add_sums(total[0], sums);
  if constexpr (Right == 3) {
    add_sums(total[1], sums + stride);
    add_sums(total[2], sums + 2 * stride);
  }
}

template <std::uint32_t Right>
void row_products(const float* left, std::uint32_t left_rows, const float* right, std::uint32_t end,
                  double* sums, std::uint32_t stride) {
  std::uint32_t i = 0;
  for (; i + 4 <= left_rows; i += 4)
    block_products<4, Right>(left + i * sample_chunk, right, end, sums + i, stride);
  for (; i < left_rows; ++i) block_products<1, Right>(left + i * sample_chunk, right, end, sums + i, stride);
}

void sum_products(const float* left, std::uint32_t left_rows, const float* right, std::uint32_t right_rows,
                  std::uint32_t count, bool triangle, double* sums, std::uint32_t stride) {
  const std::uint32_t end = whole_pairs(count);
  std::uint32_t j = 0;
  for (; j + 3 <= right_rows; j += 3)
    row_products<3>(left, triangle ? std::min(left_rows, (j + 6) & ~3u) : left_rows, right + j * sample_chunk,
                    end, sums + j * stride, stride);
  for (; j < right_rows; ++j)
    row_products<1>(left, triangle ? j + 1 : left_rows, right + j * sample_chunk, end, sums + j * stride,
                    stride);
}
