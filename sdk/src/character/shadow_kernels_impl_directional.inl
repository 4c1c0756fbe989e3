// The same layers with a colour: each sphere's term times the light behind it. Include after
// shadow_kernels_impl.inl, in the same namespace.

namespace {

struct SeenDirection {
  Direction<Float> offset;  // to the sphere's centre, in its radii
  Float xi, delta2;
};

SeenDirection see_direction(const SphereSoa& spheres, std::uint32_t i, const Points<Float>& p) {
  const Float inverse_radius = broadcast(spheres.inverse_radius[i]);
  const Direction<Float> o{(broadcast(spheres.x[i]) - p.x) * inverse_radius,
                           (broadcast(spheres.y[i]) - p.y) * inverse_radius,
                           (broadcast(spheres.z[i]) - p.z) * inverse_radius};
  return {o, fma(o.x, p.nx, fma(o.y, p.ny, o.z * p.nz)), fma(o.x, o.x, fma(o.y, o.y, o.z * o.z))};
}

Direction<Float> normal_of(const Points<Float>& p) {
  return {p.nx, p.ny, p.nz};
}

Colour<Float> load_colour(float* const* rgb, std::uint32_t k) {
  return {load(rgb[0] + k), load(rgb[1] + k), load(rgb[2] + k)};
}
void store_colour(float* const* rgb, std::uint32_t k, const Colour<Float>& colour) {
  store(rgb[0] + k, colour.r);
  store(rgb[1] + k, colour.g);
  store(rgb[2] + k, colour.b);
}

template <KernelForm Form, NormPower P>
void directional_norm(const SphereSoa& spheres, const KeyPointSoa& points, float gamma,
                      const LightView& light, float* const* rgb) {
  const Float exponent = broadcast(gamma);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    const Colour<Float> inverse = inverse_hemisphere(light, n);
    Colour<Float> total = load_colour(rgb, k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection seen = see_direction(spheres, i, p);
      const Float y = shadow_term(Form, seen.xi, seen.delta2);
      const Colour<Float> ratio =
          light_ratio(light, inverse, n, sight_of(n, seen.offset, seen.xi, seen.delta2), y,
                      broadcast(no_sharpest), self_ratio);
      const Float term = raised<P>(y, exponent);
      total = {fma(term, ratio.r, total.r), fma(term, ratio.g, total.g), fma(term, ratio.b, total.b)};
    }
    store_colour(rgb, k, total);
  }
}

template <KernelForm Form>
void directional_norm_of_form(const SphereSoa& spheres, const KeyPointSoa& points, float gamma,
                              const LightView& light, float* const* rgb) {
  switch (norm_power(gamma)) {
    case NormPower::one:
      return directional_norm<Form, NormPower::one>(spheres, points, gamma, light, rgb);
    case NormPower::three_halves:
      return directional_norm<Form, NormPower::three_halves>(spheres, points, gamma, light, rgb);
    case NormPower::two:
      return directional_norm<Form, NormPower::two>(spheres, points, gamma, light, rgb);
    case NormPower::general:
      return directional_norm<Form, NormPower::general>(spheres, points, gamma, light, rgb);
  }
}

void directional_norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, const Kernel& kernel,
                          const LightView& light, float* const* rgb) {
  switch (kernel.form) {
    case KernelForm::paper:
      return directional_norm_of_form<KernelForm::paper>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::nook:
      return directional_norm_of_form<KernelForm::nook>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::rational:
      return directional_norm_of_form<KernelForm::rational>(spheres, points, kernel.gamma, light, rgb);
  }
}

void directional_depth(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                       float* const* rgb) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    const Colour<Float> inverse = inverse_hemisphere(light, n);
    JointSight<Float> joint;
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection seen = see_direction(spheres, i, p);
      joint.add(sight_of(n, seen.offset, seen.xi, seen.delta2),
                form_factor_fast(seen.xi, seen.delta2) * broadcast(spheres.caster_weight[i]));
    }
    const Colour<Float> ratio = light_ratio(
        light, inverse, n, joint.mean(n), min(joint.taken, broadcast(1.0f)), joint.sharpest(), caster_ratio);
    const Colour<Float> total = load_colour(rgb, k);
    store_colour(rgb, k,
                 {fma(joint.taken, ratio.r, total.r), fma(joint.taken, ratio.g, total.g),
                  fma(joint.taken, ratio.b, total.b)});
  }
}

void directional_open(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                      float* const* rgb) {
  const Float one = broadcast(1.0f);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    const Colour<Float> inverse = inverse_hemisphere(light, n);
    Colour<Float> product = load_colour(rgb, k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection seen = see_direction(spheres, i, p);
      const Float weight = spheres.caster_weight ? broadcast(spheres.caster_weight[i]) : one;
      const Float share = min(weight * form_factor_exact(seen.xi, seen.delta2), one);
      const Colour<Float> ratio =
          light_ratio(light, inverse, n, sight_of(n, seen.offset, seen.xi, seen.delta2), share,
                      broadcast(no_sharpest), caster_ratio);
      product = {product.r * (one - min(share * ratio.r, one)), product.g * (one - min(share * ratio.g, one)),
                 product.b * (one - min(share * ratio.b, one))};
    }
    store_colour(rgb, k, product);
  }
}

}  // namespace
