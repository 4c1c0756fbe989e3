// Removes shear and uneven scale from the matrix of a bone, as sdk/src/character/pose_source.cpp and
// sdk/src/core/affine.cpp do in double precision. A matrix is given by its three columns.

// Returns true if the caller should use the matrix unchanged, because its scale is almost uniform and it has
// almost no shear. Exporters and rounding cause such small deviations.
bool nook_is_kept(mat3 axes) {
  vec3 squared = vec3(dot(axes[0], axes[0]), dot(axes[1], axes[1]), dot(axes[2], axes[2]));
  float shortest = min(squared.x, min(squared.y, squared.z));
  float longest = max(squared.x, max(squared.y, squared.z));
  float shear = max(abs(dot(axes[0], axes[1])), max(abs(dot(axes[1], axes[2])), abs(dot(axes[2], axes[0]))));
  return shortest > 0.0 && 0.5 * (longest / shortest - 1.0) <= 1e-4 && shear <= 1e-4 * longest;
}

// Returns a rotation that is computed from the first two columns. If a column becomes 0, it is replaced by
// another direction.
mat3 nook_gram_schmidt(mat3 a) {
  float size = length(a[0]);
  vec3 x = size > 1e-6 ? a[0] / size : vec3(1.0, 0.0, 0.0);
  vec3 y = a[1] - dot(x, a[1]) * x;
  size = length(y);
  y = size > 1e-6 ? y / size : normalize(cross(x, abs(x.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  return mat3(x, y, cross(x, y));
}

vec3 nook_turned(vec3 axis, float angle, vec3 v) {
  float c = cos(angle);
  return v * c + cross(axis, v) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}

// Uses equation 7 of Mueller, Bender, Chentanez, Macklin 2016, "A Robust Method to Extract the Rotational
// Part of Deformations". On the GPU, the precision is only 1e-7, so the loop ends earlier than on the CPU.
mat3 nook_nearest_rotation(mat3 a) {
  mat3 r = nook_gram_schmidt(a);
  for (int turn = 0; turn < 60; ++turn) {
    vec3 torque = cross(r[0], a[0]) + cross(r[1], a[1]) + cross(r[2], a[2]);
    float stiffness = dot(r[0], a[0]) + dot(r[1], a[1]) + dot(r[2], a[2]);
    float size = length(torque);
    float angle = size / (abs(stiffness) + 1e-12);
    if (angle < 1e-6) break;
    vec3 axis = torque / size;
    r = mat3(nook_turned(axis, angle, r[0]), nook_turned(axis, angle, r[1]), nook_turned(axis, angle, r[2]));
  }
  return nook_gram_schmidt(r);
}

// Returns the nearest similarity: a rotation, possibly mirrored, with one scale above 0.
mat3 nook_nearest_similarity(mat3 axes) {
  float norm = sqrt(dot(axes[0], axes[0]) + dot(axes[1], axes[1]) + dot(axes[2], axes[2]));
  mat3 a = norm > 0.0 ? mat3(axes[0] / norm, axes[1] / norm, axes[2] / norm) : mat3(0.0);
  // If the matrix mirrors, solves the mirrored problem instead: x is negated before and after the matrix.
  float side = dot(a[0], cross(a[1], a[2])) < -1e-6 ? -1.0 : 1.0;
  mat3 flip = mat3(side, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  // Negates only the x of the columns, which does not change the scale.
  mat3 upright = a * flip;
  mat3 r = nook_nearest_rotation(upright);
  float scale = (dot(upright[0], r[0]) + dot(upright[1], r[1]) + dot(upright[2], r[2])) / 3.0 * norm;
  return (r * flip) * max(scale, 1e-6);
}
