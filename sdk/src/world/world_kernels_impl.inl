// The kernels for one vector type. Each instruction set includes this file inside its own namespace. Before
// that, it must define isa, Float with the operations of core/simd_scalar.h, width, broadcast, load and
// store.

namespace {

// Returns a caster relative to each of `width` points, with its radii multiplied by `scale`.
world::CapsuleLanes<Float> lanes_of(const PosedCaster& caster, float scale, Float x, Float y, Float z) {
  const Capsule& c = caster.capsule;
  return {broadcast(c.a.x) - x,          broadcast(c.a.y) - y,         broadcast(c.a.z) - z,
          broadcast(c.b.x) - x,          broadcast(c.b.y) - y,         broadcast(c.b.z) - z,
          broadcast(scale * c.radius_a), broadcast(scale * c.radius_b)};
}

void open_hemisphere(const PosedCaster* casters, std::uint32_t count, const world::PointSoa& points,
                     float* open) {
  for (std::uint32_t i = 0; i < points.padded_count; i += width) {
    const Float x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    const Float nx = load(points.nx + i), ny = load(points.ny + i), nz = load(points.nz + i);
    Float left = load(open + i);
    for (std::uint32_t k = 0; k < count; ++k)
      left = left *
             (Float(1.0f) - world::coverage(lanes_of(casters[k], casters[k].ao_scale, x, y, z), nx, ny, nz));
    store(open + i, left);
  }
}

world::GatheredTerms<Float> load_gathered(const world::GatheredSoa& gathered, std::uint32_t i) {
  world::GatheredTerms<Float> terms;
  for (int lane = 0; lane < world::GatheredSoa::lanes; ++lane)
    terms.sum[lane] = load(gathered.lane[lane] + i);
  return terms;
}

void gather_hemisphere(const PosedCaster* casters, std::uint32_t count, const world::PointSoa& points,
                       float* open, const world::GatheredSoa& gathered) {
  for (std::uint32_t i = 0; i < points.padded_count; i += width) {
    const Float x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    const Direction<Float> n{load(points.nx + i), load(points.ny + i), load(points.nz + i)};
    Float left = load(open + i);
    world::GatheredTerms<Float> terms = load_gathered(gathered, i);
    for (std::uint32_t k = 0; k < count; ++k) {
      Direction<Float> phi;
      const Float share =
          world::coverage(lanes_of(casters[k], casters[k].ao_scale, x, y, z), n.x, n.y, n.z, phi);
      left = left * (Float(1.0f) - share);
      world::gather(terms, n, phi, share);
    }
    store(open + i, left);
    for (int lane = 0; lane < world::GatheredSoa::lanes; ++lane)
      store(gathered.lane[lane] + i, terms.sum[lane]);
  }
}

void open_light(const world::LightTerms& terms, const world::PointSoa& points,
                const world::GatheredSoa& gathered, const float* open, float* const* rgb) {
  for (std::uint32_t i = 0; i < points.padded_count; i += width) {
    const Direction<Float> n{load(points.nx + i), load(points.ny + i), load(points.nz + i)};
    const Colour<Float> light = world::open_light(load_gathered(gathered, i), terms, n, load(open + i));
    store(rgb[0] + i, light.r);
    store(rgb[1] + i, light.g);
    store(rgb[2] + i, light.b);
  }
}

void open_part(const PosedCaster* casters, std::uint32_t count, const world::PointSoa& points, Vec3 axis,
               float slope, float* open) {
  const Float lx = broadcast(axis.x), ly = broadcast(axis.y), lz = broadcast(axis.z), s = broadcast(slope);
  for (std::uint32_t i = 0; i < points.padded_count; i += width) {
    const Float x = load(points.x + i), y = load(points.y + i), z = load(points.z + i);
    Float left = load(open + i);
    for (std::uint32_t k = 0; k < count; ++k)
      left = left * (Float(1.0f) - world::part_coverage(lanes_of(casters[k], 1, x, y, z), lx, ly, lz, s));
    store(open + i, left);
  }
}

constexpr world::WorldKernels world_table{isa,        isa_name(isa), open_hemisphere, gather_hemisphere,
                                          open_light, open_part};

}  // namespace

const world::WorldKernels& world_kernels() {
  return world_table;
}
