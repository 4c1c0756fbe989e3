// Nook inside of real engines, as programs without a screen: OpenGL's errors, the engines' own pictures with
// and without Nook, and the AO on both paths.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

Picture read(const std::filesystem::path& path) {
  Picture picture;
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  const OIIO::ImageSpec& spec = input->spec();
  REQUIRE(spec.nchannels >= 3);
  picture.width = spec.width;
  picture.height = spec.height;
  picture.rgb.resize(3 * std::size_t(spec.width) * std::size_t(spec.height));
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.rgb.data()));
  return picture;
}

double rmse(const Picture& a, const Picture& b) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::pow(double(a.rgb[i]) - double(b.rgb[i]), 2);
  return std::sqrt(sum / double(a.rgb.size()));
}

void write(const std::string& path, const Picture& picture) {
  const auto output = OIIO::ImageOutput::create(path);
  REQUIRE(output);
  REQUIRE(output->open(path, OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8)));
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, picture.rgb.data()));
  REQUIRE(output->close());
}

// The columns from `first` up to `end` of each picture.
Picture side_by_side(const std::vector<const Picture*>& pictures, int first, int end) {
  Picture out;
  out.height = pictures[0]->height;
  out.width = int(pictures.size()) * (end - first);
  for (int y = 0; y < out.height; ++y)
    for (const Picture* picture : pictures) {
      const auto row = picture->rgb.begin() + std::ptrdiff_t(3) * y * picture->width;
      out.rgb.insert(out.rgb.end(), row + 3 * first, row + 3 * end);
    }
  return out;
}

// The mean of squares of pixels, whose side divides the side of the picture.
Picture shrunk(const Picture& source, int side) {
  Picture out;
  out.width = source.width / side;
  out.height = source.height / side;
  out.rgb.resize(3 * std::size_t(out.width) * std::size_t(out.height));
  for (int y = 0; y < out.height * side; ++y)
    for (int x = 0; x < out.width * side; ++x)
      for (int c = 0; c < 3; ++c)
        out.rgb[3 * (std::size_t(y / side) * std::size_t(out.width) + std::size_t(x / side)) +
                std::size_t(c)] +=
            source.rgb[3 * (std::size_t(y) * std::size_t(source.width) + std::size_t(x)) + std::size_t(c)] /
            float(side * side);
  return out;
}

struct Drawn {
  Picture picture;
  int gl_errors = 0;
  std::string first_error;
};

// Each picture is drawn once, by a program of its own.
Drawn draw(const std::string& host, const std::string& arguments) {
  std::string name = host + arguments;
  for (char& c : name)
    if (c == ' ' || c == '/') c = '_';
  const std::filesystem::path out = std::filesystem::path(HOSTS_FOLDER) / (name + ".png");
  const std::string command = "xvfb-run -a -s '-screen 0 1280x1024x24' " HOSTS_PROGRAMS "/nook_host_" + host +
                              " " HOSTS_CHARACTER " " HOSTS_MODEL " " + arguments + " --out " + out.string() +
                              " 2> " + out.string() + ".log";
  std::FILE* const pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), count);
  INFO(command);
  REQUIRE(pclose(pipe) == 0);
  INFO(text);
  const std::size_t begin = text.find("{\"host\"");
  REQUIRE(begin != std::string::npos);
  const auto report = nlohmann::json::parse(text.substr(begin, text.find('\n', begin) - begin));
  return {read(out), report["gl_errors"], report["first_error"]};
}

void require_no_errors(const Drawn& drawn) {
  INFO(drawn.first_error);
  CHECK(drawn.gl_errors == 0);
}

}  // namespace

TEST_CASE("hosts: no OpenGL errors, and the engine's own picture stays as it was") {
  for (const std::string host : {"ogre", "osg"}) {
    INFO(host);
    const Drawn without = draw(host, "--show plain --path none");
    require_no_errors(without);
    for (const std::string state : {"preserve", "defaults"})
      for (const std::string path : {"gpu", "cpu"}) {
        INFO(state << " " << path);
        const Drawn with = draw(host, "--show plain --path " + path + " --state " + state);
        require_no_errors(with);
        CHECK(with.picture.rgb == without.picture.rgb);
      }
  }
}

