#include "bakers/lab/gpu_cost/instruction_count.h"

#include <string>

#include "tests/catch.h"

using namespace nook::lab;

namespace {

// Two nested loops, one behind them, and a branch forward, which is not a loop.
const char* const nested = R"(BB0:
	s_mov_b32 s0, 0                                             ; be800380
	v_mov_b32_e32 v0, 0                                         ; 7e000280
	s_cbranch_execz BB4                                         ; bf880000
BB1:
	v_add_f32_e32 v0, v1, v0                                    ; 06000101
	v_add_f32_e32 v0, v1, v0                                    ; 06000101
BB2:
	image_load v[2:5], v[0:1], s[0:7] dmask:0x1 dim:SQ_RSRC_IMG_2D ; f0000108
	v_rcp_f32_e32 v2, v2                                        ; 7e045502
	v_mul_f32_e32 v2, v2, v0                                    ; 10040102
	s_cbranch_scc1 BB2                                          ; bf850000
BB3:
	s_add_i32 s0, s0, 1                                         ; 81008100
	s_branch BB1                                                ; bf820000
BB4:
	ds_read_b128 v[0:3], v4                                     ; d9fc0000
	v_mul_lo_u32 v0, v0, v1                                     ; d5690000
	s_buffer_load_dwordx4 s[0:3], s[4:7], 0x0                   ; f4280002
	s_cbranch_vccnz BB4                                         ; bf870000
BB5:
	buffer_store_dword v0, v1, s[0:3], 0 offen                  ; e0701000
	exp mrt0 v0, off, off, off done vm                          ; f8001801
	s_endpgm                                                    ; bf810000
)";

constexpr double outer = 5, inner = 7, behind = 3;
const std::vector<Loop> expected = {{"outer", outer, {{"inner", inner, {}}}}, {"behind", behind, {}}};

}  // namespace

TEST_CASE("instructions of nested loops count by the product of their trips") {
  const InstructionCounts counts = count_instructions(nested, expected);
  CHECK(counts[InstructionClass::vector] == 1 + outer * (2 + inner));
  CHECK(counts[InstructionClass::quarter_rate] == outer * inner + behind);
  CHECK(counts[InstructionClass::fetch] == outer * inner);
  CHECK(counts[InstructionClass::local_memory] == behind);
  CHECK(counts[InstructionClass::scalar_load] == behind);
  CHECK(counts[InstructionClass::scalar] == 1 + outer);
  CHECK(counts[InstructionClass::store] == 1);
}

TEST_CASE("a loop of no trips counts nothing") {
  const InstructionCounts counts =
      count_instructions(nested, {{"outer", 0, {{"inner", inner, {}}}}, {"behind", 0, {}}});
  CHECK(counts[InstructionClass::vector] == 1);
  CHECK(counts[InstructionClass::fetch] == 0);
  CHECK(counts[InstructionClass::quarter_rate] == 0);
}

TEST_CASE("a disassembly with other loops than expected is refused") {
  // Unrolled, one more, and as many of another nesting.
  const std::vector<std::vector<Loop>> others = {
      {},
      {{"outer", outer, {}}, {"behind", behind, {}}},
      {{"outer", outer, {{"inner", inner, {{"innermost", 2, {}}}}}}, {"behind", behind, {}}},
      {{"outer", outer, {}}, {"inner", inner, {}}, {"behind", behind, {}}}};
  for (const std::vector<Loop>& other : others)
    CHECK_THROWS_AS(count_instructions(nested, other), std::runtime_error);
}

TEST_CASE("the refusal shows the compiled and the expected loops") {
  try {
    count_instructions(nested, {{"taps", 16, {}}});
    FAIL("three loops pass for one");
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    CHECK(text.find("BB2 to BB2") != text.npos);
    CHECK(text.find("taps: 16") != text.npos);
  }
}

TEST_CASE("a large branch counts by its share where a branch is expected, and whole elsewhere") {
  std::string text = "BB0:\n\ts_cbranch_execz BB2\nBB1:\n";
  for (int i = 0; i < least_branch_cycles; ++i) text += "\tv_add_f32_e32 v0, v1, v0\n";
  text += "BB2:\n\tv_mov_b32_e32 v0, 0\n\ts_endpgm\n";
  constexpr double share = 0.25;
  CHECK(count_instructions(text, {})[InstructionClass::vector] == least_branch_cycles + 1);
  CHECK(count_instructions(text, {{"taken", share, {}, true}})[InstructionClass::vector] ==
        share * least_branch_cycles + 1);
  CHECK_THROWS_AS(count_instructions(text, {{"one", share, {}, true}, {"two", share, {}, true}}),
                  std::runtime_error);
}

TEST_CASE("mnemonics of three generations fall into their classes") {
  CHECK(classify("v_fma_f32") == InstructionClass::vector);
  CHECK(classify("v_rsq_f32_e32") == InstructionClass::quarter_rate);
  CHECK(classify("v_mul_lo_u32") == InstructionClass::quarter_rate);
  CHECK(classify("v_mul_hi_i32_i24_e32") == InstructionClass::vector);
  CHECK(classify("image_sample_lz") == InstructionClass::fetch);
  CHECK(classify("buffer_load_format_xyzw") == InstructionClass::fetch);
  CHECK(classify("buffer_load_b128") == InstructionClass::fetch);
  CHECK(classify("buffer_gl0_inv") == InstructionClass::other);
  CHECK(classify("image_store") == InstructionClass::store);
  CHECK(classify("ds_load_b128") == InstructionClass::local_memory);
  CHECK(classify("s_buffer_load_b512") == InstructionClass::scalar_load);
  CHECK(classify("s_waitcnt_vscnt") == InstructionClass::other);
  CHECK(classify("s_and_saveexec_b64") == InstructionClass::scalar);
  CHECK(classify("exp") == InstructionClass::other);
}
