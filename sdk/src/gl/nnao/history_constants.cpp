#include "sdk/src/gl/nnao/history_constants.h"

#include <algorithm>
#include <iterator>

#include "sdk/src/nnao/history.h"

namespace nook::gl {
namespace {

const float* row(const FrameConstants& constants, int index) {
  return &constants.values[std::size_t(4 * index)];
}

bool is_cut(const NnaoFrame& frame, const FrameConstants& constants, const EarlierFrame& earlier) {
  const float* surface = row(constants, NOOK_FRAME_SURFACE);
  return frame.reset || !earlier.drawn || float(earlier.width) != surface[2] ||
         float(earlier.height) != surface[3] ||
         row(earlier.constants, NOOK_FRAME_SPREAD)[0] != row(constants, NOOK_FRAME_SPREAD)[0];
}

// The inverse of a view matrix: rows of three numbers, then the translation.
struct Inverse {
  double rotation[9], translation[3];
};

// Doubles keep the product within float rounding of a product that the host forms itself.
Inverse inverse_of(const float (&m)[16]) {
  const auto at = [&](int row, int column) { return double(m[4 * column + row]); };
  const auto minor = [&](int row, int column) {
    const int r0 = (row + 1) % 3, r1 = (row + 2) % 3, c0 = (column + 1) % 3, c1 = (column + 2) % 3;
    return at(r0, c0) * at(r1, c1) - at(r0, c1) * at(r1, c0);
  };
  const double determinant = at(0, 0) * minor(0, 0) + at(0, 1) * minor(0, 1) + at(0, 2) * minor(0, 2);
  Inverse inverse{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      inverse.rotation[3 * row + column] = minor(column, row) / determinant;
      inverse.translation[row] -= inverse.rotation[3 * row + column] * at(column, 3);
    }
  return inverse;
}

}  // namespace

Mat3x4 earlier_from_view(const float (&earlier)[16], const float (&view)[16]) {
  Mat3x4 product;
  if (std::equal(std::begin(view), std::end(view), earlier)) return product;  // exactly the identity
  const Inverse inverse = inverse_of(view);
  const auto at = [&](int row, int column) { return double(earlier[4 * column + row]); };
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += at(row, k) * inverse.rotation[3 * k + column];
      product.m[4 * row + column] = float(sum);
    }
    double sum = at(row, 3);
    for (int k = 0; k < 3; ++k) sum += at(row, k) * inverse.translation[k];
    product.m[4 * row + 3] = float(sum);
  }
  return product;
}

HistoryConstants history_constants(const NnaoFrame& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier) {
  HistoryConstants values{};
  // A cut reads no history.
  const Mat3x4 motion = earlier.drawn ? earlier_from_view(earlier.view, frame.view) : Mat3x4{};
  std::copy_n(motion.m, 12, values.begin());
  const auto set = [&](int index, std::array<float, 4> four) {
    std::copy(four.begin(), four.end(), values.begin() + std::ptrdiff_t(4 * index));
  };
  const float* rays = row(earlier.constants, NOOK_FRAME_SURFACE_RAYS);
  set(NOOK_EARLIER_RAYS, {rays[0], rays[1], rays[2], rays[3]});
  const bool cut = is_cut(frame, constants, earlier);
  set(NOOK_EARLIER_SIZE, {float(earlier.width - 1), float(earlier.height - 1),
                          cut ? 1.0f : float(pass.max_history_frames), frame.motion_vectors ? 1.0f : 0.0f});
  const float per_pixel = pass.half_resolution ? 0.5f : 1.0f;
  set(NOOK_EARLIER_MOTION,
      {per_pixel * frame.motion_vector_scale[0], per_pixel * frame.motion_vector_scale[1],
       nnao::noise_reach(std::uint32_t(pass.taps)), 0});
  return values;
}

}  // namespace nook::gl
