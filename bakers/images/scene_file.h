// Reads a scene from its file, with textures, and the light around it. Only the tool compiles this, or the
// library would load OpenImageIO for nothing.
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

// Fails with BAD_FILE if OpenImageIO cannot read the image, or if it has more than 2^26 texels; the message
// starts with the image's name.
Texture decode_texture(const EncodedImage& image);

}  // namespace nook::bake

namespace nook::bake::probe {

// Reads a latitude-longitude map of floating-point radiance (.hdr, .exr), twice as wide as high, at most
// 16,384 columns. Filters leave negative values behind; they become 0 if they add up to 1 % of the others or
// less. Fails with BAD_FILE on anything else, also on values that are not finite or above raytrace's
// max_radiance. The message names the fault, and the caller adds the name of the file.
Environment read_environment(const std::filesystem::path& path);

}  // namespace nook::bake::probe

namespace nook::bake {

struct ProbeScene {
  TriangleSoup soup;
  Vec3 low_ws, high_ws;     // what all triangles fill, metres
  float origin_offset = 0;  // metres along the normal, of rays that leave a surface
  std::unique_ptr<LitScene> lit;
};

// Throws Failure (BAD_FILE) that names the texture, where it is one's fault. Without textures their colour
// factors stand for them. Adds the warnings of the import.
LitTriangles read_lit_triangles(const std::filesystem::path& path, bool textures,
                                const ImportOptions& options, std::vector<std::string>& warnings);

ProbeScene make_probe_scene(LitTriangles triangles, Environment light);

}  // namespace nook::bake
