// Projections of engines and libraries, each built by its own formula, with the depth range that it goes
// with.
#pragma once

#include <nook/nook_gl.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::test {

using Matrix4 = std::array<double, 16>;  // column-major

struct RealProjection {
  std::string source;
  Matrix4 matrix;
  nook_clip_space clip = NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE;

  void copy_to(float (&projection)[16]) const {
    for (std::size_t i = 0; i < 16; ++i) projection[i] = float(matrix[i]);
  }
};

inline Matrix4 transposed(const Matrix4& m) {
  Matrix4 turned{};
  for (std::size_t i = 0; i < 16; ++i) turned[i] = m[4 * (i % 4) + i / 4];
  return turned;
}

inline Matrix4 product(const Matrix4& a, const Matrix4& b) {
  Matrix4 out{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return out;
}

// A perspective from its four numbers of x and y and its two of depth.
inline Matrix4 perspective_of(double x, double y, double centre_x, double centre_y, double z, double w) {
  return {x, 0, 0, 0, 0, y, 0, 0, centre_x, centre_y, z, -1, 0, 0, w, 0};
}
inline Matrix4 parallel_of(double x, double y, double z, double tx, double ty, double tz) {
  return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, tx, ty, tz, 1};
}

// glFrustum.
inline Matrix4 gl_frustum(double l, double r, double b, double t, double n, double f) {
  return perspective_of(2 * n / (r - l), 2 * n / (t - b), (r + l) / (r - l), (t + b) / (t - b),
                        -(f + n) / (f - n), -2 * f * n / (f - n));
}
// gluPerspective; the angle in degrees.
inline Matrix4 glu_perspective(double fovy, double aspect, double n, double f) {
  const double cotangent = 1 / std::tan(fovy * 3.14159265358979 / 360);
  return perspective_of(cotangent / aspect, cotangent, 0, 0, (f + n) / (n - f), 2 * f * n / (n - f));
}
// glOrtho.
inline Matrix4 gl_ortho(double l, double r, double b, double t, double n, double f) {
  return parallel_of(2 / (r - l), 2 / (t - b), -2 / (f - n), -(r + l) / (r - l), -(t + b) / (t - b),
                     -(f + n) / (f - n));
}
// XMMatrixPerspectiveOffCenterRH, whose rows are these columns.
inline Matrix4 d3d_frustum(double l, double r, double b, double t, double n, double f) {
  return perspective_of(2 * n / (r - l), 2 * n / (t - b), (l + r) / (r - l), (t + b) / (t - b), f / (n - f),
                        n * f / (n - f));
}
inline Matrix4 d3d_ortho(double l, double r, double b, double t, double n, double f) {
  return parallel_of(2 / (r - l), 2 / (t - b), 1 / (n - f), (l + r) / (l - r), (t + b) / (b - t),
                     n / (n - f));
}
// Depth 1 at the near plane and 0 at the far one, or at infinity.
inline Matrix4 reversed_zero_to_one(Matrix4 m, double n, double f) {
  m[10] = std::isinf(f) ? 0 : n / (f - n);
  m[14] = std::isinf(f) ? n : f * n / (f - n);
  return m;
}
inline Matrix4 infinite(Matrix4 m, double n, double epsilon = 0) {
  m[10] = epsilon - 1;
  m[14] = (epsilon - 2) * n;
  return m;
}
inline Matrix4 flipped(Matrix4 m) {
  for (const std::size_t i : {1u, 5u, 9u, 13u}) m[i] = -m[i];
  return m;
}
// Moves the picture by a share of a pixel, as temporal antialiasing does: m02 and m12 of Unity and Unreal.
inline Matrix4 jittered(Matrix4 m, double x_px, double y_px, double width, double height) {
  m[8] += 2 * x_px / width;
  m[9] += 2 * y_px / height;
  return m;
}
// E. Lengyel, Oblique View Frustum Depth Projection and Clipping, 2005. The plane is in view space; what is
// kept has a positive distance.
inline Matrix4 lengyel_oblique(Matrix4 m, const std::array<double, 4>& plane) {
  const auto sign = [](double v) { return v < 0 ? -1.0 : v > 0 ? 1.0 : 0.0; };
  const double q[] = {(sign(plane[0]) + m[8]) / m[0], (sign(plane[1]) + m[9]) / m[5], -1,
                      (1 + m[10]) / m[14]};
  double along = 0;
  for (std::size_t i = 0; i < 4; ++i) along += plane[i] * q[i];
  for (std::size_t i = 0; i < 4; ++i) m[4 * i + 2] = 2 / along * plane[i];
  m[10] += 1;
  return m;
}
// The tangents of the four angles of an eye of a headset; two are negative.
struct Eye {
  double left = -1.19, right = 0.84, down = -1.28, up = 1.0;
};
// XrMatrix4x4f_CreateProjection of the OpenXR samples. far <= near: infinite.
inline Matrix4 openxr(const Eye& eye, double n, double f, bool vulkan) {
  const double width = eye.right - eye.left, height = vulkan ? eye.down - eye.up : eye.up - eye.down;
  const double offset = vulkan ? 0 : n;
  return perspective_of(2 / width, 2 / height, (eye.right + eye.left) / width, (eye.up + eye.down) / height,
                        f <= n ? -1 : -(f + offset) / (f - n),
                        f <= n ? -(n + offset) : -(f * (n + offset)) / (f - n));
}

