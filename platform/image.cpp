#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <glad/gl.h>

#include <algorithm>
#include <span>
#include <stdexcept>

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
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) fail(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (!spec.format.is_floating_point()) fail("it has no floating-point values; use .hdr or .exr");
  if (spec.nchannels < 3 || spec.depth > 1) fail("it is not a flat image of three channels");
  FloatImage image{spec.width, spec.height, {}};
  image.rgb.resize(3 * std::size_t(spec.width) * std::size_t(spec.height));
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.rgb.data())) fail(input->geterror());
  return image;
}

void write_image(const std::filesystem::path& path, const Image& image) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(path.string());
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  if (!output || !output->set_ioproxy(&memory) || !output->open(path.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !output->close())
    throw std::runtime_error("write_image: " + path.string() + " cannot be written (" +
                             (output ? output->geterror() : OIIO::geterror()) + ")");
  OutputFile(path).commit(std::as_bytes(std::span(bytes)));
}

}  // namespace platform
