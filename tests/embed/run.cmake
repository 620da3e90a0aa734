# Script: installs the build at BUILD_DIR to a fresh prefix, then builds and runs foreign programs against it, all below
# WORK_DIR: by CMake with static and with shared libraries, by pkg-config, in C++ and in C. All draw the same picture and
# must write the same bytes. Fails with the output of the step that failed.
#   cmake -DBUILD_DIR=... -DLIBDIR=lib -DWORK_DIR=... -DSOURCE_DIR=... -DCXX=... -DCC=... -P run.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
set(here ${CMAKE_CURRENT_LIST_DIR})
set(example ${SOURCE_DIR}/examples/03_from_c.c)
function(step name)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "embed: ${name} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

step(install ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

# Nothing but the public headers may be installed, and all of them.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*)
foreach(header IN LISTS headers)
  if(NOT header MATCHES "^conelight(\\.h|/light_field\\.glsl|/(thesis/|io/|platform/)?[a-z_]+\\.h)$")
    message(FATAL_ERROR "embed: ${header} is installed, but is no public header")
  endif()
endforeach()
foreach(header conelight.h conelight/renderer.h conelight/light_field.glsl conelight/thesis/thesis.h conelight/io/scene_file.h conelight/platform/headless_context.h)
  if(NOT header IN_LIST headers)
    message(FATAL_ERROR "embed: ${header} is not installed")
  endif()
endforeach()

# With the program comes what shells and desktops know of it.
if(EXISTS ${prefix}/bin/conelight)
  foreach(file bash-completion/completions/conelight zsh/site-functions/_conelight fish/vendor_completions.d/conelight.fish
      man/man1/conelight.1 applications/conelight.desktop mime/packages/conelight.xml
      thumbnailers/conelight.thumbnailer icons/hicolor/scalable/apps/conelight.svg doc/conelight/docs/guide/viewer.md)
    if(NOT EXISTS ${prefix}/share/${file})
      message(FATAL_ERROR "embed: share/${file} is not installed")
    endif()
  endforeach()
endif()

# symbols(LIBRARY): what a shared library gives, in `output`. Nothing of namespaces that are not public.
function(symbols library)
  step("nm of ${library}" nm -D --defined-only --demangle ${prefix}/${LIBDIR}/lib${library}.so)
  string(REGEX MATCHALL "conelight::[a-z0-9_]+::" namespaces "${output}")
  list(REMOVE_DUPLICATES namespaces)
  list(REMOVE_ITEM namespaces conelight::thesis:: conelight::io:: conelight::platform::)
  if(namespaces)
    message(FATAL_ERROR "embed: lib${library}.so gives symbols of ${namespaces}, which are not public")
  endif()
  if(NOT EXISTS ${prefix}/${LIBDIR}/lib${library}.so.0.1)
    message(FATAL_ERROR "embed: lib${library}.so has no versioned name")
  endif()
  step("readelf of ${library}" readelf -d ${prefix}/${LIBDIR}/lib${library}.so)
  if(NOT output MATCHES "soname: \\[lib${library}\\.so\\.0\\.1\\]")
    message(FATAL_ERROR "embed: lib${library}.so has another soname:\n${output}")
  endif()
endfunction()
find_program(NM nm)
find_program(READELF readelf)
if(NM AND READELF)
  foreach(library conelight conelight_headless conelight_io conelight_c)
    symbols(${library})
  endforeach()
endif()

# run(NAME PROGRAM): runs a program that writes the picture; every one must have the same bytes.
function(run name)
  step("run ${name}" ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${prefix}/${LIBDIR} ${ARGN} ${WORK_DIR}/${name}.pfm)
  message(STATUS "${name}: ${output}")
  if(NOT EXISTS ${WORK_DIR}/first.pfm)
    file(COPY_FILE ${WORK_DIR}/${name}.pfm ${WORK_DIR}/first.pfm)
  endif()
  step("compare ${name}" ${CMAKE_COMMAND} -E compare_files ${WORK_DIR}/${name}.pfm ${WORK_DIR}/first.pfm)
endfunction()

foreach(kind static shared)
  set(build ${WORK_DIR}/${kind})
  step("configure ${kind}" ${CMAKE_COMMAND} -S ${here}/project -B ${build} -G Ninja -DCMAKE_BUILD_TYPE=Release -DKIND=${kind}
    -DEXAMPLE=${example} -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_C_COMPILER=${CC})
  step("build ${kind}" ${CMAKE_COMMAND} --build ${build})
  run(cpp_${kind} ${build}/embed)
  run(c_${kind} ${build}/from_c)
  step("misuse ${kind}" ${build}/misuse)
  step("light_field ${kind}" ${build}/light_field)
  step("scenes ${kind}" ${build}/scenes ${WORK_DIR})
endforeach()

# In C alone, where pkg-config knows nothing of libepoxy.
step("configure C" ${CMAKE_COMMAND} -E env PKG_CONFIG_LIBDIR=${prefix}/${LIBDIR}/pkgconfig ${CMAKE_COMMAND} -S ${here}/c_project
  -B ${WORK_DIR}/c -G Ninja -DEXAMPLE=${example} -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${CC})
step("build C" ${CMAKE_COMMAND} --build ${WORK_DIR}/c)
run(c_alone ${WORK_DIR}/c/from_c)

# By pkg-config. Static: the same names, asked for as archives.
set(pkg_config ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${prefix}/${LIBDIR}/pkgconfig pkg-config)
step("pkg-config C" ${pkg_config} --cflags --libs conelight-c)
separate_arguments(flags UNIX_COMMAND "${output}")
step("compile C" ${CC} -std=c11 -Wall -Wextra -pedantic -Werror ${example} -o ${WORK_DIR}/pc_c ${flags})
run(pc_c ${WORK_DIR}/pc_c)
step("pkg-config C++" ${pkg_config} --cflags --libs conelight conelight-c epoxy)
separate_arguments(flags UNIX_COMMAND "${output}")
step("compile C++" ${CXX} -std=c++20 -O1 ${here}/project/main.cpp -o ${WORK_DIR}/pc_cpp ${flags})
run(pc_cpp ${WORK_DIR}/pc_cpp)
step("pkg-config static" ${pkg_config} --static --cflags --libs conelight-c)
string(REGEX REPLACE "-l(conelight[a-z_]*)" "-l:lib\\1.a" flags "${output}")
separate_arguments(flags UNIX_COMMAND "${flags}")
step("compile C static" ${CC} -std=c11 ${example} -o ${WORK_DIR}/pc_static ${flags})
run(pc_static ${WORK_DIR}/pc_static)

# Every header, first and alone, without a warning.
list(FILTER headers EXCLUDE REGEX "\\.glsl$")  # for host shaders
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  file(WRITE ${WORK_DIR}/headers/${name}.cpp "#include <${header}>\n")
  list(APPEND sources ${WORK_DIR}/headers/${name}.cpp)
endforeach()
step("headers" ${CXX} -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only -I${prefix}/include ${sources})

# Other layouts of GLM's types are refused by the compiler, in words.
file(WRITE ${WORK_DIR}/layout.cpp "#include <conelight/scene.h>\n")
execute_process(COMMAND ${CXX} -std=gnu++20 -DGLM_FORCE_INTRINSICS -DGLM_FORCE_DEFAULT_ALIGNED_GENTYPES -fsyntax-only
  -I${prefix}/include ${WORK_DIR}/layout.cpp RESULT_VARIABLE status ERROR_VARIABLE output)
if(status EQUAL 0 OR NOT output MATCHES "do not define GLM_FORCE_DEFAULT_ALIGNED_GENTYPES")
  message(FATAL_ERROR "embed: aligned types of GLM are not refused:\n${output}")
endif()

# As a part of another project.
step("sub-project" ${CMAKE_COMMAND} -S ${here}/subproject -B ${WORK_DIR}/subproject -G Ninja -DCONELIGHT=${SOURCE_DIR}
  -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_C_COMPILER=${CC})
