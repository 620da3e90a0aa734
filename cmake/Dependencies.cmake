# Everything we link is a system package (Debian names in scripts/install_packages).
find_package(PkgConfig REQUIRED)
find_package(glm REQUIRED)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
if(CONELIGHT_BUILD_PROGRAM)
  find_package(assimp REQUIRED)
  find_package(OpenEXR REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(embree REQUIRED)  # 3 (Debian 12) or 4
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(Threads REQUIRED)
  find_path(STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb REQUIRED)
endif()
