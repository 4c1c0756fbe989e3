#include "sdk/src/transfer/vectors.h"

#include <algorithm>

#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/transfer/lit_rows.h"
#include "sdk/src/transfer/vector_kernels.h"

namespace nook::transfer {

const VectorKernels* vector_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::vector_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

namespace {

// A thread takes this many vertices at a time, which is a whole number of blocks.
constexpr std::uint32_t piece = 256;

AlignedArray<float> padded_amplitudes(const Response& response, std::span<const float> amplitudes,
                                      Memory* memory) {
  AlignedArray<float> padded(std::size_t(4) * response.padded, memory);
  for (std::uint32_t j = 0; j < response.lobes; ++j)
    for (std::uint32_t c = 0; c < 3; ++c) padded[4 * j + c] = amplitudes[3 * j + c] * (1 / 255.0f);
  return padded;
}

LightView view_of(const Response& response, const AlignedArray<float>& amplitudes) {
  LightView view;
  view.axis_x = response.axis_x.data();
  view.axis_y = response.axis_y.data();
  view.axis_z = response.axis_z.data();
  view.amplitudes = amplitudes.data();
  view.lobes = response.lobes;
  view.padded = response.padded;
  view.side = response.side;
  view.scale = response.scale;
  view.centre = response.centre;
  view.lowest_z = response.lowest_z;
  view.row_begin = response.row_begin.data();
  view.row_end = response.row_end.data();
  view.table = response.table.data();
  view.light_modes = response.light_modes;
  view.lanes = response.lanes;
  return view;
}

void write_axes(const Frame& frame, float* axes) {
  const Vec3 y = frame.bitangent();
  const float values[9] = {frame.tangent.x, frame.tangent.y, frame.tangent.z, y.x, y.y, y.z,
                           frame.normal.x,  frame.normal.y,  frame.normal.z};
  std::copy_n(values, 9, axes);
}

// Computes the light that a baked shape reflects onto itself, for one light and one material.
class ReflectedLight {
 public:
  ReflectedLight(const Response& response, std::span<const float> amplitudes, const Transfer& transfer,
                 Memory* memory)
      : response_(response),
        transfer_(transfer),
        light_(reflected_light(response, amplitudes, transfer.bounces, memory)) {}

  void add(std::size_t vertex, float* vector) const noexcept {
    const std::uint32_t count = transfer_.bounces * band_count;
    if (count == 0) return;
    const std::uint16_t* const halves = &transfer_.indirect[vertex * count];
    Vec3 sum;
    for (std::uint32_t i = 0; i < count; ++i) sum += light_[i] * from_half(halves[i]);
    const float channel[3] = {sum.x, sum.y, sum.z};
    for (std::uint32_t c = 0; c < 3; ++c)
      for (std::uint32_t a = 0; a < response_.light_modes; ++a)
        vector[c * response_.light_modes + a] += channel[c] * response_.even[c * response_.light_modes + a];
  }

 private:
  const Response& response_;
  const Transfer& transfer_;
  const ReflectedBands light_;
};

// frame_at(i) returns the frame of vertex i. shares_at(i) returns its shares, or null if the vertex is open.
// after(i, vector) is called for each finished vector and may change it.
template <class FrameAt, class SharesAt, class After>
void run(const Response& response, Isa isa, std::span<const float> amplitudes, std::uint32_t count,
         const VectorOutput& output, const Parallel& parallel, Memory* memory, FrameAt&& frame_at,
         SharesAt&& shares_at, After&& after) {
  const AlignedArray<float> padded = padded_amplitudes(response, amplitudes, memory);
  const LightView light = view_of(response, padded);
  const VectorKernels* const kernels = vector_kernels(isa);
  const std::uint32_t at_once = block_vertices(response.side);
  const auto body = [&](std::uint32_t index) noexcept {
    alignas(64) float scratch[scratch_floats];
    float axes[9 * max_block_vertices];
    const std::uint32_t end = std::min(count, (index + 1) * piece);
    for (std::uint32_t i = index * piece; i < end; i += at_once) {
      VertexBlock block;
      block.count = std::min(end - i, at_once);
      for (std::uint32_t v = 0; v < block.count; ++v) write_axes(frame_at(i + v), axes + 9 * v);
      block.shares = shares_at(i);
      block.frames = axes;
      block.vectors = output.vectors + i * output.stride;
      block.stride = output.stride;
      block.scratch = scratch;
      kernels->vectors(light, block);
      for (std::uint32_t v = 0; v < block.count; ++v) after(i + v, block.vectors + v * block.stride);
    }
  };
  parallel_for(parallel, (count + piece - 1) / piece, body);
}

}  // namespace

void baked_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                   const Transfer& transfer, std::uint32_t first, std::uint32_t count,
                   const VectorOutput& output, const Parallel& parallel, Memory* memory) {
  const ReflectedLight reflected(response, amplitudes, transfer, memory);
  if (transfer.paper.is_used()) {
    const Vector<float> lit = paper_light(transfer.paper, amplitudes, parallel, memory);
    const auto body = [&](std::uint32_t index) noexcept {
      const std::uint32_t end = std::min(count, (index + 1) * piece);
      for (std::uint32_t i = index * piece; i < end; ++i) {
        float* const vector = output.vectors + i * output.stride;
        paper_vector(transfer.paper, lit, std::size_t(first) + i, vector);
        reflected.add(std::size_t(first) + i, vector);
      }
    };
    parallel_for(parallel, (count + piece - 1) / piece, body);
    return;
  }
  run(
      response, isa, amplitudes, count, output, parallel, memory,
      [&](std::uint32_t i) { return unpack(transfer.frames[first + i]); },
      [&](std::uint32_t i) { return transfer.shares_of(first + i); },
      [&](std::uint32_t i, float* vector) { reflected.add(std::size_t(first) + i, vector); });
}

void open_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                  std::span<const Frame> frames, const VectorOutput& output, const Parallel& parallel,
                  Memory* memory) {
  run(
      response, isa, amplitudes, std::uint32_t(frames.size()), output, parallel, memory,
      [&](std::uint32_t i) { return frames[i]; },
      [](std::uint32_t) { return static_cast<const std::uint8_t*>(nullptr); }, [](std::uint32_t, float*) {});
}

}  // namespace nook::transfer
