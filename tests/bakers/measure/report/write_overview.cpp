// write_overview COUNT PAGE.html: the page of COUNT made-up assets.
#include <cstdlib>
#include <fstream>

#include "tests/bakers/measure/report/made_up_assets.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string page = nook::report::overview_page(made_up_overview(std::strtoull(argv[1], nullptr, 10)));
  std::ofstream(argv[2], std::ios::binary).write(page.data(), std::streamsize(page.size()));
  return 0;
}
