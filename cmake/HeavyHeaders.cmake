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
