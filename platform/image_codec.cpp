#include "platform/image_codec.h"

#include <dlfcn.h>

#include <stdexcept>

namespace platform {
namespace {

// The module is never unloaded, because OpenImageIO uses threads and strings until the process ends.
const ImageCodec& load() {
  void* module = dlopen(PLATFORM_IMAGE_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* codec = module ? dlsym(module, "platform_openimageio_codec") : nullptr;
  if (!codec)
    throw std::runtime_error(std::string("images cannot be read or written: the module " PLATFORM_IMAGE_MODULE
                                         " is not beside this program (") +
                             dlerror() + "); install Nook's tool again, with its folder lib/nook");
  return *reinterpret_cast<const ImageCodec* (*)()>(codec)();
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace platform
