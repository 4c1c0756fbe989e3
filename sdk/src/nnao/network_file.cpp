#include "sdk/src/nnao/network_file.h"

#include <cmath>

#include "sdk/src/core/floats.h"
#include "sdk/src/nnao/layers.h"

namespace nook::nnao {
namespace {

constexpr std::size_t filter_count = std::size_t(PaperNetwork::grid_size) * PaperNetwork::grid_size *
                                     PaperNetwork::tap_inputs * PaperNetwork::units;

float checked(float value, const char* what, nook_result code) {
  if (!(std::abs(value) <= max_parameter))
    throw Failure(code, "a %s of the network is out of range (got %g, need at most %g); train it again", what,
                  double(value), double(max_parameter));
  return value;
}

std::array<std::uint32_t, 3> sizes_of(NetworkForm form) {
  if (form == NetworkForm::paper)
    return {PaperNetwork::grid_size, PaperNetwork::tap_inputs, PaperNetwork::units};
  return {HorizonNetwork::revision, HorizonNetwork::tap_inputs, HorizonNetwork::units};
}

NetworkForm read_head(ByteReader in) {
  const std::uint32_t form = in.u8();
  if (form > std::uint32_t(NetworkForm::horizon))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the form of the network is unknown (got %u, need 0 or 1); train it again", form);
  for (const std::uint32_t need : sizes_of(NetworkForm(form)))
    if (const std::uint32_t got = in.u16(); got != need)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the network has a size or revision that this version does not evaluate (got %u, need "
                    "%u); train it again",
                    got, need);
  in.check_end();
  return NetworkForm(form);
}

void read_filters(ByteReader in, Vector<float>& filters) {
  in.check_count(filter_count, 16, "filters");
  filters.resize(filter_count);
  for (float& weight : filters)
    weight = checked(from_half(std::uint16_t(in.u16())), "filter", NOOK_ERROR_BAD_FILE);
  in.check_end();
}

}  // namespace

std::vector<std::byte> write_network(const Network& network) {
  std::vector<ContainerSection> sections;
  ByteWriter head, filters, layers, recipe;
  head.u8(std::uint32_t(network.form));
  for (const std::uint32_t size : sizes_of(network.form)) head.u16(size);
  sections.push_back({four_letters("HEAD"), head.bytes()});
  if (network.form == NetworkForm::paper) {
    if (network.paper.filters.size() != filter_count)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of filter weights is wrong (got %zu, need %zu)",
                    network.paper.filters.size(), filter_count);
    for (const float weight : network.paper.filters)
      filters.u16(to_half(checked(weight, "filter", NOOK_ERROR_INVALID_ARGUMENT)));
    sections.push_back({four_letters("FILT"), filters.bytes()});
  }
  visit_layers(network, [&](std::span<const float> values) {
    for (const float value : values) layers.f32(checked(value, "parameter", NOOK_ERROR_INVALID_ARGUMENT));
  });
  sections.push_back({four_letters("LAYR"), layers.bytes()});
  recipe.text(network.recipe);
  sections.push_back({four_letters("RECP"), recipe.bytes()});
  return write_container(network_kind, sections);
}

Network read_network(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, network_kind);
  Network network(memory);
  network.form = read_head(file.section("HEAD"));
  if (network.form == NetworkForm::paper) read_filters(file.section("FILT"), network.paper.filters);
  ByteReader layers = file.section("LAYR");
  visit_layers(network, [&](std::span<float> values) {
    for (float& value : values) value = checked(layers.f32(), "parameter", NOOK_ERROR_BAD_FILE);
  });
  layers.check_end();
  ByteReader recipe = file.section("RECP");
  network.recipe = recipe.text(recipe.remaining());
  return network;
}

NetworkForm network_form(std::span<const std::byte> bytes) {
  return read_head(Container(bytes, network_kind).section("HEAD"));
}

}  // namespace nook::nnao
