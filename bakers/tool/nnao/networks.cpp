#include "bakers/tool/nnao/networks.h"

#include "bakers/tool/input_file.h"

namespace nook::tool {

Networks read_networks(const std::filesystem::path& file) {
  Networks networks;
  networks.embedded = nook::nnao::read_network(nook::nnao::default_network_file());
  if (file.empty()) return networks;
  networks.file = read_file(file);
  networks.other = naming_file(file, [&] { return nook::nnao::read_network(networks.file); });
  return networks;
}

std::string other_name(const Networks& networks) {
  if (networks.file.empty()) return "";
  return networks.other.form == nook::nnao::NetworkForm::paper ? "nnao_paper" : "nnao_file";
}

}  // namespace nook::tool
