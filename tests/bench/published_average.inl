// The running average as T. Roughton published it (2018), a sample and a lobe at a time, as one would write
// it first: the yardstick of the fits, which each instruction set's flags compile. Included in a namespace of
// its own.

struct Colour {
  float r, g, b;
};

inline Colour operator+(Colour x, Colour y) {
  return {x.r + y.r, x.g + y.g, x.b + y.b};
}
inline Colour operator-(Colour x, Colour y) {
  return {x.r - y.r, x.g - y.g, x.b - y.b};
}
inline Colour operator*(Colour x, float a) {
  return {x.r * a, x.g * a, x.b * a};
}

void published_average(PublishedFit& fit, const float* directions, const float* radiance, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k, directions += 3, radiance += 3) {
    const Colour light{radiance[0], radiance[1], radiance[2]};
    const float share = 1 / ++fit.weight;
    Colour sum{0, 0, 0};
    for (PublishedLobe& lobe : fit.lobes) {
      const float cosine =
          lobe.axis[0] * directions[0] + lobe.axis[1] * directions[1] + lobe.axis[2] * directions[2];
      lobe.value = std::exp(lobe.sharpness * (cosine - 1));
      sum = sum + Colour{lobe.amplitude[0], lobe.amplitude[1], lobe.amplitude[2]} * lobe.value;
    }
    for (PublishedLobe& lobe : fit.lobes) {
      if (lobe.value == 0) continue;
      const Colour before{lobe.amplitude[0], lobe.amplitude[1], lobe.amplitude[2]};
      lobe.square += (lobe.value * lobe.value - lobe.square) * share;
      const float denominator = std::max(lobe.square, 0.75f * lobe.true_square);
      const Colour others = sum - before * lobe.value;
      const Colour residual = (light - others) * lobe.value;
      const Colour target{residual.r / denominator, residual.g / denominator, residual.b / denominator};
      const Colour after = before + (target - before) * share;
      lobe.amplitude[0] = after.r;
      lobe.amplitude[1] = after.g;
      lobe.amplitude[2] = after.b;
    }
  }
}
