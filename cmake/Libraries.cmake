# What hosts link. Inside, libraries are static: the program and the tests see all of their symbols. A host gets
# libraries made of the same objects, static and shared, of which the shared ones give only what CONELIGHT_API marks
# (include/conelight/export.h). conelight::NAME is the kind that BUILD_SHARED_LIBS asks for.

# conelight_hide_symbols(TARGET): for libraries whose objects become part of a shared one.
function(conelight_hide_symbols target)
  set_target_properties(${target} PROPERTIES C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# conelight_stage_headers(FOLDER HEADER...): makes headers of the sources public as <conelight/FOLDER/...>, for hosts
# that build us in their project and for the installation. They may include public headers, and each other as "FOLDER/...".
function(conelight_stage_headers folder)
  foreach(header IN LISTS ARGN)
    get_filename_component(name ${header} NAME)
    file(READ ${header} text)
    string(REPLACE "#include \"${folder}/" "#include \"conelight/${folder}/" text "${text}")
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/conelight/${folder}/${name} CONTENT "${text}" @ONLY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  endforeach()
endfunction()

# conelight_publish(NAME SET set FROM target... [LINK library...] [USE library...]): the libraries conelight_NAME_static and
# _shared out of the objects of our targets FROM. LINK: published names that its headers need; USE: that it needs itself.
# SET: export set (cmake/Install.cmake).
function(conelight_publish name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SET" "FROM;LINK;USE")
  set(output conelight_${name})
  if(name STREQUAL conelight)
    set(output conelight)
  endif()
  set(objects "")
  set(privates "")
  foreach(target IN LISTS arg_FROM)
    list(APPEND objects $<TARGET_OBJECTS:${target}>)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    list(APPEND privates ${libraries})
  endforeach()
  list(FILTER privates EXCLUDE REGEX "^(conelight|glm::glm)")
  list(REMOVE_DUPLICATES privates)
  foreach(kind static shared)
    string(TOUPPER ${kind} type)
    set(target conelight_${name}_${kind})
    add_library(${target} ${type} ${objects})
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${output} EXPORT_NAME ${name} LINKER_LANGUAGE CXX
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN"
      ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
    target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
    list(TRANSFORM arg_LINK REPLACE "(.+)" "conelight_\\1_${kind}" OUTPUT_VARIABLE links)
    list(TRANSFORM arg_USE REPLACE "(.+)" "conelight_\\1_${kind}" OUTPUT_VARIABLE uses)
    target_link_libraries(${target} PUBLIC ${links} PRIVATE ${uses} ${privates})
    conelight_warnings(${target})
    set_property(GLOBAL APPEND PROPERTY CONELIGHT_PUBLISHED_${arg_SET}_${kind} ${target})
    if(NOT CONELIGHT_INSTALL)
      set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  endforeach()
  if(NOT CONELIGHT_SANITIZE AND NOT CONELIGHT_SANITIZE_THREADS AND NOT CONELIGHT_FUZZ AND NOT APPLE)
    target_link_options(conelight_${name}_shared PRIVATE -Wl,--no-undefined)
  endif()
  if(BUILD_SHARED_LIBS)
    add_library(conelight::${name} ALIAS conelight_${name}_shared)
  else()
    add_library(conelight::${name} ALIAS conelight_${name}_static)
  endif()
endfunction()

# conelight_publish_all(): the libraries of this project. Call it behind the folders.
function(conelight_publish_all)
  conelight_publish(conelight SET core FROM conelight conelight_thesis)
  foreach(kind static shared)
    target_compile_features(conelight_conelight_${kind} INTERFACE cxx_std_20)
    target_link_libraries(conelight_conelight_${kind} INTERFACE glm::glm)
    add_library(conelight_guest_${kind} INTERFACE)  # the guest is in the library: a name for hosts that link it
    set_target_properties(conelight_guest_${kind} PROPERTIES EXPORT_NAME thesis)
    target_link_libraries(conelight_guest_${kind} INTERFACE conelight_conelight_${kind})
    target_include_directories(conelight_conelight_${kind} INTERFACE
      $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/modes/thesis/include>)
    set_property(GLOBAL APPEND PROPERTY CONELIGHT_PUBLISHED_core_${kind} conelight_guest_${kind})
  endforeach()
  if(BUILD_SHARED_LIBS)
    add_library(conelight::thesis ALIAS conelight_guest_shared)
  else()
    add_library(conelight::thesis ALIAS conelight_guest_static)
  endif()
  conelight_publish(headless SET core FROM conelight_headless LINK conelight)
  if(CONELIGHT_BUILD_IO)
    conelight_publish(io SET io FROM conelight_io LINK conelight)
    conelight_publish(c SET io FROM conelight_c USE io headless conelight)
  endif()
endfunction()
