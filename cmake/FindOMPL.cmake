# OMPL, as Debian installs it: its own configuration wants libraries that we do not use. Defines
# OMPL::ompl.
file(GLOB _versions "/usr/include/ompl-*" "/usr/local/include/ompl-*")
find_path(OMPL_INCLUDE_DIR ompl/config.h PATHS ${_versions})
find_library(OMPL_LIBRARY ompl)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OMPL REQUIRED_VARS OMPL_LIBRARY OMPL_INCLUDE_DIR)

if(OMPL_FOUND AND NOT TARGET OMPL::ompl)
  add_library(OMPL::ompl UNKNOWN IMPORTED)
  set_target_properties(
    OMPL::ompl
    PROPERTIES IMPORTED_LOCATION "${OMPL_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${OMPL_INCLUDE_DIR}"
               INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OMPL_INCLUDE_DIR}")
endif()
