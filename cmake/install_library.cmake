# Installs the shared and the static library, the public headers, and the files by which other projects find them: a CMake package and a
# pkg-config file.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/corpuscle)

install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set_target_properties(corpuscle PROPERTIES EXPORT_NAME static)
install(TARGETS corpuscle EXPORT corpuscle-static-targets)
install(EXPORT corpuscle-static-targets NAMESPACE corpuscle:: DESTINATION ${package_folder})
if(TARGET corpuscle_shared)
  set_target_properties(corpuscle_shared PROPERTIES EXPORT_NAME corpuscle)
  install(TARGETS corpuscle_shared EXPORT corpuscle-shared-targets)
  install(EXPORT corpuscle-shared-targets NAMESPACE corpuscle:: DESTINATION ${package_folder})
endif()
configure_package_config_file(cmake/corpuscle-config.cmake.in corpuscle-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(corpuscle-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/corpuscle-config.cmake ${PROJECT_BINARY_DIR}/corpuscle-config-version.cmake DESTINATION ${package_folder})

# The pkg-config file has the prefix of the installation (cmake --install --prefix), so it is written when that is known.
set(settings "")
foreach(name CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR PROJECT_DESCRIPTION PROJECT_VERSION)
  string(APPEND settings "set(${name} \"${${name}}\")\n")
endforeach()
install(CODE "${settings}configure_file(${PROJECT_SOURCE_DIR}/cmake/corpuscle.pc.in ${PROJECT_BINARY_DIR}/corpuscle.pc @ONLY)")
install(FILES ${PROJECT_BINARY_DIR}/corpuscle.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
