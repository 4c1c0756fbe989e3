// The kernels over one vector type. Each instruction set includes this file inside its own namespace, after
// defining there isa, Float, width, broadcast, load and store. Everything here but vector_kernels() has
// internal linkage.

namespace {

using transfer::LightView;
using transfer::VertexBlock;

// Places of the lobes of one vector in the grid, and 1 where a lobe has an effect, else 0.
struct alignas(64) Places {
  float column[width], row[width], effect[width];
};

void place_lobes(const LightView& light, const float* frame, std::uint32_t first, Places& places) {
  const Float x = load(light.axis_x + first), y = load(light.axis_y + first), z = load(light.axis_z + first);
  const auto along = [&](const float* axis) {
    return fma(broadcast(axis[0]), x, fma(broadcast(axis[1]), y, broadcast(axis[2]) * z));
  };
  const Float up = along(frame + 6);
  const Float scale = rsqrt(max(broadcast(1.0f) + up, broadcast(1e-3f))) * broadcast(light.scale);
  const Float low = broadcast(0.0f), high = broadcast(float(light.side - 1) - 1e-3f);
  const Float centre = broadcast(light.centre);
  store(places.column, min(max(fma(along(frame), scale, centre), low), high));
  store(places.row, min(max(fma(along(frame + 3), scale, centre), low), high));
  store(places.effect, select(less(up, broadcast(light.lowest_z)), broadcast(0.0f), broadcast(1.0f)));
}

bool all_dark(const std::uint8_t* shares, std::uint32_t count) {
  std::uint32_t any = 0;
  for (std::uint32_t i = 0; i < count; ++i) any |= shares[i];
  return any == 0;
}

// Adds the light of all lobes to the nodes of one vertex; a node has red, green, blue and 0.
void spread(const LightView& light, const std::uint8_t* shares, const float* frame, float* nodes) {
  Places places;
  for (std::uint32_t first = 0; first < light.lobes; first += width) {
    const std::uint32_t count = light.lobes - first < width ? light.lobes - first : width;
    if (shares && all_dark(shares + first, count)) continue;
    place_lobes(light, frame, first, places);
    for (std::uint32_t k = 0; k < count; ++k) {
      const float share = (shares ? float(shares[first + k]) : 255.0f) * places.effect[k];
      if (share == 0) continue;
      const auto column = std::uint32_t(places.column[k]), row = std::uint32_t(places.row[k]);
      const float right = places.column[k] - float(column), below = places.row[k] - float(row);
      const float* const amplitude = light.amplitudes + 4 * std::size_t(first + k);
      const float top[2] = {share * (1 - below) * (1 - right), share * (1 - below) * right};
      const float bottom[2] = {share * below * (1 - right), share * below * right};
      float* const upper = nodes + 4 * std::size_t(row * light.side + column);
      float* const lower = upper + 4 * std::size_t(light.side);
      float sums[16];
      for (int c = 0; c < 4; ++c) {
        sums[c] = upper[c] + top[0] * amplitude[c];
        sums[4 + c] = upper[4 + c] + top[1] * amplitude[c];
        sums[8 + c] = lower[c] + bottom[0] * amplitude[c];
        sums[12 + c] = lower[4 + c] + bottom[1] * amplitude[c];
      }
      std::memcpy(upper, sums, 32);
      std::memcpy(lower, sums + 8, 32);
    }
  }
}

// Weighs `Vectors` vectors of the table's lanes, from lane `first` on, with the nodes of Vertices vertices.
template <std::uint32_t Vertices, std::uint32_t Vectors>
void weigh(const LightView& light, const float* nodes, std::uint32_t node_floats, std::uint32_t first,
           const VertexBlock& block) {
  Float sums[Vertices][3][Vectors];
  for (auto& vertex : sums)
    for (auto& channel : vertex)
      for (Float& sum : channel) sum = broadcast(0.0f);
  for (std::uint32_t row = 0; row < light.side; ++row)
    for (std::uint32_t column = light.row_begin[row]; column < light.row_end[row]; ++column) {
      const std::size_t node = std::size_t(row) * light.side + column;
      const float* const table = light.table + node * 3 * light.lanes + first;
      for (std::uint32_t c = 0; c < 3; ++c)
        for (std::uint32_t k = 0; k < Vectors; ++k) {
          const Float response = load(table + std::size_t(c) * light.lanes + k * width);
          for (std::uint32_t v = 0; v < Vertices; ++v)
            sums[v][c][k] = fma(broadcast(nodes[v * node_floats + 4 * node + c]), response, sums[v][c][k]);
        }
    }
  const std::uint32_t used =
      light.light_modes - first < Vectors * width ? light.light_modes - first : Vectors * width;
  for (std::uint32_t v = 0; v < Vertices; ++v)
    for (std::uint32_t c = 0; c < 3; ++c) {
      alignas(64) float lanes[Vectors * width];
      for (std::uint32_t k = 0; k < Vectors; ++k) store(lanes + k * width, sums[v][c][k]);
      std::memcpy(block.vectors + v * block.stride + std::size_t(c) * light.light_modes + first, lanes,
                  used * sizeof(float));
    }
}

template <std::uint32_t Vertices>
void weigh_all(const LightView& light, const float* nodes, std::uint32_t node_floats,
               const VertexBlock& block) {
  constexpr std::uint32_t vectors = width >= 16 ? 1 : 2;
  for (std::uint32_t first = 0; first < light.light_modes; first += vectors * width)
    weigh<Vertices, vectors>(light, nodes, node_floats, first, block);
}

void vectors(const LightView& light, const VertexBlock& block) {
  const std::uint32_t node_floats = light.side * light.side * 4;
  std::memset(block.scratch, 0, std::size_t(block.count) * node_floats * sizeof(float));
  for (std::uint32_t v = 0; v < block.count; ++v)
    spread(light, block.shares ? block.shares + std::size_t(v) * light.lobes : nullptr,
           block.frames + 9 * std::size_t(v), block.scratch + std::size_t(v) * node_floats);
  if (block.count == 2)
    weigh_all<2>(light, block.scratch, node_floats, block);
  else
    weigh_all<1>(light, block.scratch, node_floats, block);
}

constexpr transfer::VectorKernels vector_table{isa, isa_name(isa), vectors};

}  // namespace

const transfer::VectorKernels& vector_kernels() {
  return vector_table;
}
