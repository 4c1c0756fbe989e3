#include "sdk/src/nnao/projection_check.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "sdk/src/core/failure.h"

namespace nook::nnao {
namespace {

// An element is treated as zero if its magnitude is at most this fraction of the largest one in its row. The
// limit is relative to the row because rows differ in scale: a wide orthographic projection has small
// elements, and a distant near plane causes a large one.
constexpr double equal_share = 1e-6;

// The relative tolerance for the depths at both ends of the clip range. Some infinite projections need it,
// because they place the far plane slightly beyond infinity.
constexpr double plane_share = 1e-3;

// In the projection of a real camera, the far depth divided by the near depth is larger than this.
constexpr double usual_depth_ratio = 50;

// A projection matrix, with the elements m[i] in OpenGL's (column-major) order.
struct Matrix {
  double m[16];
  double largest[4];  // the largest magnitude in each row

  double operator[](int i) const { return m[i]; }
  bool zero(int i) const { return std::abs(m[i]) <= equal_share * largest[i % 4]; }
  bool all_zeros() const {
    return std::all_of(m, m + 16, [](double element) { return element == 0; });
  }
  bool zeros(std::initializer_list<int> elements) const {
    return std::all_of(elements.begin(), elements.end(), [&](int i) { return zero(i); });
  }
  bool perspective() const { return !zero(11); }
  bool oblique() const { return !zero(2) || !zero(6); }
};

// Builds a matrix from element(i), which returns the value of element i.
template <class Element>
Matrix matrix_of(const Element& element) {
  Matrix matrix{};
  for (int i = 0; i < 16; ++i) {
    matrix.m[i] = element(i);
    matrix.largest[i % 4] = std::max(matrix.largest[i % 4], std::abs(matrix.m[i]));
  }
  return matrix;
}

Matrix transposed(const Matrix& matrix) {
  return matrix_of([&](int i) { return matrix[4 * (i % 4) + i / 4]; });
}

// In a camera's projection, clip x depends on x and z, clip y on y and z, and clip w on z or is constant.
// Returns the index of an element that should be 0 but is not, or -1 if there is none.
int stray_element(const Matrix& m) {
  const bool perspective = m.perspective();
  for (const int i : {1, 3, 4, 7, perspective ? 12 : 8, perspective ? 13 : 9, perspective ? 15 : 11})
    if (!m.zero(i)) return i;
  return -1;
}

// Returns true for the projection of a camera that looks along -z, or along +z in a left-handed system.
bool is_camera_of_any_hand(const Matrix& m) {
  return stray_element(m) < 0 && !m.zero(0) && !m.zero(5) && (m.perspective() || m[15] > 0) &&
         m[m.perspective() ? 14 : 10] != 0;
}

bool is_one(double value) {
  return std::abs(std::abs(value) - 1) <= 1e-5;
}

// Returns 1 / depth of the points whose clip z / w has this value, in a perspective projection.
double inverse_depth(const Matrix& m, double clip_z) {
  return (clip_z - m[10] / m[11]) / (-m[14] / m[11]);
}

struct InverseDepths {
  double first, last;  // the values at both ends of the clip range

