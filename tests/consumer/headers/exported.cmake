# The dynamic symbols of a shared library that links ours whole: no name of namespace sublimit, and the functions of eval.h.
execute_process(COMMAND ${NM} -D --defined-only -C ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]*sublimit::[^\n]*" ours "${symbols}")
# Trees and lists of std of our numbers are not ours. g++ 12 forgets that functions made for several processors
# (target_clones), and constants of templates in them, are hidden.
list(FILTER ours EXCLUDE REGEX " [A-Za-z] std::|sublimit::(kernels::|LimitPatches::Loop::)")
list(LENGTH ours count)
if(count GREATER 0)
  list(SUBLIST ours 0 10 first)
  list(JOIN first "\n" first)
  message(FATAL_ERROR "${count} names of sublimit are exported:\n${first}")
endif()
if(NOT symbols MATCHES " T sublimit_table_from_rows_f\n")
  message(FATAL_ERROR "the functions of eval.h are not exported")
endif()
