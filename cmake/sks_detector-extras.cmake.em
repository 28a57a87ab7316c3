# The imported target sks_detector::core, for packages that prefer targets to catkin's variables.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
@[if DEVELSPACE]@
include("@(PROJECT_BINARY_DIR)/sks_detectorTargets.cmake")
@[else]@
include("${sks_detector_DIR}/sks_detectorTargets.cmake")
@[end if]@
