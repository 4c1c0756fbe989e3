# cmake -DNETWORK=file.nook -DOUTPUT=file.cpp -P embed_network.cmake
# Turns a trained network into a C++ source file, so that engines need not ship the network as a file.
cmake_minimum_required(VERSION 3.25)

file(READ "${NETWORK}" hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "std::byte{0x\\1}," bytes "${hex}")
# Break the array into short lines, because some tools cannot read very long lines.
string(REPEAT "std::byte{0x..}," 8 line)
string(REGEX REPLACE "(${line})" "\\1\n" bytes "${bytes}")
file(WRITE "${OUTPUT}"
  "// Made from ${NAME} at build; do not edit.\n#include \"sdk/src/nnao/network_file.h\"\n\nnamespace nook::nnao {\nnamespace {\n"
  "constexpr std::byte network[] = {\n${bytes}};\n}  // namespace\n\n"
  "std::span<const std::byte> default_network_file() { return network; }\n\n}  // namespace nook::nnao\n")
