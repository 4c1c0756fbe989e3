# Fails when an object compiled for a better processor defines a symbol that the linker may merge with another object's:
# every weak or external symbol of it must be named after its instruction set. Arguments: NM, FILE,
# TABLE (the function that returns the table), ISA, OBJECTS (separated by |).
string(REPLACE "|" ";" OBJECTS "${OBJECTS}")
list(FILTER OBJECTS INCLUDE REGEX "isa/${ISA}/${FILE}\\.")
list(LENGTH OBJECTS count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "isa_symbols: found ${count} objects of ${ISA} (got '${OBJECTS}', need 1)")
endif()
execute_process(COMMAND ${NM} -C --defined-only --extern-only ${OBJECTS} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES "nook::isa_${ISA}::${TABLE}")
  message(FATAL_ERROR "isa_symbols: the table of ${ISA} is not in its object")
endif()
string(REPLACE ";" "," symbols "${symbols}")
string(REPLACE "\n" ";" symbols "${symbols}")
foreach(symbol IN LISTS symbols)
  if(symbol MATCHES "^[0-9a-f]+ . (.*)$" AND NOT symbol MATCHES "isa_${ISA}")
    message(SEND_ERROR "isa_symbols: '${symbol}' in the object of ${ISA} can be merged with code for other processors; "
                       "give it internal linkage or the instruction set's namespace")
  endif()
endforeach()
