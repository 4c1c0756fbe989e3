// The module that image_codec.cpp loads.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "platform/image_codec.h"

namespace platform {
namespace {

ImageHead head_of(const OIIO::ImageSpec& spec) {
  return {spec.width,       spec.height,      spec.depth,          spec.nchannels,
          spec.tile_width,  spec.tile_height, spec.format.c_str(), spec.format.is_floating_point(),
          spec.channelnames};
}

class OpenedImage : public ImageSource {
 public:
  // `reader` is null if the image is read from a file.
  OpenedImage(std::unique_ptr<OIIO::Filesystem::IOMemReader> reader, std::unique_ptr<OIIO::ImageInput> input)
      : reader_(std::move(reader)), input_(std::move(input)), head_(head_of(input_->spec())) {}

  const ImageHead& head() const override { return head_; }
  const char* format_name() const override { return input_->format_name(); }
  bool read_rows(int top, int bottom, int channels, float* values) override {
    return read(top, bottom, channels, OIIO::TypeDesc::FLOAT, values);
  }
  bool read_rows(int top, int bottom, int channels, std::uint8_t* values) override {
    return read(top, bottom, channels, OIIO::TypeDesc::UINT8, values);
  }
  bool read_tiles(int left, int right, int top, int bottom, int channels, float* values) override {
    const OIIO::ImageSpec& spec = input_->spec();
    return input_->read_tiles(0, 0, spec.x + left, spec.x + right, spec.y + top, spec.y + bottom, spec.z,
                              spec.z + 1, 0, channels, OIIO::TypeDesc::FLOAT, values);
  }
  std::string why() override { return input_->geterror(); }

 private:
  // When OpenImageIO converts values, it allocates a buffer of 64 MiB, even for a small image. So rows are
  // read in the type of the file, and converted afterwards.
  bool read(int top, int bottom, int channels, OIIO::TypeDesc type, void* values) {
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.tile_width != 0) return input_->read_image(0, 0, 0, channels, type, values);
    top += spec.y;
    bottom += spec.y;
    // If the channels have different types, the image does not have a single type.
    if (!spec.channelformats.empty())
      return input_->read_scanlines(0, 0, top, bottom, spec.z, 0, channels, type, values);
    const std::size_t count = std::size_t(channels) * std::size_t(spec.width) * std::size_t(bottom - top);
    std::vector<std::byte> own(count * spec.format.size());
    return input_->read_scanlines(0, 0, top, bottom, spec.z, 0, channels, OIIO::TypeDesc::UNKNOWN,
                                  own.data()) &&
           OIIO::convert_pixel_values(spec.format, own.data(), type, values, int(count));
  }

  std::unique_ptr<OIIO::Filesystem::IOMemReader> reader_;
  std::unique_ptr<OIIO::ImageInput> input_;
  ImageHead head_;
};

class OpenImageIoCodec : public ImageCodec {
 public:
  std::unique_ptr<ImageSource> open(const std::string& format, const std::string& path, ImageAlpha alpha,
                                    std::string& why) const override {
    return open_as(format, path, nullptr, alpha, why);
  }

  std::unique_ptr<ImageSource> open(const std::string& format, std::span<const std::byte> bytes,
                                    ImageAlpha alpha, std::string& why) const override {
    return open_as(format, "image." + format,
                   std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size()), alpha, why);
  }

  std::vector<std::byte> encode(const std::string& name, int width, int height, int channels,
                                std::span<const std::uint8_t> pixels, std::string& why) const override {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(name);
    const OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close()) {
      why = output ? output->geterror() : OIIO::geterror();
      return {};
    }
    const auto encoded = std::as_bytes(std::span(bytes));
    return {encoded.begin(), encoded.end()};
  }

 private:
  static std::unique_ptr<ImageSource> open_as(const std::string& format, const std::string& name,
                                              std::unique_ptr<OIIO::Filesystem::IOMemReader> reader,
                                              ImageAlpha alpha, std::string& why) {
    // With the name of a format, create() makes a reader, and does not open a file.
    auto input = OIIO::ImageInput::create(format);
    if (!input) {
      why = OIIO::geterror();
      return nullptr;
    }
    OIIO::ImageSpec config, opened;
    if (alpha == ImageAlpha::unassociated) config["oiio:UnassociatedAlpha"] = 1;
    // Passes the reader inside the configuration, because OpenImageIO 2.4 ignores a separate reader if there
    // is a configuration.
    OIIO::Filesystem::IOProxy* proxy = reader.get();
    if (proxy) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (input->open(name, opened, config))
      return std::make_unique<OpenedImage>(std::move(reader), std::move(input));
    why = input->geterror();
    return nullptr;
  }
};

}  // namespace
}  // namespace platform

extern "C" __attribute__((visibility("default"))) const platform::ImageCodec* platform_openimageio_codec() {
  static const platform::OpenImageIoCodec codec;
  return &codec;
}
