# Installs the package configuration, so that find_package(sketchloc) works.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sketchloc)

configure_package_config_file(cmake/sketchlocConfig.cmake.in sketchlocConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(sketchlocConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sketchlocConfig.cmake
              ${PROJECT_BINARY_DIR}/sketchlocConfigVersion.cmake cmake/FindOpenCVModules.cmake
              cmake/FindCHOLMOD.cmake cmake/FindOMPL.cmake
        DESTINATION ${package_dir})
install(EXPORT sketchloc-targets NAMESPACE sketchloc:: DESTINATION ${package_dir})
