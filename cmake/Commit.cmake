# conelight_commit(TARGET HEADER): a header in the build folder with CONELIGHT_COMMIT, the commit that the sources
# are of ("-dirty" behind it when files differ; "" outside of a Git checkout). Looked up at each build, and written
# only when it has changed.
function(conelight_commit target header)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/commit)
  add_custom_target(${target}_commit BYPRODUCTS ${folder}/${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${folder}/${header}
      -P ${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake
    COMMENT "" VERBATIM)
  add_dependencies(${target} ${target}_commit)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
