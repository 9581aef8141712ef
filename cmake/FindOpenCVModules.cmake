# OpenCV by module, so that only the small packages are needed (Debian's libopencv-dev brings
# a desktop toolkit along). Defines opencv::<module> for each component asked for.
find_path(OpenCVModules_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(_required OpenCVModules_INCLUDE_DIR)
foreach(_module IN LISTS OpenCVModules_FIND_COMPONENTS)
  find_library(OpenCVModules_${_module}_LIBRARY opencv_${_module})
  list(APPEND _required OpenCVModules_${_module}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVModules REQUIRED_VARS ${_required})

if(OpenCVModules_FOUND)
  foreach(_module IN LISTS OpenCVModules_FIND_COMPONENTS)
    if(NOT TARGET opencv::${_module})
      add_library(opencv::${_module} UNKNOWN IMPORTED)
      set_target_properties(
        opencv::${_module}
        PROPERTIES IMPORTED_LOCATION "${OpenCVModules_${_module}_LIBRARY}"
                   INTERFACE_INCLUDE_DIRECTORIES "${OpenCVModules_INCLUDE_DIR}"
                   INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OpenCVModules_INCLUDE_DIR}")
    endif()
  endforeach()
endif()
