// Loads bytes as a character model, evaluates what loads, and reads its AO: nothing may crash, whatever the
// bytes. The checksum is repaired first, so that the fuzzer reaches what lies behind it. Built for libFuzzer
// with clang; elsewhere model_fuzz_replay.cpp drives it.
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nook;
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte(data[i]);
  repair_checksum(bytes);
  try {
    std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
    const auto model =
        Owned<LoadedModel>::make(memory, Ref<const RefCounted>(), read_character_model(bytes), memory);
    Scene scene({}, {}, memory);
    const nook_instance_id first = add_instance(scene, model), second = add_instance(scene, model);
    link(scene, first, second);
    update(scene);
    std::vector<float> ao(model->model.file_to_welded.size());
    read_ao(scene, instance_of(scene, first), ao.data(), sizeof(float));
    for (const float value : ao)
      if (!(value >= 0 && value <= 1)) std::abort();
  } catch (const Failure&) {
  }
  return 0;
}
