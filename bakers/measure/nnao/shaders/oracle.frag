#version 330 core
// The oracle uses 1,024 taps and no tuned parameters. Each tap adds an occluder: a line of length `thickness`
// that starts at the visible surface and leads away from the viewer. The part of the line within the radius
// blocks the directions towards its points. The AO is the cosine-weighted share of the directions that stay
// open. Outside the screen, the oracle uses the depth at the border. The radius is never reduced.
#include "bakers/measure/nnao/shaders/surface.glsl"

uniform float thickness;  // in radii; 0: all space behind a surface within the radius is solid

const float pi = 3.14159265;
const int groups = 16;  // slices; each slice has two sides, so there are 32 directions
const int steps = 32;

#include "bakers/measure/nnao/shaders/slice.glsl"

out float result;

const float sectors = 128.0;  // sectors of a slice, each with the same cosine-weighted size

// Returns two numbers in (0, 1) that differ between the pixels of a 4 x 4 block.
vec2 pixel_noise(ivec2 pixel) {
  ivec2 at = pixel & 3;
  return (vec2(at.x * 4 + at.y, ((at.y * 4 + at.x) * 7) & 15) + 0.5) / 16.0;
}

// Returns the depth of a pixel. Outside the screen, returns the depth at the border.
float clamped_depth(ivec2 pixel) {
  return depth_at(clamp(pixel, ivec2(0), size_px - 1));
}

float sector_place(float angle, float tilt) {
  float low = tilt - 0.5 * pi;
  float inside = clamp(angle, low, tilt + 0.5 * pi);
  return (arc(low, tilt) + sign(inside) * arc(inside, tilt)) / open_arc(tilt);
}

uint word_between(int first, int last, int word) {
  int low = clamp(first - 32 * word, 0, 32), high = clamp(last - 32 * word, 0, 32), count = high - low;
  if (count <= 0) return 0u;
  return (count >= 32 ? 0xffffffffu : (1u << count) - 1u) << low;
}

uvec4 sectors_between(float from, float to) {
  int first = int(round(sectors * from)), last = int(round(sectors * to));
  return uvec4(word_between(first, last, 0), word_between(first, last, 1), word_between(first, last, 2),
               word_between(first, last, 3));
}

int set_bits(uint bits) {
  bits -= bits >> 1 & 0x55555555u;
  bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
  bits = bits + (bits >> 4) & 0x0f0f0f0fu;
  return int(bits * 0x01010101u >> 24);
}

// A slice's axes in view space, and its angles.
struct Frame {
  Slice slice;
  vec3 across, viewer, normal;
};

// Returns the angle of an offset in the slice. The pixel of a tap can lie up to half a pixel beside the slice.
// Such a tap is moved into the slice, and keeps its height above the tangent plane. A flat surface therefore
// does not block anything.
float angle_in(Frame frame, vec3 offset) {
  float u = dot(offset, frame.across), v = dot(offset, frame.viewer);
  float slope = dot(frame.normal, frame.viewer);
  if (slope > 0.2) v = (dot(offset, frame.normal) - dot(frame.normal, frame.across) * u) / slope;
  return atan(u, v);
}

uvec4 closed_by(Frame frame, ivec2 at, float depth, vec3 position, float radius) {
  vec3 tap = position_at(at, depth), front = tap - position, behind = normalize(tap);
  // Only surfaces within the radius form a horizon. Otherwise, every object in front of a wall would darken
  // the wall.
  if (thickness <= 0.0 && dot(front, front) > radius * radius) return uvec4(0u);
  // Finds the part of the line `front + s * behind` that is within `radius` of the origin.
  float along = dot(front, behind), inside = along * along - dot(front, front) + radius * radius;
  if (inside <= 0.0) return uvec4(0u);
  float near = max(-along - sqrt(inside), 0.0), far = -along + sqrt(inside);
  if (thickness > 0.0) far = min(far, thickness * radius);
  if (far <= near) return uvec4(0u);
  float from = sector_place(angle_in(frame, front + near * behind), frame.slice.tilt);
  float to = sector_place(angle_in(frame, front + far * behind), frame.slice.tilt);
  return sectors_between(min(from, to), max(from, to));
}

float open_share(ivec2 pixel, vec3 position, vec3 normal, float radius, float radius_px) {
  vec2 noise = pixel_noise(pixel);
  Frame frame;
  frame.viewer = normalize(-position);
  frame.normal = normal;
  float open = 0.0, all = 0.0;
  for (int i = 0; i < groups; ++i) {
    frame.slice = make_slice(i, noise, normal, frame.viewer);
    vec3 along = vec3(frame.slice.direction, 0.0);
    frame.across = normalize(along - dot(along, frame.viewer) * frame.viewer);
    uvec4 closed = uvec4(0u);
    for (int k = 0; k < 2 * steps; ++k) {
      float side = k < steps ? -1.0 : 1.0;
      vec2 offset = side * frame.slice.direction * step_px(k % steps, noise, radius_px);
      ivec2 at = ivec2(floor(gl_FragCoord.xy + offset));
      float depth = clamped_depth(at);
      if (depth != no_surface) closed |= closed_by(frame, at, depth, position, radius);
    }
    float weight = frame.slice.projected * open_arc(frame.slice.tilt);
    int count = set_bits(closed.x) + set_bits(closed.y) + set_bits(closed.z) + set_bits(closed.w);
    open += weight * (1.0 - float(count) / sectors);
    all += weight;
  }
  return all > 0.0 ? open / all : 1.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  result = 1.0;
  if (depth == no_surface) return;
  result = open_share(pixel, position_at(pixel, depth), normal_at(pixel), radius_m,
                      radius_m * pixels_per_metre(depth));
}
