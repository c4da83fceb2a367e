# Install rules and the package configuration behind find_package(aureole).
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/aureole)
set(shader_dir ${CMAKE_INSTALL_DATADIR}/aureole/shaders)

install(TARGETS aureole EXPORT aureoleTargets)
install(EXPORT aureoleTargets NAMESPACE aureole:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/aureoleConfig.cmake.in
    ${PROJECT_BINARY_DIR}/aureoleConfig.cmake INSTALL_DESTINATION ${package_dir}
    PATH_VARS shader_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/aureoleConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
# GLSL to include, by its path below that folder: ibl/dominant_direction.glsl.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/ DESTINATION ${shader_dir})
install(FILES ${PROJECT_BINARY_DIR}/aureoleConfig.cmake
              ${PROJECT_BINARY_DIR}/aureoleConfigVersion.cmake DESTINATION ${package_dir})
