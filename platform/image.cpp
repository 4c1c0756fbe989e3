#include <OpenImageIO/imageio.h>
#include <glad/gl.h>

#include <algorithm>
#include <stdexcept>

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
  // The first row of OpenGL is the lowest.
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
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) fail(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (!spec.format.is_floating_point()) fail("it holds no floating-point values; use .hdr or .exr");
  if (spec.nchannels < 3 || spec.depth > 1) fail("it is not a flat image of three channels");
  FloatImage image{spec.width, spec.height, {}};
  image.rgb.resize(3 * std::size_t(spec.width) * std::size_t(spec.height));
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.rgb.data())) fail(input->geterror());
  return image;
}

void write_image(const std::filesystem::path& path, const Image& image) {
  std::filesystem::path partial = path;
  partial.replace_filename(path.stem().string() + ".part" + path.extension().string());
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw std::runtime_error("write_image: " + path.string() + " cannot be written (" + why + ")");
  };
  const auto output = OIIO::ImageOutput::create(partial.string());
  if (!output) fail(OIIO::geterror());
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!output->open(partial.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close())
    fail(output->geterror());
  std::error_code error;
  std::filesystem::rename(partial, path, error);
  if (error) fail(error.message());
}

}  // namespace platform
