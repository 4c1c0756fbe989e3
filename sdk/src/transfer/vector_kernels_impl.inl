// The kernels over one vector type. Each instruction set includes this file inside its own namespace, after
// defining there isa, Float, width, broadcast, load and store. Everything here but vector_kernels() has
// internal linkage.

namespace {

using transfer::LightView;
using transfer::VertexBlock;

// The places of some lobes in the grid; few enough to stay in the first-level cache beside the grid.
inline constexpr std::uint32_t chunk = 64;
struct alignas(64) Places {
  float column[chunk], row[chunk];
  float effect[chunk];        // 1 where a lobe has an effect, else 0
  std::uint32_t lobe[chunk];  // those that are not dark, counted from the first of the chunk
};

void place_lobes(const LightView& light, const float* frame, std::uint32_t first, std::uint32_t count,
                 Places& places) {
  for (std::uint32_t i = 0; i < count; i += width) {
    const std::uint32_t j = first + i;
    const Float x = load(light.axis_x + j), y = load(light.axis_y + j), z = load(light.axis_z + j);
    const auto along = [&](const float* axis) {
      return fma(broadcast(axis[0]), x, fma(broadcast(axis[1]), y, broadcast(axis[2]) * z));
    };
    const Float up = along(frame + 6);
    const Float scale = rsqrt(max(broadcast(1.0f) + up, broadcast(1e-3f))) * broadcast(light.scale);
    const Float low = broadcast(0.0f), high = broadcast(float(light.side - 1) - 1e-3f);
    const Float centre = broadcast(light.centre);
    store(places.column + i, min(max(fma(along(frame), scale, centre), low), high));
    store(places.row + i, min(max(fma(along(frame + 3), scale, centre), low), high));
    store(places.effect + i, select(less(up, broadcast(light.lowest_z)), broadcast(0.0f), broadcast(1.0f)));
  }
}

// Lists the lobes of a chunk that are not dark, without a branch that no processor could predict.
std::uint32_t list_lobes(const std::uint8_t* shares, std::uint32_t chunk_lobes, Places& places) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < chunk_lobes; ++i) {
    places.lobe[count] = i;
    count += (!shares || shares[i] != 0) && places.effect[i] != 0;
  }
  return count;
}

// Adds the light of lobes to the nodes of one vertex; a node has red, green, blue and 0.
void add_lobes(const LightView& light, const Places& places, std::uint32_t count, std::uint32_t first,
               const std::uint8_t* shares, float* nodes) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = places.lobe[i];
    const float share = shares ? float(shares[j]) : 255.0f;
    const auto column = std::uint32_t(std::int32_t(places.column[j])),
               row = std::uint32_t(std::int32_t(places.row[j]));
    const float right = places.column[j] - float(std::int32_t(column));
    const float below = places.row[j] - float(std::int32_t(row));
    const Four amplitude = load_four(light.amplitudes + 4 * std::size_t(first + j)) * Four(share);
    const Four bottom = amplitude * Four(below), top = amplitude - bottom;
    float* const upper = nodes + 4 * std::size_t(row * light.side + column);
    float* const lower = upper + 4 * std::size_t(light.side);
    const Four top_right = top * Four(right), bottom_right = bottom * Four(right);
    store(upper, load_four(upper) + (top - top_right));
    store(upper + 4, load_four(upper + 4) + top_right);
    store(lower, load_four(lower) + (bottom - bottom_right));
    store(lower + 4, load_four(lower + 4) + bottom_right);
  }
}

void spread(const LightView& light, const std::uint8_t* shares, const float* frame, float* nodes) {
  Places places;
  for (std::uint32_t first = 0; first < light.lobes; first += chunk) {
    const std::uint32_t rest = light.lobes - first, lobes = rest < chunk ? rest : chunk;
    const std::uint8_t* const some = shares ? shares + first : nullptr;
    place_lobes(light, frame, first, lobes, places);
    add_lobes(light, places, list_lobes(some, lobes, places), first, some, nodes);
  }
}

