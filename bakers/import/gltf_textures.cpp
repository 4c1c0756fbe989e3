#include "bakers/import/gltf_textures.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "bakers/import/file_reader.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr int mag_nearest = 9728;

TextureWrap wrap_of(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamped;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::mirrored : TextureWrap::repeat;
}

double number(const tinygltf::Value& object, const char* key, int element, double otherwise) {
  if (!object.Has(key)) return otherwise;
  const tinygltf::Value& value = object.Get(key);
  if (element < 0) return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
  if (!value.IsArray() || std::size_t(element) >= value.ArrayLen()) return otherwise;
  return value.Get(element).IsNumber() ? value.Get(element).GetNumberAsDouble() : otherwise;
}

// KHR_texture_transform: scale, then rotation, then offset. Angles are counter-clockwise with v down.
void read_transform(const tinygltf::Value& extension, TextureUse& use, const std::string& what) {
  const double angle = number(extension, "rotation", -1, 0), c = std::cos(angle), s = std::sin(angle);
  const double su = number(extension, "scale", 0, 1), sv = number(extension, "scale", 1, 1);
  use.transform = {float(c * su),  float(s * sv), float(number(extension, "offset", 0, 0)),
                   float(-s * su), float(c * sv), float(number(extension, "offset", 1, 0))};
  for (const float value : use.transform)
    if (!std::isfinite(value))
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has a KHR_texture_transform that is not finite", what.c_str());
}

// glTF 2.0, section 5.11: an image is in a buffer view or in a URI. The parser has already read the URI.
std::span<const unsigned char> bytes_of(const tinygltf::Model& model, const tinygltf::Image& image) {
  if (image.bufferView < 0) return image.image;
  if (std::size_t(image.bufferView) >= model.bufferViews.size()) return {};
  const tinygltf::BufferView& view = model.bufferViews[std::size_t(image.bufferView)];
  if (view.buffer < 0 || std::size_t(view.buffer) >= model.buffers.size()) return {};
  const std::vector<unsigned char>& data = model.buffers[std::size_t(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) return {};
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

std::string name_of(const tinygltf::Image& image, int index) {
  const std::string& name = image.uri.empty() ? image.name : image.uri;
  return "image " + std::to_string(index) + (name.empty() ? "" : " (\"" + name + "\")");
}

}  // namespace

std::uint32_t GltfTextures::image_of(const tinygltf::Texture& texture, const std::string& what) {
  const int source = texture.source;
  if (source < 0)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%s has its image only in a glTF extension that Nook does not read; convert the image to PNG or JPEG",
        what.c_str());
  if (std::size_t(source) >= model_.images.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to image %d, but the file has only %zu", what.c_str(),
                  source, model_.images.size());
  const auto known = place_of_source_.find(source);
  if (known != place_of_source_.end()) return known->second;
  const tinygltf::Image& image = model_.images[std::size_t(source)];
  const std::span<const unsigned char> bytes = bytes_of(model_, image);
  if (bytes.empty())
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%s: %s cannot be read; it must be a regular file at the path that the scene's file gives, "
                  "and inside the folder of that file unless you allow files outside",
                  what.c_str(), name_of(image, source).c_str());
  if (bytes.size() > max_file_bytes - bytes_)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s: the images have more than 2 GiB in all", what.c_str());
  bytes_ += bytes.size();
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  images_.push_back({what + ": " + name_of(image, source), {first, first + bytes.size()}});
  const auto place = std::uint32_t(images_.size() - 1);
  place_of_source_.emplace(source, place);
  return place;
}

TextureUse GltfTextures::use(const tinygltf::TextureInfo& info, const std::string& what) {
  TextureUse use;
  if (info.index < 0) return use;
  if (std::size_t(info.index) >= model_.textures.size())
    throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to texture %d, but the file has only %zu", what.c_str(),
                  info.index, model_.textures.size());
  const tinygltf::Texture& texture = model_.textures[std::size_t(info.index)];
  use.image = image_of(texture, what);
  double set = info.texCoord;
  if (const auto extension = info.extensions.find("KHR_texture_transform");
      extension != info.extensions.end() && extension->second.IsObject()) {
    read_transform(extension->second, use, what);
    set = number(extension->second, "texCoord", -1, set);
  }
  if (set != 0 && set != 1)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s uses TEXCOORD_%g (need 0 or 1)", what.c_str(), set);
  use.uv_set = std::uint8_t(set);
  if (texture.sampler >= 0) {
    if (std::size_t(texture.sampler) >= model_.samplers.size())
      throw Failure(NOOK_ERROR_BAD_FILE, "%s refers to sampler %d, but the file has only %zu", what.c_str(),
                    texture.sampler, model_.samplers.size());
    const tinygltf::Sampler& sampler = model_.samplers[std::size_t(texture.sampler)];
    use.wrap_u = wrap_of(sampler.wrapS);
    use.wrap_v = wrap_of(sampler.wrapT);
    use.nearest = sampler.magFilter == mag_nearest;
  }
  return use;
}

}  // namespace nook::bake
