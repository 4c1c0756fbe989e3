#include <exception>
#include <iostream>
#include <span>
#include <vector>

#include "bakers/mannequin/mannequin.h"
#include "platform/output_file.h"
#include "platform/standard_streams.h"

int main(int argc, char** argv) {
  open_closed_streams();
  if (argc != 2) {
    std::cerr << "usage: mannequin OUT.glb\n";
    return 2;
  }
  try {
    const std::vector<unsigned char> bytes = nook::mannequin::make_mannequin_glb();
    platform::OutputFile(argv[1]).commit(std::as_bytes(std::span(bytes)));
  } catch (const std::exception& error) {
    std::cerr << "mannequin: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
