// The same layers with a colour: each term of a sphere is multiplied by the light behind it. This file must
// be included after shadow_kernels_impl.inl, in the same namespace.

namespace {

template <class F>
struct SeenDirection {
  Direction<F> offset;  // to the sphere's centre, in its radii
  F xi, delta2;
};

template <class F>
SeenDirection<F> see_direction(const SphereSoa& spheres, std::uint32_t i, const Points<F>& p) {
  const F inverse_radius = F(broadcast(spheres.inverse_radius[i]));
  const Direction<F> o{(F(broadcast(spheres.x[i])) - p.x) * inverse_radius,
                       (F(broadcast(spheres.y[i])) - p.y) * inverse_radius,
                       (F(broadcast(spheres.z[i])) - p.z) * inverse_radius};
  return {o, fma(o.x, p.nx, fma(o.y, p.ny, o.z * p.nz)), fma(o.x, o.x, fma(o.y, o.y, o.z * o.z))};
}

template <class F>
Direction<F> normal_of(const Points<F>& p) {
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
                      const LightBands& light, float* const* rgb) {
  const Float exponent = broadcast(gamma);
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    GatheredBands<Float> gathered = GatheredBands<Float>::none();
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection<Float> seen = see_direction(spheres, i, p);
      const Float y = shadow_term(Form, seen.xi, seen.delta2);
      gather(gathered, n, sight_of(n, seen.offset, seen.xi, seen.delta2), y, raised<P>(y, exponent));
    }
    const Colour<Float> sum = coloured_sum(gathered, light, n), before = load_colour(rgb, k);
    store_colour(rgb, k, {before.r + sum.r, before.g + sum.g, before.b + sum.b});
  }
}

template <KernelForm Form>
void directional_norm_of_form(const SphereSoa& spheres, const KeyPointSoa& points, float gamma,
                              const LightBands& light, float* const* rgb) {
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
                          const LightBands& light, float* const* rgb) {
  switch (kernel.form) {
    case KernelForm::paper:
      return directional_norm_of_form<KernelForm::paper>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::nook:
      return directional_norm_of_form<KernelForm::nook>(spheres, points, kernel.gamma, light, rgb);
    case KernelForm::rational:
      return directional_norm_of_form<KernelForm::rational>(spheres, points, kernel.gamma, light, rgb);
  }
}

void directional_hemisphere(const KeyPointSoa& points, const LightView& light, float* const* inverse) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width)
    store_colour(inverse, k, inverse_hemisphere(light, normal_of(load_points<Float>(points, k))));
}

template <class F>
JointSight<F> joint_sight(const SphereSoa& spheres, const Points<F>& p) {
  const Direction<F> n = normal_of(p);
  JointSight<F> joint;
  for (std::uint32_t i = 0; i < spheres.count; ++i) {
    const SeenDirection<F> seen = see_direction(spheres, i, p);
    joint.add(sight_of(n, seen.offset, seen.xi, seen.delta2),
              form_factor_fast(seen.xi, seen.delta2) * F(broadcast(spheres.caster_weight[i])));
  }
  return joint;
}

void add_depth(const JointSight<Float>& joint, const Points<Float>& p, const LightView& light,
               float* const* inverse, std::uint32_t k, float* const* rgb) {
  const Direction<Float> n = normal_of(p);
  const Colour<Float> ratio = light_ratio(light, load_colour(inverse, k), n, joint.mean(n),
                                          min(joint.taken, broadcast(1.0f)), joint.sharpest());
  const Colour<Float> total = load_colour(rgb, k);
  store_colour(rgb, k,
               {fma(joint.taken, ratio.r, total.r), fma(joint.taken, ratio.g, total.g),
                fma(joint.taken, ratio.b, total.b)});
}

void directional_depth(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                       float* const* inverse, float* const* rgb) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    add_depth(joint_sight(spheres, p), p, light, inverse, k, rgb);
  }
}

Colour<Float> left_of(const Colour<Float>& open, Float share, const Colour<Float>& ratio) {
  const Float one = broadcast(1.0f);
  return {open.r * (one - min(share * ratio.r, one)), open.g * (one - min(share * ratio.g, one)),
          open.b * (one - min(share * ratio.b, one))};
}

void directional_open(const SphereSoa& spheres, const KeyPointSoa& points, const LightView& light,
                      float* const* inverse, float* const* rgb) {
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const Direction<Float> n = normal_of(p);
    Colour<Float> open = load_colour(rgb, k);
    for (std::uint32_t i = 0; i < spheres.count; ++i) {
      const SeenDirection<Float> seen = see_direction(spheres, i, p);
      const Float share = min(form_factor_exact(seen.xi, seen.delta2), broadcast(1.0f));
      open =
          left_of(open, share,
                  light_ratio(light, load_colour(inverse, k), n,
                              sight_of(n, seen.offset, seen.xi, seen.delta2), share, broadcast(no_sharpest)));
    }
    store_colour(rgb, k, open);
  }
}

void directional_ground(const SphereSoa& ground, const KeyPointSoa& points, const LightView& light, Vec3 up,
                        float* const* rgb) {
  const Direction<Float> above{broadcast(up.x), broadcast(up.y), broadcast(up.z)};
  for (std::uint32_t k = 0; k < points.padded_count; k += width) {
    const Points<Float> p = load_points<Float>(points, k);
    const SeenDirection<Float> seen = see_direction(ground, 0, p);
    const Float share = min(form_factor_exact(seen.xi, seen.delta2), broadcast(1.0f));
    store_colour(rgb, k, left_of(load_colour(rgb, k), share, ground_ratio(light, normal_of(p), above)));
  }
}

}  // namespace
