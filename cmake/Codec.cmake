# The module that reads and writes image files, the only thing that links OpenImageIO. The library loads
# it by name when the first image is read or written (host/image/codec.hpp), by way of the program's run
# path: here the build folder, after installation WEDGE_CODEC_DIR. Its name has the version, so that one of
# another version is missing before a render, not after it.
file(GLOB codec_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/host/codec/*.cpp)
add_library(wedge_codec MODULE ${codec_sources})
set(WEDGE_CODEC_NAME libwedge_codec-${PROJECT_VERSION})
set_target_properties(wedge_codec PROPERTIES PREFIX "" OUTPUT_NAME ${WEDGE_CODEC_NAME})
target_compile_definitions(wedge_image PRIVATE
    WEDGE_CODEC_FILE="${WEDGE_CODEC_NAME}${CMAKE_SHARED_MODULE_SUFFIX}")
target_include_directories(wedge_codec PRIVATE
    $<TARGET_PROPERTY:wedge_image,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(wedge_codec PRIVATE wedge_options wedge_dep_fmt OpenImageIO::OpenImageIO)
list(APPEND CMAKE_BUILD_RPATH $<TARGET_FILE_DIR:wedge_codec>)
