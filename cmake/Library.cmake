# sketchloc_library(<folder-name> SOURCES ... [PUBLIC targets...] [PRIVATE targets...])
# One target per folder with the alias sketchloc::<name>; warnings are private to us.
include(GNUInstallDirs)

function(sketchloc_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                                           $<$<BOOL:${SKETCHLOC_WERROR}>:-Werror>)
endfunction()

function(sketchloc_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target sketchloc_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(sketchloc::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
                                             CXX_EXTENSIONS OFF)
  target_compile_features(${target} PUBLIC cxx_std_20)
  file(GLOB headers CONFIGURE_DEPENDS *.hpp detail/*.hpp)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  sketchloc_warnings(${target})
  install(TARGETS ${target} EXPORT sketchloc-targets
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sketchloc)
endfunction()

# sketchloc_test(<folder> SOURCES ... LINK ...): one test binary per folder.
function(sketchloc_test folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  set(target ${folder}_test)
  add_executable(${target} ${ARG_SOURCES})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_link_libraries(${target} PRIVATE ${ARG_LINK} sketchloc_test_support GTest::gmock
                                          GTest::gtest_main)
  sketchloc_warnings(${target})
  # Suites named Statistical* and EndToEnd* carry their label; all others are unit tests.
  gtest_discover_tests(${target} TEST_FILTER "-*Statistical*:*EndToEnd*" PROPERTIES LABELS unit
                       DISCOVERY_TIMEOUT 60)
  gtest_discover_tests(${target} TEST_FILTER "*Statistical*" PROPERTIES LABELS statistical
                       DISCOVERY_TIMEOUT 60)
  gtest_discover_tests(${target} TEST_FILTER "*EndToEnd*" PROPERTIES LABELS end_to_end
                       DISCOVERY_TIMEOUT 60)
endfunction()

# sketchloc_vector_sources(<sources...>): kernels written with Highway. They give the same bits on
# every processor, so no fused multiply-add behind our back; HWY_WANT_AVX3_DL asks for the
# instruction set that has 128-byte table look-ups (VBMI).
function(sketchloc_vector_sources)
  set_source_files_properties(${ARGV} PROPERTIES COMPILE_OPTIONS -ffp-contract=off
                                                 COMPILE_DEFINITIONS HWY_WANT_AVX3_DL)
endfunction()
