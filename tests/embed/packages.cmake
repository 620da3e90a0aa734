# Script: makes the Debian packages of the build at BUILD_DIR, checks what is in them and what they depend on, unpacks them to
# a folder below WORK_DIR (nothing is installed on this machine), and builds and runs a program in C against that folder.
# Prints "skipped" and ends with 0 where dpkg is not there.
#   cmake -DBUILD_DIR=... -DWORK_DIR=... -DSOURCE_DIR=... -DCC=... -DLIBDIR=lib -P packages.cmake
cmake_minimum_required(VERSION 3.25)
find_program(DPKG_DEB dpkg-deb)
find_program(SHLIBDEPS dpkg-shlibdeps)
find_program(PKG_CONFIG pkg-config)
if(NOT DPKG_DEB OR NOT SHLIBDEPS OR NOT PKG_CONFIG)
  message(STATUS "packages: skipped: dpkg-deb, dpkg-shlibdeps or pkg-config is not installed")
  return()
endif()
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
function(step name)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "packages: ${name} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

step(cpack ${CMAKE_CPACK_COMMAND} -G DEB --config ${BUILD_DIR}/CPackConfig.cmake -B ${WORK_DIR}/deb)

# check(PACKAGE DEPENDS files...): the package is there, depends on each of DEPENDS and has the files; it is unpacked.
function(check package depends)
  file(GLOB deb ${WORK_DIR}/deb/${package}_*.deb)
  list(LENGTH deb count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "packages: there are ${count} packages ${package}")
  endif()
  step("fields of ${package}" ${DPKG_DEB} -f ${deb} Depends)
  foreach(wanted IN LISTS depends)
    if(NOT output MATCHES "(^|, )${wanted}( |,|\n|$)")
      message(FATAL_ERROR "packages: ${package} does not depend on ${wanted}, but on ${output}")
    endif()
  endforeach()
  step("contents of ${package}" ${DPKG_DEB} -c ${deb})
  foreach(wanted usr/share/doc/${package}/copyright ${ARGN})
    if(NOT output MATCHES "\\./${wanted}( ->[^\n]*)?\n")
      message(FATAL_ERROR "packages: ${package} has no ${wanted}:\n${output}")
    endif()
  endforeach()
  set(output "${output}" PARENT_SCOPE)
  execute_process(COMMAND ${DPKG_DEB} -x ${deb} ${WORK_DIR}/root COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(lib usr/${LIBDIR})
check(libconelight0.1 "libepoxy0;libassimp5[^ ,]*;libstdc\\+\\+6;libc6" ${lib}/libconelight.so.0.1 ${lib}/libconelight_c.so.0.1
  ${lib}/libconelight_io.so.0.1 ${lib}/libconelight_headless.so.0.1)
if(output MATCHES "\\.h\n|\\.a\n|\\.so ->")
  message(FATAL_ERROR "packages: libconelight0.1 has files for development:\n${output}")
endif()
check(libconelight-dev "libconelight0.1;libglm-dev" usr/include/conelight.h usr/include/conelight/renderer.h
  usr/include/conelight/io/scene_file.h ${lib}/libconelight.a ${lib}/libconelight.so ${lib}/pkgconfig/conelight.pc
  ${lib}/pkgconfig/conelight-c.pc ${lib}/cmake/conelight/conelightConfig.cmake)
check(conelight "libepoxy0;libglfw3;libembree[^ ,]*" usr/bin/conelight
  usr/share/bash-completion/completions/conelight usr/share/man/man1/conelight.1 usr/share/applications/conelight.desktop usr/share/mime/packages/conelight.xml
  usr/share/thumbnailers/conelight.thumbnailer usr/share/doc/conelight/docs/guide/viewer.md)
step("the program" ${WORK_DIR}/root/usr/bin/conelight --version)

set(root ${WORK_DIR}/root/usr)
step(pkg-config ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${root}/${LIBDIR}/pkgconfig pkg-config --cflags --libs conelight-c)
separate_arguments(flags UNIX_COMMAND "${output}")
step(compile ${CC} -std=c11 ${SOURCE_DIR}/examples/03_from_c.c -o ${WORK_DIR}/from_c ${flags})
step(run ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${root}/${LIBDIR} ${WORK_DIR}/from_c ${WORK_DIR}/picture.pfm)
