# `cmake --install`: the program, the library with its headers, scenes and documents; and a package, so
# that another project says find_package(wedge) and links wedge::wedge.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wedge)
set(data_dir ${CMAKE_INSTALL_DATADIR}/wedge)

target_compile_features(wedge PUBLIC cxx_std_20)
install(TARGETS wedge EXPORT wedge_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS wedge_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(WEDGE_WITH_IMAGE)
    install(TARGETS wedge_codec LIBRARY DESTINATION ${WEDGE_CODEC_DIR})
endif()
install(DIRECTORY include/wedge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(DIRECTORY scenes/ DESTINATION ${data_dir}/scenes
    FILES_MATCHING PATTERN "*.json" PATTERN "generators" EXCLUDE)
install(DIRECTORY bench/peers/ DESTINATION ${data_dir}/peers FILES_MATCHING PATTERN "*.py")
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT wedge_targets NAMESPACE wedge:: DESTINATION ${package_dir})
configure_package_config_file(cmake/wedge-config.cmake.in
    ${PROJECT_BINARY_DIR}/wedge-config.cmake INSTALL_DESTINATION ${package_dir} PATH_VARS WEDGE_CODEC_DIR)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wedge-config-version.cmake
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/wedge-config.cmake
    ${PROJECT_BINARY_DIR}/wedge-config-version.cmake
    DESTINATION ${package_dir})