// Vectors of the table that are weighed at once: with two vertices and three channels, 12 sums fit into 16
// registers.
inline constexpr std::uint32_t group = width >= 16 ? 1 : 2;

template <std::uint32_t Vertices>
struct Sums {
  Float of[Vertices][3][group];
};

// Adds one row of the table, weighed with the nodes of Vertices vertices, for the lanes from `first` on.
template <std::uint32_t Vertices>
void weigh_row(const LightView& light, const float* nodes, std::uint32_t node_floats, std::uint32_t row,
               std::uint32_t first, Sums<Vertices>& out) {
  Sums<Vertices> sums = out;
  for (std::uint32_t column = light.row_begin[row]; column < light.row_end[row]; ++column) {
    const std::size_t node = std::size_t(row) * light.side + column;
    const float* const table = light.table + node * 3 * light.lanes + first;
    for (std::uint32_t c = 0; c < 3; ++c)
      for (std::uint32_t k = 0; k < group; ++k) {
        const Float response = load(table + std::size_t(c) * light.lanes + k * width);
        for (std::uint32_t v = 0; v < Vertices; ++v)
          sums.of[v][c][k] =
              fma(broadcast(nodes[v * node_floats + 4 * node + c]), response, sums.of[v][c][k]);
      }
  }
  out = sums;
}

template <std::uint32_t Vertices>
void clear(Sums<Vertices>& sums) {
  for (auto& vertex : sums.of)
    for (auto& channel : vertex)
      for (Float& sum : channel) sum = broadcast(0.0f);
}

template <std::uint32_t Vertices>
void write(const LightView& light, const Sums<Vertices>& sums, std::uint32_t first, const VertexBlock& block,
           std::uint32_t first_vertex) {
  const std::uint32_t rest = light.light_modes - first, used = rest < group * width ? rest : group * width;
  for (std::uint32_t v = 0; v < Vertices; ++v)
    for (std::uint32_t c = 0; c < 3; ++c) {
      alignas(64) float lanes[group * width];
      for (std::uint32_t k = 0; k < group; ++k) store(lanes + k * width, sums.of[v][c][k]);
      std::memcpy(
          block.vectors + (first_vertex + v) * block.stride + std::size_t(c) * light.light_modes + first,
          lanes, used * sizeof(float));
    }
}

// Row by row over all vertices of the block, so that a row of the table is read from the second-level cache
// once.
void weigh(const LightView& light, const VertexBlock& block, std::uint32_t node_floats) {
  const std::uint32_t pairs = block.count / 2, single = block.count % 2;
  for (std::uint32_t first = 0; first < light.light_modes; first += group * width) {
    Sums<2> sums[transfer::block_vertices / 2];
    Sums<1> last;
    for (std::uint32_t p = 0; p < pairs; ++p) clear(sums[p]);
    clear(last);
    const float* const odd = block.scratch + 2 * std::size_t(pairs) * node_floats;
    for (std::uint32_t row = 0; row < light.side; ++row) {
      for (std::uint32_t p = 0; p < pairs; ++p)
        weigh_row<2>(light, block.scratch + 2 * std::size_t(p) * node_floats, node_floats, row, first,
                     sums[p]);
      if (single) weigh_row<1>(light, odd, node_floats, row, first, last);
    }
    for (std::uint32_t p = 0; p < pairs; ++p) write(light, sums[p], first, block, 2 * p);
    if (single) write(light, last, first, block, 2 * pairs);
  }
}

void vectors(const LightView& light, const VertexBlock& block) {
  const std::uint32_t node_floats = light.side * light.side * 4;
  std::memset(block.scratch, 0, std::size_t(block.count) * node_floats * sizeof(float));
  for (std::uint32_t v = 0; v < block.count; ++v)
    spread(light, block.shares ? block.shares + std::size_t(v) * light.lobes : nullptr,
           block.frames + 9 * std::size_t(v), block.scratch + std::size_t(v) * node_floats);
  weigh(light, block, node_floats);
}

constexpr transfer::VectorKernels vector_table{isa, isa_name(isa), vectors};

}  // namespace

const transfer::VectorKernels& vector_kernels() {
  return vector_table;
}
