# Every target has it.
set(isa_built ON)