TEST_CASE("hosts: OpenSceneGraph, which caches state, notices the contract that leaves state to the host") {
  const Drawn without = draw("osg", "--show plain --path none"),
              with = draw("osg", "--show plain --state host");
  CHECK(with.gl_errors > 0);
  CHECK(rmse(with.picture, without.picture) > 0.01);
}

TEST_CASE("hosts: the AO of both paths agrees, between the hosts as well") {
  std::vector<Picture> of_hosts;
  for (const std::string host : {"ogre", "osg"}) {
    INFO(host);
    const Drawn gpu = draw(host, "--show ao --path gpu"), cpu = draw(host, "--show ao --path cpu");
    const double between_paths = rmse(gpu.picture, cpu.picture);
    WARN(host << ": rmse of the AO on the GPU against the CPU " << between_paths);
    CHECK(between_paths < 0.001);
    of_hosts.push_back(gpu.picture);
  }
  const double between_hosts = rmse(of_hosts[0], of_hosts[1]);
  WARN("rmse of OGRE against OpenSceneGraph " << between_hosts);
  CHECK(between_hosts < 0.005);
}

TEST_CASE("hosts: VTK's picture changes in ambient light alone, and translucent props stay as they are") {
  // Without ambient light nothing is left to darken; a translucent ball is part of the picture.
  const Drawn without = draw("vtk", "--show plain --path none");
  require_no_errors(without);
  for (const std::string state : {"preserve", "defaults"}) {
    INFO(state);
    const Drawn with = draw("vtk", "--show plain --state " + state);
    require_no_errors(with);
    CHECK(with.picture.rgb == without.picture.rgb);
  }
  for (const std::string projection : {"", " --orthographic"}) {
    INFO(projection);
    const Drawn open = draw("vtk", "--show ao --path none" + projection),
                dark = draw("vtk", "--show ao" + projection);
    require_no_errors(dark);
    std::size_t darker = 0, brighter = 0;
    for (std::size_t i = 0; i < open.picture.rgb.size(); ++i) {
      darker += dark.picture.rgb[i] < open.picture.rgb[i] - 0.1f;
      brighter += dark.picture.rgb[i] > open.picture.rgb[i];
    }
    CHECK(brighter == 0);
    CHECK(darker > open.picture.rgb.size() / 100);
    CHECK(darker < open.picture.rgb.size() / 5);
  }
}

TEST_CASE("hosts: Nook's pass in VTK is nearer to ray tracing than VTK's own") {
  for (const std::string projection : {"", " --orthographic"}) {
    INFO(projection);
    const auto picture = [&](const std::string& path) {
      return draw("vtk", "--show ao --path " + path + projection).picture;
    };
    const Picture open = picture("none"), traced = picture("traced"), nook = picture("gpu"),
                  own = picture("vtk");
    // Surfaces are white where nothing darkens them, the background is not.
    const auto rmse_of_surfaces = [&](const Picture& other) {
      double sum = 0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < open.rgb.size(); ++i) {
        if (open.rgb[i] < 1) continue;
        sum += std::pow(double(other.rgb[i]) - double(traced.rgb[i]), 2);
        ++count;
      }
      return std::sqrt(sum / double(count));
    };
    WARN("rmse against rays" << projection << ": Nook " << rmse_of_surfaces(nook) << ", vtkSSAOPass "
                             << rmse_of_surfaces(own) << ", no AO " << rmse_of_surfaces(open));
    // Measured: 0.49 of it in perspective, 0.52 orthographic.
    CHECK(rmse_of_surfaces(nook) < 0.57 * rmse_of_surfaces(own));
    if (std::getenv("NOOK_BLESS") && projection.empty())
      write(std::string(HOSTS_STORED) + "/../../docs/hosts_vtk.png",
            side_by_side({&own, &nook, &traced}, 220, 460));
  }
}

// NOOK_BLESS=1 writes the stored pictures anew.
TEST_CASE("hosts: the pictures are the stored ones") {
  for (const std::string host : {"ogre", "osg", "vtk"}) {
    INFO(host);
    const Picture small = shrunk(draw(host, "--show lit").picture, 8);
    const std::string path = std::string(HOSTS_STORED) + "/" + host + ".png";
    if (std::getenv("NOOK_BLESS")) write(path, small);
    const double difference = rmse(small, read(path));
    WARN(host << ": rmse against the stored picture " << difference);
    CHECK(difference < 0.01);
  }
}