  bool before_camera() const {
    return std::min(first, last) >= -plane_share * std::max(std::abs(first), std::abs(last));
  }
  double ratio() const {
    const double near = std::max(first, last), far = std::min(first, last);
    return far > 0 ? near / far : HUGE_VAL;
  }
};

InverseDepths inverse_depths(const Matrix& m, ClipRange clip) {
  return {inverse_depth(m, clip == ClipRange::zero_to_one ? 0 : -1), inverse_depth(m, 1)};
}

bool is_deep(const Matrix& m, ClipRange clip) {
  const InverseDepths depths = inverse_depths(m, clip);
  return !m.oblique() && depths.before_camera() && depths.ratio() > usual_depth_ratio;
}

// In a perspective projection, clip w is -z or z, so its coefficient is -1 or 1. If the matrix is transposed,
// this coefficient is swapped with the element that depends on the near plane.
bool is_transposed(const Matrix& m, ClipRange clip) {
  const Matrix turned = transposed(m);
  if (!is_camera_of_any_hand(turned)) return false;
  if (!is_camera_of_any_hand(m)) return true;
  if (!m.perspective()) return false;
  // The host may have multiplied the matrix by a factor, so that neither element is 1 or -1. Then the depth
  // range shows which of the two matrices is the projection.
  if (!is_one(m[14]) && !is_one(m[11])) return !is_deep(m, clip) && is_deep(turned, clip);
  if (!is_one(m[14])) return false;
  return !is_one(m[11]) || (m.zeros({8, 9}) && m.oblique());
}

bool is_inverse(const Matrix& m) {
  return m.perspective() && is_one(m[14]) && !m.zero(15) && m.zeros({1, 2, 3, 4, 6, 7, 8, 9, 10});
}

struct Axis {
  double x, y, z;
};
double dot(const Axis& a, const Axis& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Returns true for a rotation with a uniform scale and a translation, such as an object's or a camera's
// matrix. The orthographic projection of a cube has the same shape. Such a matrix is treated as a projection
// if m[10] is negative, or if the box that it projects is wider than 2 metres and lies in front of the
// camera.
bool is_placement(const Matrix& m) {
  if (!m.zeros({3, 7, 11}) || !is_one(m[15])) return false;
  const Axis axes[] = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
  const double square = dot(axes[0], axes[0]), bound = 1e-3 * square;
  if (!(square > 0)) return false;
  for (int i = 0; i < 3; ++i)
    if (std::abs(dot(axes[i], axes[i]) - square) > bound || std::abs(dot(axes[i], axes[(i + 1) % 3])) > bound)
      return false;
  if (!m.zeros({1, 2, 4, 6, 8, 9})) return true;
  const double scale = std::sqrt(square);
  return m[10] > 0 && (scale > 0.999 || m[14] < 0.999);
}

const char* clip_name(ClipRange clip) {
  return clip == ClipRange::zero_to_one ? "NOOK_CLIP_SPACE_ZERO_TO_ONE"
                                        : "NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE";
}

// If depth is reversed, the matrix shows which clip range it was made for. With the wrong clip range, one end
// of the range lies behind the camera, or the far plane is only twice as far away as the near plane.
void check_perspective_depth(const Matrix& m, ClipRange clip) {
  const bool zero_to_one = clip == ClipRange::zero_to_one;
  const ClipRange other = zero_to_one ? ClipRange::negative_one_to_one : ClipRange::zero_to_one;
  const InverseDepths given = inverse_depths(m, clip), changed = inverse_depths(m, other);
  const bool doubled = zero_to_one && given.first > 0 && given.last > given.first && given.ratio() < 2.05 &&
                       changed.ratio() > usual_depth_ratio;
  if (given.before_camera() && !doubled) return;
  if (changed.before_camera())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection has reversed depth for another clip range (got [10] %g and [14] %g; with "
                  "frame.clip_space %d, the ends of the depth range would lie at %g and %g metres); set "
                  "frame.clip_space to %s",
                  m[10], m[14], int(clip), 1 / given.first, 1 / given.last, clip_name(other));
  throw Failure(
      NOOK_ERROR_INVALID_ARGUMENT,
      "frame.projection has its near or far plane behind the camera (got [10] %g and [14] %g, which put the "
      "planes at depths of %g and %g metres; need two depths above 0); pass the matrix that drew the depth",
      m[10], m[14], 1 / given.first, 1 / given.last);
}

[[noreturn]] void refuse_hand(const Matrix& m, int element) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "frame.projection is left-handed: its camera looks along +z (got [%d] %g, need less than 0); "
                "negate its elements 8 to 11, and the z that frame.view and frame.normal_matrix give",
                element, m[element]);
}

// Rejects a left-handed orthographic projection. The whole box that it projects lies behind a camera that
// looks along -z.
void check_parallel_depth(const Matrix& m, ClipRange clip) {
  const double first = (m[14] / m[15] - (clip == ClipRange::zero_to_one ? 0 : -1)) / m[10] * m[15],
               last = (m[14] / m[15] - 1) / m[10] * m[15];
  if (m[10] > 0 && std::max(first, last) <= equal_share * std::abs(first - last)) refuse_hand(m, 10);
}

void check_hardware_depth(const Matrix& m, ClipRange clip) {
  const int element = m.perspective() ? 14 : 10;
  if (m[element] == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is singular: its depth does not depend on the distance (got 0 in [%d])",
                  element);
  // The near and far planes of an oblique projection do not have a constant depth.
  if (m.oblique()) return;
  if (m.perspective())
    check_perspective_depth(m, clip);
  else
    check_parallel_depth(m, clip);
}

// Recognises matrices that hosts often pass by mistake, and names them in the message.
void check_kind_of_matrix(const Matrix& m, ClipRange clip) {
  if (m.all_zeros())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is all zeros; copy the projection of the camera to it");
  if (is_transposed(m, clip))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is transposed (got [11] %g and [14] %g; need column-major order, where "
                  "[11] of a perspective is -1); transpose it",
                  m[11], m[14]);
  if (is_inverse(m))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is an inverse projection (got [11] %g, [14] %g and [15] %g); give the "
                  "matrix from view space to clip space",
                  m[11], m[14], m[15]);
  if (is_placement(m))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is the identity, or a world or view matrix (its axes are orthogonal and "
                  "of the same length, %g); give the projection of the camera",
                  std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
  if (m.perspective() && m[11] > 0 && stray_element(m) < 0) refuse_hand(m, 11);
}

}  // namespace

void check_projection(const float (&projection)[16], DepthKind kind, ClipRange clip) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(projection[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "frame.projection[%d] is not finite (got %g, need a projection matrix)", i,
                    double(projection[i]));
  const Matrix m = matrix_of([&](int i) { return double(projection[i]); });
  check_kind_of_matrix(m, clip);
  if (m.zero(0) || m.zero(5) || (m.perspective() ? m[11] > 0 : !(m[15] > 0)))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.projection is not a projection of a camera that looks along -z, or is singular (got "
                  "[0] %g, [5] %g, [11] %g, [15] %g; need [0] and [5] other than 0, and [11] below 0 or [15] "
                  "above 0); pass the projection alone, not multiplied by a view matrix",
                  m[0], m[5], m[11], m[15]);
  if (const int i = stray_element(m); i >= 0)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.projection[%d] is %g, need 0; give the projection alone, not multiplied by a view matrix", i,
        m[i]);
  if (kind == DepthKind::logarithmic && !m.perspective())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "frame.depth_kind %d needs a perspective projection (got frame.projection[11] %g, need "
                  "less than 0); use the depth that OpenGL wrote",
                  int(kind), m[11]);
  if (kind == DepthKind::hardware) check_hardware_depth(m, clip);
}

}  // namespace nook::nnao