inline std::vector<RealProjection> real_projections() {
  constexpr auto zero = NOOK_CLIP_SPACE_ZERO_TO_ONE;
  constexpr double wide = 16.0 / 9, endless = HUGE_VAL;
  const Matrix4 plain = glu_perspective(60, wide, 0.1, 100);
  return {
      {"GLU: gluPerspective", glu_perspective(45, 4.0 / 3, 0.5, 500)},
      {"OpenGL: glFrustum, off-centre", gl_frustum(-0.3, 0.5, -0.2, 0.4, 0.7, 90)},
      {"OpenGL: glOrtho", gl_ortho(-8, 8, -4.5, 4.5, 0.1, 50)},
      {"OpenGL: glOrtho, off-centre", gl_ortho(-3, 9, 1, 8, 0, 200)},
      {"GLM: perspectiveRH_NO", glu_perspective(70, wide, 0.01, 1000)},
      {"GLM: perspectiveRH_ZO", d3d_frustum(-0.0577, 0.0577, -0.0325, 0.0325, 0.05, 400), zero},
      {"GLM: infinitePerspectiveRH_NO", infinite(plain, 0.1)},
      {"GLM: tweakedInfinitePerspective", infinite(plain, 0.1, 1.19209290e-7)},
      {"GLM: orthoRH_ZO", d3d_ortho(-2, 2, -2, 2, 0.1, 12), zero},
      {"Vulkan: GLM with proj[1][1] *= -1", flipped(d3d_frustum(-0.1, 0.1, -0.06, 0.06, 0.1, 10)), zero},
      {"three.js: PerspectiveCamera", gl_frustum(-0.0978, 0.0978, -0.055, 0.055, 0.1, 2000)},
      {"three.js: setViewOffset", gl_frustum(0.0, 0.0978, -0.055, 0.0, 0.1, 2000)},
      {"three.js: reversed depth buffer", reversed_zero_to_one(plain, 0.1, 2000), zero},
      {"three.js: OrthographicCamera", gl_ortho(-640, 640, -360, 360, 1, 1000)},
      {"Godot 3: CameraMatrix::set_perspective", glu_perspective(70, wide, 0.05, 100)},
      {"Godot 4: depth correction, reversed", reversed_zero_to_one(flipped(plain), 0.05, 4000), zero},
      {"Godot: set_frustum with an offset", gl_frustum(-0.05, 0.09, -0.06, 0.02, 0.05, 300)},
      {"Unity: Matrix4x4.Perspective", glu_perspective(60, wide, 0.3, 1000)},
      {"Unity: GetGPUProjectionMatrix into a texture", flipped(reversed_zero_to_one(plain, 0.3, 1000)), zero},
      {"Unity: jittered by temporal antialiasing", jittered(plain, 0.375, -0.21, 1920, 1080)},
      {"Unity: CalculateObliqueMatrix", lengyel_oblique(plain, {0.0, 0.98, -0.2, -1.5})},
      {"Unreal: FReversedZPerspectiveMatrix, right-handed", reversed_zero_to_one(plain, 10, endless), zero},
      {"Unreal: the same, jittered", jittered(reversed_zero_to_one(plain, 10, endless), 0.4, 0.1, 1280, 720),
       zero},
      {"Bevy: perspective_infinite_reverse_rh", reversed_zero_to_one(plain, 0.1, endless), zero},
      {"Bevy: orthographic_rh with near and far swapped", d3d_ortho(-5, 5, -3, 3, 1000, 0), zero},
      {"glam: perspective_rh_gl", glu_perspective(50, 1, 0.2, 80)},
      {"DirectXMath: XMMatrixPerspectiveOffCenterRH", d3d_frustum(-0.2, 0.4, -0.3, 0.1, 0.25, 60), zero},
      {"MonoGame: CreatePerspectiveFieldOfView", d3d_frustum(-1, 1, -0.6, 0.6, 1, 10000), zero},
      {"OpenXR: CreateProjectionFov, OpenGL", openxr(Eye{}, 0.05, 100, false)},
      {"OpenXR: CreateProjectionFov, OpenGL, infinite", openxr(Eye{}, 0.05, 0, false)},
      {"OpenXR: CreateProjectionFov, Vulkan", openxr(Eye{}, 0.05, 100, true), zero},
      {"OpenXR: an infinite reversed eye",
       reversed_zero_to_one(openxr(Eye{}, 0.05, 100, true), 0.05, endless), zero},
      {"OpenVR: ComposeProjection", d3d_frustum(-0.0139, 0.0125, -0.0147, 0.0146, 0.01, 30), zero},
      {"WebXR: XRView.projectionMatrix", gl_frustum(-0.11, 0.09, -0.1, 0.12, 0.1, 1000)},
      {"Android: Matrix.perspectiveM", glu_perspective(42, 0.56, 0.1, 100)},
      {"OGRE: a render texture", flipped(glu_perspective(45, wide, 5, 100000))},
      {"OGRE-Next: reversed depth", reversed_zero_to_one(glu_perspective(45, wide, 5, 100000), 5, 100000),
       zero},
      {"Filament: reversed and infinite", reversed_zero_to_one(plain, 0.05, endless), zero},
      {"bgfx: mtxProj, right-handed, homogeneous", glu_perspective(60, wide, 0.1, 100)},
      {"bgfx: mtxProjRhInf, reversed", reversed_zero_to_one(glu_perspective(60, 1, 0.1, 100), 0.1, endless),
       zero},
      {"raylib: MatrixPerspective", gl_frustum(-0.0103, 0.0103, -0.0058, 0.0058, 0.01, 1000)},
      {"cglm: glm_perspective_infinite_rh_no", infinite(glu_perspective(90, 1, 0.5, 9), 0.5)},
      {"cglm: glm_ortho_aabb around the camera", gl_ortho(-20, 20, -20, 20, -30, 30)},
      {"Lengyel: oblique near plane of a mirror", lengyel_oblique(plain, {0.1, 0.2, -0.97, -0.3})},
      {"Lengyel: oblique near plane, infinite",
       lengyel_oblique(infinite(plain, 0.1), {-0.3, 0.9, -0.3, -2.0})},
      {"Lengyel: infinite with an epsilon of 2^-22",
       infinite(glu_perspective(75, wide, 0.2, 9), 0.2, 2.4e-7)},
      {"Cesium: PerspectiveOffCenterFrustum.infiniteProjectionMatrix",
       infinite(gl_frustum(-0.06, 0.05, -0.03, 0.03, 0.1, 9), 0.1)},
      {"VTK: vtkPerspectiveTransform::Frustum", gl_frustum(-0.4, 0.4, -0.3, 0.3, 1.1, 7.3)},
      {"Blender: perspective_m4 with a lens shift", gl_frustum(-0.018, 0.054, -0.02, 0.0205, 0.1, 1000)},
      {"JOML: setPerspective, zero to one, reversed", d3d_frustum(-8, 8, -4.5, 4.5, 100, 0.1), zero},
      {"GLM: perspectiveRH_NO with near and far swapped", glu_perspective(60, wide, 100, 0.1)},
      {"gl-matrix: perspectiveFromFieldOfView", gl_frustum(-0.13, 0.11, -0.12, 0.125, 0.1, 60)},
      {"libGDX: OrthographicCamera", gl_ortho(0, 1280, 0, 720, 0, 100)},
      {"A cascade of shadows: XMMatrixOrthographicOffCenterRH", d3d_ortho(-30, 34, -31, 33, -120, 80), zero},
      {"A tile of a screenshot", gl_frustum(0.05, 0.1, 0.0, 0.03, 0.1, 400)},
      {"Cesium: the far one of several frustums", gl_frustum(-4e5, 4e5, -2e5, 2e5, 1e6, 5e8)},
      {"A survey in millimetres: orthographic", gl_ortho(-4e7, 4e7, -3e7, 3e7, 10, 9e7)},
      {"A microscope in metres", glu_perspective(5, 1, 2e-5, 4e-3)},
      {"A telescope: an angle of 0.05 degrees", glu_perspective(0.05, wide, 10, 1e5)},
      {"X-Plane: reversed, -1 to 1", glu_perspective(60, wide, 20000, 0.5)},
  };
}

}  // namespace nook::test
