# conelight_warnings(TARGET): the warnings every target of ours builds with.
function(conelight_warnings target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:C,GNU,Clang>:-Wall -Wextra -Wpedantic -Wshadow>
    $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wformat=2
      -Wno-format-nonliteral -Wno-missing-field-initializers>
    # GCC 12 and 13 report overlapping copies inside std::string that do not exist (GCC bug 105651).
    $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict>)
  if(CONELIGHT_WERROR)
    # What GCC's optimiser guesses differs from version to version and is often wrong: shown, but no error.
    target_compile_options(${target} PRIVATE
      $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-Werror>
      $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-error=maybe-uninitialized -Wno-error=array-bounds
        -Wno-error=stringop-overflow -Wno-error=stringop-overread -Wno-error=free-nonheap-object>)
  endif()
  if(CONELIGHT_SANITIZE)
    # Instrumented, std::function and std::regex look uninitialised to GCC.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-maybe-uninitialized>)
    target_compile_options(${target} PUBLIC -fsanitize=address,undefined -fno-sanitize-recover=all
      -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(CONELIGHT_SANITIZE_THREADS)
    target_compile_options(${target} PUBLIC -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=thread)
  endif()
  if(CONELIGHT_FUZZ)
    # Clang 14 cannot compile coroutines with its check of functions' types (llvm-project issue 49689).
    target_compile_options(${target} PUBLIC -fsanitize=fuzzer-no-link -fno-sanitize=function)
  endif()
endfunction()

# conelight_keep_libraries(TARGET): under sanitizers, a program whose leak report names the drivers' libraries
# (tools/keep_libraries.cpp).
function(conelight_keep_libraries target)
  if(CONELIGHT_SANITIZE)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tools/keep_libraries.cpp)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/tools/keep_libraries.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()
