# What slamot needs from the system. Read by the build and, installed, by find_package(slamot).
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(ZLIB REQUIRED)
foreach(module math poses random config system io serialization bayes obs opengl maps slam)
  find_package(mrpt-${module} REQUIRED)
endforeach()
# OpenCV's modules one by one: its own CMake files come with all of them only.
find_path(SLAMOT_OPENCV_INCLUDE opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(module core imgproc calib3d imgcodecs)
  find_library(SLAMOT_OPENCV_${module} opencv_${module} REQUIRED)
  if(NOT TARGET slamot_opencv::${module})
    add_library(slamot_opencv::${module} UNKNOWN IMPORTED)
    set_target_properties(slamot_opencv::${module} PROPERTIES IMPORTED_LOCATION ${SLAMOT_OPENCV_${module}}
                          INTERFACE_INCLUDE_DIRECTORIES ${SLAMOT_OPENCV_INCLUDE})
  endif()
endforeach()
