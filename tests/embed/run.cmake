# Script: installs the build at BUILD_DIR to a fresh prefix, then configures, builds and runs the foreign project
# beside this file against it, all below WORK_DIR. Fails with the output of the step that failed.
#   cmake -DBUILD_DIR=... -DWORK_DIR=... -DCXX=... -P run.cmake
file(REMOVE_RECURSE ${WORK_DIR})
function(step name)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "embed: ${name} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

step(install ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)

# Nothing but the public headers may be installed.
file(GLOB_RECURSE headers RELATIVE ${WORK_DIR}/prefix/include ${WORK_DIR}/prefix/include/*)
foreach(header IN LISTS headers)
  if(NOT header MATCHES "^conelight/(thesis/)?[a-z_]+\\.h$")
    message(FATAL_ERROR "embed: ${header} is installed, but is no public header")
  endif()
endforeach()

# With the program comes what shells and desktops know of it.
if(EXISTS ${WORK_DIR}/prefix/bin/conelight)
  foreach(file bash-completion/completions/conelight zsh/site-functions/_conelight fish/vendor_completions.d/conelight.fish
      man/man1/conelight.1 applications/conelight.desktop mime/packages/conelight.xml
      icons/hicolor/scalable/apps/conelight.svg)
    if(NOT EXISTS ${WORK_DIR}/prefix/share/${file})
      message(FATAL_ERROR "embed: share/${file} is not installed")
    endif()
  endforeach()
endif()

step(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${WORK_DIR}/build -G Ninja
     -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${CXX})
step(build ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
step(run ${WORK_DIR}/build/embed)
message(STATUS "${output}")
