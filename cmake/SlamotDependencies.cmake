# What slamot needs from the system. Read by the build and, installed, by find_package(slamot).
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(ZLIB REQUIRED)
foreach(module math poses random config system io serialization bayes obs opengl maps)
  find_package(mrpt-${module} REQUIRED)
endforeach()
