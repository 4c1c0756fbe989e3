#include <glad/gl.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "platform/image_codec.h"
#include "platform/output_file.h"
#include "platform/platform.h"

namespace platform {

Image read_pixels(const Context& context, int width, int height, int channels) {
  Image image{width, height, channels,
              std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * channels)};
  const GladGLContext& gl = context.gl();
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS})
    gl.PixelStorei(name, 0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  // OpenGL's first row is the lowest one.
  const std::size_t row = static_cast<std::size_t>(width) * channels;
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
                     image.pixels.begin() + (height - 1 - y) * row);
  return image;
}

FloatImage read_float_image(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error("read_float_image: " + path.string() + " cannot be read (" + why + ")");
  };
  std::string why, ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  const auto input = image_codec().open(ending, path.string(), ImageAlpha::associated, why);
  if (!input) fail(why);
  const ImageHead& head = input->head();
  if (!head.is_floating_point) fail("it has no floating-point values; use .hdr or .exr");
  if (head.channels < 3 || head.depth > 1) fail("it is not a flat image of three channels");
  FloatImage image{head.width, head.height, {}};
  image.rgb.resize(3 * std::size_t(head.width) * std::size_t(head.height));
  if (!input->read_rows(0, head.height, 3, image.rgb.data())) fail(input->why());
  return image;
}

void write_image(const std::filesystem::path& path, const Image& image) {
  std::string why;
  const std::vector<std::byte> bytes =
      image_codec().encode(path.string(), image.width, image.height, image.channels, image.pixels, why);
  if (bytes.empty())
    throw std::runtime_error("write_image: " + path.string() + " cannot be written (" + why + ")");
  OutputFile(path).commit(bytes);
}

}  // namespace platform
