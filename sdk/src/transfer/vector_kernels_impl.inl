// The kernels for one vector type. Each instruction set includes this file inside its own namespace. Before
// that, it must define isa, Float, width, broadcast, load and store there. Everything here except
// vector_kernels() has internal linkage.

namespace {

using transfer::LightView;
using transfer::VertexBlock;

// The positions of some lobes in the grid. The number of lobes is small, so that positions and grid stay in
// the first-level cache, and one word has a bit for each lobe.
inline constexpr std::uint32_t chunk = 64;
struct alignas(64) Places {
  float node[chunk];                 // index of the upper left node of the four nodes
  float right[chunk];                // distance to the right of that node, in [0, 1]
  float upper[chunk], lower[chunk];  // the lobe's share in that node's row and in the next row
};

// Rounds positions in the grid to the nearest integer. Floats as large as `magnitude` have no fraction, so
// adding `magnitude` and subtracting it again rounds a position.
Float to_whole(Float place) {
  const Float magnitude = broadcast(12582912.0f);  // 1.5 x 2^23
  return (place + magnitude) - magnitude;
}

void read_shares(const std::uint8_t* shares, std::uint32_t count, float* out) {
  if (shares && count == chunk) {
    for (std::uint32_t i = 0; i < chunk; ++i) out[i] = float(shares[i]);
    return;
  }
  for (std::uint32_t i = 0; i < chunk; ++i) out[i] = i >= count ? 0.0f : shares ? float(shares[i]) : 255.0f;
}

// Computes the positions of lobes. Returns a bit mask of the lobes that are not dark. The positions of dark
// lobes are undefined and may be NaN.
std::uint64_t place_lobes(const LightView& light, const float* frame, const std::uint8_t* shares,
                          std::uint32_t first, std::uint32_t count, Places& places) {
  alignas(64) float share[chunk];
  read_shares(shares, count, share);
  float across[6];  // the axes x and y, in grid steps
  for (std::uint32_t i = 0; i < 6; ++i) across[i] = frame[i] * light.scale;
  const Float zero = broadcast(0.0f), half = broadcast(0.5f), last = broadcast(float(light.side - 2));
  const Float centre = broadcast(light.centre), lowest = broadcast(light.lowest_z);
  std::uint64_t bright = 0;
  for (std::uint32_t i = 0; i < count; i += width) {
    const std::uint32_t j = first + i;
    const Float x = load(light.axis_x + j), y = load(light.axis_y + j), z = load(light.axis_z + j);
    const auto along = [&](const float* axis) {
      return fma(broadcast(axis[0]), x, fma(broadcast(axis[1]), y, broadcast(axis[2]) * z));
    };
    const Float up = along(frame + 6);
    const Float scale = rsqrt(broadcast(1.0f) + up);
    const Float column = fma(along(across), scale, centre), row = fma(along(across + 3), scale, centre);
    const Float left = min(max(to_whole(column - half), zero), last);
    const Float top = min(max(to_whole(row - half), zero), last);
    const Float used = select(less(up, lowest), zero, load(share + i));
    const Float lower = used * (row - top);
    store(places.node + i, fma(top, broadcast(float(light.side)), left));
    store(places.right + i, column - left);
    store(places.upper + i, used - lower);
    store(places.lower + i, lower);
    bright |= std::uint64_t(bits(less(zero, used))) << i;
  }
  return bright;
}

// Adds the light of lobes to the nodes of one vertex. A node has red, green, blue and 0. Two neighbouring
// nodes of a row are updated at once.
void add_lobes(const LightView& light, const Places& places, std::uint64_t bright, std::uint32_t first,
               float* nodes) {
  alignas(32) constexpr float slopes[8] = {-1, -1, -1, -1, 1, 1, 1, 1}, starts[8] = {1, 1, 1, 1, 0, 0, 0, 0};
  const Eight slope = load_eight(slopes), start = load_eight(starts);
  const float* const amplitudes = light.amplitudes + 4 * std::size_t(first);
  for (; bright != 0; bright &= bright - 1) {
    const auto i = std::size_t(std::countr_zero(bright));
    float* const upper = nodes + 4 * std::ptrdiff_t(std::int32_t(places.node[i]));
    float* const lower = upper + 4 * std::size_t(light.side);
    const Eight amplitude =
        load_four_twice(amplitudes + 4 * i) * product_plus(slope, Eight(places.right[i]), start);
    store(upper, product_plus(amplitude, Eight(places.upper[i]), load_eight(upper)));
    store(lower, product_plus(amplitude, Eight(places.lower[i]), load_eight(lower)));
  }
}

void spread(const LightView& light, const std::uint8_t* shares, const float* frame, float* nodes) {
  Places places;
  for (std::uint32_t first = 0; first < light.lobes; first += chunk) {
    const std::uint32_t rest = light.lobes - first, lobes = rest < chunk ? rest : chunk;
    const std::uint8_t* const some = shares ? shares + first : nullptr;
    add_lobes(light, places, place_lobes(light, frame, some, first, lobes, places), first, nodes);
  }
}

// The number of SIMD vectors of the table that are processed at once.
inline constexpr std::uint32_t group = width >= 16 ? 1 : 2;

// The number of channels that are processed at once. A product loads a row of the table and a node's weight
// from memory, and processors can load at most two values for two products. In a block of four vertices, one
// channel needs six loads, two rows and four weights, for eight products. With wide vectors, or with fewer
// vertices in a block, all channels are processed at once, so that enough independent sums are in flight to
// hide the latency.
template <std::uint32_t Vertices>
inline constexpr std::uint32_t channels_at_once = width >= 16 || Vertices < 4 ? 3 : 1;

template <std::uint32_t Vertices>
struct Sums {
  Float of[Vertices][channels_at_once<Vertices>][group];
};

// The range [begin, end) of nodes in a row that have light at any of the vertices.
struct Columns {
  std::uint32_t begin = 0, end = 0;
};

template <std::uint32_t Vertices>
bool is_dark(const float* node, std::size_t node_floats) {
  std::uint64_t any = 0;
  for (std::uint32_t v = 0; v < Vertices; ++v) {
    std::uint64_t half[2];
    std::memcpy(half, node + v * node_floats, sizeof half);
    any |= half[0] | half[1];
  }
  return any == 0;
}

template <std::uint32_t Vertices>
Columns lit_columns(const LightView& light, const float* nodes, std::size_t node_floats, std::uint32_t row) {
  Columns lit{light.row_begin[row], light.row_end[row]};
  const float* const first = nodes + 4 * std::size_t(row) * light.side;
  while (lit.begin < lit.end && is_dark<Vertices>(first + 4 * std::size_t(lit.begin), node_floats))
    ++lit.begin;
  while (lit.begin < lit.end && is_dark<Vertices>(first + 4 * std::size_t(lit.end - 1), node_floats))
    --lit.end;
  return lit;
}

// Adds one row of the table, weighted by the nodes of the vertices. It processes the channels from `channel`
// on and the lanes from `first` on.
template <std::uint32_t Vertices>
void weigh_row(const LightView& light, const float* nodes, std::size_t node_floats, std::uint32_t row,
               Columns columns, std::uint32_t channel, std::uint32_t first, Sums<Vertices>& out) {
  constexpr std::uint32_t channels = channels_at_once<Vertices>;
  Sums<Vertices> sums = out;
  const std::size_t begin = std::size_t(row) * light.side + columns.begin, lanes = light.lanes;
  const float* table = light.table + (3 * begin + channel) * lanes + first;
  const float* node = nodes + 4 * begin + channel;
  for (std::uint32_t column = columns.begin; column < columns.end; ++column) {
    for (std::uint32_t c = 0; c < channels; ++c) {
      Float response[group];
      for (std::uint32_t k = 0; k < group; ++k) response[k] = load(table + c * lanes + k * width);
      for (std::uint32_t v = 0; v < Vertices; ++v) {
        const Float weight = broadcast(node[v * node_floats + c]);
        for (std::uint32_t k = 0; k < group; ++k)
          sums.of[v][c][k] = fma(weight, response[k], sums.of[v][c][k]);
      }
    }
    table += 3 * lanes;
    node += 4;
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
void write(const LightView& light, const Sums<Vertices>& sums, std::uint32_t channel, std::uint32_t first,
           const VertexBlock& block, std::uint32_t first_vertex) {
  const std::uint32_t rest = light.light_modes - first, used = rest < group * width ? rest : group * width;
  for (std::uint32_t v = 0; v < Vertices; ++v)
    for (std::uint32_t c = 0; c < channels_at_once<Vertices>; ++c) {
      alignas(64) float lanes[group * width];
      for (std::uint32_t k = 0; k < group; ++k) store(lanes + k * width, sums.of[v][c][k]);
      std::memcpy(block.vectors + (first_vertex + v) * block.stride +
                      std::size_t(channel + c) * light.light_modes + first,
                  lanes, used * sizeof(float));
    }
}

// Processes all channels of a row before the next row, so that a row of nodes is read from the second-level
// cache only once.
template <std::uint32_t Vertices>
void weigh(const LightView& light, const VertexBlock& block, std::size_t node_floats,
           std::uint32_t first_vertex) {
  constexpr std::uint32_t channels = channels_at_once<Vertices>;
  const float* const nodes = block.scratch + first_vertex * node_floats;
  Columns lit[transfer::max_side];
  for (std::uint32_t row = 0; row < light.side; ++row)
    lit[row] = lit_columns<Vertices>(light, nodes, node_floats, row);
  for (std::uint32_t first = 0; first < light.light_modes; first += group * width) {
    Sums<Vertices> sums[3 / channels];
    for (Sums<Vertices>& of_channels : sums) clear(of_channels);
    for (std::uint32_t row = 0; row < light.side; ++row)
      for (std::uint32_t c = 0; c < 3; c += channels)
        weigh_row<Vertices>(light, nodes, node_floats, row, lit[row], c, first, sums[c / channels]);
    for (std::uint32_t c = 0; c < 3; c += channels)
      write<Vertices>(light, sums[c / channels], c, first, block, first_vertex);
  }
}

void vectors(const LightView& light, const VertexBlock& block) {
  const std::size_t node_floats = std::size_t(light.side) * light.side * 4;
  std::memset(block.scratch, 0, block.count * node_floats * sizeof(float));
  for (std::uint32_t v = 0; v < block.count; ++v)
    spread(light, block.shares ? block.shares + std::size_t(v) * light.lobes : nullptr,
           block.frames + 9 * std::size_t(v), block.scratch + v * node_floats);
  std::uint32_t v = 0;
  for (; v + 4 <= block.count; v += 4) weigh<4>(light, block, node_floats, v);
  for (; v + 2 <= block.count; v += 2) weigh<2>(light, block, node_floats, v);
  if (v < block.count) weigh<1>(light, block, node_floats, v);
}

constexpr transfer::VectorKernels vector_table{isa, isa_name(isa), vectors};

}  // namespace

const transfer::VectorKernels& vector_kernels() {
  return vector_table;
}
