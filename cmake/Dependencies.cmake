# Everything Wedge builds on. Header-only packages are looked for by header, so that a machine with
# nothing but OpenCL can take them from any folder named in WEDGE_DEPS_DIR.
set(WEDGE_DEPS_DIR "" CACHE PATH "Folder with an include/ of header-only dependencies")

function(wedge_header_library name header package)
    find_path(WEDGE_${name}_INCLUDE ${header} HINTS ${WEDGE_DEPS_DIR}/include)
    if(NOT WEDGE_${name}_INCLUDE)
        message(FATAL_ERROR "Cannot find ${header}. On Debian: apt-get install ${package}")
    endif()
    add_library(wedge_dep_${name} INTERFACE)
    target_include_directories(wedge_dep_${name} SYSTEM INTERFACE
        $<BUILD_INTERFACE:${WEDGE_${name}_INCLUDE}>)
endfunction()

wedge_header_library(glm glm/glm.hpp libglm-dev)
wedge_header_library(fmt fmt/format.h libfmt-dev)
find_package(fmt CONFIG QUIET)
if(fmt_FOUND)
    # Compiled: header-only, it is two thirds of the time that most files take to compile.
    target_link_libraries(wedge_dep_fmt INTERFACE fmt::fmt)
else()
    target_compile_definitions(wedge_dep_fmt INTERFACE FMT_HEADER_ONLY)
endif()
wedge_header_library(json nlohmann/json.hpp nlohmann-json3-dev)
wedge_header_library(tinyobj tiny_obj_loader.h libtinyobjloader-dev)
wedge_header_library(cli11 CLI/CLI.hpp libcli11-dev)
if(WEDGE_BUILD_TESTS)
    wedge_header_library(doctest doctest/doctest.h doctest-dev)
endif()
wedge_header_library(opencl_hpp CL/opencl.hpp opencl-clhpp-headers)
target_compile_definitions(wedge_dep_opencl_hpp INTERFACE
    CL_TARGET_OPENCL_VERSION=120
    CL_HPP_TARGET_OPENCL_VERSION=120
    CL_HPP_MINIMUM_OPENCL_VERSION=120
    CL_HPP_ENABLE_EXCEPTIONS)

find_package(OpenCL REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB CONFIG QUIET)
if(WEDGE_WITH_IMAGE)
    find_package(OpenImageIO REQUIRED)
    # Debian 12's exported target names folders of headers that its package does not depend on
    # (OpenCV's), and CMake refuses targets with folders that are not there.
    get_target_property(listed OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
    set(existing "")
    foreach(folder IN LISTS listed)
        if(EXISTS "${folder}")
            list(APPEND existing "${folder}")
        endif()
    endforeach()
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${existing}")
endif()
