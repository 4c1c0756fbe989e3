// The instruction sets that both processor and operating system can run. All answers are false on processors
// of another family.
#pragma once

namespace nook {

bool processor_has_sse2();
bool processor_has_avx2_and_fma();
bool processor_has_avx512f();

}  // namespace nook
