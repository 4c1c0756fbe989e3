// The fast step of running averages, eight samples at a time. A part of fit_kernels_impl.inl.

// Two vectors of samples: their functions become orthonormal ones, in place, from the last to the first,
// which needs none of the later ones.
void whiten(const WhiteView& fit, float* values) {
  for (std::uint32_t block = (fit.count + 3) / 4; block-- > 0;) {
    const float* factor = fit.whitening + 8 * block * (block + 1);
    Float first[4], second[4];
    for (std::uint32_t i = 0; i < 4; ++i) first[i] = second[i] = broadcast(0.0f);
    const std::uint32_t end = std::min(4 * block + 4, fit.count);
    for (std::uint32_t j = 0; j < end; ++j, factor += 4) {
      const Float a = load(values + j * sample_chunk), b = load(values + j * sample_chunk + width);
      for (std::uint32_t i = 0; i < 4; ++i) {
        const Float f = broadcast(factor[i]);
        first[i] = fma(f, a, first[i]);
        second[i] = fma(f, b, second[i]);
      }
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
      store(values + (4 * block + i) * sample_chunk, first[i]);
      store(values + (4 * block + i) * sample_chunk + width, second[i]);
    }
  }
}

// Of a chunk before its first step.
struct ChunkSteps {
  alignas(64) float residual[3][sample_chunk];  // between the samples and the fit
  alignas(64) float step[sample_chunk];         // - w / (W + w p)
};

void prepare_steps(const WhiteView& fit, const SampleColumns& samples, const float* total, std::uint32_t k,
                   const float* values, ChunkSteps& steps) {
  const Float zero = broadcast(0.0f);
  Float leverage = zero, red = zero, green = zero, blue = zero;
  for (std::uint32_t i = 0; i < fit.count; ++i) {
    const Float u = load(values + i * sample_chunk);
    leverage = fma(u, u, leverage);
    red = fma(broadcast(fit.value[0][i]), u, red);
    green = fma(broadcast(fit.value[1][i]), u, green);
    blue = fma(broadcast(fit.value[2][i]), u, blue);
  }
  store(steps.residual[0] + k, load(samples.red + k) - red);
  store(steps.residual[1] + k, load(samples.green + k) - green);
  store(steps.residual[2] + k, load(samples.blue + k) - blue);
  const Float weight = load(samples.weight + k);
  store(steps.step + k, zero - weight / fma(weight, leverage, load(total + k)));
}

// What the changes since the chunk began leave of the residuals of eight samples, as RGB0, and how much of
// sample j's residual each later one loses, in rows[j].
struct Block {
  Four residual[8];
  alignas(32) float rows[7][8];
};

Block residuals_of(const WhiteView& fit, const ChunkSteps& steps, std::uint32_t k, const float* values) {
  Eight red = load_eight(steps.residual[0] + k), green = load_eight(steps.residual[1] + k),
        blue = load_eight(steps.residual[2] + k);
  Eight products[7];
  for (Eight& row : products) row = Eight(0.0f);
  for (std::uint32_t i = 0; i < fit.count; ++i, values += sample_chunk) {
    const Eight u = load_eight(values);
    red = product_plus(Eight(fit.change[4 * i]), u, red);
    green = product_plus(Eight(fit.change[4 * i + 1]), u, green);
    blue = product_plus(Eight(fit.change[4 * i + 2]), u, blue);
    for (std::uint32_t j = 0; j < 7; ++j) products[j] = product_plus(Eight(values[j]), u, products[j]);
  }
  Block block;
  for (std::uint32_t j = 0; j < 7; ++j) store(block.rows[j], products[j] * Eight(steps.step[k + j]));
  alignas(32) float channel[3][8];
  store(channel[0], red);
  store(channel[1], green);
  store(channel[2], blue);
  for (std::uint32_t half = 0; half < 8; half += 4) {
    Four* const r = block.residual + half;
    r[0] = load_four(channel[0] + half);
    r[1] = load_four(channel[1] + half);
    r[2] = load_four(channel[2] + half);
    r[3] = Four(0.0f);
    transpose(r[0], r[1], r[2], r[3]);
  }
  return block;
}

// fit.change is negative here, as the steps are.
void step_block(const WhiteView& fit, const ChunkSteps& steps, std::uint32_t k, const float* values) {
  const Block block = residuals_of(fit, steps, k, values);
  Four r[8];
  for (std::uint32_t i = 0; i < 8; ++i) r[i] = block.residual[i];
  for (std::uint32_t j = 0; j < 7; ++j)
    for (std::uint32_t i = j + 1; i < 8; ++i) r[i] = fma(Four(block.rows[j][i]), r[j], r[i]);
  for (std::uint32_t i = 0; i < 8; ++i) r[i] = r[i] * Four(steps.step[k + i]);
  for (std::uint32_t i = 0; i < fit.count; ++i, values += sample_chunk) {
    Four even = load_four(fit.change + 4 * i), odd = Four(values[1]) * r[1];
    even = fma(Four(values[0]), r[0], even);
    for (std::uint32_t j = 2; j < 8; j += 2) {
      even = fma(Four(values[j]), r[j], even);
      odd = fma(Four(values[j + 1]), r[j + 1], odd);
    }
    store(fit.change + 4 * i, even + odd);
  }
}

void step_fast(const WhiteView& fit, const SampleColumns& samples, const float* total, std::uint32_t count,
               float* values) {
  ChunkSteps steps;
  const std::uint32_t end = whole_pairs(count);
  for (std::uint32_t k = 0; k < end; k += pair) {
    whiten(fit, values + k);
    prepare_steps(fit, samples, total, k, values + k, steps);
    prepare_steps(fit, samples, total, k + width, values + k + width, steps);
  }
  std::fill_n(fit.change, 4 * fit.count, 0.0f);
  for (std::uint32_t k = 0; k < count; k += 8) step_block(fit, steps, k, values + k);
  for (std::uint32_t i = 0; i < 4 * fit.count; ++i) fit.change[i] = -fit.change[i];
}
