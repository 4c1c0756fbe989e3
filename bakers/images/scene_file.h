// Reads a scene with its textures, and the environment map that lights it. Only the tool compiles this file,
// so that the library does not load OpenImageIO.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/lit_scene.h"
#include "bakers/raytrace/texture.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Throws Failure(BAD_FILE) if OpenImageIO cannot read the image, or if the image has more than 2^26 texels.
// The message starts with the image's name.
Texture decode_texture(const EncodedImage& image);

}  // namespace nook::bake

namespace nook::bake::probe {

// Reads a latitude-longitude map of floating-point radiance (.hdr, .exr). It must be twice as wide as high,
// with at most 16,384 columns. Filters sometimes produce negative values. They are set to 0 if their sum is
// at most 1 % of the sum of the positive values. Throws Failure(BAD_FILE) for any other image, and for values
// that are not finite or above max_radiance (environment.h). The message does not name the file; the caller
// must add its name.
Environment read_environment(const std::filesystem::path& path);

}  // namespace nook::bake::probe

namespace nook::bake {

struct ProbeScene {
  TriangleSoup soup;
  Vec3 low_ws, high_ws;     // bounding box of all triangles, metres
  float origin_offset = 0;  // offset of ray origins along the normal, metres
  std::unique_ptr<LitScene> lit;
};

// Appends the warnings of the import to `warnings`. If `textures` is false, uses only the materials' colour
// factors. Throws Failure(BAD_FILE). If a texture is the cause, the message names it.
LitTriangles read_lit_triangles(const std::filesystem::path& path, bool textures,
                                const ImportOptions& options, std::vector<std::string>& warnings);

ProbeScene make_probe_scene(LitTriangles triangles, Environment light);

}  // namespace nook::bake
