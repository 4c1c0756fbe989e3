// The depth, normals and radius that every method uses. View space is as in OpenGL, in metres. Pixels are
// counted from the lower left corner.
uniform sampler2D depth_image;   // -z, metres; infinite: no surface
uniform sampler2D normal_image;  // view space, unit length
uniform vec4 screen_rays;        // x_scale, x_offset, y_scale, y_offset: x / depth = x_scale px + x_offset
uniform ivec2 size_px;
uniform float radius_m;
uniform float max_radius_px;

const float no_surface = 1.0e30;

float depth_at(ivec2 pixel) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size_px))) return no_surface;
  float depth = texelFetch(depth_image, pixel, 0).r;
  return depth < no_surface ? depth : no_surface;
}

vec3 position_at(ivec2 pixel, float depth) {
  return vec3((screen_rays.xz * (vec2(pixel) + 0.5) + screen_rays.yw) * depth, -depth);
}

vec3 normal_at(ivec2 pixel) {
  return normalize(texelFetch(normal_image, pixel, 0).xyz);
}

float pixels_per_metre(float depth) {
  return 1.0 / abs(screen_rays.z * depth);
}

// Returns the radius at a pixel: x in metres and y in pixels. The radius is reduced if it would cover too many
// pixels.
vec2 pixel_radius(float depth) {
  float per_metre = pixels_per_metre(depth);
  float pixels = min(radius_m * per_metre, max_radius_px);
  return vec2(pixels / per_metre, pixels);
}
