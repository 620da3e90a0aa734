# conelight_compile_quickly(TARGET HEADER...): for code that takes longer to compile than to run. Precompiles the
# headers that most of its files include, and optimises as far as pays for itself.
function(conelight_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  if(CCACHE_PROGRAM)
    # ccache keeps files that use precompiled headers with these alone; GCC names the header by the flag.
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${CCACHE_PROGRAM}")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
  endif()
endfunction()

# conelight_compile_together(TARGET): several of its files in one run of the compiler, where CONELIGHT_UNITY asks for it. Headers of
# libraries are then read, and what is inline in them is compiled, once for all of them.
function(conelight_compile_together target)
  if(CONELIGHT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    # GCC takes a .cpp that another file includes for a header, whose types others could see.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
