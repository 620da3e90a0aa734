# Installs the published libraries with their public headers, package files for find_package(conelight) and pkg-config, and
# the program. Components: runtime (shared libraries), development, program.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/conelight)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
foreach(set core io)
  foreach(kind static shared)
    get_property(targets GLOBAL PROPERTY CONELIGHT_PUBLISHED_${set}_${kind})
    if(targets)
      install(TARGETS ${targets} EXPORT conelight-${set}-${kind} LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
      install(EXPORT conelight-${set}-${kind} NAMESPACE conelight:: DESTINATION ${package})
      if(TARGET conelight_program)
        add_dependencies(conelight_program ${targets})  # `scripts/build` builds what is installed
      endif()
    endif()
  endforeach()
endforeach()
# Where Debian looks for it, once a package (cmake/Package.cmake).
set(doc ${CMAKE_INSTALL_DATAROOTDIR}/doc)
set(runtime_package libconelight${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(FILES LICENSE DESTINATION ${doc}/${runtime_package} RENAME copyright COMPONENT runtime)
install(FILES LICENSE DESTINATION ${doc}/libconelight-dev RENAME copyright COMPONENT development)
if(CONELIGHT_BUILD_IO)
  install(FILES include/conelight.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
install(DIRECTORY include/conelight modes/thesis/include/conelight ${PROJECT_BINARY_DIR}/include/conelight
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
get_property(conelight_decoders GLOBAL PROPERTY CONELIGHT_DECODERS)
configure_package_config_file(cmake/conelightConfig.cmake.in ${PROJECT_BINARY_DIR}/conelightConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/conelightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/conelightConfig.cmake ${PROJECT_BINARY_DIR}/conelightConfigVersion.cmake
  DESTINATION ${package})
if(TARGET conelight_program)
  install(TARGETS conelight_program COMPONENT program)
  install(FILES LICENSE DESTINATION ${doc}/conelight RENAME copyright COMPONENT program)
endif()

# pkg-config. What static libraries need stands in Libs.private, not in Requires.private: with the shared ones nobody needs
# its development files.
file(RELATIVE_PATH pc_up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" pc_up ${pc_up})
# What is not named is empty.
function(conelight_install_pkgconfig name)
  cmake_parse_arguments(PARSE_ARGV 1 pc "" "description;requires;libs;private" "")
  set(pc_name ${name})
  configure_file(cmake/pkgconfig.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
conelight_install_pkgconfig(conelight description "Global illumination in real time: the renderer" requires glm
  libs -lconelight private "-lepoxy -lstdc++ -lm -ldl")
conelight_install_pkgconfig(conelight-headless description "Conelight: OpenGL contexts without a display"
  requires conelight libs -lconelight_headless)
if(CONELIGHT_BUILD_IO)
  set(io_libraries "-lassimp -lOpenEXR -lIex -lImath -lpng -ljpeg -lfmt")
  foreach(decoder IN LISTS conelight_decoders)
    string(APPEND io_libraries " -l${decoder}")
  endforeach()
  conelight_install_pkgconfig(conelight-io description "Conelight: scenes and pictures in files" requires conelight
    libs -lconelight_io private "${io_libraries}")
  conelight_install_pkgconfig(conelight-c description "Conelight for C" libs -lconelight_c
    private "-lconelight_io -lconelight_headless -lconelight ${io_libraries} -lepoxy -lstdc++ -lm -ldl")
endif()
