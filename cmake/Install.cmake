# Installs the public headers, the library, its guests and a package file for find_package(conelight).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
install(TARGETS conelight conelight_thesis EXPORT conelightTargets)
install(DIRECTORY include/conelight modes/thesis/include/conelight DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT conelightTargets NAMESPACE conelight:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/conelight)
configure_package_config_file(cmake/conelightConfig.cmake.in ${PROJECT_BINARY_DIR}/conelightConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/conelight)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/conelightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/conelightConfig.cmake ${PROJECT_BINARY_DIR}/conelightConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/conelight)
if(TARGET conelight_program)
  install(TARGETS conelight_program)
endif()
