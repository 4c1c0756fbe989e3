#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "samples/mannequin/mannequin.h"

namespace {

/// Writes beside the target and renames, so that a failed run leaves no half-written file.
void write_file(const std::filesystem::path& path, const std::vector<unsigned char>& bytes) {
  std::filesystem::path partial = path;
  partial += ".part";
  std::ofstream file(partial, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    std::filesystem::remove(partial);
    throw std::runtime_error("mannequin: cannot write '" + path.string() + "'; check that its folder exists");
  }
  std::filesystem::rename(partial, path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: mannequin OUT.glb\n";
    return 2;
  }
  try {
    write_file(argv[1], nook_samples::mannequin::make_mannequin_glb());
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
