// write_report_inputs FILE.glb: a rigged tube whose clips have hostile names.
#include <fstream>

#include "tests/bakers/tool/glb_tube.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string bytes =
      glb_tube({"<img src=x onerror=alert(1)>", "</script><script>throw 1</script>", "walk"});
  std::ofstream(argv[1], std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
  return 0;
}
