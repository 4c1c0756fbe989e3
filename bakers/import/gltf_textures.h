// The colour textures of glTF materials, their images collected once each. The time is linear in the textures
// and in the bytes of the images.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "bakers/import/texture_use.h"

namespace nook::bake {

class GltfTextures {
 public:
  // The document must have been parsed with Images::keep and outlive this.
  explicit GltfTextures(const tinygltf::Model& model) : model_(model) {}

  // `what` names the texture in messages. Fails with BAD_FILE on indices out of range, images without bytes
  // and coordinate sets above 1.
  TextureUse use(const tinygltf::TextureInfo& info, const std::string& what);

  // In the order of their first use, which TextureUse::image counts.
  std::vector<EncodedImage> take_images() { return std::move(images_); }

 private:
  std::uint32_t image_of(const tinygltf::Texture& texture, const std::string& what);

  const tinygltf::Model& model_;
  std::vector<EncodedImage> images_;
  std::unordered_map<int, std::uint32_t> place_of_source_;  // of an image of the file in images_
  std::size_t bytes_ = 0;                                   // of images_
};

}  // namespace nook::bake
