# What `wedge bench converge` measures with: a part on top of the library, so that tests can link it.
if(WEDGE_WITH_IMAGE)
    file(GLOB converge_sources CONFIGURE_DEPENDS bench/converge/*.cpp bench/baselines/*.cpp
        bench/peers/*.cpp bench/stability/*.cpp)
    add_library(wedge_converge STATIC ${converge_sources})
    target_link_libraries(wedge_converge PUBLIC wedge wedge_options wedge_dep_glm wedge_dep_fmt
        wedge_dep_json wedge_dep_opencl_hpp)
    target_compile_definitions(wedge_converge PRIVATE WEDGE_PEERS_DIR="${PROJECT_SOURCE_DIR}/bench/peers")
    set(commit_header ${PROJECT_BINARY_DIR}/generated/wedge_commit.hpp)
    add_custom_target(wedge_commit BYPRODUCTS ${commit_header}
        COMMAND ${CMAKE_COMMAND} -DOUT=${commit_header} -DROOT=${PROJECT_SOURCE_DIR}
                -P ${PROJECT_SOURCE_DIR}/cmake/Commit.cmake)
    add_dependencies(wedge_converge wedge_commit)
    target_include_directories(wedge_converge PRIVATE ${PROJECT_BINARY_DIR}/generated)
endif()

# The command-line program, `wedge`, with what it measures.
file(GLOB cli_sources CONFIGURE_DEPENDS host/cli/*.cpp bench/*.cpp)
if(NOT WEDGE_WITH_IMAGE)
    list(REMOVE_ITEM cli_sources ${PROJECT_SOURCE_DIR}/host/cli/compare.cpp
        ${PROJECT_SOURCE_DIR}/host/cli/bench_converge.cpp
        ${PROJECT_SOURCE_DIR}/host/cli/bench_options.cpp
        ${PROJECT_SOURCE_DIR}/host/cli/bench_peers.cpp
        ${PROJECT_SOURCE_DIR}/host/cli/bench_stability.cpp)
endif()
add_executable(wedge_program ${cli_sources})
set_target_properties(wedge_program PROPERTIES OUTPUT_NAME wedge)
target_link_libraries(wedge_program PRIVATE wedge wedge_options wedge_dep_glm wedge_dep_fmt
    wedge_dep_json wedge_dep_cli11 wedge_dep_opencl_hpp)
if(WEDGE_WITH_IMAGE)
    target_link_libraries(wedge_program PRIVATE wedge_converge)
    file(RELATIVE_PATH to_codec /${CMAKE_INSTALL_BINDIR} /${WEDGE_CODEC_DIR})
    set_target_properties(wedge_program PROPERTIES
        BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN;$ORIGIN/${to_codec}")
endif()
if(TBB_FOUND)
    target_compile_definitions(wedge_program PRIVATE WEDGE_HAVE_TBB)
endif()
if(WEDGE_WITH_EMBREE)
    find_package(embree 3 QUIET)
    if(embree_FOUND)
        target_compile_definitions(wedge_program PRIVATE WEDGE_HAVE_EMBREE)
        target_link_libraries(wedge_program PRIVATE embree)
    endif()
endif()
