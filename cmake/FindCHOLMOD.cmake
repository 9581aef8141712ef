# CHOLMOD of SuiteSparse, as Debian installs it. Defines CHOLMOD::cholmod.
find_path(CHOLMOD_INCLUDE_DIR suitesparse/cholmod.h)
find_library(CHOLMOD_LIBRARY cholmod)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::cholmod)
  add_library(CHOLMOD::cholmod UNKNOWN IMPORTED)
  set_target_properties(
    CHOLMOD::cholmod
    PROPERTIES IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}"
               INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
