# Read by ctest: asks a test program for its tests and adds one entry LABEL/SUITE for each class of tests. All tests of
# a class run in one process, which makes one OpenGL context. Tests of a class that ends its process are lost; those of
# other classes are not. The including file sets label, program and results (a folder: support/test_main.cpp).
if(NOT EXISTS ${program})
  add_test(${label}/not_built ${program})
  set_tests_properties(${label}/not_built PROPERTIES LABELS ${label})
  return()
endif()
file(MAKE_DIRECTORY ${results})
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
# Names of classes stand at the beginning of a line and end with a dot.
string(REGEX MATCHALL "(^|\n)[^ \n][^ \n]*\\.( |\n)" suites "${list}")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[ \n.]*([^ \n]+)\\.[ \n]" "\\1" suite "${suite}")
  string(REPLACE "/" "." file "${suite}")
  add_test(${label}/${suite} ${program} --gtest_filter=${suite}.* --gtest_color=no)
  set(environment "CONELIGHT_TEST_RESULTS=${results}/${label}.${file}.txt;MESA_SHADER_CACHE_DIR=${shader_cache}")
  # Small pictures wait for a driver's threads longer than they work; and without them each run takes the same memory.
  # Commands are tested as users start them.
  if(NOT label STREQUAL "cli" OR suite MATCHES "^Viewer")
    list(APPEND environment LP_NUM_THREADS=0)
  endif()
  # The time limit ends what hangs; a busy machine must not reach it.
  set_tests_properties(${label}/${suite} PROPERTIES LABELS ${label} TIMEOUT 3000 SKIP_RETURN_CODE 77 ENVIRONMENT "${environment}")
  # Those of windows wait more than they work, for long: they start first. Then what takes minutes.
  if(suite MATCHES "^Viewer")
    set_tests_properties(${label}/${suite} PROPERTIES COST 1000)
  elseif(suite MATCHES "^(SoakTest|GlassTest)$")
    set_tests_properties(${label}/${suite} PROPERTIES COST 500)
  endif()
endforeach()
