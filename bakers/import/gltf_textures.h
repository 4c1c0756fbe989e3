// Collects the colour textures of glTF materials, and their images. Each image is collected only once. The
// time is linear in the textures and in the bytes of the images.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "bakers/import/texture_use.h"

namespace nook::bake {

class GltfTextures {
 public:
  // The document must be parsed with Images::keep and outlive this object.
  explicit GltfTextures(const tinygltf::Model& model) : model_(model) {}

  // `what` names the texture in messages. Fails with BAD_FILE if an index is out of range, an image has no
  // bytes, or the index of the coordinate set is above 1.
  TextureUse use(const tinygltf::TextureInfo& info, const std::string& what);

  // Returns the images in the order of their first use. TextureUse::image is an index into this list.
  std::vector<EncodedImage> take_images() { return std::move(images_); }

 private:
  std::uint32_t image_of(const tinygltf::Texture& texture, const std::string& what);

  const tinygltf::Model& model_;
  std::vector<EncodedImage> images_;
  std::unordered_map<int, std::uint32_t> place_of_source_;  // place in images_, by the image's index in the
                                                            // file
  std::size_t bytes_ = 0;                                   // bytes of images_
};

}  // namespace nook::bake
